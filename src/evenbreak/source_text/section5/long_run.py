"""P5.26 and P5.27, Table 5.5 and the ladder: drills, leads and ratings in the long run."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from evenbreak.chains.explore import chain_of
from evenbreak.chains.spectrum import spectrum
from evenbreak.games.ahead import Ahead
from evenbreak.games.drill import Drill
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.opponents import AUTOCORRELATED, NATURAL
from evenbreak.matches.win import race_win_probability, win_probability
from evenbreak.practice.drills import DrillStatistics, drill_statistics
from evenbreak.ratings.scale import SCALES
from evenbreak.source_text.inputs import Answers, Inputs
from evenbreak.source_text.section5.rows import Derived, Row, formulas
from evenbreak.stats.summary import Distribution

DRILL_P = ("0.5", "0.6", "0.7", "0.8", "0.9", "0.95", "0.99")
"""The shot chances of Table 5.5."""
LEVELS = 9
HANDICAPS = ((1, 5), (2, 4), (3, 3), (4, 2), (5, 1))
"""The leads m, n of P5.27."""
CHARTS = (8, 10, 12, 20)
"""The charts of Table 5.6."""


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


ANSWERS: Answers = {
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


def _p5_26() -> Iterator[Row]:
    for p in DRILL_P:
        found = drill(float(p))
        yield Row("level most worth practising", f"p={p}", found.practise_next)
        for level, gain in enumerate(found.gain, 1):
            yield Row("gain of the mean level", f"p={p} level={level}", gain)


def _p5_27() -> Iterator[Row]:
    yield from formulas("P5.27")
    for m, n in HANDICAPS:
        for tenths in range(11):
            p = tenths / 10
            win = win_probability(Ahead(m, n, Rack(p)))
            yield Row("W", f"{m}:{n} p={p}", win)


DERIVED: Derived = {"P5.26": _p5_26, "P5.27": _p5_27}
