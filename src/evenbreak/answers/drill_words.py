"""What a drill and its log tell, in the words of a player."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

from evenbreak.practice.levels import MORE

if TYPE_CHECKING:
    from evenbreak.practice.drills import DrillStatistics
    from evenbreak.practice.log_analysis import LogAnalysis
    from evenbreak.practice.log_tests import PlayedAgainTest

SPACE = "\u00a0"
"""A space at which no line is broken."""

ODD = 0.05
"""A p-value below which chance is not blamed."""

AS_OFTEN = "as often"

SURE = 0.8
"""From this probability on, the second best level is not mentioned."""


def drill_advice(statistics: DrillStatistics) -> str:
    """Return where practice lifts the mean level of a drill most, in words.

    >>> from evenbreak.games import Drill
    >>> from evenbreak.practice import drill_statistics
    >>> drill_advice(drill_statistics(Drill.progressive(0.8))).split(": ")[0]
    'Practice helps most at level 4'
    """
    level = statistics.practise_next
    if level is None:
        return "More success would lift the mean level nowhere."
    lift = statistics.lift[level - 1]
    return (
        f"Practice helps most at level {level}: {_better(statistics.drill.success[level - 1])} "
        f"there lift the mean level by {lift:.2f}."
    )


def log_advice(analysis: LogAnalysis) -> Iterator[str]:
    """Yield what a log tells, a paragraph each: what to practise, then what is odd or not."""
    yield _practise(analysis) + _untried(analysis)
    test = analysis.difference
    yield (
        "Are you where your chances lead? If you went on for ever with the successes of this "
        f"log, {100 * test.seen:.0f} attempts in 100 would be at other levels than so far. In "
        f"sessions like yours, played by chance, that is {100 * test.by_chance:.0f} in 100. "
        + _verdict(test, "That is more than", "Nothing odd")
        + (" Perhaps you stop when it goes well." if test.p_value < ODD else "")
    )
    if analysis.memory is not None:
        yield _memory(analysis.memory)
    yield from _model(analysis)


def _practise(analysis: LogAnalysis) -> str:
    best = analysis.practise_next
    missed = [report for report in analysis.levels if report.attempts > report.successes]
    if best is None:
        return _nothing_to_practise(levels=len(analysis.levels), missed=bool(missed))
    told = (
        f"Practise level {best.level} next: {_better(best.p or 0.0)} there "
        f"lift your mean level by {best.lift:.2f} ({best.lift_low:.2f} to {best.lift_high:.2f}). "
    )
    others = [report for report in missed if report is not best]
    if not others:
        return f"{told}It is the only level that you missed."
    told += f"It is {_percent(best.p_best)} sure that no other level helps more"
    second = max(others, key=lambda report: report.p_best)
    if best.p_best >= SURE:
        return f"{told}."
    return (
        f"{told}, and {_percent(second.p_best)} for level {second.level}; a longer log will tell "
        "them apart."
    )


def _nothing_to_practise(*, levels: int, missed: bool) -> str:
    if levels == 1:
        return (
            "Taken as a drill of level 1 alone, there is nothing to climb; say how many levels the "
            "drill has."
        )
    if not missed:
        return (
            "You never missed, so your log cannot tell yet what to practise; log more attempts, "
            "at higher levels if the drill has them."
        )
    return "No level that you missed would lift your mean level."


def _untried(analysis: LogAnalysis) -> str:
    """Return what the first level counts as that nobody tried above one that was tried."""
    for below, report in pairwise(analysis.levels):
        if below.attempts and not report.attempts:
            return (
                f" You never tried level {report.level}: it counts as one that never succeeds "
                "until your log says otherwise."
            )
    return ""


def _better(p: float) -> str:
    """Return by how much a chance p is raised to see what a level is worth."""
    return "five more successes in 100" if p <= 1.0 - MORE else "successes without a miss"


def _percent(p: float) -> str:
    """Return a chance in words that promise nothing for certain.

    >>> [_percent(p).replace(SPACE, " ") for p in (0.714, 0.9995, 0.001)]
    ['71 %', 'more than 99 %', 'less than 1 %']
    """
    if p > 0.99:
        return f"more than 99{SPACE}%"
    return f"less than 1{SPACE}%" if p < 0.01 else f"{100 * p:.0f}{SPACE}%"


def _p(test: PlayedAgainTest) -> str:
    return f"(p{SPACE}={SPACE}{test.p_value:.2g})"


def _verdict(test: PlayedAgainTest, odd: str, plain: str) -> str:
    return f"{odd} chance explains {_p(test)}." if test.p_value < ODD else f"{plain} {_p(test)}."


def _memory(test: PlayedAgainTest) -> str:
    often = _often(test.seen)
    told = (
        f"Does one attempt weigh on the next? At the same level you succeed {often} after a "
        f"success {'as' if often == AS_OFTEN else 'than'} after a miss; by chance alone it would "
        f"be {_often(test.by_chance)}. "
    )
    if test.p_value >= ODD:
        return told + f"No sign of it {_p(test)}."
    why = (
        "a miss seems to weigh on the next attempt"
        if test.seen > test.by_chance
        else "a success seems to make the next attempt worse"
    )
    return told + f"More than chance explains {_p(test)}: {why}."


def _often(difference: float) -> str:
    """Return a difference of two chances in words.

    >>> _often(0.024), _often(-0.3), _often(0.004)
    ('2 times in 100 more often', '30 times in 100 less often', 'as often')
    """
    hundredths = round(100 * difference)
    if not hundredths:
        return AS_OFTEN
    many = f"{abs(hundredths)} time{'s' * (abs(hundredths) > 1)} in 100"
    return f"{many} {'more' if hundredths > 0 else 'less'} often"


def _model(analysis: LogAnalysis) -> Iterator[str]:
    model, off = analysis.model, analysis.furthest_off_model
    if model is None or off is None:
        yield "Without attempts above level 1 nothing can be said of a single shot."
        return
    told = (
        f"If level i takes i - 1 good shots in a row, a shot succeeds "
        f"with {model.p:.3f} ({model.low:.3f} to {model.high:.3f})."
    )
    test = analysis.model_test
    if test is not None:
        told += _verdict(
            test, " But levels differ from that more than", " No level stands out from that"
        )
        if test.p_value < ODD:
            told += (
                f" The furthest off is level {off.level}: {off.successes} of {off.attempts} "
                f"succeeded, and it would be {off.attempts * (off.p_model or 0.0):.0f}."
            )
    if model.level_1_misses:
        told += (
            f" By that level 1 could not be missed, so its {model.level_1_attempts} attempts, "
            f"{model.level_1_misses} missed, are left out of it."
        )
    yield told
