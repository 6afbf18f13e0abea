"""The tables in section 5 in Markdown, as the page shows them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from functools import partial
from itertools import chain
from typing import Any

from evenbreak.source_text.cells import Rows, Tables, beside, markdown_table, rounded, short
from evenbreak.source_text.published import Finding
from evenbreak.source_text.section5.chains import CHARTS, LEVELS
from evenbreak.source_text.section5.games import INNINGS
from evenbreak.source_text.section5.samples import pascals_triangle

_STARTS = {"v": "from S1", "w": "from S2", "half v, half w": "from either, half the time"}


def _lines_table(header: Sequence[str], cells: Iterable[tuple[str, str]]) -> str:
    """Return a table from its cells, line by line, each with its line's name."""
    lines: dict[str, list[str]] = {}
    for name, cell in cells:
        lines.setdefault(name, [name]).append(cell)
    return markdown_table(header, lines.values())


def score_table(rows: Rows) -> str:
    """Return a table for P5.6, with rows m and columns n."""
    header = ["m \\ n", *(name.removeprefix("n_") for name in list(rows[0])[1:])]
    cells = [list(row.values()) for row in rows]
    return markdown_table(header, [[f"**{m}**", *map(_chance, chances)] for m, *chances in cells])


def _chance(value: Decimal) -> str:
    return f"{value:.0E}" if value < Decimal("0.00095") else rounded(value, 3)


def _pair(row: Mapping[str, Any], name: str, decimals: int) -> str:
    return beside(row[name], row[f"{name}_printed"], decimals)


def _pairs_table(
    rows: Rows, *, header: Sequence[str], plain: Sequence[str], decimals: Mapping[str, int]
) -> str:
    """Return a table: some columns unchanged, then computed numbers next to printed ones."""
    return markdown_table(
        header,
        [
            [*(row[name] for name in plain), *(_pair(row, *pair) for pair in decimals.items())]
            for row in rows
        ],
    )


def _table_5_1(rows: Rows) -> str:
    """Return the critical values, with the printed ones below."""
    return markdown_table(
        ["P", *(str(row["coverage"]) for row in rows)],
        [
            ["z_c", *(rounded(row["z_c"], 4) for row in rows)],
            ["text", *(str(row["z_c_printed"]) for row in rows)],
        ],
    )


def _table_5_3(rows: Rows) -> str:
    """Return the mode, mean and median of scores, with a column for each number of innings."""
    cells = {(row["p"], row["m"]): row for row in rows}
    chances = list(dict.fromkeys(p for p, _ in cells))
    return markdown_table(
        ["p", "", *(f"m = {innings}" for innings in INNINGS)],
        [
            [p, name, *(_pair(cells[p, innings], name, decimals) for innings in INNINGS)]
            for p in chances
            for name, decimals in (("mode", 0), ("mean", 1), ("median", 0))
        ],
    )


def _table_5_6(rows: Rows) -> str:
    """Return the four charts side by side, with the printed differences next to the rule's."""
    charts: dict[int, list[list[str]]] = {number: [] for number in CHARTS}
    for row in rows:
        span, printed = _span(row, ""), _span(row, "_printed")
        span += "" if printed == span else f" (text: {printed})"
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


def _span(row: Mapping[str, Any], end: str) -> str:
    first, last = row[f"difference_from{end}"], row[f"difference_to{end}"]
    return f"{first}{' up' if last is None else f'–{last}'}"


def off_rule_table(rows: Rows) -> str:
    """Return where the charts don't have the most nearly even race."""
    return markdown_table(
        ["chart", "difference", "race in the text", "W", "race nearest 1/2", "W"],
        [
            [
                row["chart"],
                row["difference"],
                f"{row['printed_stronger_needs']}:{row['printed_weaker_needs']}",
                rounded(row["w_printed"], 3),
                f"{row['stronger_needs']}:{row['weaker_needs']}",
                rounded(row["w"], 3),
            ]
            for row in rows
        ],
    )


def eight_ball_table(rows: Rows) -> str:
    """Return the shares of the 8-ball drill's levels, and the result."""
    names = list(rows[0])[1:]
    whole = {"mode", "median"}
    return markdown_table(
        ["p", *names[:-1], "sd"],
        [
            [row["p"], *(rounded(row[name], 0 if name in whole else 3) for name in names)]
            for row in rows
        ],
    )


