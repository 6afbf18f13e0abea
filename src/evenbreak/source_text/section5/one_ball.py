"""P5.20 to P5.23: the one-ball game, by its series, by two shots and by its chain."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from evenbreak.chains.chain import Chain
from evenbreak.chains.explore import chain_of
from evenbreak.chains.limits import stochastic_limit
from evenbreak.chains.powers import propagate
from evenbreak.chains.spectrum import spectrum
from evenbreak.games.one_ball import OneBall
from evenbreak.practice.shots import critical_p2, one_ball_win
from evenbreak.source_text.inputs import Answers, Inputs
from evenbreak.source_text.section5.rows import Derived, Row, formulas

SHOTS = ((0.1, 0.9), (0.9, 0.1), (0.9, 0.9), (0.5, 0.5), (0.25, 0.33), (0.4, 0.8), (0.3, 0.3))
"""The pairs p1, p2 of the table in P5.22."""
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


ANSWERS: Answers = {
    ("P5.22", "W infinite look-ahead"): lambda i: _win(i, "infinite"),
    ("P5.22", "W two-shot look-ahead"): lambda i: _win(i, "two shots"),
    ("P5.22", "critical p2"): lambda i: critical_p2(i["p1"]),
    ("P5.23", "number of eigenvalues 1"): lambda _: spectrum(_chain()).units,
}


def _p5_20() -> Iterator[Row]:
    yield from _surface("P5.20", "infinite")


def _p5_21() -> Iterator[Row]:
    yield from _surface("P5.21", "two shots")


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


DERIVED: Derived = {"P5.20": _p5_20, "P5.21": _p5_21, "P5.22": _p5_22, "P5.23": _p5_23}
