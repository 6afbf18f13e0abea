"""Where the bundled program starts: the command line, the page, a worker, or what reads a workbook.

Without an argument, as after a double click, it opens tonight's page; with the file of an evening
alone, as when one is dropped on it, the page of that.
"""

import multiprocessing
import os
import sys
from contextlib import suppress
from pathlib import Path

AS_READER = "--read-workbook"  # `evenbreak.files.tables.workbook.AS_READER`


def run() -> None:
    """Do what the words say."""
    # Other programs that are started, such as the browser, need the system's libraries, not ours.
    before = os.environ.pop("LD_LIBRARY_PATH_ORIG", None)
    os.environ.pop("LD_LIBRARY_PATH", None)
    if before is not None:
        os.environ["LD_LIBRARY_PATH"] = before
    words = sys.argv[1:]
    if words[:1] == [AS_READER]:
        from evenbreak.files.tables import workbook

        del sys.argv[1]
        workbook.main()
        return
    # What is dropped is a file by its whole path; `serve` says if it is none of an evening.
    dropped = len(words) == 1 and Path(words[0]).is_absolute() and Path(words[0]).exists()
    clicked = not words or dropped or (len(words) == 1 and words[0].lower().endswith(".db"))
    if clicked:
        sys.argv[1:] = ["serve", *words, "--open"]
    from evenbreak.cli import main

    try:
        main()
    except SystemExit as end:
        if clicked and end.code not in (0, None, 130) and sys.stdin and sys.stdin.isatty():
            with suppress(EOFError):  # of a terminal without a keyboard
                input("Press Enter to close this window. ")  # it would close before it is read
        raise


if __name__ == "__main__":
    multiprocessing.freeze_support()  # a worker process goes no further
    run()
