"""The numbers behind the plots of section 5."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from evenbreak.games.ahead import Ahead
from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.games.rack import Rack
from evenbreak.matches.win import race_win_probability, win_probability
from evenbreak.practice.breaks import long_run_share
from evenbreak.practice.shots import one_ball_win
from evenbreak.source_text.cells import Records, Tables, record
from evenbreak.source_text.section5.break_formats import FORMATS
from evenbreak.source_text.section5.long_run import CHARTS, HANDICAPS, drill, ladder

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
