"""The command line: thin click commands, one file for each.

Nothing is computed here. A command reads its options, puts the question to the rooms below
and returns their `Answer`, which `kit.faces` prints. `program` holds the program itself; a
command's module is imported only when that command runs.
"""

import atexit
import gc
import os
import sys

from evenbreak.cli.interrupts import INTERRUPTED, listen, stop_listening

_code: object = 0


def main() -> None:
    """Run the program with the command-line arguments, and exit."""
    global _code
    listen()
    atexit.register(_exit_if_interrupted)  # registered first, called last
    # What is made at the start lives to the end: collecting it would only cost time, now and
    # once more at exit.
    gc.set_threshold(100_000)
    # The program opens no window and writes no date, and matplotlib fails where these are wrong.
    for name in ("MPLBACKEND", "SOURCE_DATE_EPOCH"):
        os.environ.pop(name, None)
    try:
        from evenbreak.cli.program import program

        program()
    except KeyboardInterrupt:  # before the program could handle it
        if sys.stderr is not None:
            sys.stderr.write("Interrupted.\n")
        _code = INTERRUPTED
        sys.exit(INTERRUPTED)
    except SystemExit as end:
        _code = end.code
        raise
    finally:
        stop_listening()
        gc.freeze()


def _exit_if_interrupted() -> None:
    """Exit with the code for an interrupt, where Python would kill itself by a signal.

    Python does so after an interrupt in code run by `exec`, such as parts of an import, even
    if the interrupt was caught.
    """
    if _code == INTERRUPTED:
        if sys.stderr is not None:
            sys.stderr.flush()
        os._exit(INTERRUPTED)
