"""Whether a player is getting better: the scores of a drill over time."""

import numpy as np

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Part, Quantities, Quantity, statistic
from evenbreak.answers.wording import chance, count_of, decimals, luck_words, percent
from evenbreak.arrays import Floats
from evenbreak.files.practice import ScoresFile
from evenbreak.stats.confidence import MeanInterval, mean_interval, sd_of
from evenbreak.stats.trend import Trend, TrendLine, trend, trend_line

TWO = decimals(2)
DAYS_A_WEEK = 7.0

LUCK = 0.1
"""From this p-value on, a slope is no sign of a change."""

DRIFTS = 0.05
"""Below this p-value of the slope, the level of the scores is not steady."""


def getting_better_answer(file: ScoresFile, *, confidence: float = 0.95) -> Answer:
    """Return whether scores rise or fall over time, and what they average.

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
    quantities = [
        Quantity("n", len(file.scores)),
        Quantity("mean", mean, "average", TWO, note=_interval(own)),
        statistic("sd", own and own.sd, "standard deviation", TWO),
        Quantity("confidence", confidence),
        Quantity("low", own and own.low),
        Quantity("high", own and own.high),
        Quantity("low_normal", normal and normal.low),
        Quantity("high_normal", normal and normal.high),
        Quantity("slope_per_week", line and line.slope, "change in a week", TWO, _interval(line)),
        Quantity("slope_low", line and line.low),
        Quantity("slope_high", line and line.high),
        statistic("p_slope", line and line.p_value, "chance of such a slope by luck", chance),
    ]
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
        [_in_words(file, own, line), _average(mean, own, line), Quantities(quantities)],
        details=details,
        warnings=file.warnings,
    )


def _interval(found: MeanInterval | Trend | None) -> str:
    return f"({found.low:.2f} to {found.high:.2f})" if found else ""


def interval_of(file: ScoresFile, confidence: float) -> MeanInterval | None:
    """Return the interval of the true average; None where the scores have no spread."""
    if len(file.scores) < 2 or sd_of(file.scores) == 0.0:
        return None
    return mean_interval(file.scores, confidence)


def _trend(file: ScoresFile, confidence: float) -> Trend | None:
    """Return the trend in points a week; None without enough dates to see one."""
    if file.dates is None or len(file.scores) < 3 or sd_of(file.scores) == 0.0:
        return None
    weeks = _weeks(file)
    return trend(weeks, file.scores, confidence) if weeks.any() else None


def trend_line_of(file: ScoresFile, confidence: float) -> TrendLine | None:
    """Return the line of the trend on the day of each score; None without enough dates for one."""
    if _trend(file, confidence) is None:
        return None
    weeks = _weeks(file)
    return trend_line(weeks, file.scores, weeks, confidence)


def _weeks(file: ScoresFile) -> Floats:
    """Return when each score was made, in weeks since the first."""
    dates = np.asarray(file.dates)
    return np.asarray((dates - dates.min()).astype(float) / DAYS_A_WEEK)


def _in_words(file: ScoresFile, own: MeanInterval | None, line: Trend | None) -> str:
    if line is not None:
        change = f"You {'gain' if line.slope >= 0 else 'lose'} {abs(line.slope):.2f} points a week"
        if line.p_value < LUCK:
            return f"{change}; {luck_words(line.p_value)}."
        return (
            f"No sign of a change. {change}, but luck alone does as much "
            f"{percent(line.p_value)} of the time."
        )
    if len(file.scores) == 1:
        return "A single score cannot show whether you are getting better."
    if own is None:
        return "The scores are all equal, so they cannot show whether you are getting better."
    if file.dates is None:
        return "Give every score a date to see whether you are getting better."
    return (
        "It takes at least three scores, not all on one date, to see whether you are getting "
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
