"""The tables in section 5: Tables 5.1 to 5.6, and one for each problem from P5.1 to P5.27."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from decimal import Decimal
from fractions import Fraction
from typing import Any

from evenbreak.games import Drill
from evenbreak.handicaps import chart
from evenbreak.handicaps.charts.off_rule import nearest_rows, off_rule
from evenbreak.practice import drill_statistics
from evenbreak.source_text.answers import DERIVED
from evenbreak.source_text.cells import Rows, Tables, number_cell
from evenbreak.source_text.published import Finding, Row, parse_inputs, row_of
from evenbreak.source_text.section5.chains import CHARTS, DRILL_P
from evenbreak.source_text.section5.games import match_probability
from evenbreak.stats import score_probability

_SIZE = 10


def table_rows(findings: Iterable[Finding], table: str) -> Rows:
    """Return one of Tables 5.1 to 5.5: its inputs, and each quantity next to the printed one.

    Raises KeyError if no number in that table is among the findings.
    """
    rows: dict[tuple[Any, ...], dict[str, Any]] = {}
    for published, computed, _ in findings:
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
    """Return P5.6's four tables: scores P(p; m, n) and matches W(p; m, n), by file name."""
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
    """Return Table 5.6: each race in the four charts, with its place by the rule and as printed.

    The rule takes the chart's race with W closest to 1/2.
    """
    return [
        {
            "chart": number,
            "stronger_needs": row.stronger_needs,
            "weaker_needs": row.weaker_needs,
            "difference_from": row.difference_from,
            "difference_to": row.difference_to,
            "difference_from_printed": printed.difference_from,
            "difference_to_printed": printed.difference_to,
        }
        for number in CHARTS
        for row, printed in zip(
            nearest_rows(chart(f"npl_{number}"), "npl"),
            chart(f"npl_{number}").rows,
            strict=True,
        )
    ]


def off_rule_rows() -> Rows:
    """Return the places where a chart in Table 5.6 doesn't have the race with W closest to 1/2."""
    return [
        {
            "chart": number,
            "difference": place.difference,
            "printed_stronger_needs": place.race[0],
            "printed_weaker_needs": place.race[1],
            "w_printed": number_cell(place.win),
            "stronger_needs": place.nearest[0],
            "weaker_needs": place.nearest[1],
            "w": number_cell(place.nearest_win),
        }
        for number in CHARTS
        for place in off_rule(chart(f"npl_{number}"), "npl")
    ]


def eight_ball_rows() -> Rows:
    """Return where the 8-ball drill after exercise 5.1 settles, like Table 5.5 for 9-ball."""
    rows = []
    for p in DRILL_P:
        law = drill_statistics(Drill.eight_ball(float(p))).distribution
        shares = {f"d{level}": share for level, share in enumerate(law.probability, 1)}
        numbers = {
            **shares,
            "mean": law.mean,
            "mode": law.mode,
            "median": law.median,
            "standard_deviation": law.sd,
        }
        rows.append({"p": Decimal(p), **{name: number_cell(x) for name, x in numbers.items()}})
    return rows


def ladder_rows(findings: Iterable[Finding]) -> Rows:
    """Return the spread of ratings under each chart, and its widest even race."""
    rows: dict[int, dict[str, Any]] = {
        number: {"chart": number, "even_up_to": chart(f"npl_{number}").rows[0].difference_to}
        for number in CHARTS
    }
    for published, computed, _ in findings:
        number = parse_inputs(published.inputs).get("chart")
        if published.problem == "NPL" and number is not None:
            auto = "autocorrelation" in published.quantity
            name = "sd_autocorrelated" if auto else "sd_natural"
            rows[int(number)][name] = number_cell(computed)
            rows[int(number)][f"{name}_printed"] = published.printed
    return list(rows.values())


def _column(name: str) -> str:
    """Return a quantity as a column name; P is what a critical value covers.

    >>> _column("median/mean"), _column("W winner breaks"), _column("P")
    ('median_over_mean', 'w_winner_breaks', 'coverage')
    """
    if name == "P":
        return "coverage"
    return re.sub(r"\W+", "_", name.replace("/", " over ").lower())


PROBLEMS = tuple(f"P5.{number}" for number in range(1, 28))

_PROBLEM_OF = {
    "Table 5.1": "P5.10",
    "Table 5.2": "P5.11",
    "Table 5.3": "P5.16",
    "Table 5.4": "P5.24",
    "Table 5.5": "P5.26",
}
"""The problem that a table answers or follows."""


def file_of(problem: str) -> str:
    """Return a problem's file name, without its extension.

    >>> file_of("P5.7")
    'problem_5_07'
    """
    return f"problem_5_{int(problem.removeprefix('P5.')):02}"


def problem_tables(findings: Iterable[Finding]) -> Tables:
    """Return each problem's answer by file name: printed numbers, then the rest."""
    printed: dict[str, list[dict[str, Any]]] = {}
    for finding in findings:
        home = finding.published.problem
        printed.setdefault(_PROBLEM_OF.get(home, home), []).append(row_of(finding))
    return {
        file_of(problem): [
            *printed.get(problem, ()),
            *(_derived(problem, row) for row in DERIVED.get(problem, tuple)()),
        ]
        for problem in PROBLEMS
    }


def _derived(problem: str, row: Row) -> dict[str, Any]:
    return {
        "problem": problem,
        "quantity": row.quantity,
        "inputs": row.inputs,
        "printed": None,
        "computed": row.computed if isinstance(row.computed, str) else number_cell(row.computed),
        "difference": None,
        "tolerance": None,
        "verdict": "derived",
        "note": row.note,
    }
