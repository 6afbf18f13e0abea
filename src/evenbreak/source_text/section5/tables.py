"""The tables of section 5."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any

from evenbreak.games.ahead import Ahead
from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.games.drill import Drill
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.charts.off_rule import nearest_rows, off_rule
from evenbreak.matches.win import race_win_probability, win_probability
from evenbreak.practice.breaks import long_run_share
from evenbreak.practice.drills import drill_statistics
from evenbreak.practice.shots import one_ball_win
from evenbreak.source_text.cells import Records, Rows, Tables, number_cell, record
from evenbreak.source_text.findings import Finding
from evenbreak.source_text.inputs import parse_inputs
from evenbreak.source_text.section5.break_formats import FORMATS
from evenbreak.source_text.section5.games_won import match_probability
from evenbreak.source_text.section5.long_run import CHARTS, DRILL_P, HANDICAPS, drill, ladder
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
    """Return Table 5.6: each race of the four charts, where the rule has it and where it stands.

    The rule takes the race of the chart with W nearest 1/2.
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
    """Return the places where a chart of Table 5.6 has not the race with W nearest 1/2."""
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
    """Return where the 8-ball drill after exercise 5.1 settles, as Table 5.5 for 9-ball."""
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


# The numbers behind the plots of section 5.


_LONGEST = 10
_HUNDREDTHS = [k / 100 for k in range(101)]
_INSIDE = [k / 20 for k in range(1, 20)]
"""The grid of the contour plots; at a corner the limit may depend on the direction of approach."""


def figure_tables() -> Tables:
    """Return the numbers behind each plot of section 5, by the name of the figure."""
    tables = {
        "figure_5_1": _curves(
            {
                f"w_{k * n}_{n}": race_win_probability(_HUNDREDTHS, k * n, n)
                for k in (1, 2)
                for n in range(1, _LONGEST + 1)
            }
        ),
        "figure_5_3": _surfaces(
            {
                "w_infinite": one_ball_win,
                "w_two_shots": lambda p1, p2: one_ball_win(p1, p2, look_ahead="two shots"),
            }
        ),
        "figure_5_6": _surfaces(
            {
                **{f"w_{name}_breaks": _share(name) for name in FORMATS},
                "winner_less_loser": lambda p1, p2: (
                    _share("winner")(p1, p2) - _share("loser")(p1, p2)
                ),
            }
        ),
        "figure_5_8": _levels(),
        "figure_5_9": _ladders(),
        "figure_5_11": _curves(
            {f"w_{m}_{n}": win_probability(Ahead(m, n, Rack(_HUNDREDTHS))) for m, n in HANDICAPS}
        ),
    }
    return {name: list(rows) for name, rows in tables.items()}


def _share(name: str) -> Callable[[Any, Any], Any]:
    return lambda p1, p2: long_run_share(p1, p2, BREAK_FORMATS[name])


def _curves(columns: Mapping[str, Any]) -> Records:
    for k, p in enumerate(_HUNDREDTHS):
        yield record({"p": p}, {name: values[k] for name, values in columns.items()})


def _surfaces(functions: Mapping[str, Callable[[Any, Any], Any]]) -> Records:
    for p1 in _INSIDE:
        for p2 in _INSIDE:
            values = {name: function(p1, p2) for name, function in functions.items()}
            yield record({"p1": p1, "p2": p2}, values)


def _levels() -> Records:
    for p in _HUNDREDTHS:
        shares = enumerate(drill(p).distribution.probability, 1)
        yield record({"p": p}, {f"d_{level}": share for level, share in shares})


def _ladders() -> Records:
    laws = {
        f"{kind}_{number}": ladder(number, autocorrelated=kind == "autocorrelated")
        for kind in ("natural", "autocorrelated")
        for number in CHARTS
    }
    errors = next(iter(laws.values())).values
    for k, error in enumerate(errors):
        yield record(
            {"rating_error": error}, {name: law.probability[k] for name, law in laws.items()}
        )
