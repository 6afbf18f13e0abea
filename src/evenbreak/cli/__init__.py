"""The command line: thin click commands, one file a command.

Nothing is computed here: a command reads what a person typed, asks the layers below,
and prints. `base` holds the program itself; a command's module is imported only when
that command runs.
"""

import atexit
import gc
import os
import sys

INTERRUPTED = 130

_code: object = 0


def main() -> None:
    """Run the program on the words of the command line, and exit."""
    global _code
    atexit.register(_end_of_interrupted)  # the first is called last, when all is cleared away
    # What a start makes lives to the end: the collector would look through it in vain
    # several times over, and once more when all is done while a person waits.
    gc.set_threshold(100_000)
    try:
        from evenbreak.cli.program import program

        program()
    except KeyboardInterrupt:  # before the program is there to take it
        sys.stderr.write("Interrupted.\n")
        _code = INTERRUPTED
        sys.exit(INTERRUPTED)
    except SystemExit as end:
        _code = end.code
        raise
    finally:
        gc.freeze()


def _end_of_interrupted() -> None:
    """End with the exit code where Python would end by a signal.

    It does so after an interrupt in what is run by `exec`, such as parts of an import, although
    somebody caught it.
    """
    if _code == INTERRUPTED:
        if sys.stderr is not None:
            sys.stderr.flush()
        os._exit(INTERRUPTED)
