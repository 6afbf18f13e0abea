"""A report's tables as one workbook, with a sheet for each.

This needs XlsxWriter, which the extra `excel` installs.
"""

import datetime as dt
import io
import math
from collections.abc import Mapping
from typing import Any

import pandas as pd

from evenbreak.answers.kit.remarks import warnings_of
from evenbreak.answers.league.report import left_out
from evenbreak.answers.league.sheet import NO_RACE, Sheet
from evenbreak.errors import InputError

MOST_ROWS, MOST_COLUMNS = 1_048_576, 16_384
"""What a sheet in a workbook can hold, including the header."""

_DECIMALS = 6
_WIDEST = 40
_LONGEST_TEXT = 32_767
_WRITTEN = dt.datetime(2000, 1, 1)
"""Every workbook's creation date, so that the same tables give the same bytes."""


def check_workbook() -> None:
    """Raise InputError, before any work, if XlsxWriter isn't installed."""
    _xlsxwriter()


def _xlsxwriter() -> Any:
    try:
        import xlsxwriter  # type: ignore[import-untyped]
    except ModuleNotFoundError as error:
        raise InputError(
            "a workbook needs XlsxWriter, which isn't installed. Install it with: pip "
            "install XlsxWriter (the extra evenbreak[excel]), or ask for CSV files"
        ) from error
    return xlsxwriter


def workbook_bytes(tables: Mapping[str, pd.DataFrame]) -> bytes:
    """Return tables as one workbook (.xlsx), a sheet for each, with the same bytes every time.

    Text stays text even if it starts with = or looks like a date, and no cell is a link. Numbers
    are rounded to six decimals, as in our CSV files; missing values, NaN and infinities become
    empty cells. The header is bold, stays in view and is printed on each page.

    Parameters
    ----------
    tables
        by sheet name, in order; the index is left out.

    Raises
    ------
    InputError
        if a table has more rows or columns than a sheet can hold, or XlsxWriter is not
        installed.

    >>> import pandas as pd
    >>> workbook_bytes({"Ratings": pd.DataFrame({"player": ["Ann"], "rating": [80.0]})})[:2]
    b'PK'
    """
    xlsxwriter = _xlsxwriter()
    for name, table in tables.items():
        rows, columns = len(table) + 1, len(table.columns)
        if rows > MOST_ROWS or columns > MOST_COLUMNS:
            raise InputError(
                f"sheet {name!r} would have {rows:,} rows and {columns:,} columns; a workbook "
                f"holds {MOST_ROWS:,} and {MOST_COLUMNS:,}, so pair fewer players"
            )
    out = io.BytesIO()
    # Cells are written with methods that guess nothing: no formula, link or date is made.
    with xlsxwriter.Workbook(out, {"in_memory": True}) as book:
        book.set_properties({"created": _WRITTEN})
        header = book.add_format({"bold": True, "bottom": 1})
        decimal = book.add_format({"num_format": "0.000"})
        for name, table in tables.items():
            _write(book.add_worksheet(name), table, header, decimal)
    return out.getvalue()


def _write(sheet: Any, table: pd.DataFrame, header: Any, decimal: Any) -> None:
    for number, (name, column) in enumerate(table.items()):
        look = decimal if column.dtype.kind == "f" else None
        cells = [_value(cell) for cell in column.astype(object).where(column.notna(), None)]
        sheet.write_string(0, number, str(name), header)
        for row, cell in enumerate(cells, 1):
            if isinstance(cell, str):
                sheet.write_string(row, number, cell)
            elif cell is not None:
                sheet.write_number(row, number, cell, look)
        longest = max((len(str(cell)) for cell in (name, *cells) if cell is not None), default=1)
        sheet.set_column(number, number, min(_WIDEST, longest + 2))
    sheet.freeze_panes(1, 1)
    sheet.set_landscape()
    sheet.set_paper(9)  # A4
    sheet.fit_to_pages(1, 0)
    sheet.repeat_rows(0)
    sheet.set_footer("&L&A&RPage &P of &N")


def _value(cell: Any) -> str | float | None:
    """Return a cell's content: text, a finite number, or nothing."""
    if cell is None:
        return None
    if isinstance(cell, str):
        return cell[:_LONGEST_TEXT] or None
    number = float(cell)
    if not math.isfinite(number):
        return None
    return int(number) if number == int(number) else round(number, _DECIMALS)


def report_tables(sheet: Sheet) -> dict[str, pd.DataFrame]:
    """Return a report's tables by sheet name.

    Returns
    -------
    dict of str to pandas.DataFrame
        Ratings; Races, with a row and a column for each player; Pairs, with a row for each pair;
        Chart, if the races make one; Left out; About.
    """
    tables = {"Ratings": sheet.rated, "Races": race_table(sheet), "Pairs": _with_errors(sheet)}
    if sheet.bands:
        tables["Chart"] = pd.DataFrame(
            [(band.first, *band[2:]) for band in sheet.bands],
            columns=[
                "difference_from",
                "stronger_needs",
                "weaker_needs",
                "p_win_at_from",
                "p_win_at_end",
            ],
        )
    items = [(item.heading, item.why) for item in (*left_out(sheet), *warnings_of(sheet.file))]
    tables["Left out"] = pd.DataFrame(items, columns=["what", "why"])
    tables["About"] = sheet.summary
    return tables


def race_table(sheet: Sheet) -> pd.DataFrame:
    """Return all paired players' races as a table: a row and a column for each.

    The row's player comes first, then the race against each opponent as text, with the row player's
    games first; '-' if there is no race, and empty against oneself.
    """
    names = sheet.listed["player"].tolist()
    rows = [
        (
            row,
            *(
                "" if row == opponent else sheet.races.get((row, opponent), NO_RACE)
                for opponent in names
            ),
        )
        for row in names
    ]
    # A player may be called "player": the columns' names need not be different.
    return pd.DataFrame(rows).set_axis(["player", *names], axis=1)


def _with_errors(sheet: Sheet) -> pd.DataFrame:
    """Return the pairs with the effect on the chance of two standard errors in the difference."""
    by_pair = {(pair.player_a, pair.player_b): pair for pair in sheet.sure}
    paired = sheet.paired
    pairs = [by_pair.get(key) for key in zip(paired["player_a"], paired["player_b"], strict=True)]
    more = {
        "p_win_a_low": [pair.low if pair else None for pair in pairs],
        "p_win_a_high": [pair.high if pair else None for pair in pairs],
    }
    numbers = pd.DataFrame(more, dtype="float64")
    return pd.concat([paired.drop(columns="note"), numbers, paired["note"]], axis=1)
