"""P5.4 to P5.17 and Tables 5.1 to 5.3: races and sets, a long evening, runs, innings and wagers."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from functools import partial
from itertools import pairwise, permutations, product
from typing import Any, NamedTuple

from evenbreak.games import Race, Rack
from evenbreak.matches import race_win_probability, win_probability
from evenbreak.source_text.published import Answers, Derived, Inputs, Row, formulas
from evenbreak.stats import (
    Distribution,
    GamesWon,
    InningsScore,
    RunLength,
    critical_value,
    median_ratio_limit,
    score_probability,
)

_LONGEST = 10
EVENINGS = ((4, "2/3"), (120, "0.52"), (3, "1/2"))
"""The games N and chances p for which P5.9 is computed."""


def match_probability(p: Fraction, m: int, n: int) -> Fraction:
    """Return W(p; m, n) without rounding, using P5.5's sum over the loser's games.

    >>> match_probability(Fraction(2, 3), 3, 2)
    Fraction(16, 27)
    """
    return sum((p * score_probability(p, m - 1, lost) for lost in range(n)), Fraction(0))


def _win(p: float, m: int, n: int) -> float:
    return float(race_win_probability(p, m, n))


def _sets(p: float) -> Race:
    return Race(3, 1, Race(3, 3, Rack(p)))


class _Needs(NamedTuple):
    """The sets that each player needs, and the games that each needs for a set."""

    m: int
    n: int
    set_m: int
    set_n: int


def _games_in(inputs: Inputs) -> _Needs:
    m, n = map(int, inputs.all())
    set_m, set_n = map(int, inputs.numbers.get("of", (1, 1)))
    return _Needs(m, n, set_m, set_n)


def _root(function: Any, low: float, high: float) -> float:
    from scipy.optimize import brentq

    return float(brentq(function, low, high, xtol=1e-14))


def _crossing(n: int) -> float:
    """Return where the curves 2n:n and (2n + 2):(n + 1) cross, for p above 1/2."""
    return _root(lambda p: _win(p, 2 * n, n) - _win(p, 2 * n + 2, n + 1), 0.55, 0.9)


def _fair(n: int) -> float:
    """Return the p for which the race 2n:n is even."""
    return _root(lambda p: _win(p, 2 * n, n) - 0.5, 0.5, 0.9)


def _law(inputs: Inputs) -> GamesWon:
    return GamesWon(int(inputs.one("N")), inputs.one("p"))


def _margin(inputs: Inputs) -> float:
    return float(critical_value(inputs["coverage"])) * _law(inputs).sd


def _orders() -> list[str]:
    return sorted({"".join(order) for order in permutations("WWWL")})


def _p5_4() -> Iterator[Row]:
    p = Fraction(2, 3)
    for order in _orders():
        chance = p ** order.count("W") * (1 - p) ** order.count("L")
        yield Row(f"order {order}", "p=2/3", chance)
    yield Row("P(p;3,1) as a fraction", "p=2/3", str(score_probability(p, 3, 1)))


def _p5_5() -> Iterator[Row]:
    p = Fraction(2, 3)
    yield from formulas("P5.5")
    yield Row("W(p;3,2) as a fraction", "p=2/3", str(match_probability(p, 3, 2)))


def _p5_7() -> Iterator[Row]:
    for n in range(1, _LONGEST + 1):
        yield Row("p where W(p;2n,n)=1/2", f"n={n}", _fair(n))
    for n in range(1, _LONGEST):
        p = _crossing(n)
        yield Row("p where W(p;2n,n)=W(p;2n+2,n+1)", f"n={n}", p)
        yield Row("W where W(p;2n,n)=W(p;2n+2,n+1)", f"n={n}", _win(p, 2 * n, n))
    for (n, fair), (_, after) in pairwise((n, _fair(n)) for n in range(1, _LONGEST + 1)):
        yield Row(
            "width of the span where the longer match is lost more seldom",
            f"n={n}",
            after - _crossing(n),
            f"from the crossing to W(p;2n+2,n+1)=1/2; W(p;2n,n)=1/2 comes at {fair:.4f}",
        )


def _p5_8() -> Iterator[Row]:
    yield Row("3:1 match with the set's chance rounded", "set .790", _win(0.79, 3, 1))
    yield Row("P(player 2 wins 9:5)", "p=2/3", _win(1 / 3, 5, 9))
    yield Row(
        "P(player 2 wins the sets)",
        "p=2/3",
        win_probability(_sets(float(Fraction(2, 3))), player=2),
    )


def _p5_9() -> Iterator[Row]:
    yield from formulas("P5.9")
    for games, p in EVENINGS:
        law = GamesWon(games, Fraction(p))
        inputs = f"N={games} p={p}"
        yield Row("N p - q", inputs, (games + 1) * Fraction(p) - 1)
        yield Row("mode", inputs, law.mode)
        yield Row("number of modes", inputs, len(law.modes))
        yield Row("mean", inputs, law.mean)
        yield Row("standard deviation", inputs, law.sd)


def _p5_10() -> Iterator[Row]:
    law = GamesWon(120, Fraction("0.52"))
    for coverage in (0.95, 0.5):
        inputs = f"N=120 p=.52 coverage={coverage}"
        for name, span in (
            ("normal, to the nearest score", law.normal_range(coverage)),
            ("exact, the shortest", law.exact_range(coverage)),
        ):
            yield Row(f"range low, {name}", inputs, span.low)
            yield Row(f"range high, {name}", inputs, span.high)
            yield Row(f"probability of the range, {name}", inputs, span.probability)
    yield Row("exact P(51<=score<=73)", "N=120 p=.52", law.between(51, 73))


SCORE_P = range(50, 100, 10)
"""The shot chances in Table 5.3, in hundredths."""
INNINGS = (1, 2, 4, 8, 16)
"""The innings in Table 5.3."""
SAFETIES = (10, 9, 8, 7, 6, 5)
"""The factors on the first shot in the table in P5.15, in tenths."""
_PLAYER = Fraction(24, 25)


def _run(inputs: Inputs) -> RunLength:
    return RunLength(inputs.one("p"))


def _score(inputs: Inputs) -> InningsScore:
    innings = inputs.numbers.get("m") or inputs.all("innings")
    return InningsScore(inputs.one("p"), int(innings[0]))


def _dice() -> Distribution:
    return Distribution.of([sum(pair) for pair in product(range(1, 7), repeat=2)])


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


ANSWERS: Answers = {
    ("P5.4", "P(p;3,1)"): lambda i: score_probability(i.one("p"), 3, 1),
    ("P5.4", "each way to 3:1"): lambda i: score_probability(i.one("p"), 3, 1) / len(_orders()),
    ("P5.4", "number of ways to 3:1"): lambda _: len(_orders()),
    ("P5.5", "W(p;3,2)"): lambda i: _win(i["p"], 3, 2),
    ("P5.5", "P(3:0)"): lambda i: i.one("p") * score_probability(i.one("p"), 2, 0),
    ("P5.5", "P(3:1)"): lambda i: i.one("p") * score_probability(i.one("p"), 2, 1),
    ("P5.6", "P(p;m,n)"): lambda i: score_probability(i.one("p"), int(i.one("m")), int(i.one("n"))),
    ("P5.6", "W(p;m,n)"): lambda i: match_probability(i.one("p"), int(i.one("m")), int(i.one("n"))),
    ("P5.7", "p where W(p;2,1)=W(p;4,2)"): lambda _: _crossing(1),
    ("P5.7", "W(p;2,1)"): lambda i: _win(i["p"], 2, 1),
    ("P5.7", "W(p;4,2)"): lambda i: _win(i["p"], 4, 2),
    ("P5.7", "p where W(p;4,2)=1/2"): lambda _: _fair(2),
    ("P5.7", "W(1/2;n,n)"): lambda i: _win(0.5, int(i.one("n")), int(i.one("n"))),
    ("P5.8", "W(p;9,5)"): lambda i: _win(i["p"], 9, 5),
    ("P5.8", "set W(p;3,3)"): lambda i: _win(i["p"], 3, 3),
    ("P5.8", "3:1 match of 3:3 sets"): lambda i: win_probability(_sets(i["p"])),
    ("P5.8", "9:5, above an even chance"): lambda i: _win(i["p"], 9, 5) - 0.5,
    ("P5.8", "sets, below an even chance"): lambda i: 0.5 - win_probability(_sets(i["p"])),
    ("P5.8", "games that player 1 must win"): lambda i: _games_in(i).m * _games_in(i).set_m,
    ("P5.8", "fewest games that player 2 wins with"): lambda i: _games_in(i).n * _games_in(i).set_n,
    ("P5.8", "most games that player 2 can win and lose"): lambda i: (
        _games_in(i).m * (_games_in(i).set_n - 1) + _games_in(i).set_n * (_games_in(i).n - 1)
    ),
    ("P5.10", "mean"): lambda i: _law(i).mean,
    ("P5.10", "standard deviation"): lambda i: _law(i).sd,
    ("P5.10", "margin z_c sd"): _margin,
    ("P5.10", "range low, normal"): lambda i: _law(i).mean - _margin(i),
    ("P5.10", "range high, normal"): lambda i: _law(i).mean + _margin(i),
    ("P5.10", "exact P(59<=score<=66)"): lambda i: _law(i).between(59, 66),
    ("Table 5.1", "z_c"): lambda i: critical_value(i["P"]),
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
"""How each quantity in these problems is computed."""

DERIVED: Derived = {
    "P5.4": _p5_4,
    "P5.5": _p5_5,
    "P5.7": _p5_7,
    "P5.8": _p5_8,
    "P5.9": _p5_9,
    "P5.10": _p5_10,
    "P5.11": partial(formulas, "P5.11"),
    "P5.12": _p5_12,
    "P5.13": _p5_13,
    "P5.14": _p5_14,
    "P5.15": _p5_15,
    "P5.16": _p5_16,
    "P5.17": _p5_17,
}
"""What these problems have beyond the numbers that the text prints."""
