"""The bytes of a file, and the text in them, or why they cannot be text."""

from __future__ import annotations

import codecs
import sys
from pathlib import Path
from typing import NamedTuple

from evenbreak.errors import DataError
from evenbreak.files.problems import printable

MAGIC = {
    b"\xd0\xcf\x11\xe0": "an old or locked Excel workbook; save it as .xlsx without a password",
    b"%PDF": "a PDF document; save it as CSV, in UTF-8",
}


MOST_BYTES = 256 << 20
"""The largest file that is read: some five million matches."""


class Text(NamedTuple):
    """The text of a file.

    Parameters
    ----------
    body
        its bytes; UTF-8 where the file was UTF-16.
    encoding
        how `body` is encoded.
    warnings
        whether that had to be guessed.
    """

    body: bytes
    encoding: str
    warnings: list[str]


def content_of(path: str | Path) -> tuple[str, bytes]:
    """Return what to call a file in messages, and its bytes; '-' is standard input."""
    if str(path) == "-":
        if sys.stdin is None:
            raise DataError(["stdin: is closed; name a file, or pipe one into the command"])
        return "stdin", _no_larger(sys.stdin.buffer.read(MOST_BYTES + 1), "stdin")
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
    return source, _no_larger(content, source)


def _no_larger(content: bytes, source: str) -> bytes:
    """Return a file's bytes, or refuse a file that is larger than any table of a league."""
    if len(content) > MOST_BYTES:
        raise DataError(
            [f"{source}: is larger than {MOST_BYTES >> 20} MB; name a table, or split it up"]
        )
    return content


def text_of(content: bytes, source: str) -> Text:
    r"""Return the text of a file: UTF-8, UTF-16 with a byte order mark, or else Windows-1252.

    Raises
    ------
    DataError
        if there is none.

    >>> text_of("\ufeffZoë".encode("utf-16-be"), "r.csv").body.decode()
    'Zoë'
    """
    for magic, kind in MAGIC.items():
        if content.startswith(magic):
            raise DataError([f"{source}: is {kind}"])
    if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        try:
            content = content.decode("utf-16").removeprefix("\ufeff").encode()
        except UnicodeError:
            raise DataError(
                [f"{source}: is damaged UTF-16 text; save the file again, in UTF-8"]
            ) from None
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
    return Text(content, encoding, warnings)
