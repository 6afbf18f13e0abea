"""From a question about practice to its answer: `drill`, `practice` and `runs`."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from evenbreak import files, games, practice, stats
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.wording import count_of
from evenbreak.errors import DataError
from evenbreak.fields.question import worded
from evenbreak.questions.practice import EIGHT_BALL_LEVELS, DrillPlayed, Runs, Scores
from evenbreak.words import Parameter

if TYPE_CHECKING:
    from evenbreak.files.practice import ScoresFile, ShotsFile

NINE_BALL_LEVELS = 9

MOST_DRAWS = 20_000_000
"""The most attempts simulated for a test, so that a long log takes seconds."""


def drill(asked: DrillPlayed) -> Answer:
    """Return where a drill settles."""
    if asked.log is not None:
        return _drill_log(asked, asked.log)
    from evenbreak.answers.practice.drill import drill_answer

    if asked.p is None:
        played = games.Drill(asked.success or ())
        description = "A drill with the given chance of success at each level"
    elif asked.game == "8-ball":
        played = games.Drill.eight_ball(asked.p, asked.levels or EIGHT_BALL_LEVELS)
        description = (
            "The progressive 8-ball drill: i balls of each group and the 8-ball at level i, which "
            f"takes i good shots, each with chance {asked.p:g}"
        )
    else:
        played = games.Drill.progressive(asked.p, asked.levels or NINE_BALL_LEVELS)
        description = (
            f"A drill in which level i takes i - 1 good shots, each with chance {asked.p:g}"
        )
    statistics = practice.drill_statistics(played, via=asked.via)
    return replace(drill_answer(statistics, description, via=asked.via), drawn=statistics)


def _drill_log(asked: DrillPlayed, path: str) -> Answer:
    import numpy as np

    from evenbreak.answers.practice.drill import drill_log_answer

    seed = 1 if asked.seed is None else asked.seed
    file = files.read_drill_log(path, levels=asked.levels, drill=asked.drill)
    replicas = min(1999, max(199, MOST_DRAWS // len(file.log)))
    analysis = practice.analyse_log(file.log, rng=np.random.default_rng(seed), replicas=replicas)
    answer = drill_log_answer(file, analysis, seed=seed, levels_given=asked.levels is not None)
    return replace(answer, drawn=analysis)


def scores(asked: Scores) -> Answer:
    """Return whether a player is getting better."""
    from evenbreak.files.practice import ShotsFile, read_practice, read_scores

    file = read_practice(asked.scores, drill=asked.drill, dates=asked.dates)
    if isinstance(file, ShotsFile):
        return _shots(asked, file)
    if asked.versus is None:
        return _one_list(asked, file)
    return _versus(asked, file, read_scores(asked.versus, drill=asked.drill, dates=asked.dates))


def _shots(asked: Scores, file: ShotsFile) -> Answer:
    from evenbreak.answers.practice.shots import shots_answer

    for name in ("new", "versus"):
        if getattr(asked, name) is not None:
            asked.refuse(
                "{part} is for scores, and {source} is a log of single shots; leave it out",
                part=Parameter(name),
                source=file.source,
            )
    found = practice.analyse_shots(file.log, confidence=asked.confidence)
    answer = shots_answer(file, found, confidence=asked.confidence)
    return replace(answer, drawn=(file, found))


def _one_list(asked: Scores, file: ScoresFile) -> Answer:
    from evenbreak.answers.practice.practice import (
        getting_better_answer,
        interval_of,
        new_score_answer,
    )

    own = interval_of(file, asked.confidence)
    if asked.new is not None and own is None:
        raise DataError(
            [
                worded(
                    "{file}: {new} needs at least two different scores; add some", file=file.source
                )
            ]
        )
    if asked.new is not None:
        answer = new_score_answer(file, asked.new, confidence=asked.confidence)
    else:
        answer = getting_better_answer(file, confidence=asked.confidence)
    return replace(answer, drawn=file)


def _versus(asked: Scores, before: ScoresFile, after: ScoresFile) -> Answer:
    from evenbreak.answers.practice.practice import before_and_after_answer
    from evenbreak.stats.compare import compare

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


def runs(asked: Runs) -> Answer:
    """Return how long runs get."""
    from evenbreak.answers.practice.runs import Asked, runs_answer

    law, ranges = _law(asked), Asked(asked.at_least, asked.between, asked.over)
    return replace(runs_answer(law, ranges), drawn=(law, list(ranges.ranges.values())))


def _law(asked: Runs) -> stats.RunLength | stats.InningsScore:
    p, safety = asked.p, asked.safety
    chance = stats.shot_chance(asked.mean or 0.0, safety) if p is None else p
    if asked.innings == 1:
        return stats.RunLength(chance, safety)
    return stats.InningsScore(chance, asked.innings, safety)
