"""The bytes of a file and how they are encoded, or why they cannot be text."""

from __future__ import annotations

import codecs
import sys
from pathlib import Path

from evenbreak.errors import DataError
from evenbreak.files.problems import printable

MAGIC = {
    b"PK\x03\x04": "a spreadsheet or a zip archive",
    b"\xd0\xcf\x11\xe0": "an old Excel workbook",
    b"%PDF": "a PDF document",
    b"\xff\xfe": "UTF-16 text",
    b"\xfe\xff": "UTF-16 text",
}


MOST_BYTES = 256 << 20
"""The longest file that is read: some five million matches."""


def content_of(path: str | Path) -> tuple[str, bytes]:
    """Return what to call a file in messages, and its bytes; '-' is standard input."""
    if str(path) == "-":
        if sys.stdin is None:
            raise DataError(["stdin: is closed; name a file, or pipe one into the command"])
        return "stdin", _no_longer(sys.stdin.buffer.read(MOST_BYTES + 1), "stdin")
    source = printable(str(path))
    try:
        with Path(path).open("rb") as file:
            content = file.read(MOST_BYTES + 1)
    except FileNotFoundError:
        raise DataError([f"{source}: there is no such file; check its name"]) from None
    except IsADirectoryError:
        raise DataError([f"{source}: is a folder; name a file in it"]) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DataError([f"{source}: cannot be read ({reason}); check the file"]) from None
    return source, _no_longer(content, source)


def _no_longer(content: bytes, source: str) -> bytes:
    """Return a file's bytes, or refuse a file that is longer than any table of a league."""
    if len(content) > MOST_BYTES:
        raise DataError(
            [f"{source}: is longer than {MOST_BYTES >> 20} MB; name a table, or split it in parts"]
        )
    return content


def encoding_of(content: bytes, source: str) -> tuple[str, list[str]]:
    """Return how a file is encoded, and a warning if that had to be guessed."""
    for magic, kind in MAGIC.items():
        if content.startswith(magic):
            raise DataError([f"{source}: is {kind}; save it as CSV, in UTF-8"])
    nul = content.find(b"\0")
    if nul >= 0:
        line = content.count(b"\n", 0, nul) + 1
        raise DataError([f"{source}:{line}: holds a NUL byte; save the file as CSV, in UTF-8"])
    try:
        encoding, warnings = "utf-8-sig", []
        text = content.decode(encoding)
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        try:
            # After the mark of UTF-8 a byte that is not UTF-8 is damage, not another encoding.
            encoding = "ascii" if content.startswith(codecs.BOM_UTF8) else "cp1252"
            text = content.decode(encoding)
        except UnicodeDecodeError as also:
            line = content.count(b"\n", 0, also.start) + 1
            raise DataError(
                [f"{source}:{line}: is neither UTF-8 nor Windows-1252 text; save it as UTF-8"]
            ) from None
        warnings = [f"{source}:{line}: is not UTF-8; read as Windows-1252, so check the accents"]
    if not text.strip():
        raise DataError([f"{source}: is empty; write a header line, then one line for each row"])
    return encoding, warnings
