"""CSV with the same bytes every time, and safe to open in a spreadsheet."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas as pd

DECIMALS = 6
FORMULA_STARTS = "=+-@\uff1d\uff0b\uff0d\uff20\ufe66\ufe62\ufe63\ufe6b\u2212"
"""Text that starts with one of these may be run as a formula by a spreadsheet.

These are the signs on every keyboard, their full-width and small forms, and the minus sign.
"""

# A spreadsheet that splits cells at semicolons or tabs takes no notice of quotes within a cell.
_BEGINS = r"((?:^|[;\t\r\n])[\s\"]*)"
_FORMULA = re.compile(rf"{_BEGINS}(?='*[{re.escape(FORMULA_STARTS)}])")
_DEFUSED = re.compile(rf"{_BEGINS}'(?='*[{re.escape(FORMULA_STARTS)}])")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)


def to_csv(frame: pd.DataFrame, *, excel: bool = False) -> bytes:
    r"""Return a frame as CSV without its index, in the format of `csv_lines`.

    Parameters
    ----------
    excel
        start with a byte order mark and end lines with CRLF, as Excel prefers.

    >>> import pandas as pd
    >>> frame = pd.DataFrame({"player": ["Ann", "=1+1"], "p_win_a": [0.5, -1e-9]})
    >>> to_csv(frame)
    b"player,p_win_a\nAnn,0.500000\n'=1+1,0.000000\n"
    """
    lines = csv_lines(list(map(str, frame.columns)), rows_of(frame))
    if excel:
        return "".join(f"{line[:-1]}\r\n" for line in lines).encode("utf-8-sig")
    return "".join(lines).encode()


def rows_of(frame: pd.DataFrame) -> list[tuple[Any, ...]]:
    """Return the rows of a frame as plain values, None where one is missing.

    >>> import pandas as pd
    >>> rows_of(pd.DataFrame({"player": ["Ann", "Bo"], "rating": [92.5, float("nan")]}))
    [('Ann', 92.5), ('Bo', None)]
    """
    columns = [
        column.astype(object).where(column.notna(), None).tolist() for _, column in frame.items()
    ]
    return list(zip(*columns, strict=True))


def csv_lines(names: Sequence[str], rows: Iterable[Sequence[Any]]) -> Iterator[str]:
    r"""Yield a header and rows as lines of CSV, each with its line ending.

    Floats have six decimals and whole numbers have none; True is yes and False is no; None, NaN and
    infinities are empty cells; dates are ISO. Text is passed through `text_cell`.

    >>> list(csv_lines(["race_a", "p_win_a"], [[7, 0.5], [8, None]]))
    ['race_a,p_win_a\n', '7,0.500000\n', '8,\n']
    """
    yield ",".join(map(text_cell, names)) + "\n"
    for row in rows:
        yield ",".join(map(_cell, row)) + "\n"


def _cell(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, str):
        return text_cell(value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return _number(value)
    if hasattr(value, "date"):
        return str(value.date())
    return str(value)


def _number(value: float) -> str:
    if not math.isfinite(value):
        return ""
    text = f"{value:.{DECIMALS}f}"
    # A number that rounds to zero has no sign.
    return text.removeprefix("-") if float(text) == 0.0 else text


def text_cell(text: str) -> str:
    r"""Return text as a CSV cell that no spreadsheet will run as a formula.

    Anything that a spreadsheet might run gets an apostrophe in front: text that starts with one of
    `FORMULA_STARTS` or a control character, even after a semicolon, a tab or a line break, where a
    spreadsheet set to another country starts a new cell. Numbers are unchanged. `undefused` removes
    the apostrophes again.

    >>> text_cell("@SUM(A1)"), text_cell("Ann-Marie"), text_cell('5" ball'), text_cell("-1")
    ("'@SUM(A1)", 'Ann-Marie', '"5"" ball"', '-1')
    >>> text_cell("Bo;=1+1")
    '"Bo;\'=1+1"'
    """
    if not _NUMBER.fullmatch(text):
        text = _FORMULA.sub(r"\1'", text)
        if unicodedata.category(text[:1] or "x") == "Cc":
            text = f"'{text}"
    # The csv module would leave a lone CR unquoted, and readers end a line there.
    return '"' + text.replace('"', '""') + '"' if set(text) & set(',;\t"\r\n') else text


def undefused(text: str) -> str:
    """Return text as it was before `text_cell` added apostrophes.

    >>> undefused("'@SUM(A1)"), undefused("'t Hooft"), undefused("Bo;'=1+1")
    ('@SUM(A1)', "'t Hooft", 'Bo;=1+1')
    """
    return _DEFUSED.sub(r"\1", text)
