"""CSV that is the same to the byte each time, and safe to open in a spreadsheet."""

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
"""What text begins with that a spreadsheet may run as a formula."""

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)


def to_csv(frame: pd.DataFrame, *, excel: bool = False) -> bytes:
    r"""Return a frame as CSV, without its index, as `csv_lines` writes it.

    Parameters
    ----------
    frame
        the table; its order of columns and rows is kept.
    excel
        begin with a byte order mark and end lines with CRLF, as Excel likes it.

    >>> import pandas as pd
    >>> frame = pd.DataFrame({"player": ["Ann", "=1+1"], "p_win_a": [0.5, -1e-9]})
    >>> to_csv(frame)
    b"player,p_win_a\nAnn,0.500000\n'=1+1,0.000000\n"
    """
    columns = [
        column.astype(object).where(column.notna(), None).tolist() for _, column in frame.items()
    ]
    lines = csv_lines(list(map(str, frame.columns)), zip(*columns, strict=True))
    if excel:
        return "".join(f"{line[:-1]}\r\n" for line in lines).encode("utf-8-sig")
    return "".join(lines).encode()


def csv_lines(names: Sequence[str], rows: Iterable[Sequence[Any]]) -> Iterator[str]:
    r"""Yield a header and rows as lines of CSV, each with its line end.

    A comma between cells. Floats have six decimals, whole numbers none; True is yes and False
    no; a value that is None, NaN or infinite is an empty cell; dates are ISO. Text that begins
    with = + - @ or a control character, which a spreadsheet might run as a formula, gets an
    apostrophe before it; numbers never do.

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
    """Return text as a cell of CSV that no spreadsheet takes for a formula.

    >>> text_cell("@SUM(A1)"), text_cell("Ann-Marie"), text_cell('5" ball'), text_cell("-1")
    ("'@SUM(A1)", 'Ann-Marie', '"5"" ball"', '-1')
    """
    control = unicodedata.category(text[:1] or "x") == "Cc"
    if control or (text.startswith(FORMULA_STARTS) and not _NUMBER.fullmatch(text)):
        text = f"'{text}"
    # The csv module would leave a lone CR bare, where readers of CSV end a line.
    return '"' + text.replace('"', '""') + '"' if set(text) & set(',"\r\n') else text
