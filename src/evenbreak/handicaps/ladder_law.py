"""The law of rating errors that goes with a law of the opponents, and that is the same as it.

The players of a night draw their deviations at its beginning; in its k-th match all of them
have the same joint law of error and deviation. A round of the iteration takes the law of errors
at the beginning of a night, sends the player through it, and corrects that law by the one that
the average match of the night leaves as it is.

Averaged over the matches of a night, P(move | error) is a chain whose stationary law is the
average law exactly: what flows into an error in a night is what flows out of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from evenbreak.errors import AccuracyError
from evenbreak.handicaps.error_walk import long_run_law

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.handicaps.pairing import Pairing

    Floats: TypeAlias = NDArray[np.float64]
    Against: TypeAlias = Callable[[int, Floats], Floats]

__all__ = ["Night", "Settled", "settled"]

_SETTLED = 1e-14
_SETTLED_NIGHT = 1e-12
_ROUNDS = 500


class Night(NamedTuple):
    """The matches that players have on a night, and the law of their deviations on it."""

    pairing: Pairing
    weights: Floats
    matches: int


class Settled(NamedTuple):
    """What a ladder comes to: P(move | error), P(win | error), and the two laws of errors."""

    steps: NDArray[np.int64]
    kernel: Floats
    wins: Floats
    law: Floats
    opponents: Floats
    changes: tuple[float, ...]


class _Passed(NamedTuple):
    """A night: P(move | error, deviation) in each match, and the joint law before each."""

    chances: list[Floats]
    joint: list[Floats]

    @property
    def law(self) -> Floats:
        """The law of the error on the average of the matches."""
        return np.asarray(sum(self.joint).sum(axis=1) / len(self.joint))  # type: ignore[union-attr]

    @property
    def average(self) -> Floats:
        """P(move | error) on the average of the matches, and P(win | error) last."""
        if self.joint[0].shape[1] == 1 and len(self.joint) == 1:
            return self.chances[0][..., 0]
        pairs = zip(self.chances, self.joint, strict=True)
        flow = sum((chances * joint).sum(axis=2) for chances, joint in pairs)
        weight = sum(joint.sum(axis=1) for joint in self.joint)
        # Where a law is smaller than any float, what the first match does stands for all.
        plain = self.chances[0].mean(axis=2)
        return np.asarray(np.where(weight > 0.0, flow / np.where(weight > 0.0, weight, 1.0), plain))


def settled(night: Night, error: Floats | None, drift: float, *, conserving: bool) -> Settled:
    """Return the law of a player's errors, and of his opponents' if it is not given.

    Parameters
    ----------
    night
        the matches.
    error
        the law of the opponents' error; None: that of a player without drift, made symmetric.
    drift
        points by which the player's skill rises with each match on average.
    conserving
        whether the winner gains what the loser loses.

    Raises
    ------
    AccuracyError
        if the law does not settle.

    Notes
    -----
    Among symmetric laws each round brings the change down to a hundredth or so. But where
    opponents are a little better on average than they are rated, the player falls below his
    own skill by a little more: without the symmetry, rounding errors grow until the law swings
    to and fro between two skewed ones.

    Where opponents err as the player does and the system makes all ratings rise, errors are
    those beyond the mean error of the league: else no law would stay.
    """
    pairing = night.pairing
    if error is not None:
        chances = pairing.moves(np.outer(error, night.weights))
        return _rounds(night, lambda _, __: chances, drift, error)[0]

    def as_he_errs(_: int, joint: Floats) -> Floats:
        return pairing.moves((joint + joint[::-1, ::-1]) / 2.0)

    pace, rise = 0.0, math.inf
    while abs(rise) > _SETTLED:
        found, passed = _rounds(night, as_he_errs, pace)
        rise = 0.0 if conserving else _mean_move(night, passed) - pace
        pace += rise
    if not drift:
        return found
    league = passed.chances
    moving, _ = _rounds(night, lambda k, _: league[k], pace + drift, found.opponents)
    return moving._replace(changes=found.changes)


def _rounds(
    night: Night, against: Against, fall: float, opponents: Floats | None = None
) -> tuple[Settled, _Passed]:
    """Return what a ladder comes to, and its night, if errors fall by so much with each match.

    Parameters
    ----------
    against
        from the number of a match and the player's joint law before it to P(move | error,
        deviation), P(win | error, deviation) last.
    opponents
        the law of the opponents' errors; None: the player's own.
    """
    pairing = night.pairing
    exact = np.zeros(len(pairing.errors))
    exact[len(exact) // 2] = 1.0
    first = against(0, np.outer(exact, night.weights)) @ night.weights
    steps, moves = _falling(pairing.steps, first[:-1], fall)
    begun = long_run_law(steps, moves.T)
    enough = _SETTLED if night.matches == 1 else _SETTLED_NIGHT
    changes: list[float] = []
    for _ in range(_ROUNDS):
        passed = _pass(night, against, fall, begun)
        average = passed.average
        steps, moves = _falling(pairing.steps, average[:-1], fall)
        law, met = long_run_law(steps, moves.T), passed.law
        changes.append(float(np.abs(law - met).max()))
        if changes[-1] <= enough:
            even = (law + law[::-1]) / 2.0 if opponents is None else opponents
            told = tuple(changes) if opponents is None or night.matches > 1 else ()
            return Settled(steps, moves.T, average[-1], law, even, told), passed
        begun = begun * np.divide(law, met, out=np.ones_like(law), where=met > 0.0)
        begun /= begun.sum()
    raise AccuracyError(
        f"the law still changes by {changes[-1]:.3g} after {_ROUNDS} rounds; "
        "give the opponents' error, or opponents=NATURAL, who are rated rightly"
    )


def _pass(night: Night, against: Against, fall: float, begun: Floats) -> _Passed:
    """Return a night that begins with this law of the errors."""
    passed = _Passed([], [])
    joint = np.outer(begun, night.weights)
    for match in range(night.matches):
        chances = against(match, joint)
        passed.chances.append(chances)
        passed.joint.append(joint)
        if match + 1 < night.matches:
            joint = _after(joint, *_falling(night.pairing.steps, chances[:-1], fall))
    return passed


def _after(joint: Floats, steps: NDArray[np.int64], chances: Floats) -> Floats:
    """Return the joint law after a match; an error that would go beyond an end stays."""
    after = np.zeros_like(joint)
    many = len(joint)
    for step, chance in zip(steps.tolist(), chances, strict=True):
        flow = joint * chance
        low, high = max(0, -step), min(many, many - step)
        after[low + step : high + step] += flow[low:high]
        after[:low] += flow[:low]
        after[high:] += flow[high:]
    return after


def _falling(
    steps: NDArray[np.int64], chances: Floats, fall: float
) -> tuple[NDArray[np.int64], Floats]:
    """Return moves and chances if errors fall by so much besides, a whole point at a time.

    >>> _falling(np.array([-1, 1]), np.array([[0.5], [0.5]]), 0.25)[0].tolist()
    [-2, -1, 0, 1]
    """
    if not fall:
        return steps, chances
    less = math.floor(fall)
    more = fall - less
    both = np.unique([steps - less, steps - less - 1])
    moved = np.zeros((len(both), *chances.shape[1:]))
    moved[np.searchsorted(both, steps - less)] += (1.0 - more) * chances
    moved[np.searchsorted(both, steps - less - 1)] += more * chances
    return both, moved


def _mean_move(night: Night, passed: _Passed) -> float:
    """Return the mean move of a rating, over the matches of a night."""
    return float(night.pairing.steps @ passed.average[:-1] @ passed.law)
