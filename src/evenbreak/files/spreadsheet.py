"""The sheets of a workbook (.xlsx or .ods) as rows of text, as a CSV file would have them."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import NamedTuple

from evenbreak.errors import DataError
from evenbreak.files import workbook

PATIENCE = 60.0
"""Seconds in which a workbook must have been read."""

_ZIP = b"PK\x03\x04"


class Sheet(NamedTuple):
    """The rows of a sheet that are not blank.

    Parameters
    ----------
    name
        what the sheet is called.
    lines
        the number of each row in the sheet, from 1.
    rows
        their cells as text.
    """

    name: str
    lines: list[int]
    rows: list[list[str]]


def is_spreadsheet(content: bytes) -> bool:
    """Return whether a file may be a workbook: a zip archive."""
    return content.startswith(_ZIP)


def sheets_of(content: bytes, source: str) -> list[Sheet]:
    """Return the visible sheets of a workbook that hold anything.

    Numbers are written as they are (1500, not 1500.0), dates as 2024-09-03, times of day as
    7:05, which is what a spreadsheet makes of a score of 7:5. It is read in a process of its own:
    one that asks for all the memory ends that process alone.

    Raises
    ------
    DataError
        if the file is no workbook, is damaged or locked, too large, or empty.
    """
    # -I and -S: nothing from the current folder or the environment is imported there.
    words = [sys.executable, "-I", "-S", workbook.__file__, str(workbook.MOST_MEMORY), *sys.path]
    try:
        done = subprocess.run(  # noqa: S603
            words, input=content, capture_output=True, timeout=PATIENCE, check=True
        )
        answer = json.loads(done.stdout)
    except (subprocess.SubprocessError, MemoryError):
        answer = {"problem": workbook.TOO_MUCH}
    except OSError as error:
        answer = {"problem": f"cannot be read now ({error.strerror}); try again"}
    if "problem" in answer:
        raise DataError([f"{source}: {answer['problem']}"])
    sheets = [Sheet(*sheet) for sheet in answer["sheets"] if sheet[2]]
    if not sheets:
        raise DataError([f"{source}: has no sheet with anything in it; write a header and rows"])
    return sheets
