"""Run the command line with `python -m evenbreak`."""

from evenbreak.cli import main

main()
