"""P5.1 to P5.3, P5.18 and P5.19: averages and spread, samples, and whether it was luck."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import combinations, pairwise, product

from evenbreak.source_text.published import Answers, Derived, Inputs, Row, formulas
from evenbreak.stats import (
    Distribution,
    Moments,
    coverage_within,
    mean_interval,
    merge,
    sd_of_mean,
    was_it_luck,
)

_FIRST, _SECOND = (0, 1, 1, 4, 5), (0, 1, 1, 8, 9)
_SLIPS = (1, 2, 3, 4)
_ROWS = 10
"""The rows in Pascal's triangle, below its tip."""
_POPULATION = (1, 2, 4, 5)
_SCORES = (50, 44, 46, 52, 47, 51, 49, 45, 48, 50)
_NEW = 53


def _values(inputs: Inputs) -> Distribution:
    return Distribution.of(inputs.all("x"))


def _population(inputs: Inputs) -> Distribution:
    return Distribution.of(inputs.all())


def _scores(inputs: Inputs) -> list[float]:
    return [float(score) for score in inputs.all("scores")]


def _both() -> Moments:
    return merge([Moments.of(_FIRST), Moments.of(_SECOND)])


def _units_over(inputs: Inputs, end: float) -> float:
    return (_NEW - end) / Distribution.of(inputs.all("scores")).sd


def _high(inputs: Inputs) -> float:
    return mean_interval(_scores(inputs), 0.8, method="normal").high


def _pair_means(inputs: Inputs) -> Distribution:
    return Distribution.of([(a + b) / 2 for a, b in product(inputs.all(), repeat=2)])


def _cautious_units(inputs: Inputs) -> float:
    return was_it_luck(_scores(inputs), _NEW, confidence=0.8).cautious.units


def _p5_1() -> Iterator[Row]:
    for values in (_FIRST, _SECOND):
        law = Distribution.of(values)
        of = "x=" + _listed(values)
        for value, chance, sum_to in zip(law.values, law.probability, law.cumulative, strict=True):
            yield Row("probability of a value", f"{of} value={value}", chance)
            yield Row("cumulative probability of a value", f"{of} value={value}", sum_to)
        counts = {value: values.count(value) for value in law.values}
        weighted = sum(n * y for y, n in counts.items()) / sum(counts.values())
        yield Row("mean of the values", of, sum(values) / len(values))
        yield Row("mean of distinct values by repetitions", of, weighted)
        yield Row("mean of distinct values by probabilities", of, law.mean)
        for name, quartile in zip(("lower", "upper"), law.quartiles[::2], strict=True):
            yield Row(f"{name} quartile", of, quartile)


def _p5_2() -> Iterator[Row]:
    together = Moments.of([*_FIRST, *_SECOND])
    of = "all ten values"
    yield Row("merged number", of, together.n, "from the values themselves")
    yield Row("merged mean", of, together.mean, "from the values themselves")
    yield Row("merged variance", of, together.variance, "from the values themselves")


def pascals_triangle() -> list[list[int]]:
    """Return Pascal's triangle: each entry is the sum of the two above it, C(n, m) in row n.

    >>> pascals_triangle()[4]
    [1, 4, 6, 4, 1]
    """
    rows = [[1]]
    while len(rows) <= _ROWS:
        rows.append([left + right for left, right in pairwise([0, *rows[-1], 0])])
    return rows


def _p5_3() -> Iterator[Row]:
    for size in range(len(_SLIPS) + 1):
        for number, chosen in enumerate(combinations(_SLIPS, size), 1):
            yield Row(f"choice {number} of {size}", "of 1 2 3 4", "{" + _listed(chosen) + "}")
        closed = math.comb(len(_SLIPS), size)
        yield Row("binomial coefficient", f"n=4 m={size}", closed, "N! / (m! (N - m)!)")
    for n, row in enumerate(pascals_triangle()):
        for m, entry in enumerate(row):
            yield Row("Pascal's triangle", f"n={n} m={m}", entry, "C(n-1, m-1) + C(n-1, m)")


