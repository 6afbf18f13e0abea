"""The rating-error distribution that reproduces itself when opponents are drawn from it.

Every player draws their form for a night at its start; before its k-th match all players have
the same joint distribution of error and form. One round of the iteration takes the errors at the
start of a night, lets all players play each other through the night, and finds the distribution
that is the same at the end as at the start.

Averaged over the matches of a night, P(move | error) is a chain whose stationary distribution is
exactly the average one: what flows into an error during a night also flows out of it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.errors import AccuracyError
from evenbreak.handicaps.ladders.error_walk import long_run_law
from evenbreak.handicaps.ladders.pairing import Pairing

_SETTLED = 1e-13
_ROUNDS = 300
_FULL_DIGITS = float(np.finfo(float).tiny / np.finfo(float).eps)
"""Products of a probability and a weight above this are correct to the last digit."""


class NightModel(NamedTuple):
    """A night's matches: the outcomes of each, the chance of each form, and their number."""

    pairing: Pairing
    weights: Floats
    matches: int


class LongRun(NamedTuple):
    """Long-run state of a ladder.

    `kernel` is P(move | error), shape (errors, steps); `wins` is P(win | error), `law` and
    `opponents` are the distributions of the player's and the opponents' error, shape (errors,).
    `changes` has the largest change of a probability in each round of the iteration.
    """

    steps: Ints
    kernel: Floats
    wins: Floats
    law: Floats
    opponents: Floats
    changes: tuple[float, ...]


def long_run(night: NightModel, error: Floats | None, drift: float, *, conserving: bool) -> LongRun:
    """Return the long run of a player's errors, and of the opponents' if theirs are not given.

    Without `error`, opponents have the errors of a player without drift, made symmetric. `drift` is
    how many points the player's skill rises per match on average; `conserving` is whether the
    winner gains what the loser loses. Raises AccuracyError if the iteration does not converge.

    Among symmetric distributions each round reduces the change to about a hundredth. But if the
    opponents are slightly better than their ratings on average, the player's rating falls below
    their skill by slightly more. Without the symmetry, rounding errors would grow in this way until
    the iteration swings between two skewed distributions.

    If opponents err as the player does and the system makes all ratings rise, errors are
    measured from the league's mean error; otherwise they would rise forever.
    """
    pairing = night.pairing
    if error is not None:
        each = pairing.moves(np.outer(error, night.weights))
        return _average_over_night(night, [each] * night.matches, drift, error, ())
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
            "the rating errors are still changing by {change:.3g} after {rounds} rounds. Give "
            "the opponents' error, or opponents=NATURAL (correctly rated opponents).",
            change=changes[-1],
            rounds=_ROUNDS,
        )
    league = _average_over_night(night, chances, pace, exact, tuple(changes[1:]))
    met = (league.law + league.law[::-1]) / 2.0
    if drift:
        league = _average_over_night(night, chances, pace + drift, met, league.changes)
    return league._replace(opponents=met)


def _average_over_night(
    night: NightModel,
    chances: list[Floats],
    fall: float,
    opponents: Floats,
    changes: tuple[float, ...],
) -> LongRun:
    """Return the average over a night's matches, given the chances in each match."""
    steps = night.pairing.steps
    joint = [np.outer(_beginning(night, chances, fall), night.weights)]
    for each in chances[:-1]:
        joint.append(_after(joint[-1], *_falling(steps, each[:-1], fall)))
    average = _average(chances, joint)
    steps, moves = _falling(steps, average[:-1], fall)
    law = np.mean([of_match.sum(axis=1) for of_match in joint], axis=0)
    return LongRun(steps, moves.T, average[-1], law, opponents, changes)


def _against_the_same(
    night: NightModel, fall: float, begun: Floats
) -> tuple[list[Floats], list[Floats]]:
    """Return the chances in each match against players with the same errors, made symmetric.

    Also return the joint distribution of error and form before each match, made symmetric.
    """
    chances, laws = [], []
    joint = np.outer(begun, night.weights)
    for match in range(night.matches):
        laws.append((joint + joint[::-1, ::-1]) / 2.0)
        chances.append(night.pairing.moves(laws[-1]))
        if match + 1 < night.matches:
            joint = _after(joint, *_falling(night.pairing.steps, chances[-1][:-1], fall))
    return chances, laws


def _beginning(night: NightModel, chances: list[Floats], fall: float) -> Floats:
    """Return the error distribution that is the same at the end of a night as at its start.

    A night moves a rating by the sum of its matches: P(sum | error, form) is calculated match by
    match and averaged over the form.
    """
    sums, moved = _falling(night.pairing.steps, chances[0][:-1], fall)
    for each in chances[1:]:
        sums, moved = _one_match_more(sums, moved, *_falling(night.pairing.steps, each[:-1], fall))
    return long_run_law(sums, (moved @ night.weights).T)


def _one_match_more(sums: Ints, moved: Floats, steps: Ints, chances: Floats) -> tuple[Ints, Floats]:
    """Return the sums of moves and their chances after one more match.

    An error beyond an end moves as it would at that end, and is held there only at the end of
    the night. If it were held at once, an even number of matches could move an error by an odd
    number of points; that is extremely rare, but it would decide between even and odd errors.
    """
    many, far = moved.shape[1], int(np.abs(sums).max())
    reached = np.unique(sums[:, None] + steps)
    after = np.zeros((len(reached), *moved.shape[1:]))
    beyond = np.pad(chances, ((0, 0), (far, far), (0, 0)), mode="edge")
    # With moves of many sizes this is most of the work; without copies it fits a cache.
    both = np.empty(moved.shape[1:])
    for total, before in zip(sums.tolist(), moved, strict=True):
        here = beyond[:, far + total : far + total + many]
        for place, chance in zip(np.searchsorted(reached, total + steps), here, strict=True):
            after[place] += np.multiply(before, chance, out=both)
    return reached, after


def _average(chances: list[Floats], joint: list[Floats]) -> Floats:
    """Return P(move | error) averaged over the matches, with P(win | error) last."""
    flow = sum(
        ((each * law).sum(axis=2) for each, law in zip(chances, joint, strict=True)),
        start=np.zeros(chances[0].shape[:2]),
    )
    weight = np.sum(joint, axis=(0, 2))
    reached = weight > _FULL_DIGITS
    # Where the weight is hardly larger than any float, one form is as good as another.
    return np.where(reached, flow / np.where(reached, weight, 1.0), chances[0].mean(axis=2))


def _after(joint: Floats, steps: Ints, chances: Floats) -> Floats:
    """Return the joint distribution after a match; an error that would pass an end stays."""
    after = np.zeros_like(joint)
    many = len(joint)
    for step, chance in zip(steps.tolist(), chances, strict=True):
        flow = joint * chance
        low, high = max(0, -step), min(many, many - step)
        after[low + step : high + step] += flow[low:high]
        after[:low] += flow[:low]
        after[high:] += flow[high:]
    return after


def _falling(steps: Ints, chances: Floats, fall: float) -> tuple[Ints, Floats]:
    """Return moves and chances if errors also fall by `fall`, one whole point at a time.

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


def _mean_move(night: NightModel, chances: list[Floats], joint: list[Floats]) -> float:
    """Return the mean move of a rating in a match of the night."""
    flow = _average(chances, joint)[:-1] @ np.mean([law.sum(axis=1) for law in joint], axis=0)
    return float(night.pairing.steps @ flow)
