"""A comparison of two lists of scores in words that a player understands."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from evenbreak.stats.compare import Comparison, Scores

FEW = 10
"""With fewer scores than this, how near to normal their law is matters."""

EXPECTED_AT_LEAST = 5.0
"""The expected count from which on chi-squared is a fair approximation."""

STRENGTHS = (
    (0.01, "strong evidence of a change"),
    (0.05, "evidence of a change"),
    (0.1, "a hint of a change, no more"),
    (1.0, "no evidence of a change: chance alone does this often"),
)
"""What to call a p-value up to each bound."""


ONE_FLAT = "hard to tell, since one list has equal scores only"
"""What to call any p-value where one list shows no spread: it comes out too small."""


def sentence_of(found: Comparison) -> str:
    """Return which way the scores went, how much, how sure that is, and by which test."""
    if found.welch is None or found.low is None or found.high is None:
        return _without_spread(found)
    p = found.welch.p_value
    strength, often = next(words for bound, words in STRENGTHS if p <= bound), how_often(p)
    if 0.0 in (found.before.sd, found.after.sd):
        strength, often = ONE_FLAT, f"{often} or more often"
    wins = 100 * found.effect.p_after_higher
    return (
        f"{_direction(found.difference)} "
        f"({100 * found.confidence:g} % interval {found.low:+.2f} to {found.high:+.2f}). "
        f"By Welch's t test this is {strength}; if nothing had changed, a difference so large, "
        f"up or down, would come {often}. "
        f"In {wins:.0f} of 100 pairs of these scores the one after is higher, a tie counting half."
    )


def warnings_of(
    before: Scores, after: Scores, counts: tuple[tuple[int, int], tuple[int, int]], *, ties: bool
) -> tuple[str, ...]:
    """Return what to keep in mind with these lists, a line each.

    Parameters
    ----------
    before, after
        the two lists in short.
    counts
        their scores (below, above) the median of all.
    ties
        whether scores are equal that the test by ranks compares.
    """
    told = []
    fewest = min(before.n, after.n)
    if fewest < FEW:
        told.append(
            f"one list has only {fewest} scores: one odd score changes the answer; gather "
            f"{FEW} or more of each"
        )
    for name, side, other in (("before", before, after), ("after", after, before)):
        if side.sd == 0.0 < other.sd:
            told.append(
                f"all scores {name} are {side.mean:g}: their spread is not known, so take the "
                "p-values as too small and the intervals as too narrow"
            )
    if ties:
        told.append("some scores are equal: the Mann-Whitney p-value is an approximation")
    if 0.0 < _least_expected(counts) < EXPECTED_AT_LEAST:
        told.append("chi-squared expects fewer than 5 scores in a cell: its p-value is a rough one")
    return tuple(told)


def _without_spread(found: Comparison) -> str:
    if found.difference == 0.0:
        return f"All scores, before and after, are {found.before.mean:g}: nothing has changed."
    return (
        f"{_direction(found.difference)}: all scores before are {found.before.mean:g}, all after "
        f"{found.after.mean:g}. No test of the means can be made without a spread."
    )


def _direction(difference: float) -> str:
    if difference == 0.0:
        return "The mean is the same after as before"
    return f"The mean is {abs(difference):.2f} {'higher' if difference > 0 else 'lower'} after"


def how_often(p: float) -> str:
    """Return how often something of probability p comes, in words.

    >>> how_often(0.012), how_often(0.3), how_often(1.0)
    ('about 1 time in 83', 'about 30 times in 100', 'nearly always')
    """
    if p > 0.99:
        return "nearly always"
    if p < 0.001:
        return "less than 1 time in 1000"
    if p < 0.1:
        return f"about 1 time in {1 / p:.0f}"
    return f"about {100 * p:.0f} times in 100"


def _least_expected(counts: tuple[tuple[int, int], tuple[int, int]]) -> float:
    (a, b), (c, d) = counts
    total = a + b + c + d
    return min(a + b, c + d) * min(a + c, b + d) / total if total else 0.0
