"""Simulated drill logs: what a log looks like if nothing but the chances decides."""

from __future__ import annotations

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.practice.drill_log import AFTER_MISS, AFTER_START, AFTER_SUCCESS, DrillLog

_AT_ONCE = 500_000
"""The most stretches simulated side by side, so that memory stays small."""


def play_again(log: DrillLog, success: Floats, *, replicas: int, rng: np.random.Generator) -> Ints:
    """Return the outcomes of simulated logs that have the starts and lengths of a log.

    Each stretch of the log, from one start to the next, is simulated from its first level for
    the same number of attempts, each independent of those before it, given its level.

    Parameters
    ----------
    log
        where the stretches begin, and how long they are.
    success
        shape (levels,): P(success | an attempt at level i).
    replicas
        how many logs to simulate.
    rng
        the source of the random draws.

    Returns
    -------
    numpy.ndarray
        shape (replicas, levels, 3, 2): as `DrillLog.outcomes`, one log per row.

    >>> from evenbreak.practice import DrillLog
    >>> log = DrillLog([1, 2, 1], [True, False, True])
    >>> always = np.array([1.0, 1.0])
    >>> play_again(log, always, replicas=1, rng=np.random.default_rng(1)).sum((2, 3))
    array([[1, 2]])
    """
    ends = np.append(log.starts[1:], len(log))
    lengths = ends - log.starts
    longest_first = np.argsort(-lengths, kind="stable")
    lengths, first = lengths[longest_first], log.level[log.starts[longest_first]] - 1
    batch = max(1, _AT_ONCE // len(lengths))
    parts = [
        _played(first, lengths, success, min(batch, replicas - done), rng)
        for done in range(0, replicas, batch)
    ]
    return np.concatenate(parts)


def _played(
    first: Ints,
    lengths: Ints,
    success: Floats,
    replicas: int,
    rng: np.random.Generator,
) -> Ints:
    """Simulate all stretches of all replicas side by side, the longest first."""
    n = len(success)
    counts = np.zeros(replicas * n * 6, dtype=np.int64)
    level = np.tile(first, (replicas, 1))
    before = np.full(level.shape, AFTER_START)
    row = np.arange(replicas)[:, None] * n
    still = np.searchsorted(-lengths, -np.arange(lengths[0]), side="left")
    for count in still.tolist():
        level, before = level[:, :count], before[:, :count]
        won = rng.random(level.shape) < success[level]
        np.add.at(counts, (((row + level) * 3 + before) * 2 + won).ravel(), 1)
        level = np.clip(level + np.where(won, 1, -1), 0, n - 1)
        before = np.where(won, AFTER_SUCCESS, AFTER_MISS)
    return counts.reshape(replicas, n, 3, 2)
