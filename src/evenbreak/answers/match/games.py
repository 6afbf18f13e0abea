"""From a question about breaks, straight pool or one ball to its answer."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from evenbreak import matches, practice, stats
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.match.formats import breaks_answer
from evenbreak.answers.match.shot_games import oneball_answer, straight_answer
from evenbreak.games.rack import Rack
from evenbreak.questions.games import Breaks, OneBall, Straight


def breaks(asked: Breaks) -> Answer:
    """Return break formats side by side."""
    rack = Rack(asked.p1 or 0.0, asked.p2 or 0.0)
    first = "ab".index(asked.first_break) + 1
    answer = breaks_answer(rack, win=asked.win, lose=asked.lose, first_breaker=first, via=asked.via)
    return replace(answer, drawn=(rack, first))


def oneball(asked: OneBall) -> Answer:
    """Return the best shot."""
    shots = [
        practice.ShotChoice(str(number), shot[0], shot[1], shot[2:])
        for number, shot in enumerate(asked.shots, start=1)
    ]
    return replace(oneball_answer(shots, look_ahead=asked.ahead, via=asked.via), drawn=shots)


def straight(asked: Straight) -> Answer:
    """Return the odds of a match of straight pool."""
    safety, averages = asked.safety, asked.averages
    shots: list[Fraction | float] = (
        [stats.shot_chance(average, safety) for average in averages]
        if averages
        else [asked.p1 or 0.0, asked.p2 or 0.0]
    )
    if asked.plot is not None and (not any(shots) or not safety):
        asked.refuse("nobody ever makes a ball, so there is nothing to draw; leave {plot} out")
    match = matches.StraightPool(
        *asked.points,
        *shots,
        safety_1=safety,
        safety_2=safety,
        first="ab".index(asked.first) + 1,
    )
    answer = straight_answer(match, (averages[0], averages[1]) if averages else None)
    return replace(answer, drawn=match)
