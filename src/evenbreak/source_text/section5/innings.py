"""P5.11 to P5.17, Tables 5.2 and 5.3: runs of balls, innings of runs, and fair wagers."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import partial
from itertools import product

from evenbreak.source_text.inputs import Answers, Inputs
from evenbreak.source_text.section5.rows import Derived, Row, formulas
from evenbreak.stats.innings import InningsScore
from evenbreak.stats.runs import RunLength, median_ratio_limit
from evenbreak.stats.summary import Distribution

SCORE_P = range(50, 100, 10)
"""The shot chances of Table 5.3, in hundredths."""
INNINGS = (1, 2, 4, 8, 16)
"""The innings of Table 5.3."""
SAFETIES = (10, 9, 8, 7, 6, 5)
"""The factors on the first shot of the table in P5.15, in tenths."""
_PLAYER = Fraction(24, 25)


def _run(inputs: Inputs) -> RunLength:
    return RunLength(inputs.one("p"))


def _score(inputs: Inputs) -> InningsScore:
    innings = inputs.numbers.get("m") or inputs.all("innings")
    return InningsScore(inputs.one("p"), int(innings[0]))


def _dice() -> Distribution:
    return Distribution.of([sum(pair) for pair in product(range(1, 7), repeat=2)])


ANSWERS: Answers = {
    ("Table 5.2", "mean run"): lambda i: _run(i).mean,
    ("Table 5.2", "median bound"): lambda i: _run(i).median_bound,
    ("Table 5.2", "median run"): lambda i: _run(i).median,
    ("Table 5.2", "median/mean"): lambda i: _run(i).median_ratio,
    ("P5.12", "large-mean limit of median/mean"): lambda _: median_ratio_limit(),
    ("P5.13", "shot probability"): lambda i: RunLength.of_mean(i.one("run")).p,
    ("P5.13", "P(50<=run<=75)"): lambda i: _run(i).between(50, 75),
    ("P5.13", "P(run>=100)"): lambda i: _run(i).at_least(100),
    ("P5.14", "median run"): lambda i: _run(i).median,
    ("P5.14", "P(run<=20)"): lambda i: _run(i).cumulative(20),
    ("P5.14", "P(run>20)"): lambda i: _run(i).at_least(21),
    ("P5.14", "median run by ln(2) times the mean"): lambda i: median_ratio_limit() * _run(i).mean,
    ("P5.15", "ln(2 alpha)/alpha"): lambda i: median_ratio_limit(i.one("alpha")),
    ("P5.16", "P(two dice total 7)"): lambda _: _dice().between(7, 7),
    ("P5.16", "P(two dice total 2)"): lambda _: _dice().between(2, 2),
    ("Table 5.3", "mode"): lambda i: _score(i).mode,
    ("Table 5.3", "mean"): lambda i: _score(i).mean,
    ("Table 5.3", "median"): lambda i: _score(i).median,
    ("P5.17", "mean"): lambda i: _score(i).mean,
    ("P5.17", "mode"): lambda i: _score(i).mode,
    ("P5.17", "median (empirical formula and exact)"): lambda i: _score(i).median,
    ("P5.17", "median by (2 mean + mode)/3"): lambda i: _score(i).median_estimate,
    ("P5.17", "standard deviation"): lambda i: _score(i).sd,
    ("P5.17", "relative deviation"): lambda i: _score(i).relative_sd,
}


def _p5_12() -> Iterator[Row]:
    for mean in (1, 2, 5, 10, 20, 50, 100, 1000):
        run = RunLength.of_mean(mean)
        yield Row("median/mean", f"mean run {mean}", run.median_ratio)


def _p5_13() -> Iterator[Row]:
    run = RunLength(_PLAYER)
    for n in (10, 25, 50, 75, 100, 150):
        yield Row(f"P(run>={n})", "p=.96", run.at_least(n))


def _p5_14() -> Iterator[Row]:
    line = RunLength(_PLAYER).fair_line
    yield Row("fair line, so much a ball", "p=.96", line.mean, "the mean")
    yield Row("fair line, over or not", "p=.96", line.median, "the median")


def _p5_15() -> Iterator[Row]:
    yield from formulas("P5.15")
    for tenths in SAFETIES:
        run = RunLength(_PLAYER, Fraction(tenths, 10))
        inputs = f"p=.96 alpha={tenths / 10}"
        yield Row("mean run", inputs, run.mean)
        yield Row("median bound", inputs, run.median_bound)
        yield Row("median run", inputs, run.median)
        yield Row("median/mean", inputs, run.median_ratio)


def _p5_16() -> Iterator[Row]:
    yield from formulas("P5.16")
    for hundredths, innings in product(SCORE_P, INNINGS):
        score = InningsScore(Fraction(hundredths, 100), innings)
        inputs = f"p={hundredths / 100} m={innings}"
        yield Row("standard deviation", inputs, score.sd)
        yield Row("median by (2 mean + mode)/3", inputs, score.median_estimate)
    for total, chance in zip(_dice().values, _dice().probability, strict=True):
        yield Row("P(two dice total)", f"total={total}", chance)


def _p5_17() -> Iterator[Row]:
    for innings in (5, 50):
        score = InningsScore(_PLAYER, innings)
        inputs = f"p=.96 innings={innings}"
        line = score.fair_line
        yield Row("fair line, so much a point", inputs, line.mean, "the mean")
        yield Row("fair line, over or not", inputs, line.median, "the median")
        yield Row("best guess of the exact score", inputs, line.mode, "the mode")
        yield Row("P(score is the best guess)", inputs, score.probability(line.mode))
        yield Row("P(score <= the mean)", inputs, score.cumulative(int(line.mean)))
        yield Row("P(score <= the median)", inputs, score.cumulative(line.median))


DERIVED: Derived = {
    "P5.11": partial(formulas, "P5.11"),
    "P5.12": _p5_12,
    "P5.13": _p5_13,
    "P5.14": _p5_14,
    "P5.15": _p5_15,
    "P5.16": _p5_16,
    "P5.17": _p5_17,
}
