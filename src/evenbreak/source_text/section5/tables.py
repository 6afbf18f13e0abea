"""The tables of section 5 as frames, and the numbers behind its figures."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from evenbreak.games.ahead import Ahead
from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.chart import chart
from evenbreak.matches.win import race_win_probability, win_probability
from evenbreak.practice.breaks import long_run_share
from evenbreak.practice.shots import one_ball_win
from evenbreak.source_text.section5.break_formats import FORMATS
from evenbreak.source_text.section5.games_won import match_probability
from evenbreak.source_text.section5.long_run import CHARTS, HANDICAPS, LEVELS, drill, ladder
from evenbreak.source_text.section5.numbers import Finding
from evenbreak.source_text.section5.rows import fixed_cell, number_cell, parse_inputs
from evenbreak.stats.binomial import score_probability

if TYPE_CHECKING:
    import pandas as pd

_SIZE = 10
_HUNDREDTHS = [k / 100 for k in range(101)]
_INSIDE = [k / 20 for k in range(1, 20)]
"""The grid of the contour plots; at a corner a limit may depend on the way to it."""


def table_frame(found: Iterable[Finding], table: str) -> pd.DataFrame:
    """Return one of Tables 5.1 to 5.5: its inputs, each quantity and the printed one beside it.

    Raises
    ------
    KeyError
        if no number of that table is among the findings.
    """
    rows: dict[tuple[Any, ...], dict[str, Any]] = {}
    for finding in found:
        if finding.published.problem != table or " less " in finding.published.quantity:
            continue
        named = parse_inputs(finding.published.inputs).named
        inputs = {_column(name): number_cell(value) for name, (value,) in named.items()}
        row = rows.setdefault(tuple(inputs.values()), inputs)
        name = _column(finding.published.quantity)
        row[name] = number_cell(finding.computed)
        row[f"{name}_printed"] = finding.published.printed
    if not rows:
        raise KeyError(table)
    return _frame(rows.values())


def score_frames() -> Mapping[str, pd.DataFrame]:
    """Return the four tables of P5.6: scores P(p; m, n) and matches W(p; m, n), by file name."""
    frames = {}
    for p in (Fraction(1, 2), Fraction(2, 3)):
        end = f"p_{p.numerator}_{p.denominator}"
        frames[f"problem_5_06_scores_{end}"] = _square(p, score_probability, 0)
        frames[f"problem_5_06_matches_{end}"] = _square(p, match_probability, 1)
    return frames


def _square(p: Fraction, chance: Callable[[Fraction, int, int], Any], first: int) -> pd.DataFrame:
    games = range(first, first + _SIZE)
    return _frame(
        {"m": m, **{f"n_{n}": number_cell(chance(p, m, n)) for n in games}} for m in games
    )


def charts_frame() -> pd.DataFrame:
    """Return Table 5.6: the races of the four charts, by rating difference."""
    return _frame(
        {"chart": number, **row._asdict()}
        for number in CHARTS
        for row in chart(f"npl_{number}").rows
    )


def ladder_frame(found: Iterable[Finding]) -> pd.DataFrame:
    """Return how far ratings wander under each chart, and the last even difference."""
    rows: dict[int, dict[str, Any]] = {
        number: {"chart": number, "even_up_to": chart(f"npl_{number}").rows[0].difference_to}
        for number in CHARTS
    }
    for finding in found:
        inputs = parse_inputs(finding.published.inputs).named
        if finding.published.problem == "NPL" and "chart" in inputs:
            auto = "autocorrelation" in finding.published.quantity
            name = "sd_autocorrelated" if auto else "sd_natural"
            row = rows[int(inputs["chart"][0])]
            row[name] = number_cell(finding.computed)
            row[f"{name}_printed"] = finding.published.printed
    return _frame(rows.values())


def figure_frames() -> Mapping[str, pd.DataFrame]:
    """Return the numbers behind each plot of section 5, by the name of the figure."""
    return {
        "figure_5_1": _curves(
            {
                f"w_{k * n}_{n}": race_win_probability(_HUNDREDTHS, k * n, n)
                for k in (1, 2)
                for n in range(1, _SIZE + 1)
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
        "figure_5_8": _frame(
            {
                "p": number_cell(p),
                **{
                    f"d_{level}": fixed_cell(chance)
                    for level, chance in zip(
                        range(1, LEVELS + 1), drill(p).distribution.probability, strict=True
                    )
                },
            }
            for p in _HUNDREDTHS
        ),
        "figure_5_9": _ladders(),
        "figure_5_11": _curves(
            {f"w_{m}_{n}": win_probability(Ahead(m, n, Rack(_HUNDREDTHS))) for m, n in HANDICAPS}
        ),
    }


def _share(name: str) -> Callable[[Any, Any], Any]:
    return lambda p1, p2: long_run_share(p1, p2, BREAK_FORMATS[name])


def _curves(columns: Mapping[str, Any]) -> pd.DataFrame:
    return _frame(
        {"p": number_cell(p), **{name: fixed_cell(values[k]) for name, values in columns.items()}}
        for k, p in enumerate(_HUNDREDTHS)
    )


def _surfaces(functions: Mapping[str, Callable[[Any, Any], Any]]) -> pd.DataFrame:
    return _frame(
        {
            "p1": number_cell(p1),
            "p2": number_cell(p2),
            **{name: fixed_cell(function(p1, p2)) for name, function in functions.items()},
        }
        for p1 in _INSIDE
        for p2 in _INSIDE
    )


def _ladders() -> pd.DataFrame:
    laws = {
        f"{kind}_{number}": ladder(number, autocorrelated=kind == "autocorrelated")
        for kind in ("natural", "autocorrelated")
        for number in CHARTS
    }
    errors = next(iter(laws.values())).values  # noqa: PD011
    return _frame(
        {"rating_error": error, **{n: fixed_cell(law.probability[k]) for n, law in laws.items()}}
        for k, error in enumerate(errors)
    )


def _column(name: str) -> str:
    """Return a quantity as the name of a column; P is what a critical value covers.

    >>> _column("median/mean"), _column("W winner breaks"), _column("P")
    ('median_over_mean', 'w_winner_breaks', 'coverage')
    """
    if name == "P":
        return "coverage"
    return re.sub(r"\W+", "_", name.replace("/", " over ").lower())


def _frame(rows: Iterable[Mapping[str, Any]]) -> pd.DataFrame:
    import pandas as pd

    return pd.DataFrame(list(rows), dtype=object)
