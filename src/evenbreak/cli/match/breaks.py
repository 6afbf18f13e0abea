"""`evenbreak breaks`: what each break format is worth to two players in the long run."""

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.plot import write_plot
from evenbreak.games.rack import Rack
from evenbreak.questions.games import Breaks


@command_of(Breaks, "breaks")
def command(asked: Breaks) -> Answer:
    """Compare break formats."""
    from evenbreak.answers.match.formats import breaks_answer

    rack = Rack(asked.p1 or 0.0, asked.p2 or 0.0)
    first = "ab".index(asked.first_break) + 1
    if asked.plot is not None:
        from evenbreak.plots.contours import breaks_figure

        write_plot(breaks_figure(rack, first_breaker=first), asked.plot)
    return breaks_answer(rack, win=asked.win, lose=asked.lose, first_breaker=first, via=asked.via)
