"""Lists that come in with a form, pasted or as a file, read as the readers of files do."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from starlette.datastructures import UploadFile

from evenbreak.errors import DataError
from evenbreak.files.roster import RosterFile
from evenbreak.web.forms import Form

_LONGEST_LIST = 200_000

Read = TypeVar("Read")


async def list_of(form: Form, text: str, file: str) -> bytes:
    """Return the file that came in a field, or else the text of another field."""
    upload = form.fields.get(file)
    if isinstance(upload, UploadFile) and upload.size:
        return await upload.read()
    return form.text(text, longest=_LONGEST_LIST).encode()


def read_list(content: bytes, read: Callable[[Path], Read], name: str = "list") -> Read:
    """Read a list; its problems call it by a name, which never becomes that of a file."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder, "list.csv")
        place.write_bytes(content)
        try:
            return read(place)
        except DataError as error:
            raise DataError([p.replace(str(place), name) for p in error.problems]) from None


def warnings_of(file: RosterFile, name: str = "list") -> list[str]:
    """Return the warnings about a list that came in, which they call by a name."""
    return [line.replace(file.source, name) for line in file.warnings]
