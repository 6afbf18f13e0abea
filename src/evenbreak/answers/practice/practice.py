"""Practice scores: whether they have changed, are rising, or whether a new one was luck."""

from collections.abc import Iterator

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Quantity
from evenbreak.answers.kit.wording import count_of, how_often, luck_words, percent
from evenbreak.arrays import Floats
from evenbreak.files.practice import ScoresFile
from evenbreak.stats.compare import Comparison
from evenbreak.stats.confidence import Luck, MeanInterval, mean_interval, sd_of, was_it_luck
from evenbreak.stats.trend import Trend, TrendLine, trend, trend_line

FEW = 10
"""With fewer scores than this, a single score can change the answer."""

EXPECTED_AT_LEAST = 5.0
"""From this expected count up, chi-squared is a fair approximation."""

LUCK = 0.1
"""From this p-value up, a difference or a slope is no sign of change."""

TESTS = ("welch", "student", "anova", "variances", "mann_whitney", "chi_squared")
"""The tests whose p-values are shown."""


def before_and_after_answer(before: ScoresFile, after: ScoresFile, found: Comparison) -> Answer:
    """Return whether scores have changed, and by how much."""
    sentences = [_change_in_words(found)]
    if found.low is not None and found.high is not None:
        sentences.append(
            f"The true difference is between {found.low:+.2f} and {found.high:+.2f}, with "
            f"{100 * found.confidence:g}% confidence. If you take one score from before and "
            f"one from after, the later one is higher {100 * found.effect.p_after_higher:.0f}% "
            f"of the time."
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
    tests = {name: getattr(found, name) for name in TESTS}
    values = {
        "n_before": found.before.n,
        "mean_before": found.before.mean,
        "sd_before": found.before.sd,
        "n_after": found.after.n,
        "mean_after": found.after.mean,
        "sd_after": found.after.sd,
        "confidence": found.confidence,
        "mean_difference": found.difference,
        "low": found.low,
        "high": found.high,
        **{f"p_{name}": test and test.p_value for name, test in tests.items()},
        "g": effect.g,
        "g_low": effect.low,
        "g_high": effect.high,
        "p_after_higher": effect.p_after_higher,
    }
    notes = {
        "mean_difference": _between(found.low, found.high),
        "g": _between(effect.low, effect.high),
    }
    return quantities_of(values, notes=notes)


def _between(low: float | None, high: float | None) -> str:
    return f"({low:.2f} to {high:.2f})" if low is not None else ""


def _change_in_words(found: Comparison) -> str:
    if found.difference == 0.0 and found.welch is None:
        return f"All scores, before and after, are {found.before.mean:g}: nothing has changed."
    more = "more" if found.difference > 0 else "less"
    change = f"you average {abs(found.difference):.2f} points {more} than before"
    if found.difference == 0.0:
        change = "you average the same as before"
    if 0.0 in (found.before.sd, found.after.sd) or found.welch is None:
        return (
            f"{change.capitalize()}, but a list of equal scores can't show how much of that is "
            "luck."
        )
    p = found.welch.p_value
    if p >= LUCK:
        return (
            f"No sign of a change: {change}, but luck alone would make a difference this large "
            f"{how_often(p)}."
        )
    return (
        f"{change.capitalize()}, and {luck_words(p)}: if nothing had changed, a difference this "
        f"large, up or down, would happen {how_often(p)}."
    )


def _explained(found: Comparison) -> Iterator[str]:
    yield (
        "The answer uses Welch's t test, which was chosen beforehand. The numbers next to the "
        "tests are p-values: how often luck makes a difference at least this large, by that "
        "test's measure, if nothing has changed. The other tests answer other questions; do "
        "not pick the smallest number."
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
            f"one list has only {fewest} scores, so a single unusual score can change the "
            f"answer. Collect at least {FEW} of each."
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


DAYS_A_WEEK = 7.0

DRIFTS = 0.05
"""Below this p-value for the slope, the level of the scores isn't steady."""


def getting_better_answer(file: ScoresFile, *, confidence: float = 0.95) -> Answer:
    """Return whether scores are rising or falling over time, and their average.

    >>> import numpy as np
    >>> from evenbreak.files.practice import ScoresFile
    >>> weeks = np.arange("2024-09-02", "2024-11-04", 7, dtype="M8[D]")
    >>> rising = ScoresFile(np.array([44.0, 45, 47, 46, 48, 49, 49, 51, 52]), weeks, "s.csv", ())
    >>> print(getting_better_answer(rising).sentences[0])
    You gain 0.95 points a week; this is not luck.
    """
    own, line = interval_of(file, confidence), _trend(file, confidence)
    normal = own and mean_interval(file.scores, confidence, method="normal")
    share = f"{100 * confidence:g}%"
    mean = float(file.scores.mean())
    quantities = quantities_of(
        {
            "n": len(file.scores),
            "mean": mean,
            "sd": own and own.sd,
            "confidence": confidence,
            "low": own and own.low,
            "high": own and own.high,
            "low_normal": normal and normal.low,
            "high_normal": normal and normal.high,
            "slope_per_week": line and line.slope,
            "slope_low": line and line.low,
            "slope_high": line and line.high,
            "p_slope": line and line.p_value,
        },
        notes={"mean": _interval(own), "slope_per_week": _interval(line)},
    )
    details: list[Part] = []
    if normal is not None:
        details.append(
            f"All intervals have {share} confidence: that share of such intervals contains the "
            "true value. The interval of the average uses Student's t; the normal distribution "
            f"would give {normal.low:.2f} to {normal.high:.2f}, which is too narrow for few scores."
        )
    if line is not None:
        details.append(
            "The change in a week is the slope of the straight line through the scores. Its chance "
            "is the p-value: how often luck gives a slope at least this steep, up or down, if your "
            "level is steady."
        )
    return Answer(
        f"{count_of(len(file.scores), 'score')} in {file.source}{_days(file)}",
        [_trend_in_words(file, own, line), _average(mean, own, line), Quantities(quantities)],
        details=details,
        warnings=file.warnings,
    )


def _interval(found: MeanInterval | Trend | None) -> str:
    return f"({found.low:.2f} to {found.high:.2f})" if found else ""


def interval_of(file: ScoresFile, confidence: float) -> MeanInterval | None:
    """Return the interval for the true average; None if the scores are all equal."""
    if len(file.scores) < 2 or sd_of(file.scores) == 0.0:
        return None
    return mean_interval(file.scores, confidence)


def _trend(file: ScoresFile, confidence: float) -> Trend | None:
    """Return the trend in points per week; None if there are too few dates."""
    if file.dates is None or len(file.scores) < 3 or sd_of(file.scores) == 0.0:
        return None
    weeks = _weeks(file)
    return trend(weeks, file.scores, confidence) if weeks.any() else None


def trend_line_of(file: ScoresFile, confidence: float) -> TrendLine | None:
    """Return the trend line at each score's date; None if there are too few dates."""
    if _trend(file, confidence) is None:
        return None
    weeks = _weeks(file)
    return trend_line(weeks, file.scores, weeks, confidence)


def _weeks(file: ScoresFile) -> Floats:
    """Return when each score was made, in weeks since the first."""
    dates = np.asarray(file.dates)
    return np.asarray((dates - dates.min()).astype(float) / DAYS_A_WEEK)


def _trend_in_words(file: ScoresFile, own: MeanInterval | None, line: Trend | None) -> str:
    if line is not None:
        change = f"You {'gain' if line.slope >= 0 else 'lose'} {abs(line.slope):.2f} points a week"
        if line.p_value < LUCK:
            return f"{change}; {luck_words(line.p_value)}."
        return (
            f"No sign of a change. {change}, but luck alone would do as much "
            f"{percent(line.p_value)} of the time."
        )
    if len(file.scores) == 1:
        return "A single score can't show whether you are getting better."
    if own is None:
        return "The scores are all equal, so they can't show whether you are getting better."
    if file.dates is None:
        return "Give every score a date to see whether you are getting better."
    return (
        "It takes at least three scores, on more than one date, to see whether you are getting "
        "better."
    )


def _average(mean: float, own: MeanInterval | None, line: Trend | None) -> str:
    if own is None:
        return (
            f"Your average is {mean:.2f}. It takes more scores, not all of them equal, to say how "
            "certain that is."
        )
    text = (
        f"Your average is {mean:.2f} so far; in the long run it is between {own.low:.2f} and "
        f"{own.high:.2f}, with {100 * own.confidence:g}% confidence"
    )
    if line is not None and line.p_value < DRIFTS:
        text += ", but only if your level is steady, which it does not seem to be"
    return f"{text}."


def _days(file: ScoresFile) -> str:
    if file.dates is None:
        return ""
    return f", {file.dates.min()} to {file.dates.max()}"


def new_score_answer(file: ScoresFile, score: float, *, confidence: float = 0.95) -> Answer:
    """Return how often luck alone gives a score like the new one, given two or more that differ."""
    luck = was_it_luck(file.scores, score, confidence=confidence)
    sd = mean_interval(file.scores, confidence).sd
    high = score >= luck.mean
    share, as_high, as_low = f"{100 * confidence:g}%", "" if high else "-", "-" if high else ""
    quantities = quantities_of(
        {
            "-score": score,
            "n": luck.n,
            "mean_earlier": luck.mean,
            "sd_earlier": sd,
            "confidence": confidence,
            "units": luck.t.units,
            "p_as_far": luck.t.as_far,
            f"{as_high}p_as_high": luck.t.as_high,
            f"{as_low}p_as_low": luck.t.as_low,
            f"{as_high}p_as_high_by_rank": luck.as_high_by_rank,
            f"{as_low}p_as_low_by_rank": luck.as_low_by_rank,
            "units_normal": luck.normal.units,
            "p_as_far_normal": luck.normal.as_far,
            "units_cautious": luck.cautious.units,
            "p_as_far_cautious": luck.cautious.as_far,
        },
        share=share,
        n=luck.n + 1,
    )
    return Answer(
        f"{score:g} after {count_of(luck.n, 'score')} in {file.source}",
        [_luck_in_words(luck), Quantities(quantities)],
        details=[
            f"The answer uses Student's t, which allows for the average and the spread being known "
            "only from your earlier scores. The normal distribution ignores that and is "
            f"overconfident. "
            f"The cautious measure counts from the nearer end of the {share} interval of the "
            "average. The rank needs no distribution at all."
        ],
        warnings=file.warnings,
    )


def _luck_in_words(luck: Luck) -> str:
    away = luck.score - luck.mean
    if away == 0.0:
        return f"{luck.score:g} is exactly your average, so it shows nothing new."
    return (
        f"{luck.score:g} is {abs(away):.2f} {'above' if away > 0 else 'below'} your average, and "
        f"{luck_words(luck.t.as_far)}: if nothing has changed, a score this far off, up or down, "
        f"happens {how_often(luck.t.as_far)}. Several new scores would show more than one."
    )
