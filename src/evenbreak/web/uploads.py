"""Files that come in by the page: read from a temporary place whose name is ours."""

from __future__ import annotations

import io
import tempfile
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from evenbreak.errors import DataError
from evenbreak.files.lists.roster import RosterFile
from evenbreak.files.tables.problems import of_list
from evenbreak.web.forms import Form
from evenbreak.web.refusals import RefusalError
from evenbreak.words import say

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
            problems = [_nameless(of_list(problem), place) for problem in error.problems]
            raise DataError(problems) from None


def warnings_of(file: RosterFile, name: str = "") -> list[str]:
    """Return the warnings about a list that came in, with its name in place of the file's."""
    return [_nameless(of_list(text, name), file.source, name) for text in file.warnings]


def _nameless(text: str, place: object, name: str = "") -> str:
    """Return a text that may still name the file that it was read from, with the list's name."""
    source = str(place)
    return text.replace(source, name or say("the list")) if source in text else text


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
