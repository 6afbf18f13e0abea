"""The tables of section 5."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import Any

from evenbreak.handicaps.charts.chart import chart
from evenbreak.source_text.cells import Rows, Tables, number_cell
from evenbreak.source_text.findings import Finding
from evenbreak.source_text.inputs import parse_inputs
from evenbreak.source_text.section5.games_won import match_probability
from evenbreak.source_text.section5.long_run import CHARTS
from evenbreak.stats.binomial import score_probability

_SIZE = 10


def table_rows(found: Iterable[Finding], table: str) -> Rows:
    """Return one of Tables 5.1 to 5.5: its inputs, each quantity and the printed one beside it.

    Raises
    ------
    KeyError
        if no number of that table is among the findings.
    """
    rows: dict[tuple[Any, ...], dict[str, Any]] = {}
    for published, computed, _ in found:
        if published.problem != table or " less " in published.quantity:
            continue
        numbers = parse_inputs(published.inputs).numbers
        inputs = {_column(name): number_cell(value) for name, (value,) in numbers.items()}
        row = rows.setdefault(tuple(inputs.values()), inputs)
        name = _column(published.quantity)
        row[name] = number_cell(computed)
        row[f"{name}_printed"] = published.printed
    if not rows:
        raise KeyError(table)
    return list(rows.values())


def score_tables() -> Tables:
    """Return the four tables of P5.6: scores P(p; m, n) and matches W(p; m, n), by file name."""
    tables = {}
    for p in (Fraction(1, 2), Fraction(2, 3)):
        end = f"p_{p.numerator}_{p.denominator}"
        tables[f"problem_5_06_scores_{end}"] = _square(p, score_probability, 0)
        tables[f"problem_5_06_matches_{end}"] = _square(p, match_probability, 1)
    return tables


def _square(p: Fraction, chance: Callable[[Fraction, int, int], Any], first: int) -> Rows:
    games = range(first, first + _SIZE)
    return [{"m": m, **{f"n_{n}": number_cell(chance(p, m, n)) for n in games}} for m in games]


def chart_rows() -> Rows:
    """Return Table 5.6: the races of the four charts, by rating difference."""
    return [
        {"chart": number, **row._asdict()}
        for number in CHARTS
        for row in chart(f"npl_{number}").rows
    ]


def ladder_rows(found: Iterable[Finding]) -> Rows:
    """Return the spread of ratings under each chart, and its widest even race."""
    rows: dict[int, dict[str, Any]] = {
        number: {"chart": number, "even_up_to": chart(f"npl_{number}").rows[0].difference_to}
        for number in CHARTS
    }
    for published, computed, _ in found:
        number = parse_inputs(published.inputs).get("chart")
        if published.problem == "NPL" and number is not None:
            auto = "autocorrelation" in published.quantity
            name = "sd_autocorrelated" if auto else "sd_natural"
            rows[int(number)][name] = number_cell(computed)
            rows[int(number)][f"{name}_printed"] = published.printed
    return list(rows.values())


def _column(name: str) -> str:
    """Return a quantity as the name of a column; P is what a critical value covers.

    >>> _column("median/mean"), _column("W winner breaks"), _column("P")
    ('median_over_mean', 'w_winner_breaks', 'coverage')
    """
    if name == "P":
        return "coverage"
    return re.sub(r"\W+", "_", name.replace("/", " over ").lower())
