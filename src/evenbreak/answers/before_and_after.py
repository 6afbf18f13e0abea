"""Whether scores have changed: two lists of them, before and after."""

from collections.abc import Iterator

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Quantities, Quantity, statistic
from evenbreak.answers.wording import chance, count_of, decimals, how_often, luck_words
from evenbreak.files.practice import ScoresFile
from evenbreak.stats.compare import Comparison, Scores

TWO = decimals(2)

FEW = 10
"""With fewer scores than this, a single one can change the answer."""

EXPECTED_AT_LEAST = 5.0
"""From this expected count on, chi-squared is a fair approximation."""

LUCK = 0.1
"""From this p-value on, a difference is no sign of a change."""

TESTS = (
    ("welch", "Welch's t: are the averages equal?"),
    ("student", "Student's t: the same, if the spreads are equal"),
    ("anova", "analysis of variance: the same again"),
    ("variances", "F: are the spreads equal?"),
    ("mann_whitney", "Mann-Whitney: by ranks"),
    ("chi_squared", "chi-squared: above or below the median of all"),
)
"""Each test, with the question that it answers."""


def before_and_after_answer(before: ScoresFile, after: ScoresFile, found: Comparison) -> Answer:
    """Return whether scores have changed, and by how much.

    Parameters
    ----------
    before, after
        the files of the two lists.
    found
        their comparison.

    >>> import numpy as np
    >>> from evenbreak.files.practice import ScoresFile
    >>> from evenbreak.stats import compare
    >>> old = np.array([50.0, 44, 46, 52, 47, 51, 49, 45, 48, 50])
    >>> files = [ScoresFile(scores, None, "s.csv", ()) for scores in (old, old + 2)]
    >>> found = compare(old, old + 2)
    >>> print(before_and_after_answer(*files, found).sentences[0])
    No sign of a change: you average 2.00 points more than before, but luck alone makes a difference
    this large about 11 times in 100.
    """
    sentences = [_in_words(found)]
    if found.low is not None and found.high is not None:
        sentences.append(
            f"The true difference is between {found.low:+.2f} and {found.high:+.2f}, with "
            f"{100 * found.confidence:g}% confidence. Of one score before and one "
            f"after, the later one is higher {100 * found.effect.p_after_higher:.0f}% of the time."
        )
    return Answer(
        f"Before: {_scores(before)}\nAfter: {_scores(after)}",
        [*sentences, Quantities(_quantities(found))],
        details=list(_explained(found)),
        warnings=[*before.warnings, *after.warnings, *_doubts(found)],
    )


def _scores(file: ScoresFile) -> str:
    return f"{count_of(len(file.scores), 'score')} in {file.source}"


def _quantities(found: Comparison) -> list[Quantity]:
    effect = found.effect
    return [
        *_summary("before", found.before),
        *_summary("after", found.after),
        Quantity("confidence", found.confidence),
        Quantity(
            "difference", found.difference, "difference", TWO, _between(found.low, found.high)
        ),
        Quantity("low", found.low),
        Quantity("high", found.high),
        *(
            statistic(f"p_{name}", test and test.p_value, words, chance)
            for name, words in TESTS
            for test in [getattr(found, name)]
        ),
        statistic(
            "g",
            effect.g,
            "Hedges' g: difference in standard deviations",
            TWO,
            _between(effect.low, effect.high),
        ),
        Quantity("g_low", effect.low),
        Quantity("g_high", effect.high),
        Quantity("p_after_higher", effect.p_after_higher, "the later score is higher", chance),
    ]


def _between(low: float | None, high: float | None) -> str:
    return f"({low:.2f} to {high:.2f})" if low is not None else ""


def _summary(when: str, scores: Scores) -> list[Quantity]:
    return [
        Quantity(f"n_{when}", scores.n),
        Quantity(f"mean_{when}", scores.mean, f"average {when}", TWO),
        statistic(f"sd_{when}", scores.sd, f"standard deviation {when}", TWO),
    ]


def _in_words(found: Comparison) -> str:
    if found.difference == 0.0 and found.welch is None:
        return f"All scores, before and after, are {found.before.mean:g}: nothing has changed."
    more = "more" if found.difference > 0 else "less"
    change = f"you average {abs(found.difference):.2f} points {more} than before"
    if found.difference == 0.0:
        change = "you average the same as before"
    if 0.0 in (found.before.sd, found.after.sd) or found.welch is None:
        return (
            f"{change.capitalize()}, but a list of equal scores cannot show how much of that is "
            "luck."
        )
    p = found.welch.p_value
    if p >= LUCK:
        return (
            f"No sign of a change: {change}, but luck alone makes a difference this large "
            f"{how_often(p)}."
        )
    return (
        f"{change.capitalize()}, and {luck_words(p)}: if nothing had changed, a difference this "
        f"large, up or down, would happen {how_often(p)}."
    )


def _explained(found: Comparison) -> Iterator[str]:
    yield (
        "The answer uses Welch's t test, which was chosen beforehand. The numbers beside the tests "
        "are p-values: how often luck makes a difference at least this large, by that test's "
        "measure, if nothing has changed. The other tests answer other questions; do not pick the "
        "smallest number."
    )
    if found.mann_whitney is not None and found.ties:
        yield "Some scores are equal, so the p-value of Mann-Whitney is an approximation."
    if 0.0 < _least_expected(found.counts) < EXPECTED_AT_LEAST:
        yield "Chi-squared expects fewer than 5 scores in a cell, so its p-value is a rough one."


def _doubts(found: Comparison) -> Iterator[str]:
    before, after = found.before, found.after
    fewest = min(before.n, after.n)
    if fewest < FEW:
        yield (
            f"one list has only {fewest} scores, so a single unusual score can change the answer; "
            f"gather {FEW} or more of each"
        )
    for name, side, other in (("before", before, after), ("after", after, before)):
        if side.sd == 0.0 < other.sd:
            yield (
                f"all scores {name} are {side.mean:g}, so their spread is not known; the p-values "
                "are too small and the intervals too narrow"
            )


def _least_expected(counts: tuple[tuple[int, int], tuple[int, int]]) -> float:
    (a, b), (c, d) = counts
    total = a + b + c + d
    return min(a + b, c + d) * min(a + c, b + d) / total if total else 0.0
