"""`evenbreak drill`, `practice` and `runs`: what practice scores say."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak import files, games, practice, stats
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.wording import count_of
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.terminal import write_plot
from evenbreak.errors import DataError
from evenbreak.questions.practice import EIGHT_BALL_LEVELS, DrillPlayed, Runs, Scores
from evenbreak.words import Parameter

if TYPE_CHECKING:
    from evenbreak.files.practice import ScoresFile, ShotsFile

NINE_BALL_LEVELS = 9

MOST_DRAWS = 20_000_000
"""The most attempts simulated for a test, so that a long log takes seconds."""


@command_of(DrillPlayed, "drill")
def drill(asked: DrillPlayed) -> Answer:
    """Find where a drill settles."""
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
    if asked.plot is not None:
        from evenbreak.plots.practice import draw_drill

        write_plot(draw_drill(statistics), asked.plot)
    return drill_answer(statistics, description, via=asked.via)


def _drill_log(asked: DrillPlayed, path: str) -> Answer:
    import numpy as np

    from evenbreak.answers.practice.drill import drill_log_answer

    seed = 1 if asked.seed is None else asked.seed
    file = files.read_drill_log(path, levels=asked.levels, drill=asked.drill)
    replicas = min(1999, max(199, MOST_DRAWS // len(file.log)))
    analysis = practice.analyse_log(file.log, rng=np.random.default_rng(seed), replicas=replicas)
    if asked.plot is not None:
        from evenbreak.plots.practice import draw_log

        write_plot(draw_log(analysis), asked.plot)
    return drill_log_answer(file, analysis, seed=seed, levels_given=asked.levels is not None)


@command_of(Scores, "practice")
def scores(asked: Scores) -> Answer:
    """Find out whether you are getting better."""
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
    if asked.plot is not None:
        from evenbreak.plots.practice import draw_practice_shots

        write_plot(draw_practice_shots(file, found, confidence=asked.confidence), asked.plot)
    return shots_answer(file, found, confidence=asked.confidence)


def _one_list(asked: Scores, file: ScoresFile) -> Answer:
    from evenbreak.answers.practice.practice import (
        getting_better_answer,
        interval_of,
        new_score_answer,
        trend_line_of,
    )

    own = interval_of(file, asked.confidence)
    if asked.new is not None and own is None:
        raise DataError([f"{file.source}: --new needs at least two different scores; add some"])
    if asked.plot is not None:
        from evenbreak.plots.practice import draw_scores

        line = trend_line_of(file, asked.confidence) if asked.new is None else None
        write_plot(draw_scores(file, own, line, new=asked.new), asked.plot)
    if asked.new is not None:
        return new_score_answer(file, asked.new, confidence=asked.confidence)
    return getting_better_answer(file, confidence=asked.confidence)


def _versus(asked: Scores, before: ScoresFile, after: ScoresFile) -> Answer:
    from evenbreak.answers.practice.practice import before_and_after_answer
    from evenbreak.stats.compare import compare

    short = [
        f"{file.source}: has {count_of(len(file.scores), 'score')}; a comparison needs two or more"
        + (", but --new takes a single new one" if file is after else "")
        for file in (before, after)
        if len(file.scores) < 2
    ]
    if short:
        raise DataError(short)
    change = compare(before.scores, after.scores, confidence=asked.confidence)
    if asked.plot is not None:
        from evenbreak.answers.practice.practice import interval_of
        from evenbreak.plots.practice import draw_two_lists

        intervals = interval_of(before, asked.confidence), interval_of(after, asked.confidence)
        both = before.scores, after.scores
        write_plot(draw_two_lists(*both, ("before", "after"), intervals), asked.plot)
    return before_and_after_answer(before, after, change)


@command_of(Runs, "runs")
def runs(asked: Runs) -> Answer:
    """Find how long runs get."""
    from evenbreak.answers.practice.runs import Asked, runs_answer

    law, ranges = _law(asked), Asked(asked.at_least, asked.between, asked.over)
    if asked.plot is not None:
        from evenbreak.plots.practice import draw_score

        shaded = list(ranges.ranges.values())
        write_plot(draw_score(law, asked.innings, asked=shaded), asked.plot)
    return runs_answer(law, ranges)


def _law(asked: Runs) -> stats.RunLength | stats.InningsScore:
    p, safety = asked.p, asked.safety
    chance = stats.shot_chance(asked.mean or 0.0, safety) if p is None else p
    if asked.innings == 1:
        return stats.RunLength(chance, safety)
    return stats.InningsScore(chance, asked.innings, safety)
