"""The commands about games shot by shot: `breaks`, `oneball` and `straight`."""

from __future__ import annotations

from fractions import Fraction

from evenbreak import matches, plots, practice, stats
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.terminal import write_plot
from evenbreak.games.rack import Rack
from evenbreak.questions.games import Breaks, OneBall, Straight


@command_of(Breaks, "breaks")
def breaks(asked: Breaks) -> Answer:
    """Compare break formats."""
    from evenbreak.answers.match.formats import breaks_answer

    rack = Rack(asked.p1 or 0.0, asked.p2 or 0.0)
    first = "ab".index(asked.first_break) + 1
    if asked.plot is not None:
        from evenbreak.plots.contours import breaks_figure

        write_plot(breaks_figure(rack, first_breaker=first), asked.plot)
    return breaks_answer(rack, win=asked.win, lose=asked.lose, first_breaker=first, via=asked.via)


@command_of(OneBall, "oneball")
def oneball(asked: OneBall) -> Answer:
    """Choose the best shot."""
    from evenbreak.answers.match.shot_games import oneball_answer

    shots = [
        practice.ShotChoice(str(number), shot[0], shot[1], shot[2:])
        for number, shot in enumerate(asked.shots, start=1)
    ]
    if asked.plot is not None:
        write_plot(plots.draw_shots(shots, look_ahead=asked.ahead), asked.plot)
    return oneball_answer(shots, look_ahead=asked.ahead, via=asked.via)


@command_of(Straight, "straight")
def straight(asked: Straight) -> Answer:
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
