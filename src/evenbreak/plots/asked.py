"""The picture of an answer, for every question that has one."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from evenbreak.answers.kit.answer import Answer

Picture = Callable[[Any, "Answer"], "Axes | Figure"]


def picture_of(command: str, asked: Any, answer: Answer) -> Axes | Figure:
    """Return the picture of an answer.

    Parameters
    ----------
    command, asked
        the question, as `evenbreak.answers.asked.answer_to` takes it.
    answer
        its answer.
    """
    return _PICTURES[command](asked, answer)


def _live(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots.matches import course_figure

    players, odds = answer.drawn
    return course_figure(odds, title=answer.heading, names=players.names)


def _compare(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots.matches import draw_formats

    players, formats, line, pairs = answer.drawn
    return draw_formats(
        formats,
        line,
        pairs.values(),
        p1=float(players.rack.p1),
        title=answer.heading,
        names=players.names,
    )


def _breaks(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots.contours import breaks_figure

    rack, first = answer.drawn
    return breaks_figure(rack, first_breaker=first)


def _oneball(asked: Any, answer: Answer) -> Axes | Figure:
    from evenbreak.plots import draw_shots

    return draw_shots(answer.drawn, look_ahead=asked.ahead)


def _straight(asked: Any, answer: Answer) -> Axes | Figure:  # noqa: ARG001
    from evenbreak.plots.practice import draw_spot

    return draw_spot(answer.drawn)


_PICTURES: dict[str, Picture] = {
    "live": _live,
    "compare": _compare,
    "breaks": _breaks,
    "oneball": _oneball,
    "straight": _straight,
}
