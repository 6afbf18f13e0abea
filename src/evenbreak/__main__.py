"""Run the command line with `python -m evenbreak`."""

import sys
from pathlib import Path

# `python -m` looks for modules in the working folder first, where a file of data, or of somebody
# else, may have the name of one; unless that is where this package is.
if not sys.flags.safe_path and Path.cwd() != Path(__file__).parents[1]:
    sys.path[:] = [place for place in sys.path if place not in ("", str(Path.cwd()))]

from evenbreak.cli import main

main()
