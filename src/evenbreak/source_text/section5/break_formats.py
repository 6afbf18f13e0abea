"""P5.24, P5.25 and Table 5.4: who breaks next, and what that is worth."""

from __future__ import annotations

from collections.abc import Iterator

from evenbreak.chains.explore import chain_of
from evenbreak.chains.rewards import long_run_reward
from evenbreak.chains.spectrum import spectrum
from evenbreak.games.breaks import BREAK_FORMATS
from evenbreak.games.rack import Rack
from evenbreak.games.series import Series
from evenbreak.practice.breaks import compare_break_formats, long_run_share
from evenbreak.source_text.inputs import Answers, Inputs
from evenbreak.source_text.section5.rows import Derived, Row, formulas

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
"""The rows p1, p2 of Table 5.4."""


def _share(inputs: Inputs, name: str) -> float:
    p1, p2 = inputs["p1"], inputs["p2"]
    return float(long_run_share(p1, p2, BREAK_FORMATS[name]))


def _points(inputs: Inputs) -> float:
    rack = Rack(inputs["p1"], inputs["p2"])
    win, lose = inputs["win"], inputs["lose"]
    values = compare_break_formats(rack, win=win, lose=lose)
    points = {value.name: value.points for value in values}
    return points[inputs.words[0]]


ANSWERS: Answers = {
    ("Table 5.4", "W winner breaks"): lambda i: _share(i, "winner"),
    ("Table 5.4", "W loser breaks"): lambda i: _share(i, "loser"),
    ("Table 5.4", "W alternate breaks"): lambda i: _share(i, "alternate"),
    ("Table 5.4", "W winner breaks less 1/2"): lambda i: _share(i, "winner") - 0.5,
    ("Table 5.4", "W alternate breaks less 1/2"): lambda i: _share(i, "alternate") - 0.5,
    ("P5.25", "expected points per game"): _points,
}


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


DERIVED: Derived = {"P5.24": _p5_24, "P5.25": _p5_25}
