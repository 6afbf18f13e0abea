"""How a table is kept: the points of a match, and who is ahead on equal points."""

from __future__ import annotations

from dataclasses import dataclass

from evenbreak.checks import number, one_of
from evenbreak.errors import InputError

DIFFERENCE, SCORED, WINS, HEAD_TO_HEAD = "difference", "scored", "wins", "head-to-head"
TIE_BREAKS = (DIFFERENCE, SCORED, WINS, HEAD_TO_HEAD)
"""The sets won less those lost, the sets won, the matches won, the points of the matches among
those who are level."""


@dataclass(frozen=True)
class TableRules:
    """The rules of a table.

    Parameters
    ----------
    win, draw, loss
        the points of a match.
    a_set
        the points of each set won, on top.
    ties
        what separates teams with equal points, in that order; then it is by lot.

    Raises
    ------
    InputError
        if a loss gives more than a draw or a draw more than a win, or a tie-break is not known.

    >>> TableRules(win=0, draw=0, loss=0, a_set=1).points(3, 2)
    (3.0, 2.0)
    """

    win: float = 2.0
    draw: float = 1.0
    loss: float = 0.0
    a_set: float = 0.0
    ties: tuple[str, ...] = (DIFFERENCE, SCORED)

    def __post_init__(self) -> None:
        for name in ("win", "draw", "loss", "a_set"):
            object.__setattr__(self, name, number(getattr(self, name), name))
        if not self.loss <= self.draw <= self.win or self.a_set < 0.0:
            raise InputError(
                "points are {win:g}, {draw:g}, {loss:g} for a win, a draw and a loss; give "
                "no more for a loss than for a draw, and for a draw than for a win",
                win=self.win,
                draw=self.draw,
                loss=self.loss,
            )
        if self.win == self.loss and self.a_set == 0.0:
            raise InputError("a win is worth no more than a loss; give points for a win or a set")
        for name in self.ties:
            one_of(name, "ties", TIE_BREAKS)

    def points(self, scored: int, other: int) -> tuple[float, float]:
        """Return the points of both teams for a match with this score."""
        if scored > other:
            first, second = self.win, self.loss
        elif scored < other:
            first, second = self.loss, self.win
        else:
            first = second = self.draw
        return first + self.a_set * scored, second + self.a_set * other
