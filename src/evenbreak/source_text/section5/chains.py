"""P5.20 to P5.27, Tables 5.4 and 5.5 and the ladder: answers read off a chain's limit.

These are the one-ball game, who breaks next and what that is worth, drills, leads, and ratings.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache, partial

from evenbreak.chains import Chain, chain_of, long_run_reward, propagate, spectrum, stochastic_limit
from evenbreak.games import BREAK_FORMATS, Ahead, Drill, OneBall, Rack, Series
from evenbreak.handicaps import AUTOCORRELATED, NATURAL, Ladder, chart
from evenbreak.matches import race_win_probability, win_probability
from evenbreak.practice import (
    DrillStatistics,
    compare_break_formats,
    critical_p2,
    drill_statistics,
    long_run_share,
    one_ball_win,
)
from evenbreak.ratings import SCALES
from evenbreak.source_text.published import Answers, Derived, Inputs, Row, formulas
from evenbreak.stats import Distribution

SHOTS = ((0.1, 0.9), (0.9, 0.1), (0.9, 0.9), (0.5, 0.5), (0.25, 0.33), (0.4, 0.8), (0.3, 0.3))
"""The pairs p1, p2 in the table in P5.22."""
_NODES = ("W", "S1", "S2", "L")
_P1, _P2 = 0.4, 0.8
_STARTS: dict[str, dict[str, float]] = {
    "v": {"S1": 1.0},
    "w": {"S2": 1.0},
    "half v, half w": {"S1": 0.5, "S2": 0.5},
}
_STEPS = 5


def _win(inputs: Inputs, look_ahead: str) -> float:
    p1, p2 = inputs["p1"], inputs["p2"]
    return float(one_ball_win(p1, p2, look_ahead=look_ahead))


@cache
def _chain() -> Chain:
    return chain_of(OneBall(_P1, _P2))


def _surface(problem: str, look_ahead: str) -> Iterator[Row]:
    win, critical = formulas(problem)
    yield from (win, critical)
    for tenths in range(1, 6):
        p1 = tenths / 10
        yield Row("critical p2", f"p1={p1}", critical_p2(p1))
    name = win.quantity.removeprefix("formula: ")
    for tenths in range(1, 10):
        p1 = tenths / 10
        for p2 in (0.1, 0.5, 0.9):
            yield Row(name, f"p1={p1} p2={p2}", one_ball_win(p1, p2, look_ahead=look_ahead))


def _p5_22() -> Iterator[Row]:
    for p1, p2 in SHOTS:
        worth = one_ball_win(p1, p2) - one_ball_win(p1, p2, look_ahead="two shots")
        yield Row("W infinite less W two-shot", f"p1={p1} p2={p2}", worth)


def _p5_23() -> Iterator[Row]:
    chain = _chain()
    written = {row[:2]: row for row in formulas("P5.23")}
    inputs = f"p1={_P1} p2={_P2}"
    for start, density in _STARTS.items():
        for step in range(_STEPS + 1) if start != "half v, half w" else (0,):
            now = propagate(chain, density, steps=step)
            for node in _NODES:
                yield Row(f"{start}, step {step}", f"{inputs} node={node}", now[chain.index(node)])
        limit = stochastic_limit(chain, density)
        for node in _NODES:
            yield Row(f"{start}, limit", f"{inputs} node={node}", limit[node])
            yield written.pop((f"formula: {start}, limit", f"node={node}"))
    values = sorted(spectrum(chain).values.tolist(), reverse=True)
    for number, value in enumerate(values, 1):
        yield Row(f"eigenvalue {number}", inputs, value)
    yield from written.values()


FORMATS = ("winner", "loser", "alternate")
PAIRS = (
    (0.1, 0.1),
    (0.5, 0.5),
    (0.9, 0.9),
    (0.1, 0.9),
    (0.9, 0.1),
    (0.5, 0.1),
    (0.5, 0.9),
    (0.9, 0.5),
    (0.1, 0.5),
    (0.95, 0.94),
)
"""The rows p1, p2 in Table 5.4."""


def _share(inputs: Inputs, name: str) -> float:
    p1, p2 = inputs["p1"], inputs["p2"]
    return float(long_run_share(p1, p2, BREAK_FORMATS[name]))


def _points(inputs: Inputs) -> float:
    rack = Rack(inputs["p1"], inputs["p2"])
    win, lose = inputs["win"], inputs["lose"]
    values = compare_break_formats(rack, win=win, lose=lose)
    points = {value.name: value.points for value in values}
    return points[inputs.words[0]]


def _p5_24() -> Iterator[Row]:
    yield from formulas("P5.24")
    for p1, p2 in PAIRS:
        for name in FORMATS:
            series = Series(Rack(p1, p2), breaks=BREAK_FORMATS[name])
            chain = chain_of(series)
            wins = {state: series.rack.chance(1, state) for state in (1, 2)}
            inputs = f"{name} breaks p1={p1} p2={p2}"
            reward = long_run_reward(chain, per_state=wins)
            yield Row("W by the chain", inputs, reward)
            second = min(spectrum(chain).values.tolist())
            yield Row("second eigenvalue", inputs, second)


def _p5_25() -> Iterator[Row]:
    yield from formulas("P5.25")
    for value in sorted(
        compare_break_formats(Rack(0.9, 0.5), win=1, lose=2),
        key=lambda value: list(BREAK_FORMATS).index(value.name),
    ):
        inputs = f"{value.name} breaks p1=.9 p2=.5"
        yield Row("W", inputs, value.share)
        yield Row("even stakes: points for a win per point for a loss", inputs, value.fair_ratio)


DRILL_P = ("0.5", "0.6", "0.7", "0.8", "0.9", "0.95", "0.99")
"""The shot chances in Table 5.5."""
LEVELS = 9
HANDICAPS = ((1, 5), (2, 4), (3, 3), (4, 2), (5, 1))
"""The leads m, n in P5.27."""
CHARTS = (8, 10, 12, 20)
"""The charts in Table 5.6."""


@cache
def drill(p: float) -> DrillStatistics:
    """Return the statistics of the model progressive 9-ball drill."""
    return drill_statistics(Drill.progressive(p, LEVELS))


@cache
def ladder(number: int, *, autocorrelated: bool = False) -> Distribution:
    """Return the distribution of the rating error under one of the charts."""
    opponents = AUTOCORRELATED if autocorrelated else NATURAL
    return Ladder(chart(f"npl_{number}"), opponents=opponents).law()


def _drill(inputs: Inputs) -> DrillStatistics:
    return drill(inputs["p"])


def _ladder_sd(inputs: Inputs, *, autocorrelated: bool) -> float:
    return ladder(int(inputs.one("chart")), autocorrelated=autocorrelated).sd


def _ahead(inputs: Inputs) -> float:
    m, n = map(int, inputs.all())
    return float(win_probability(Ahead(m, n, Rack(inputs["p"]))))


def _ahead_chain(inputs: Inputs) -> Ahead:
    m, n = map(int, inputs.all())
    return Ahead(m, n, Rack(0.6))


def _even_race(m: int, n: int) -> float:
    return float(race_win_probability(0.5, m, n))


def _odds_of_30() -> float:
    p = SCALES["npl"].win_probability(30)
    return float(p / (1.0 - p))


def _p5_26() -> Iterator[Row]:
    for p in DRILL_P:
        statistics = drill(float(p))
        yield Row("level most worth practicing", f"p={p}", statistics.practice_next)
        for level, gain in enumerate(statistics.gain, 1):
            yield Row("gain of the mean level", f"p={p} level={level}", gain)


def _p5_27() -> Iterator[Row]:
    yield from formulas("P5.27")
    for m, n in HANDICAPS:
        for tenths in range(11):
            p = tenths / 10
            win = win_probability(Ahead(m, n, Rack(p)))
            yield Row("W", f"{m}:{n} p={p}", win)


ANSWERS: Answers = {
    ("P5.22", "W infinite look-ahead"): lambda i: _win(i, "infinite"),
    ("P5.22", "W two-shot look-ahead"): lambda i: _win(i, "two shots"),
    ("P5.22", "critical p2"): lambda i: critical_p2(i["p1"]),
    ("P5.23", "number of eigenvalues 1"): lambda _: spectrum(_chain()).units,
    ("Table 5.4", "W winner breaks"): lambda i: _share(i, "winner"),
    ("Table 5.4", "W loser breaks"): lambda i: _share(i, "loser"),
    ("Table 5.4", "W alternate breaks"): lambda i: _share(i, "alternate"),
    ("Table 5.4", "W winner breaks less 1/2"): lambda i: _share(i, "winner") - 0.5,
    ("Table 5.4", "W alternate breaks less 1/2"): lambda i: _share(i, "alternate") - 0.5,
    ("P5.25", "expected points per game"): _points,
    **{
        ("Table 5.5", f"d{level}"): lambda i, level=level: (  # type: ignore[misc]
            _drill(i).distribution.probability[level - 1]
        )
        for level in range(1, LEVELS + 1)
    },
    ("Table 5.5", "mean"): lambda i: _drill(i).distribution.mean,
    ("Table 5.5", "mode"): lambda i: _drill(i).distribution.mode,
    ("Table 5.5", "median"): lambda i: _drill(i).distribution.median,
    ("Table 5.5", "standard deviation"): lambda i: _drill(i).distribution.sd,
    ("NPL", "sd of the natural rating distribution"): lambda i: _ladder_sd(i, autocorrelated=False),
    ("NPL", "sd with autocorrelation (self-consistent opponents)"): lambda i: _ladder_sd(
        i, autocorrelated=True
    ),
    ("NPL", "W(1/2;5,5) at the even races of chart 10"): lambda _: _even_race(5, 5),
    ("NPL", "W(1/2;5,4) after +1 at the edge of chart 10"): lambda _: _even_race(5, 4),
    ("NPL", "W(1/2;4,5)"): lambda _: _even_race(4, 5),
    ("NPL", "odds p/q at 30 points"): lambda _: _odds_of_30(),
    ("P5.27", "n-ahead match probability"): _ahead,
    ("P5.27", "number of nodes"): lambda i: len(chain_of(_ahead_chain(i)).states),
    ("P5.27", "number of eigenvalues 1"): lambda i: spectrum(chain_of(_ahead_chain(i)), 2).units,
}
"""How each quantity in these problems is computed."""

DERIVED: Derived = {
    "P5.20": partial(_surface, "P5.20", "infinite"),
    "P5.21": partial(_surface, "P5.21", "two shots"),
    "P5.22": _p5_22,
    "P5.23": _p5_23,
    "P5.24": _p5_24,
    "P5.25": _p5_25,
    "P5.26": _p5_26,
    "P5.27": _p5_27,
}
"""What these problems have beyond the numbers that the text prints."""
