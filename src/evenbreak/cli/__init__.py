"""The command line: thin click commands, one file a command.

Nothing is computed here: a command reads what a person typed, asks the layers below,
and prints. `base` holds the program itself; a command's module is imported only when
that command runs.
"""

import gc
import sys

__all__ = ["main"]


def main() -> None:
    """Run the program on the words of the command line, and exit."""
    # What a start makes lives to the end: the collector would look through it in vain
    # several times over, and once more when all is done while a person waits.
    gc.set_threshold(100_000)
    try:
        from evenbreak.cli.base import program

        program()
    except KeyboardInterrupt:  # before the program is there to take it
        sys.stderr.write("Interrupted.\n")
        sys.exit(130)
    finally:
        gc.freeze()
