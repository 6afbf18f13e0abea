"""The law of rating errors that goes with a law of the opponents, and that is the same as it.

The players of a night draw their deviations at its beginning; in its k-th match all of them
have the same joint law of error and deviation. A round of the iteration takes the law of errors
at the beginning of a night, sends all players through it, and asks which law at the beginning
is the same again at the end.

Averaged over the matches of a night, P(move | error) is a chain whose stationary law is the
average law exactly: what flows into an error in a night is what flows out of it.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from evenbreak.errors import AccuracyError
from evenbreak.handicaps.ladders.error_walk import long_run_law

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.handicaps.ladders.pairing import Pairing

    Floats: TypeAlias = NDArray[np.float64]

_SETTLED = 1e-13
_ROUNDS = 300


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
        each = pairing.moves(np.outer(error, night.weights))
        return _as_told(night, [each] * night.matches, drift, error, ())
    exact = np.zeros(len(pairing.errors))
    exact[len(exact) // 2] = 1.0
    chances = [pairing.moves(np.outer(exact, night.weights))] * night.matches
    pace, changes = 0.0, [math.inf]
    begun = _beginning(night, chances, pace)
    while changes[-1] > _SETTLED and len(changes) <= _ROUNDS:
        chances, joint = _against_the_same(night, pace, begun)
        if not conserving:
            # A pace that misses a whole number by rounding would mix what never mixes.
            pace = round(_mean_move(night, chances, joint), 12)
        again = _beginning(night, chances, pace)
        changes.append(float(np.abs(again - begun).max()))
        begun = again
    if changes[-1] > _SETTLED:
        raise AccuracyError(
            f"the law still changes by {changes[-1]:.3g} after {_ROUNDS} rounds; "
            "give the opponents' error, or opponents=NATURAL, who are rated rightly"
        )
    league = _as_told(night, chances, pace, exact, tuple(changes[1:]))
    met = (league.law + league.law[::-1]) / 2.0
    moving = _as_told(night, chances, pace + drift, met, league.changes) if drift else league
    return moving._replace(opponents=met)


def _as_told(
    night: Night,
    chances: list[Floats],
    fall: float,
    opponents: Floats,
    changes: tuple[float, ...],
) -> Settled:
    """Return what a ladder comes to by these chances in each match of a night."""
    steps = night.pairing.steps
    joint = [np.outer(_beginning(night, chances, fall), night.weights)]
    for each in chances[:-1]:
        joint.append(_after(joint[-1], *_falling(steps, each[:-1], fall)))
    average = _average(chances, joint)
    steps, moves = _falling(steps, average[:-1], fall)
    law = np.mean([one.sum(axis=1) for one in joint], axis=0)
    return Settled(steps, moves.T, average[-1], law, opponents, changes)


def _against_the_same(
    night: Night, fall: float, begun: Floats
) -> tuple[list[Floats], list[Floats]]:
    """Return the chances in each match against players with the player's own law, made even.

    Also the joint laws of error and deviation before each match, so made even.
    """
    chances, laws = [], []
    joint = np.outer(begun, night.weights)
    for match in range(night.matches):
        laws.append((joint + joint[::-1, ::-1]) / 2.0)
        chances.append(night.pairing.moves(laws[-1]))
        if match + 1 < night.matches:
            joint = _after(joint, *_falling(night.pairing.steps, chances[-1][:-1], fall))
    return chances, laws


def _beginning(night: Night, chances: list[Floats], fall: float) -> Floats:
    """Return the law of the errors that is the same at the end of a night as at its beginning.

    A night is a walk by what its matches move in sum: P(sum | error, deviation) is worked out
    match by match, and averaged over the deviation.
    """
    sums, moved = _falling(night.pairing.steps, chances[0][:-1], fall)
    for each in chances[1:]:
        sums, moved = _one_match_more(sums, moved, *_falling(night.pairing.steps, each[:-1], fall))
    return long_run_law(sums, (moved @ night.weights).T)


def _one_match_more(
    sums: NDArray[np.int64], moved: Floats, steps: NDArray[np.int64], chances: Floats
) -> tuple[NDArray[np.int64], Floats]:
    """Return the sums of moves, and their chances, after a match by these steps and chances.

    An error beyond an end moves as it would at that end; it is held there at the end of the
    night. Held at once, an even number of matches could move an error by an odd number of
    points, and how often it does so in ages would decide between even and odd errors.
    """
    many, far = moved.shape[1], int(np.abs(sums).max())
    reached = np.unique(sums[:, None] + steps)
    after = np.zeros((len(reached), *moved.shape[1:]))
    beyond = np.pad(chances, ((0, 0), (far, far), (0, 0)), mode="edge")
    # Where moves are of many sizes this is most of the work: without copies it fits a cache.
    both = np.empty(moved.shape[1:])
    for total, before in zip(sums.tolist(), moved, strict=True):
        here = beyond[:, far + total : far + total + many]
        for place, chance in zip(np.searchsorted(reached, total + steps), here, strict=True):
            after[place] += np.multiply(before, chance, out=both)
    return reached, after


def _average(chances: list[Floats], joint: list[Floats]) -> Floats:
    """Return P(move | error) on the average of the matches, and P(win | error) last."""
    flow = sum(
        ((each * law).sum(axis=2) for each, law in zip(chances, joint, strict=True)),
        start=np.zeros(chances[0].shape[:2]),
    )
    weight = np.sum(joint, axis=(0, 2))
    known = weight > 0.0
    # Where a law is smaller than any float, one deviation is as good as another.
    return np.where(known, flow / np.where(known, weight, 1.0), chances[0].mean(axis=2))


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


def _mean_move(night: Night, chances: list[Floats], joint: list[Floats]) -> float:
    """Return the mean move of a rating, over the matches of a night."""
    flow = _average(chances, joint)[:-1] @ np.mean([law.sum(axis=1) for law in joint], axis=0)
    return float(night.pairing.steps @ flow)
