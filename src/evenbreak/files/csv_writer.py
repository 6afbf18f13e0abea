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
FORMULA_STARTS = ("=", "+", "-", "@")
"""Text that begins with one of these may be run as a formula by a spreadsheet."""

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)


def to_csv(frame: pd.DataFrame, *, excel: bool = False) -> bytes:
    r"""Return a frame as CSV, without its index, as `csv_lines` writes it.

    Parameters
    ----------
    frame
        the table; the order of its columns and rows is kept.
    excel
        whether to begin with a byte order mark and end lines with CRLF, as Excel prefers.

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
    r"""Yield a header and rows as lines of CSV, each with its line end.

    Cells are separated by commas. Floats have six decimals, whole numbers none; None, NaN and
    infinities are empty cells; dates are ISO. Text that begins with = + - @ or a control
    character, which a spreadsheet might run as a formula, gets an apostrophe in front; numbers
    never do.

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
    """Return text as a CSV cell that no spreadsheet takes for a formula.

    >>> text_cell("@SUM(A1)"), text_cell("Ann-Marie"), text_cell('5" ball'), text_cell("-1")
    ("'@SUM(A1)", 'Ann-Marie', '"5"" ball"', '-1')
    """
    control = unicodedata.category(text[:1] or "x") == "Cc"
    if control or (text.startswith(FORMULA_STARTS) and not _NUMBER.fullmatch(text)):
        text = f"'{text}"
    # The csv module would leave a lone CR unquoted, and readers end a line there.
    return '"' + text.replace('"', '""') + '"' if set(text) & set(',"\r\n') else text
