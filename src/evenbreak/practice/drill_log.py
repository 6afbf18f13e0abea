"""Log of a progressive drill: the level of every attempt, and whether it succeeded."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Ints, array_values
from evenbreak.checks import whole, whole_numbers
from evenbreak.errors import InputError

MOST_LEVELS = 100
"""The most levels that a drill with a log may have."""

AFTER_START, AFTER_MISS, AFTER_SUCCESS = range(3)
"""The preceding event of an attempt: the middle index of `DrillLog.outcomes`."""


@array_values
@dataclass(frozen=True, eq=False)
class DrillLog:
    """The attempts in a progressive drill, in order.

    A success leads one level up (the last level repeats), and a miss leads one level down (the
    first level repeats). A session may start at any level.

    Parameters
    ----------
    level
        shape (attempts,): the level of each attempt, from 1.
    success
        shape (attempts,): whether it succeeded.
    session
        shape (attempts,): any label for the session of each attempt; a change of label
        starts a new session. None if everything is one session.
    levels
        how many levels the drill has, at most 100; None: the highest one in the log.

    Raises
    ------
    InputError
        if there is no attempt, the shapes differ, or a level is not a whole number from 1
        to `levels`.

    >>> log = DrillLog([1, 2, 3, 2], [True, True, False, True])
    >>> log.attempts, log.successes
    (array([1, 2, 1]), array([1, 2, 0]))
    """

    level: Ints
    success: Bools
    session: NDArray[Any] | None = None
    levels: int | None = None

    def __post_init__(self) -> None:
        level = whole_numbers(self.level, "level", at_least=1)
        if level.ndim != 1 or not level.size:
            raise InputError("level is empty or not a list. Give the level of each attempt.")
        success = np.asarray(self.success)
        if success.shape != level.shape or not np.isin(success, (0, 1)).all():
            raise InputError("success doesn't match level. Give True or False for each attempt.")
        session = np.zeros(len(level)) if self.session is None else np.asarray(self.session)
        if session.shape != level.shape:
            raise InputError("session doesn't match level. Give a label for each attempt.")
        highest = int(level.max())
        levels = highest if self.levels is None else whole(self.levels, "levels", at_least=1)
        if levels > MOST_LEVELS:
            raise InputError(
                "the drill must have at most {most_levels} levels; it has {levels}",
                levels=levels,
                most_levels=MOST_LEVELS,
            )
        if highest > levels:
            raise InputError(
                "levels is {levels}, but the log has level {highest}. Give a larger number.",
                levels=levels,
                highest=highest,
            )
        object.__setattr__(self, "level", level.astype(np.int64))
        object.__setattr__(self, "success", success.astype(bool))
        object.__setattr__(self, "session", session)
        object.__setattr__(self, "levels", levels)

    def __len__(self) -> int:
        return len(self.level)

    @property
    def _top(self) -> int:
        """How many levels the drill has."""
        return int(self.levels or 0)

    @cached_property
    def attempts(self) -> Ints:
        """The attempts at each level; shape (levels,)."""
        return np.asarray(self.outcomes.sum((1, 2)))

    @cached_property
    def successes(self) -> Ints:
        """The successes at each level; shape (levels,)."""
        return np.asarray(self.outcomes[:, :, 1].sum(1))

    @cached_property
    def jumps(self) -> Ints:
        """The positions of attempts that break the drill's rule within their session."""
        step = self.success[:-1] * 2 - 1
        by_rule = np.clip(self.level[:-1] + step, 1, self._top)
        return np.flatnonzero((self.level[1:] != by_rule) & ~self._new_session[1:]) + 1

    @cached_property
    def starts(self) -> Ints:
        """The positions of attempts that start a session or break the rule."""
        begins = self._new_session.copy()
        begins[self.jumps] = True
        return np.flatnonzero(begins)

    @property
    def sessions(self) -> int:
        """How many sessions there are."""
        return int(self._new_session.sum())

    @cached_property
    def outcomes(self) -> Ints:
        """The attempts by level, by what came before, and by outcome; shape (levels, 3, 2).

        The middle index is `AFTER_START`, `AFTER_MISS` or `AFTER_SUCCESS`, the last one 0
        for a miss and 1 for a success.
        """
        before = np.full(len(self), AFTER_START)
        before[1:] = np.where(self.success[:-1], AFTER_SUCCESS, AFTER_MISS)
        before[self.starts] = AFTER_START
        key = ((self.level - 1) * 3 + before) * 2 + self.success
        counts = np.bincount(key, minlength=self._top * 6)
        return counts.reshape(self._top, 3, 2)

    @cached_property
    def _new_session(self) -> Bools:
        session = np.asarray(self.session)
        return np.concatenate([[True], session[1:] != session[:-1]])