def _p5_18() -> Iterator[Row]:
    sd = Distribution.of(_POPULATION).sd
    everything = _listed(_POPULATION)
    without = Distribution.of([(a + b) / 2 for a, b in combinations(_POPULATION, 2)])
    yield from formulas("P5.18")
    for n in range(1, 5):
        inputs = f"{everything} m={n}"
        yield Row("sd of the mean, with replacement", inputs, sd_of_mean(sd, n))
        yield Row("sd of the mean, without replacement", inputs, sd_of_mean(sd, n, population=4))
    yield Row(
        "sd of the mean, without replacement", f"{everything} m=2 from all six pairs", without.sd
    )


def _p5_19() -> Iterator[Row]:
    of = "scores " + _listed(_SCORES)
    for method, name in (("normal", "normal"), ("t", "Student t")):
        for confidence in (0.8, 0.95):
            interval = mean_interval(_SCORES, confidence, method=method)  # type: ignore[arg-type]
            inputs = f"{of} confidence={confidence}"
            yield Row(f"interval of the true mean, {name}, low", inputs, interval.low)
            yield Row(f"interval of the true mean, {name}, high", inputs, interval.high)
    luck = was_it_luck(_SCORES, _NEW, confidence=0.8)
    readings = (
        ("normal", luck.normal),
        ("Student t", luck.t),
        ("normal, over the 80% interval", luck.cautious),
    )
    for name, reading in readings:
        yield Row(f"a 53, {name}: standard units", of, reading.units)
        yield Row(f"a 53, {name}: chance of a score so far out", of, reading.as_far)


def _listed(values: tuple[int, ...]) -> str:
    return " ".join(map(str, values))


ANSWERS: Answers = {
    ("P5.1", "mean"): lambda i: _values(i).mean,
    ("P5.1", "median"): lambda i: _values(i).median,
    ("P5.1", "mode"): lambda i: _values(i).mode,
    ("P5.1", "variance (population)"): lambda i: _values(i).variance,
    ("P5.1", "standard deviation (population)"): lambda i: _values(i).sd,
    ("P5.2", "merged number"): lambda _: _both().n,
    ("P5.2", "merged mean"): lambda _: _both().mean,
    ("P5.2", "merged variance"): lambda _: _both().variance,
    ("P5.3", "ways to choose"): lambda i: len(
        list(combinations(range(int(i.one("n"))), int(i.one("m"))))
    ),
    ("P5.18", "population mean"): lambda i: _population(i).mean,
    ("P5.18", "population sd"): lambda i: _population(i).sd,
    ("P5.18", "number of 2-element products"): lambda i: len(i.all()) ** 2,
    ("P5.18", "mean of two"): lambda i: _population(i).mean,
    ("P5.18", "mean of 2-element means"): lambda i: _pair_means(i).mean,
    ("P5.18", "sd of 2-element means"): lambda i: sd_of_mean(_population(i).sd, 2),
    ("P5.19", "mean"): lambda i: was_it_luck(_scores(i), _NEW).mean,
    ("P5.19", "sd (population)"): lambda i: mean_interval(_scores(i), method="normal").sd,
    ("P5.19", "sd of the mean"): lambda i: mean_interval(_scores(i), method="normal").sd_of_mean,
    ("P5.19", "80% interval low"): lambda i: mean_interval(_scores(i), 0.8, method="normal").low,
    ("P5.19", "80% interval high"): _high,
    ("P5.19", "a 53 less the mean"): lambda i: _NEW - was_it_luck(_scores(i), _NEW).mean,
    ("P5.19", "a 53 less the interval's high end"): lambda i: _NEW - _high(i),
    ("P5.19", "standard units of a 53"): lambda i: was_it_luck(_scores(i), _NEW).normal.units,
    ("P5.19", "standard units of a 53 over 49.2"): lambda i: _units_over(i, 49.2),
    ("P5.19", "P(abs(z) < 1.51)"): lambda _: coverage_within(1.51),
    ("P5.19", "chance of a score so far out"): lambda i: 1.0 - coverage_within(_cautious_units(i)),
    ("P5.19", "confidence, 1 less that chance"): lambda i: coverage_within(_cautious_units(i)),
}
"""How each quantity in these problems is computed."""

DERIVED: Derived = {
    "P5.1": _p5_1,
    "P5.2": _p5_2,
    "P5.3": _p5_3,
    "P5.18": _p5_18,
    "P5.19": _p5_19,
}
"""What these problems have beyond the numbers that the text prints."""
