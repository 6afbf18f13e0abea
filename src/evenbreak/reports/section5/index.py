"""The page that shows and explains all of section 5: prose from `index.md`, numbers from here.

In the prose `{{numbers P5.7}}` stands for the printed and computed numbers of a problem,
`{{slips P5.7}}` for what is wrong in it, and the other names for tables.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from evenbreak.reports.published import Erratum, PublishedNumber, errata
from evenbreak.reports.section5.break_formats import PAIRS
from evenbreak.reports.section5.innings import INNINGS
from evenbreak.reports.section5.long_run import CHARTS, HANDICAPS, LEVELS, ahead_formula
from evenbreak.reports.section5.markdown import beside, markdown_table, rounded, short
from evenbreak.reports.section5.numbers import Finding

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["index_page", "slips_of"]

_PLACE = re.compile(r"\{\{(\w+)(?: ([^}]*))?\}\}")
_SHOWN_ELSEWHERE = {"mean of two", "W(1/2;n,n)", "W infinite look-ahead", "W two-shot look-ahead"}

_STARTS = {"v": "from S1", "w": "from S2", "half v, half w": "from either, half and half"}

Frames = Mapping[str, "pd.DataFrame"]


def index_page(found: Sequence[Finding], frames: Frames) -> str:
    """Return the page in Markdown.

    Parameters
    ----------
    found
        all printed numbers with what is computed.
    frames
        the tables of section 5, by the name of their file.
    """
    blocks = _blocks(found, frames)
    template = files("evenbreak.reports.section5").joinpath("index.md").read_text("utf-8")
    page = _PLACE.sub(lambda place: blocks[place[1]](place[2] or ""), template)
    # A problem without slips leaves an empty paragraph.
    return re.sub(r"\n{3,}", "\n\n", page)


def slips_of(place: str) -> list[Erratum]:
    """Return the slips of the text at a problem, a table or a figure.

    >>> [slip.kind for slip in slips_of("P5.25")]
    ['rounded inputs']
    """
    here = re.compile(rf"{re.escape(place)}(?!\d)")
    return [slip for slip in errata() if here.search(slip.where)]


def _blocks(found: Sequence[Finding], frames: Frames) -> Mapping[str, Callable[[str], str]]:
    return {
        "verdicts": lambda _: _verdicts(found),
        "numbers": lambda problem: _numbers(found, problem),
        "slips": _slips,
        "scores": lambda p: _square(frames[f"problem_5_06_scores_{_name(p)}"]),
        "matches": lambda p: _square(frames[f"problem_5_06_matches_{_name(p)}"]),
        "table_5_1": lambda _: _table_5_1(frames["table_5_1"]),
        "table_5_2": lambda _: _table_5_2(frames["table_5_2"]),
        "table_5_3": lambda _: _table_5_3(frames["table_5_3"]),
        "products": lambda _: _products(found),
        "table_5_22": lambda _: _table_5_22(found),
        "steps": lambda _: _steps(frames["problem_5_23"]),
        "table_5_4": lambda _: _table_5_4(frames["table_5_4"]),
        "table_5_5": lambda _: _table_5_5(frames["table_5_5"]),
        "table_5_6": lambda _: _table_5_6(frames["table_5_6"]),
        "ladder": lambda _: _ladder(frames["npl_ladder"]),
        "polynomials": lambda _: markdown_table(
            ["match", "W"], [[f"{m}:{n}", f"`{ahead_formula(m, n)}`"] for m, n in HANDICAPS]
        ),
        "errata": lambda _: markdown_table(
            ["where", "the text", "right", "kind", "why"], map(list, errata()), left=5
        ),
    }


def _name(p: str) -> str:
    return p.replace("=", "_").replace("/", "_")


def _verdicts(found: Sequence[Finding]) -> str:
    count = Counter(finding.verdict for finding in found)
    return markdown_table(
        ["verdict", "numbers"], [*sorted(count.items()), ["all", sum(count.values())]]
    )


def _numbers(found: Sequence[Finding], problem: str) -> str:
    rows = [
        [row.quantity, _given(row.inputs), short(row.printed), short(computed), verdict]
        for row, computed, verdict in found
        if row.problem == problem and row.printed is not None and not _in_a_table(row)
    ]
    marked = [
        [*cells[:4], f"**{cells[4]}**" if cells[4] == "erratum" else cells[4]] for cells in rows
    ]
    return markdown_table(["quantity", "given", "text", "computed", "verdict"], marked, left=2)


def _in_a_table(row: PublishedNumber) -> bool:
    """Return whether a number is shown in a table of its own."""
    if row.problem.startswith("Table"):
        return " less " not in row.quantity
    of_the_ladder = row.problem == "NPL" and row.inputs.startswith("chart")
    return of_the_ladder or row.quantity in _SHOWN_ELSEWHERE


def _given(inputs: str) -> str:
    """Return inputs as a reader would like them: those of P5.2 are the two lists of P5.1.

    >>> _given("as above"), _given("p=.96 innings=5")
    ('both lists', 'p=.96 innings=5')
    """
    return "both lists" if inputs == "as above" or inputs.startswith("N=5;5") else inputs


def _slips(place: str) -> str:
    return "\n>\n".join(map(_slip, slips_of(place)))


def _slip(slip: Erratum) -> str:
    if slip.kind == "scan":
        return f"> **Not legible in the copy used:** {slip.printed}. {slip.why}"
    return f"> **Slip: {slip.kind}.** The text: {slip.printed}. Right: {slip.correct}. {slip.why}"


def _square(frame: pd.DataFrame) -> str:
    columns = list(frame.columns)
    rows = [[f"**{row[0]}**", *map(_chance, row[1:])] for row in frame.itertuples(index=False)]
    return markdown_table(["m \\ n", *(name.removeprefix("n_") for name in columns[1:])], rows)


def _chance(value: Decimal) -> str:
    return f"{value:.0E}" if value < Decimal("0.00095") else rounded(value, 3)


def _records(frame: pd.DataFrame) -> list[dict[str, Any]]:
    return [dict(zip(frame.columns, row, strict=True)) for row in frame.itertuples(index=False)]


def _pair(row: Mapping[str, Any], name: str, decimals: int) -> str:
    return beside(row[name], row[f"{name}_printed"], decimals)


def _table_5_1(frame: pd.DataFrame) -> str:
    rows = _records(frame)
    return markdown_table(
        ["P", *(str(row["coverage"]) for row in rows)],
        [
            ["z_c", *(rounded(row["z_c"], 4) for row in rows)],
            ["text", *(str(row["z_c_printed"]) for row in rows)],
        ],
    )


def _table_5_2(frame: pd.DataFrame) -> str:
    decimals = {"mean_run": 1, "median_bound": 1, "median_run": 0, "median_over_mean": 3}
    return markdown_table(
        ["p", "mean", "bound", "median", "median / mean"],
        [
            [row["p"], *(_pair(row, *column) for column in decimals.items())]
            for row in _records(frame)
        ],
    )


def _table_5_3(frame: pd.DataFrame) -> str:
    cells = {(row["p"], row["m"]): row for row in _records(frame)}
    chances = list(dict.fromkeys(p for p, _ in cells))
    return markdown_table(
        ["p", "", *(f"m = {innings}" for innings in INNINGS)],
        [
            [p, name, *(_pair(cells[p, innings], name, decimals) for innings in INNINGS)]
            for p in chances
            for name, decimals in (("mode", 0), ("mean", 1), ("median", 0))
        ],
    )


def _products(found: Sequence[Finding]) -> str:
    means = {
        tuple(finding.published.inputs.split()): short(finding.computed)
        for finding in found
        if finding.published.quantity == "mean of two"
    }
    values = list(dict.fromkeys(first for first, _ in means))
    return markdown_table(
        ["mean of", *values], [[f"**{a}**", *(means[a, b] for b in values)] for a in values]
    )


def _table_5_22(found: Sequence[Finding]) -> str:
    rows: dict[str, list[str]] = {}
    for row, computed, _ in found:
        if row.problem == "P5.22" and row.quantity.startswith("W"):
            rows.setdefault(row.inputs, []).extend([f"{computed:.4f}", str(row.printed)])
    return markdown_table(
        ["shot", "W infinite", "text", "W two shots", "text"],
        [[inputs, *cells] for inputs, cells in rows.items()],
    )


def _steps(frame: pd.DataFrame) -> str:
    rows: dict[str, list[str]] = {}
    for row in _records(frame):
        start, _, when = row["quantity"].rpartition(", ")
        if start in _STARTS:
            rows.setdefault(f"{_STARTS[start]}: {when}", []).append(rounded(row["computed"], 4))
    return markdown_table(
        ["p1 = 0.4, p2 = 0.8", "W", "S1", "S2", "L"],
        [[name, *cells] for name, cells in rows.items()],
    )


def _table_5_4(frame: pd.DataFrame) -> str:
    names = ("w_winner_breaks", "w_loser_breaks", "w_alternate_breaks")
    rows = _records(frame)
    if len(rows) != len(PAIRS):
        raise ValueError("Table 5.4 has not the rows that the problem's answer is computed for")
    return markdown_table(
        ["row", "p1", "p2", "winner breaks", "loser breaks", "alternate breaks"],
        [
            [row["row"], row["p1"], row["p2"], *(_pair(row, name, 3) for name in names)]
            for row in rows
        ],
    )


def _table_5_5(frame: pd.DataFrame) -> str:
    decimals = {f"d{level}": 3 for level in range(1, LEVELS + 1)}
    decimals |= {"mean": 3, "mode": 0, "median": 0, "standard_deviation": 3}
    return markdown_table(
        ["p", *list(decimals)[:-1], "sd"],
        [
            [row["p"], *(_pair(row, *column) for column in decimals.items())]
            for row in _records(frame)
        ],
    )


def _table_5_6(frame: pd.DataFrame) -> str:
    charts: dict[int, list[list[str]]] = {number: [] for number in CHARTS}
    for row in _records(frame):
        last = row["difference_to"]
        span = f"{row['difference_from']}{' up' if last is None else f'–{last}'}"
        charts[row["chart"]].append([span, f"{row['stronger_needs']}:{row['weaker_needs']}"])
    header = [name for number in CHARTS for name in (f"chart {number}", "race")]
    longest = max(map(len, charts.values()))
    return markdown_table(
        header,
        [
            [cell for rows in charts.values() for cell in (rows[k] if k < len(rows) else ["", ""])]
            for k in range(longest)
        ],
    )


def _ladder(frame: pd.DataFrame) -> str:
    return markdown_table(
        ["chart", "even races up to", "opponents rated rightly", "opponents err alike"],
        [
            [
                row["chart"],
                f"{row['even_up_to']} points",
                _pair(row, "sd_natural", 3),
                _pair(row, "sd_autocorrelated", 3),
            ]
            for row in _records(frame)
        ],
    )
