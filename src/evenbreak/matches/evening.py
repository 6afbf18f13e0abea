"""When an evening of matches ends: several tables, a list of matches, random lengths.

Whenever a table is free, the first match on the list whose players are both free begins there.
The lengths of matches are independent of each other.

With one table the end is the sum of all lengths, a convolution. With several tables and no
player on the list twice, the state after each match is the list of times at which the tables
become free, in order; the distribution of the end is exact as long as there are few such
states. Otherwise the evening is simulated many times.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.matches.quantiles import quantile_of

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]

_MOST_MOVES = 1_000_000  # states times lengths of one exact step
_WORK = 200_000_000  # matches times matches times simulated runs
_FEWEST_RUNS, _MOST_RUNS = 1_000, 50_000
_MOST_MATCHES = 1_000
_LONGEST = 100_000  # games of a match


class LengthLike(Protocol):
    """Anything with the length of a match: P(it takes games[k] games) = probability[k]."""

    @property
    def games(self) -> ArrayLike:
        """The lengths, in games."""
        ...

    @property
    def probability(self) -> ArrayLike:
        """The probability of each length."""
        ...


class Length(NamedTuple):
    """How long one match lasts: P(it takes games[k] games) = probability[k]."""

    games: ArrayLike
    probability: ArrayLike


@dataclass(frozen=True)
class Evening:
    """When the last match ends; the unit of time is one game.

    Parameters
    ----------
    mean, sd
        mean and standard deviation of the end.
    p90
        the smallest time by which all matches are over with probability .9.
    runs
        how many evenings were simulated; 0 if the answer is exact.
    mean_error
        the standard error of `mean` from the simulation; 0 if exact. `p90` has none: it is a
        whole number, which usually comes out the same each time.
    """

    mean: float
    sd: float
    p90: int
    runs: int
    mean_error: float

    @property
    def exact(self) -> bool:
        """Whether the answer is exact, found without simulation."""
        return self.runs == 0


def evening(
    lengths: Sequence[LengthLike],
    *,
    tables: int = 1,
    players: Sequence[tuple[Hashable, Hashable]] | None = None,
    rng: np.random.Generator | None = None,
    runs: int | None = None,
) -> Evening:
    """Return when an evening of matches ends.

    Parameters
    ----------
    lengths
        the length of each match in games, in the order of the list: a `Length`, a
        `MatchLength` or a `RaceOdds`.
    tables
        how many tables there are.
    players
        the two players of each match, so that nobody plays two matches at once; None: no
        player is on the list twice.
    rng
        the source of random numbers, if any are needed; None: a generator with seed 0.
    runs
        how often to simulate the evening; None: find the exact answer if that is quick, else
        simulate 50,000 evenings, fewer for more than about sixty matches.

    Raises
    ------
    InputError
        if there is no match, a length is not a distribution, `tables` is not a whole number
        above 0, `players` does not have one pair of different players for each match, or
        more than a thousand matches would have to be simulated.

    >>> coin = Length([1, 2], [0.5, 0.5])
    >>> evening([coin] * 4).p90, evening([coin] * 4).mean, evening([coin] * 4, tables=2).mean
    (7, 6.0, 3.375)
    """
    found = [_chances(length, f"length {k}") for k, length in enumerate(lengths, 1)]
    if not found:
        raise InputError("lengths is empty; give one for each match")
    tables = min(whole(tables, "tables", at_least=1), len(found))
    pairs = _numbered(players, len(found))
    if runs is None:
        end = None
        if tables == 1:
            end = _one_table(found)
        elif len(np.unique(pairs)) == pairs.size:
            end = _all_at_once(found) if tables == len(found) else _several_tables(found, tables)
        if end is not None:
            return _exact(end)
    return _simulated(found, tables, pairs, rng or np.random.default_rng(0), runs)


def _chances(length: LengthLike, name: str) -> Floats:
    """Return P(the match takes k games) for k = 0, 1, ..."""
    games, probability = np.asarray(length.games), np.asarray(length.probability)
    right = games.ndim == 1 and games.shape == probability.shape and games.size > 0
    if not right or games.dtype.kind not in "iu" or probability.dtype.kind not in "iuf":
        raise InputError(f"{name} is not a length; give whole numbers of games, with a chance each")
    if games.min() < 0 or games.max() > _LONGEST:
        raise InputError(f"{name} has games outside 0 to {_LONGEST:,}; give numbers of games")
    if not (probability >= 0).all() or abs(probability.sum() - 1.0) > 1e-6:
        raise InputError(f"{name} has chances that do not sum to 1; give probabilities")
    counted = np.bincount(games, probability)
    chances: Floats = counted / counted.sum()
    return chances


def _numbered(players: Sequence[tuple[Hashable, Hashable]] | None, matches: int) -> Ints:
    """Return the players of each match as numbers, shape (matches, 2)."""
    if players is None:
        return np.arange(2 * matches).reshape(matches, 2)
    if len(players) != matches:
        raise InputError(
            f"players has {len(players)} pairs for {matches} matches; give one for each"
        )
    number: dict[Hashable, int] = {}
    for one, other in players:
        if one == other:
            raise InputError(f"players has {one!r} on both sides; give two players")
    return np.array(
        [[number.setdefault(player, len(number)) for player in pair] for pair in players]
    )


def _one_table(lengths: list[Floats]) -> Floats:
    end = np.ones(1)
    for length in lengths:
        end = np.convolve(end, length)
    return end


def _all_at_once(lengths: list[Floats]) -> Floats:
    """Return the distribution of the longest of all."""
    longest = max(map(len, lengths))
    padded = np.array([np.pad(length, (0, longest - len(length))) for length in lengths])
    return np.diff(padded.cumsum(axis=1).prod(axis=0), prepend=0.0)


def _several_tables(lengths: list[Floats], tables: int) -> Floats | None:
    """Return the distribution of the end if no player plays twice; None if it has too many states.

    A state is the list of times at which the tables become free, in order; the next match begins
    at the first of them.
    """
    base = sum(map(len, lengths))
    if tables * math.log2(base) > 62:
        return None
    place = base ** np.arange(tables - 1, -1, -1)
    states = np.zeros((1, tables), dtype=np.int64)
    chances: Floats = np.ones(1)
    for length in lengths:
        games = np.flatnonzero(length)
        if len(states) * len(games) > _MOST_MOVES:
            return None
        after = np.repeat(states, len(games), axis=0)
        after[:, 0] += np.tile(games, len(states))
        after.sort(axis=1)
        key, first, back = np.unique(after @ place, return_index=True, return_inverse=True)
        arriving: Floats = np.outer(chances, length[games]).ravel()
        chances = np.bincount(back, arriving, len(key)).astype(float)
        states = after[first]
    end: Floats = np.bincount(states[:, -1], chances).astype(float)
    return end


def _exact(end: Floats) -> Evening:
    times = np.arange(len(end))
    mean = float(times @ end)
    sd = math.sqrt(float((times - mean) ** 2 @ end))
    return Evening(mean, sd, quantile_of(end.tolist(), 0.9), 0, 0.0)


def _simulated(
    lengths: list[Floats], tables: int, pairs: Ints, rng: np.random.Generator, runs: int | None
) -> Evening:
    matches = len(lengths)
    if matches > _MOST_MATCHES:
        raise InputError(f"lengths has {matches:,} matches; give {_MOST_MATCHES:,} at most")
    if runs is None:
        runs = min(_MOST_RUNS, max(_FEWEST_RUNS, _WORK // matches**2))
    runs = whole(runs, "runs", at_least=2)
    played = np.empty((runs, matches), dtype=np.int64)
    for k, length in enumerate(lengths):
        played[:, k] = np.searchsorted(np.cumsum(length)[:-1], rng.random(runs), side="right")
    end = np.sort(_ends(played, tables, pairs))
    sd = float(end.std(ddof=1))
    p90 = int(end[math.ceil(0.9 * runs) - 1])
    return Evening(float(end.mean()), sd, p90, runs, sd / math.sqrt(runs))


def _ends(lengths: Ints, tables: int, pairs: Ints) -> Ints:
    """Return when each evening ends, given the length of each match in it."""
    runs, matches = lengths.shape
    row = np.arange(runs)
    table_free = np.zeros((runs, tables), dtype=np.int64)
    ready = np.zeros((runs, matches), dtype=np.int64)  # when both players of a match are free
    never = np.iinfo(np.int64).max // 2
    shared = (pairs[:, None, :, None] == pairs[None, :, None, :]).any(axis=(2, 3))
    for _ in range(matches):
        table = table_free.argmin(axis=1)
        free = table_free[row, table]
        # Of the matches that can begin soonest, the first on the list.
        match = np.maximum(ready, free[:, None]).argmin(axis=1)
        done = np.maximum(ready[row, match], free) + lengths[row, match]
        table_free[row, table] = done
        np.maximum(ready, np.where(shared[match], done[:, None], 0), out=ready)
        ready[row, match] = never
    ends: Ints = table_free.max(axis=1)
    return ends
