"""`evenbreak oneball`: which shot to take."""

from __future__ import annotations

from evenbreak import plots, practice
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.plot import write_plot
from evenbreak.questions.games import OneBall


@command_of(OneBall, "oneball")
def command(asked: OneBall) -> Answer:
    """Choose the best shot."""
    from evenbreak.answers.match.shot_games import oneball_answer

    shots = [
        practice.ShotChoice(str(number), shot[0], shot[1], shot[2:])
        for number, shot in enumerate(asked.shots, start=1)
    ]
    if asked.plot is not None:
        write_plot(plots.draw_shots(shots, look_ahead=asked.ahead), asked.plot)
    return oneball_answer(shots, look_ahead=asked.ahead, via=asked.via)
