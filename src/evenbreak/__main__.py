"""Run the command line with `python -m evenbreak`."""

import contextlib
import sys
from pathlib import Path

# `python -m` looks for modules first in the working folder, where a file of data, or of somebody
# else, may have the name of one. It stays on the path if this package is there.
with contextlib.suppress(OSError):
    here = str(Path.cwd())
    if not sys.flags.safe_path and sys.path[0] == here != str(Path(__file__).parents[1]):
        del sys.path[0]

from evenbreak.cli import main

main()