_DRILL = {f"d{level}": 3 for level in range(1, LEVELS + 1)}
_DRILL |= {"mean": 3, "mode": 0, "median": 0, "standard_deviation": 3}

TABLES: Mapping[int, Callable[[Rows], str]] = {
    1: _table_5_1,
    2: partial(
        _pairs_table,
        header=["p", "mean", "bound", "median", "median / mean"],
        plain=["p"],
        decimals={"mean_run": 1, "median_bound": 1, "median_run": 0, "median_over_mean": 3},
    ),
    3: _table_5_3,
    4: partial(
        _pairs_table,
        header=["row", "p1", "p2", "winner breaks", "loser breaks", "alternate breaks"],
        plain=["row", "p1", "p2"],
        decimals={"w_winner_breaks": 3, "w_loser_breaks": 3, "w_alternate_breaks": 3},
    ),
    5: partial(_pairs_table, header=["p", *list(_DRILL)[:-1], "sd"], plain=["p"], decimals=_DRILL),
    6: _table_5_6,
}
"""How Tables 5.1 to 5.6 are shown."""


def triangle_table() -> str:
    """Return Pascal's triangle, with rows n and columns m."""
    rows = pascals_triangle()
    return markdown_table(
        ["n \\ m", *range(len(rows))],
        [[f"**{n}**", *row, *[""] * (len(rows) - len(row))] for n, row in enumerate(rows)],
    )


def games_table(rows: Rows) -> str:
    """Return P5.9's results for some numbers of games."""
    return _lines_table(
        ["games", "N p − q", "mode", "number of modes", "mean", "standard deviation"],
        ((row["inputs"], short(row["computed"])) for row in rows if row["inputs"]),
    )


def matrix_table(name: str, tables: Tables) -> str:
    """Return a matrix in symbols, from the formulas in the tables."""
    entries = [
        (row["inputs"].split()[1], row["computed"].replace("-", "−"))
        for row in chain.from_iterable(tables.values())
        if row.get("quantity") == f"formula: {name}"
    ]
    states = dict.fromkeys(state for state, _ in entries)
    return _lines_table(["to \\ from", *states], ((f"**{to}**", entry) for to, entry in entries))


def polynomials(rows: Rows) -> str:
    """Return P5.27's W as a ratio of polynomials for each handicap."""
    return markdown_table(
        ["match", "W"],
        [
            [row["inputs"], f"`{row['computed']}`"]
            for row in rows
            if row["quantity"] == "formula: W"
        ],
    )


def eigenvalues(rows: Rows) -> str:
    """Return P5.23's eigenvalues for the shots in its table."""
    values = [
        rounded(row["computed"], 4) for row in rows if row["quantity"].startswith("eigenvalue ")
    ]
    return ", ".join(values).replace("-", "−")


def products_table(findings: Sequence[Finding]) -> str:
    """Return the sixteen means in P5.18."""
    means = [
        (row.inputs.split()[0], f"{computed:.6g}")
        for row, computed, _ in findings
        if row.quantity == "mean of two"
    ]
    values = dict.fromkeys(first for first, _ in means)
    return _lines_table(["mean of", *values], ((f"**{a}**", mean) for a, mean in means))


def table_5_22(findings: Sequence[Finding]) -> str:
    """Return the seven shots in P5.22 under both look-aheads."""
    return _lines_table(
        ["shot", "W infinite", "text", "W two shots", "text"],
        (
            (row.inputs, cell)
            for row, computed, _ in findings
            if row.problem == "P5.22" and row.quantity.startswith("W")
            for cell in (f"{computed:.4f}", str(row.printed))
        ),
    )


def steps_table(rows: Rows) -> str:
    """Return P5.23's probability vectors, step by step, and their limits."""
    densities = ((*row["quantity"].rpartition(", "), row["computed"]) for row in rows)
    return _lines_table(
        ["p1 = 0.4, p2 = 0.8", "W", "S1", "S2", "L"],
        (
            (f"{_STARTS[start]}: {when}", rounded(density, 4))
            for start, _, when, density in densities
            if start in _STARTS
        ),
    )


def ladder_table(rows: Rows) -> str:
    """Return the spread of ratings under each chart."""
    return markdown_table(
        ["chart", "even races up to", "opponents rated correctly", "opponents off the same way"],
        [
            [
                row["chart"],
                f"{row['even_up_to']} points",
                _pair(row, "sd_natural", 3),
                _pair(row, "sd_autocorrelated", 3),
            ]
            for row in rows
        ],
    )
