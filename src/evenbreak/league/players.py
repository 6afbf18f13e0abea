"""The players in a simulated league: their ratings, their skills, and when they play."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from evenbreak.arrays import Bools, Floats, Ints, array_values
from evenbreak.checks import floats, whole_numbers
from evenbreak.errors import InputError

ESTABLISHED = 1_000_000
"""Default number of earlier matches: more than any newcomer has."""

_FAR = 15_000
"""The largest rating or skill, in points: a season holds differences in 16 bits."""

_COLUMNS: dict[str, tuple[bool, int, float]] = {
    "rating": (True, -_FAR, _FAR),
    "skill": (False, -_FAR, _FAR),
    "skill_sd": (False, 0, _FAR),
    "day_sd": (False, 0, _FAR),
    "drift": (False, -_FAR, _FAR),
    "joins": (True, 1, math.inf),
    "leaves": (True, 0, math.inf),
    "absence": (False, 0, 1),
    "played": (True, 0, math.inf),
}
"""Whether a column holds whole numbers, and its least and largest value."""


@array_values
@dataclass(frozen=True, eq=False)
class LeaguePlayers:
    """A league's players as read-only columns; `LeaguePlayers.of` fills in defaults.

    Parameters
    ----------
    rating
        the rating at the start, in whole points.
    skill
        the true skill at the start, in points of the same scale.
    skill_sd
        the uncertainty of the true skill, in points: each replica of a season draws its own skill
        from a normal distribution with mean `skill` and this standard deviation.
    day_sd
        standard deviation of a player's form from day to day, in points.
    drift
        points by which the true skill rises each week.
    joins
        the first week in which a player plays, from 1.
    leaves
        the last week in which a player plays; 0 for a player who stays.
    absence
        P(a player misses a week | the player is in the league).
    played
        the number of matches played before the season, for a system that moves newcomers faster.
    names
        the names, or None.

    Raises
    ------
    InputError
        if a column does not have one value per player, or has a value that is out of range.

    >>> club = LeaguePlayers.of([92, 80, 71], skill=[90, 84.5, 71], joins=[1, 1, 5])
    >>> len(club), club.skill, club.absence
    (3, array([90. , 84.5, 71. ]), array([0., 0., 0.]))
    """

    rating: Ints
    skill: Floats
    skill_sd: Floats
    day_sd: Floats
    drift: Floats
    joins: Ints
    leaves: Ints
    absence: Floats
    played: Ints
    names: tuple[str, ...] | None = None

    def __post_init__(self) -> None:
        many = np.size(self.rating)
        if many < 2 or np.ndim(self.rating) != 1:
            raise InputError(
                "{rating} must have one value for each player, two or more; it has {many}",
                many=many,
            )
        for name in _COLUMNS:
            object.__setattr__(self, name, _column(getattr(self, name), name, many))
        _refuse_leaving_early(self)
        if self.names is not None:
            names = tuple(self.names)
            if len(names) != many or len(set(names)) < many:
                raise InputError(
                    "{names} must be {many} different names; you gave {value!r}",
                    value=names,
                    many=many,
                )
            object.__setattr__(self, "names", names)

    @classmethod
    def of(
        cls,
        rating: ArrayLike,
        *,
        skill: ArrayLike | None = None,
        skill_sd: ArrayLike = 0.0,
        day_sd: ArrayLike = 0.0,
        drift: ArrayLike = 0.0,
        joins: ArrayLike = 1,
        leaves: ArrayLike = 0,
        absence: ArrayLike = 0.0,
        played: ArrayLike = ESTABLISHED,
        names: Iterable[str] | None = None,
    ) -> LeaguePlayers:
        """Return players from columns, or from single numbers that apply to everyone.

        Parameters
        ----------
        rating
            a column, one rating for each player.
        skill
            a column; None: everyone is correctly rated.
        skill_sd, day_sd, drift, joins, leaves, absence, played
            one per column, or one number for everyone.
        names
            the names, or None.

        Raises
        ------
        InputError
            as the class does.

        >>> LeaguePlayers.of([50, 60], day_sd=5).day_sd
        array([5., 5.])
        """
        return cls(
            rating,  # type: ignore[arg-type]  # all columns are made arrays on the way in
            rating if skill is None else skill,  # type: ignore[arg-type]
            skill_sd,  # type: ignore[arg-type]
            day_sd,  # type: ignore[arg-type]
            drift,  # type: ignore[arg-type]
            joins,  # type: ignore[arg-type]
            leaves,  # type: ignore[arg-type]
            absence,  # type: ignore[arg-type]
            played,  # type: ignore[arg-type]
            None if names is None else tuple(names),
        )

    def __len__(self) -> int:
        return len(self.rating)

    def here(self, week: int) -> Bools:
        """Return who is in the league in a week, absent or not.

        >>> LeaguePlayers.of([50, 60, 70], joins=[1, 2, 1], leaves=[0, 0, 1]).here(2)
        array([ True,  True, False])
        """
        stays = (self.leaves == 0) | (self.leaves >= week)
        return np.asarray(stays & (self.joins <= week))


def _column(values: Any, name: str, many: int) -> NDArray[Any]:
    whole, low, high = _COLUMNS[name]
    wanted = "whole numbers " if whole else "numbers "
    wanted += f"from {low} to {high}" if high < math.inf else f"of {low} or more"
    numbers = floats(values, name, low=low, high=high, wanted=wanted)
    if whole:
        whole_numbers(values, name, wanted=wanted)
    if numbers.shape not in ((), (many,)):
        raise InputError(
            "{name} must have one value for each of {many} players; its shape is {numbers_shape}",
            name=name,
            numbers_shape=numbers.shape,
            many=many,
        )
    # One number for everybody stays one number in memory, however many players there are.
    column = numbers.astype(np.int64 if whole else np.float64)  # a copy: the caller may change it
    column.flags.writeable = False
    return np.broadcast_to(column, (many,))


def _refuse_leaving_early(players: LeaguePlayers) -> None:
    gone = np.flatnonzero((players.leaves > 0) & (players.leaves < players.joins))
    if gone.size:
        leaves, joins = players.leaves[gone[0]], players.joins[gone[0]]
        raise InputError(
            "a player joins in week {joins} but leaves in week {leaves}. Make the leaving week "
            "no earlier than the joining week, or 0 if the player stays.",
            leaves=leaves,
            joins=joins,
        )
