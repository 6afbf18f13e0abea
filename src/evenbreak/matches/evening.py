"""Finish time of an evening of matches: several tables, a list of matches, random times.

Whenever a table is free, the first match on the list whose players are both free starts there;
between two matches, the table is idle for the turnover. The matches' random variation and the
turnovers are independent, and the pace of the evening stretches everything equally.

If there is one table, or one for each match, the finish time at the usual pace has a distribution
that can be calculated (`minutes`); otherwise the evening is simulated many times. Then the result
is averaged over the pace of the evening by calculation.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import generator_of, kind_of, kind_or_usual, whole
from evenbreak.errors import InputError
from evenbreak.matches.minutes import End, all_at_once, between, ended_by, one_after_another
from evenbreak.matches.pace import Pace, Turnover, pace_of
from evenbreak.matches.quantiles import TIE

_WORK = 200_000_000  # matches times matches times simulated runs
_FEWEST_RUNS, _MOST_RUNS = 1_000, 50_000
_MOST_MATCHES = 1_000
_LONGEST = 100_000  # games of a match
_Y = np.linspace(-6.0, 6.0, 241)  # the evening's luck, a standard normal
_Y_CHANCE = np.exp(-(_Y**2) / 2.0) / np.exp(-(_Y**2) / 2.0).sum()


class LengthLike(Protocol):
    """Any object with the length of a match: P(it takes games[k] games) = probability[k]."""

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
    """Finish time of the last match, in minutes.

    Parameters
    ----------
    mean, sd
        mean and standard deviation of the finish time.
    p90
        the time by which all matches are over with probability .9.
    runs
        how many evenings were simulated; 0 if the finish time was calculated.
    mean_error, p90_error
        the standard errors of `mean` and `p90` from the simulation; 0 if calculated.
    """

    mean: float
    sd: float
    p90: float
    runs: int
    mean_error: float
    p90_error: float

    @property
    def exact(self) -> bool:
        """Whether the answer was calculated, without simulation."""
        return self.runs == 0


def evening(
    lengths: Sequence[LengthLike],
    pace: Pace | str,
    *,
    turnover: Turnover | None = None,
    tables: int = 1,
    players: Sequence[tuple[Hashable, Hashable]] | None = None,
    rng: np.random.Generator | int | None = None,
    runs: int | None = None,
) -> Evening:
    """Return the finish time of an evening of matches.

    Parameters
    ----------
    lengths
        the length of each match in games, in the order of the list: a `Length`, a
        `MatchLength` or a `RaceOdds`.
    pace
        a `Pace`, or the name of a discipline in `PACES`.
    turnover
        the time between two matches on a table; None: the usual time.
    players
        the two players of each match, so that no one plays two matches at once; None: no player is
        on the list twice.
    rng
        a generator or a seed, if random numbers are needed; None: seed 0.
    runs
        how often to simulate the evening; None: calculate the finish time if there is one table, or
        one for each match and no player twice; otherwise simulate 50,000 evenings, or fewer for
        more than about sixty matches.

    Raises
    ------
    InputError
        if there is no match, a length is not a distribution, `tables` is not a whole number
        above 0, `players` does not have one pair of different players for each match, there is
        no such discipline, or there are more than a thousand matches.

    Notes
    -----
    Calculations use a grid of 1/500 of the finish time's standard deviation, which changes `p90` by
    less than .02 minutes for up to a hundred matches.

    >>> coin = Length([1, 2], [0.5, 0.5])
    >>> one = evening([coin] * 4, "9-ball")
    >>> round(one.mean, 1), round(one.p90, 1)
    (81.1, 108.9)
    """
    pace = pace_of(pace) if isinstance(pace, str) else kind_of(pace, "pace", Pace)
    between_matches = kind_or_usual(turnover, "turnover", Turnover)
    laws = [_chances(length, f"length {k}") for k, length in enumerate(lengths, 1)]
    if not 0 < len(laws) <= _MOST_MATCHES:
        raise InputError(
            "{lengths} must have 1 to {most_matches:,} matches; it has {n_found:,}",
            n_found=len(laws),
            most_matches=_MOST_MATCHES,
        )
    tables = min(whole(tables, "tables", at_least=1), len(laws))
    pairs = _numbered(players, len(laws))
    if runs is None and tables == 1:
        return _calculated(one_after_another(laws, pace, between_matches), pace)
    if runs is None and tables == len(laws) and len(np.unique(pairs)) == pairs.size:
        return _calculated(all_at_once(laws, pace), pace)
    rng = generator_of(0 if rng is None else rng)
    return _simulated(laws, pace, between_matches, tables, pairs, rng, runs)


def _chances(length: LengthLike, name: str) -> Floats:
    """Return P(the match takes k games) for k = 0, 1, ..."""
    games, probability = np.asarray(length.games), np.asarray(length.probability)
    right = games.ndim == 1 and games.shape == probability.shape and games.size > 0
    if not right or games.dtype.kind not in "iu" or probability.dtype.kind not in "iuf":
        raise InputError(
            "{name} isn't a length. Give whole numbers of games, each with its chance.", name=name
        )
    if games.min() < 0 or games.max() > _LONGEST:
        raise InputError(
            "{name} must have numbers of games from 0 to {longest:,}; one isn't",
            name=name,
            longest=_LONGEST,
        )
    if not (probability >= 0).all() or abs(probability.sum() - 1.0) > 1e-6:
        raise InputError("{name} must have probabilities that sum to 1; they don't", name=name)
    counted = np.bincount(games, probability)
    return np.asarray(counted / counted.sum())


def _numbered(players: Sequence[tuple[Hashable, Hashable]] | None, matches: int) -> Ints:
    """Return the players of each match as numbers, shape (matches, 2)."""
    if players is None:
        return np.arange(2 * matches).reshape(matches, 2)
    if len(players) != matches:
        raise InputError(
            "{players} has {n_players} pairs for {matches} matches. Give one pair for each match.",
            n_players=len(players),
            matches=matches,
        )
    number: dict[Hashable, int] = {}
    for first, second in players:
        if first == second:
            raise InputError(
                "{players} has {one!r} on both sides of a match. Give two different players.",
                one=first,
            )
    return np.array(
        [[number.setdefault(player, len(number)) for player in pair] for pair in players]
    )


def _calculated(end: End, pace: Pace) -> Evening:
    """Return an evening from the distribution of its finish time at the usual pace."""
    factor = np.exp(pace.evening_sd * _Y - pace.evening_sd**2 / 2.0)

    def reached(minutes: Floats) -> bool:
        by_then = np.interp(minutes / factor, end.minutes, end.ended, left=0.0)
        return bool(_Y_CHANCE @ by_then >= 0.9 * (1.0 - TIE))

    most = end.minutes[-1] * factor[-1]
    p90 = float(between(0.0, most, reached))
    return Evening(end.mean, _with_pace(end.mean, end.sd, pace), p90, 0, 0.0, 0.0)


def _with_pace(mean: float, sd: float, pace: Pace) -> float:
    """Return the standard deviation of the finish time if the evening's pace isn't known."""
    square = (mean**2 + sd**2) * math.exp(pace.evening_sd**2)
    return math.sqrt(max(square - mean**2, 0.0))


def _simulated(
    lengths: list[Floats],
    pace: Pace,
    turnover: Turnover,
    tables: int,
    pairs: Ints,
    rng: np.random.Generator,
    runs: int | None,
) -> Evening:
    matches = len(lengths)
    if runs is None:
        runs = min(_MOST_RUNS, max(_FEWEST_RUNS, _WORK // matches**2))
    runs = whole(runs, "runs", at_least=2)
    minutes = np.empty((runs, matches))
    for k, length in enumerate(lengths):
        games = np.searchsorted(np.cumsum(length)[:-1], rng.random(runs), side="right")
        minutes[:, k] = pace.draw(games, rng)
    end = _ends(minutes, turnover.draw((runs, matches), rng), tables, pairs)
    mean, sd = float(end.mean()), float(end.std(ddof=1))

    def ended(q: float) -> float:
        def reached(by: Floats) -> bool:
            return bool(ended_by(by, end, pace.evening_sd).mean() >= q * (1.0 - TIE))

        most = end.max() * math.exp(6.0 * pace.evening_sd)
        return float(between(0.0, most, reached))

    error = 0.3 / math.sqrt(runs)  # of the share of evenings that end by a time, around .9
    return Evening(
        mean=mean,
        sd=_with_pace(mean, sd, pace),
        p90=ended(0.9),
        runs=runs,
        mean_error=sd / math.sqrt(runs),
        p90_error=(ended(0.9 + error) - ended(0.9 - error)) / 2.0,
    )


def _ends(minutes: Floats, turnover: Floats, tables: int, pairs: Ints) -> Floats:
    """Return each evening's finish time, given the time of each match and the turnover after it."""
    runs, matches = minutes.shape
    row = np.arange(runs)
    table_free = np.zeros((runs, tables))
    ready = np.zeros((runs, matches))  # when both players of a match are free
    ends = np.zeros(runs)
    shared = (pairs[:, None, :, None] == pairs[None, :, None, :]).any(axis=(2, 3))
    for _ in range(matches):
        table = table_free.argmin(axis=1)
        free = table_free[row, table]
        # Of the matches that can begin soonest, the first on the list.
        match = np.maximum(ready, free[:, None]).argmin(axis=1)
        done = np.maximum(ready[row, match], free) + minutes[row, match]
        table_free[row, table] = done + turnover[row, match]
        np.maximum(ends, done, out=ends)
        np.maximum(ready, np.where(shared[match], done[:, None], 0.0), out=ready)
        ready[row, match] = np.inf
    return ends
