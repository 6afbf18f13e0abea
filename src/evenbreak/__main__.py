"""Run the command line with `python -m evenbreak`."""

from evenbreak.cli.base import main

main()
