"""Files that come in by the page: read from a temporary place whose name is ours."""

from __future__ import annotations

import io
import re
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from evenbreak.errors import DataError
from evenbreak.files.lists.roster import RosterFile
from evenbreak.web.forms import Form
from evenbreak.web.refusals import RefusalError

_WORKBOOK = b"PK\x03\x04"
_MOST_UNPACKED = 50 << 20
_LONGEST_LIST = 200_000

Read = TypeVar("Read")


def list_of(form: Form, text: str, file: str, *, longest: int = _LONGEST_LIST) -> bytes:
    """Return the file that came in a field of a form, or else the text of another field."""
    return form.content(file) or form.text(text, longest=longest).encode()


def ending_of(content: bytes) -> str:
    """Return what a file of this content is called at its end.

    >>> ending_of(b"player,rating")
    'csv'
    """
    return "xlsx" if content.startswith(_WORKBOOK) else "csv"


def read_upload(content: bytes, read: Callable[[Path], Read]) -> Read:
    """Return what a reader of files makes of a content; its problems name the line alone.

    >>> read_upload(b"a,b", lambda path: path.read_text())
    'a,b'
    """
    if ending_of(content) == "xlsx":
        _check_size(content)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder, f"list.{ending_of(content)}")
        place.write_bytes(content)
        try:
            return read(place)
        except DataError as error:
            raise DataError([_of_list(problem, place) for problem in error.problems]) from None


def warnings_of(file: RosterFile, name: str = "") -> list[str]:
    """Return the warnings about a list that came in, with its name in place of the file's."""
    start, found = f"{name}, " if name else "", []
    for text in file.warnings:
        with_line = re.sub(rf"^{re.escape(file.source)}:(\d+): ", rf"{start}line \1: ", text)
        found.append(with_line.replace(file.source, name or "the list"))
    return found


def _of_list(problem: str, place: Path) -> str:
    """Return a problem of the list without the name of the file that it was read from."""
    with_line = re.sub(rf"^{re.escape(str(place))}:(\d+): ", r"line \1: ", problem)
    return with_line.replace(f"{place}: ", "").replace(str(place), "the list")


def _check_size(content: bytes) -> None:
    """Refuse a workbook that unpacks to far more than was sent."""
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as packed:
            size = sum(one.file_size for one in packed.infolist())
    except zipfile.BadZipFile:
        raise RefusalError("This workbook can't be read. Save it again, or as CSV.") from None
    if size > _MOST_UNPACKED:
        raise RefusalError(
            "This workbook is too large. Save the sheet with the results as CSV.", status=413
        )
