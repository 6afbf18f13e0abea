"""A rating error that moves with each match, as an endless game, and its long run.

A move that would take the error beyond the end of the line is not made: the error stays the same.
"""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.chains.birth_death import birth_death_law
from evenbreak.chains.limits import limit_of
from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.checks import number_probabilities
from evenbreak.errors import InputError
from evenbreak.game import ArcArrays
from evenbreak.stats.summary import Distribution


class ErrorWalk:
    """Base class of all ladders, which define their moves and each move's chance at each error.

    A ladder is an endless game: a state is the rating error in whole points, from -widest to
    widest, and it starts at 0.
    """

    @property
    @abstractmethod
    def steps(self) -> Ints:
        """The moves that a match can cause, in points, in increasing order."""

    @property
    @abstractmethod
    def kernel(self) -> Floats:
        """P(move | error before the match), shape (errors, steps), the ends not yet applied."""

    @property
    def errors(self) -> Ints:
        """The rating errors, from -widest to widest."""
        half = len(self.kernel) // 2
        return np.arange(-half, half + 1)

    @property
    def start(self) -> int:
        """No error."""
        return 0

    def moves(self, state: int) -> Mapping[int, float]:
        """Return the probability of each next error; InputError for a state beyond an end."""
        half = len(self.kernel) // 2
        if not -half <= state <= half:
            raise InputError(
                "{state} must be a rating error from {half} to {half_2}; you gave {value!r}",
                value=state,
                half=-half,
                half_2=half,
            )
        after: dict[int, float] = {}
        for step, chance in zip(
            self.steps.tolist(), self.kernel[state + half].tolist(), strict=True
        ):
            target = state + step if abs(state + step) <= half else state
            after[target] = after.get(target, 0.0) + chance
        return after

    def winner(self, state: int) -> None:  # noqa: ARG002
        """Return None: a ladder has no end."""
        return

    def arcs(self) -> ArcArrays | None:
        """Return the arcs in the order of the errors, or None if not every error can be reached."""
        steps, kernel = self.steps, self.kernel
        # Where a match is certainly won or lost there may be no way back to the start.
        if math.gcd(*steps.tolist()) != 1 or not (kernel > 0.0).all() or np.abs(steps).max() > 1:
            return None
        chances = walk_matrix(steps, kernel)
        sources, targets = np.nonzero(chances)
        return ArcArrays(self.errors.tolist(), sources, targets, chances[sources, targets])

    def law(self, *, via: Way | None = None) -> Distribution:
        """Return the distribution of the rating error in the long run: the stochastic limit.

        If all moves are multiples of g points, no match takes an error from one remainder modulo g
        to another. The skill is unrelated to g, so each remainder is equally likely at the start;
        the result is the average of the g limits. By default, or with 'kernel', the result is from
        a closed form or banded elimination in this module; otherwise it is the limit of the ladder
        as a game (see `evenbreak.chains.limit_of`).
        """
        way = way_of_limit(via)
        chances = long_run_law(self.steps, self.kernel) if way is None else self._law_by_limit(way)
        return Distribution(tuple(self.errors.tolist()), tuple(chances.tolist()))

    def _law_by_limit(self, via: Way) -> Floats:
        """Return the average of the limits of all remainders, shape (errors,)."""
        used = (self.kernel > 0.0).any(axis=0)
        unit, errors = math.gcd(*self.steps[used].tolist()), self.errors
        if unit == 0:
            raise _no_moves()
        law = np.zeros(len(errors))
        for first in range(unit):
            same = errors[(len(errors) // 2 + first) % unit :: unit]
            limit = limit_of(self, start=int(same[len(same) // 2]), via=via)
            law[np.array(limit.states) + len(errors) // 2] += limit.probability / unit
        return law


@dataclass(frozen=True)
class RatingLadder(ErrorWalk):
    """Custom ladder: up a point for a match won, down a point for a match lost.

    Parameters
    ----------
    wins
        P(the player wins the match | the rating error is i) for i = -widest ... widest: an odd
        number of chances, at least three.

    Raises
    ------
    InputError
        if a value is not a probability, or their number is even or less than three.

    >>> ladder = RatingLadder([0.75, 0.5, 0.25])
    >>> ladder.moves(0), ladder.moves(1)
    ({-1: 0.5, 1: 0.5}, {0: 0.75, 1: 0.25})
    >>> [round(chance, 3) for chance in ladder.law().probability]
    [0.286, 0.429, 0.286]
    """

    wins: Sequence[float]

    def __post_init__(self) -> None:
        wins = number_probabilities(self.wins, "wins", "win chance")
        if len(wins) < 3 or len(wins) % 2 == 0:
            raise InputError(
                "{wins} must have one chance for each error from -widest to widest, so an odd "
                "number of chances, at least three; it has {n_wins}",
                n_wins=len(wins),
            )
        object.__setattr__(self, "wins", wins)

    @property
    def widest(self) -> int:
        """The largest rating error, in points."""
        return len(self.wins) // 2

    @property
    def steps(self) -> Ints:
        """A point down or a point up."""
        return np.array([-1, 1])

    @cached_property
    def kernel(self) -> Floats:
        """P(lost | error) and P(won | error); shape (errors, 2)."""
        wins = np.array(self.wins)
        return np.column_stack([1.0 - wins, wins])


def long_run_law(steps: Ints, kernel: Floats) -> Floats:
    """Return the stationary distribution of a walk by these moves, shape (errors,).

    The kernel is P(move | error), shape (errors, steps).

    >>> long_run_law(np.array([-1, 1]), np.array([[0.25, 0.75], [0.5, 0.5], [0.75, 0.25]]))
    array([0.28571429, 0.42857143, 0.28571429])
    """
    used = (kernel > 0.0).any(axis=0)
    steps, kernel = steps[used], kernel[:, used]
    unit = math.gcd(*steps.tolist())
    law = np.zeros(len(kernel))
    if unit == 0:
        raise _no_moves()
    middle = len(kernel) // 2
    for first in range(unit):
        places = slice((middle + first) % unit, None, unit)
        law[places] = _law_of_class(steps // unit, kernel[places]) / unit
    return law


def _no_moves() -> InputError:
    return InputError(
        "matches in this system never move a rating. Give a system that moves ratings by whole "
        "points."
    )


def _law_of_class(steps: Ints, kernel: Floats) -> Floats:
    """Return the stationary distribution of a walk whose moves have no common divisor."""
    if len(kernel) == 1:
        return np.ones(1)
    if np.abs(steps).max() == 1:
        up = kernel[:-1, steps == 1].sum(axis=1)
        down = kernel[1:, steps == -1].sum(axis=1)
        if up.all() and down.all():
            return birth_death_law(up, down)
    else:
        law = _eliminated(walk_matrix(steps, kernel), int(np.abs(steps).max()))
        if np.isfinite(law).all():
            return law
    return _limit_from_the_middle(walk_matrix(steps, kernel))


def _eliminated(matrix: Floats, band: int) -> Floats:
    """Return the stationary distribution of a row-stochastic matrix, without subtractions.

    States are eliminated from the highest down: the flow through a state is redistributed among the
    states below it (Grassmann, Taksar & Heyman 1985). Only the band is touched.
    """
    many = len(matrix)
    left = np.ones(many)
    with np.errstate(divide="ignore", invalid="ignore"):
        for i in range(many - 1, 0, -1):
            low = max(0, i - band)
            out = matrix[i, low:i]
            left[i] = out.sum()
            matrix[low:i, low:i] += np.outer(matrix[low:i, i] / left[i], out)
        law = np.zeros(many)
        law[0] = 1.0
        for i in range(1, many):
            low = max(0, i - band)
            law[i] = law[low:i] @ matrix[low:i, i] / left[i]
            if law[i] > 1e200:  # the first error may be far out in the tail
                law[: i + 1] /= law[i]
        return np.asarray(law / law.sum())


def _limit_from_the_middle(matrix: Floats) -> Floats:
    """Return the limit of a walk that starts in the middle, with walls that no match crosses."""
    from evenbreak.chains import chain_from_arrays, stochastic_limit

    matrix = np.minimum(matrix, 1.0)  # sums of chances may miss 1 by rounding
    sources, targets = np.nonzero(matrix)
    many = len(matrix)
    chain = chain_from_arrays(range(many), sources, targets, matrix[sources, targets])
    return np.asarray(stochastic_limit(chain, many // 2).probability)


def walk_matrix(steps: Ints, kernel: Floats) -> Floats:
    """Return P(error j after the match | error i before it), shape (errors, errors).

    Rows are the errors before. A move that would lead beyond an end is not made.

    >>> walk_matrix(np.array([-1, 1]), np.array([[0.25, 0.75], [0.5, 0.5], [0.75, 0.25]]))
    array([[0.25, 0.75, 0.  ],
           [0.5 , 0.  , 0.5 ],
           [0.  , 0.75, 0.25]])
    """
    many = len(kernel)
    place = np.arange(many)[:, None]
    after = place + steps
    matrix = np.zeros((many, many))
    np.add.at(matrix, (place, np.where((after >= 0) & (after < many), after, place)), kernel)
    return matrix
