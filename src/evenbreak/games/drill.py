"""Progressive practice drills: up a level on success, down a level on failure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from evenbreak.checks import complement, number_probabilities, number_probability, whole
from evenbreak.errors import InputError

EIGHT_BALL_LEVELS = 7
"""The most levels in the 8-ball drill: seven balls of each group and the 8-ball."""


@dataclass(frozen=True)
class Drill:
    """A progressive drill with n levels (P5.26, Fig. 5.7).

    A success leads to the next level (the last level repeats), a failure to the previous one
    (the first level repeats).

    Parameters
    ----------
    success
        P(success | an attempt at level i), i = 1 ... n.

    Raises
    ------
    InputError
        if there is no level or a value is not a probability.

    >>> Drill([1, 0.5, 0.25]).moves(2)
    {3: 0.5, 1: 0.5}
    >>> Drill([1, 0.5, 0.25]).moves(3)
    {3: 0.25, 2: 0.75}
    """

    success: Sequence[float]

    def __post_init__(self) -> None:
        levels = number_probabilities(self.success, "success", "success at level")
        object.__setattr__(self, "success", levels)

    @classmethod
    def progressive(cls, p: float, levels: int = 9) -> Drill:
        """Return a model of the progressive 9-ball drill: level i succeeds with p^(i-1).

        >>> Drill.progressive(0.5, levels=4).success
        (1.0, 0.5, 0.25, 0.125)
        """
        base = number_probability(p, "p")
        return cls([base**i for i in range(whole(levels, "levels", at_least=1))])

    @classmethod
    def eight_ball(cls, p: float, levels: int = 7) -> Drill:
        """Return a model of the progressive 8-ball drill: level i succeeds with p^i.

        Level i starts with i balls of each group and the 8-ball on the table and ball in hand. The
        player runs one group and the 8-ball; the first of these i + 1 balls is treated as certain,
        as in the 9-ball drill. At level 7, all 15 balls are on the table. The effect of the other
        group's balls being in the way is part of p.

        Raises
        ------
        InputError
            if p is not a probability, or there are not 1 to 7 levels.

        Notes
        -----
        Source: the 8-ball drill after exercise 5.1; the model of P5.26 applied to it.

        >>> Drill.eight_ball(0.5, levels=3).success
        (0.5, 0.25, 0.125)
        """
        base = number_probability(p, "p")
        most = whole(levels, "levels", at_least=1)
        if most > EIGHT_BALL_LEVELS:
            raise InputError(
                "levels is {most}, but at level {eight_ball_levels} all 15 balls are already on "
                "the table",
                most=most,
                eight_ball_levels=EIGHT_BALL_LEVELS,
            )
        return cls([base**i for i in range(1, most + 1)])

    @property
    def start(self) -> int:
        """The first level."""
        return 1

    def moves(self, state: int) -> Mapping[int, float]:
        """Return the probability of each next level, given an attempt at level `state`."""
        p = self.success[state - 1]
        up, down = min(state + 1, len(self.success)), max(state - 1, 1)
        return {up: 1.0} if up == down else {up: p, down: complement(p)}

    def winner(self, state: int) -> None:  # noqa: ARG002
        """Return None: a drill has no winner and no end."""
        return
