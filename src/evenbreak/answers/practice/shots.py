"""A log of single shots: which to practice next, and whether the player has improved."""

import math
from dataclasses import replace

from evenbreak import practice
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.wording import count_of, how_often, luck_words, percent
from evenbreak.answers.practice.practice import (
    LUCK,
    before_and_after_answer,
    getting_better_answer,
    interval_of,
    new_score_answer,
)
from evenbreak.errors import DataError
from evenbreak.fields.question import worded
from evenbreak.files.practice import ScoresFile, ShotsFile, read_practice, read_scores
from evenbreak.practice.single_shots import Change, ShotAnalysis
from evenbreak.questions.practice import Scores
from evenbreak.stats.compare import compare
from evenbreak.words import Parameter

_CLEAR = 0.5
"""From this chance up, a shot is called the weakest; below it, some are too close to call."""


def shots_answer(file: ShotsFile, found: ShotAnalysis, *, confidence: float = 0.95) -> Answer:
    """Return which shot to practice next, and whether the player has improved.

    >>> import numpy as np
    >>> from evenbreak.practice import ShotLog, analyze_shots
    >>> days = np.array(["2025-01-03", "2025-02-03"], dtype="M8[D]")
    >>> log = ShotLog(("cut", "bank"), [0, 1, 0, 1], [12, 4, 15, 5], [20] * 4, days.repeat(2))
    >>> print(shots_answer(ShotsFile(log, "shots.csv", ()), analyze_shots(log)).sentences[0])
    Practice bank next: you make it 24% of the time, and the chance that it's your weakest shot
    is more than 99%.
    """
    log, since = file.log, None if found.since is None else str(found.since)
    made, tried = int(log.made.sum()), int(log.tried.sum())
    parts: list[Part] = [*([_next_words(found)] if len(log.names) > 1 else [])]
    parts.append(_better_words(found, since))
    change = found.change
    values = {
        "made_before": change and change.before,
        "made_after": change and change.after,
        "odds_ratio": change and _finite(change.ratio),
        "odds_ratio_low": change and change.low,
        "odds_ratio_high": change and _finite(change.high),
        "p_of_change": change and change.p_value,
        "since": since,
    }
    table = _table(found)
    days = "" if log.day is None else f", {log.day.min()} to {log.day.max()}"
    return Answer(
        f"{count_of(len(log.names), 'shot')}, made {made:,} of {tried:,} in {file.source}{days}",
        [*parts, Quantities(quantities_of(values)), table],
        details=[
            f"'Between' and 'and' are the ends of the exact {100 * confidence:g}% interval from "
            f"the shot's own tries. A shot's chance is pulled toward the chances of your other "
            f"shots, more strongly if it has only a few tries; how strongly is estimated from all "
            f"shots together. 'Weakest' is the probability that it is the shot you miss most.",
            "'Before' and 'since' are the earlier and the later half of your tries. The change "
            "of all shots together is tested exactly, shot by shot. With many shots, one or "
            "another will change by luck: do not pick the shot with the smallest number.",
        ],
        warnings=file.warnings,
        csv=table,
    )


def _next_words(found: ShotAnalysis) -> str:
    first, second = found.shots[:2]
    if first.p_weakest >= _CLEAR:
        sure = "more than 99%" if first.p_weakest > 0.99 else percent(first.p_weakest)
        return (
            f"Practice {first.name} next: you make it {percent(first.chance)} of the time, and "
            f"the chance that it's your weakest shot is {sure}."
        )
    return (
        f"Practice {first.name} or {second.name} next: you make them {percent(first.chance)} and "
        f"{percent(second.chance)} of the time, and which shot is your weakest is too close to "
        f"tell ({percent(first.p_weakest)} and {percent(second.p_weakest)} likely)."
    )


def _better_words(found: ShotAnalysis, since: str | None) -> str:
    if since is None:
        return (
            "Give every row a date, with at least two different days, to see whether you are "
            "getting better."
        )
    change = found.change
    if change is None:
        return "No shot was tried in both halves, so the log can't show whether you got better."
    before, after = percent(change.before), percent(change.after)
    seen = f"before {since} you made {before}, and since then {after}"
    same = ", with the same mix of shots" if len(found.shots) > 1 else ""
    if change.p_value >= LUCK:
        return (
            f"No sign of a change: {seen}{same}, but luck alone would do as much "
            f"{how_often(change.p_value)}."
        )
    got = "better" if change.ratio > 1.0 else "worse"
    return (
        f"You got {got}: {seen}{same}; {luck_words(change.p_value)}. The odds of making a shot "
        f"were multiplied by {_times(change)}."
    )


def _times(change: Change) -> str:
    if math.isinf(change.ratio):
        return f"more than {change.low:.2f}"
    if change.ratio == 0.0:
        return f"less than {change.high:.2f}"
    return f"{change.ratio:.2f} (between {change.low:.2f} and {change.high:.2f})"


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _table(found: ShotAnalysis) -> Table:
    columns = columns_of(
        "shot made tried chance_shot chance_low chance_high p_weakest share_before share_after "
        "p_change"
    )
    rows = []
    for one in found.shots:
        change = one.change
        later = (None,) * 3 if change is None else (change.before, change.after, change.p_value)
        name = one.name or "shot"
        rows.append(
            [name, one.made, one.tried, one.chance, one.low, one.high, one.p_weakest, *later]
        )
    return Table("shots", columns, rows)


def scores(asked: Scores) -> Answer:
    """Return whether a player is getting better."""
    file = read_practice(asked.scores, drill=asked.drill, dates=asked.dates)
    if isinstance(file, ShotsFile):
        return _shots(asked, file)
    if asked.versus is None:
        return _one_list(asked, file)
    return _versus(asked, file, read_scores(asked.versus, drill=asked.drill, dates=asked.dates))


def _shots(asked: Scores, file: ShotsFile) -> Answer:
    for name in ("new", "versus"):
        if getattr(asked, name) is not None:
            asked.refuse(
                "{part} is for scores, but {source} is a log of single shots. Leave it out.",
                part=Parameter(name),
                source=file.source,
            )
    found = practice.analyze_shots(file.log, confidence=asked.confidence)
    answer = shots_answer(file, found, confidence=asked.confidence)
    return replace(answer, drawn=(file, found))


def _one_list(asked: Scores, file: ScoresFile) -> Answer:
    own = interval_of(file, asked.confidence)
    if asked.new is not None and own is None:
        raise DataError(
            [
                worded(
                    "{file}: {new} needs at least two different scores. Add some.", file=file.source
                )
            ]
        )
    if asked.new is not None:
        answer = new_score_answer(file, asked.new, confidence=asked.confidence)
    else:
        answer = getting_better_answer(file, confidence=asked.confidence)
    return replace(answer, drawn=file)


def _versus(asked: Scores, before: ScoresFile, after: ScoresFile) -> Answer:
    short = [
        worded(
            "{file}: has {scores}; a comparison needs two or more"
            + (", but {new} takes a single new one" if file is after else ""),
            file=file.source,
            scores=count_of(len(file.scores), "score"),
        )
        for file in (before, after)
        if len(file.scores) < 2
    ]
    if short:
        raise DataError(short)
    change = compare(before.scores, after.scores, confidence=asked.confidence)
    return replace(before_and_after_answer(before, after, change), drawn=(before, after))
