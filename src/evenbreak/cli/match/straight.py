"""`evenbreak straight`: a match of 14.1 straight pool, and its spot."""

from __future__ import annotations

from fractions import Fraction

from evenbreak import matches, stats
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.plot import write_plot
from evenbreak.questions.games import Straight


@command_of(Straight, "straight")
def command(asked: Straight) -> Answer:
    """Give the odds of a match of straight pool."""
    from evenbreak.answers.match.shot_games import straight_answer

    safety, averages = asked.safety, asked.averages
    shots: list[Fraction | float] = (
        [stats.shot_chance(average, safety) for average in averages]
        if averages
        else [asked.p1 or 0.0, asked.p2 or 0.0]
    )
    match = matches.StraightPool(
        *asked.points,
        *shots,
        safety_1=safety,
        safety_2=safety,
        first="ab".index(asked.first) + 1,
    )
    if asked.plot is not None:
        from evenbreak.plots.practice import draw_spot

        if not any(shots) or not safety:
            asked.refuse("nobody ever makes a ball, so there is nothing to draw; leave {plot} out")
        write_plot(draw_spot(match), asked.plot)
    return straight_answer(match, (averages[0], averages[1]) if averages else None)
