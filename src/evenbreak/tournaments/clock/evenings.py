"""Evenings simulated: who wins, in how many games, in how many minutes, in each run.

All luck comes from the seed in a fixed order, so that two evenings with the same seed differ only
in what was changed: a race, a pace, a number of tables.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray
from scipy.special import ndtr, ndtri

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.errors import InputError
from evenbreak.matches.pace import Pace, Turnover
from evenbreak.tournaments.brackets.standing import NOBODY, Standing
from evenbreak.tournaments.odds.chances import Chances, with_nobody
from evenbreak.tournaments.odds.play import play_out, stratified_uniforms
from evenbreak.tournaments.odds.races import PairOdds


class InPlay(NamedTuple):
    """A match in progress.

    Parameters
    ----------
    started
        in minutes since the event's first start.
    games
        the games played so far, if the score is known. The match odds must then be from this score
        (`from_score`).
    scored
        when the score was recorded; None: not known.
    """

    match: str
    started: float
    games: int = 0
    scored: float | None = None


@dataclass(frozen=True, eq=False)
class Evenings:
    """Many evenings: rows are runs, columns the matches still to be played.

    `needed` is False for a second final that isn't played. A match in progress has its remaining
    minutes; `turnover` is the time its table needs afterward; players are positions.
    """

    names: tuple[str, ...]
    needed: Bools
    minutes: Floats
    turnover: Floats
    first: NDArray[np.int16]
    second: NDArray[np.int16]
    first_won: Bools


def play_evenings(
    now: Standing,
    laws: Mapping[str, PairOdds],
    pace: Pace,
    turnover: Turnover | None,
    *,
    playing: Sequence[InPlay] = (),
    clock: float = 0.0,
    runs: int = 2000,
    seed: int = 0,
) -> Evenings:
    """Return many evenings from the current state on; `clock` counts from the first start."""
    remaining = now.remaining
    names = tuple(match.name for match in remaining.matches if match.name not in now.winners)
    for name in names:
        if name not in laws:
            raise InputError(
                "{laws} has no match {name!r}. Give the odds for every match (`pair_odds`).",
                name=name,
            )
    rng = np.random.default_rng(seed)
    evening = lognormal(ndtri(stratified_uniforms(rng, runs)), pace.evening_sd)
    chances = Chances({m.name: with_nobody(laws[m.name].win) for m in remaining.matches})
    under_way = {}
    for match in playing:
        under_way[match.match] = _under_way(now, laws, pace, evening, match, clock, rng)
    luck = np.random.default_rng([seed, 1])
    given = {name: won for name, (won, _) in under_way.items()} | _decided(now, runs)
    played = play_out(remaining, chances, luck, runs, given=given)
    nobody = len(now.bracket.players)
    shape = runs, len(names)
    needed, minutes, between = np.ones(shape, dtype=bool), np.zeros(shape), np.zeros(shape)
    first, second = (np.zeros(shape, dtype=np.int16) for _ in range(2))
    first_won = np.zeros(shape, dtype=bool)
    for k, name in enumerate(names):
        one, other = played.first[name], played.second[name]
        needed[:, k] = (one < nobody) & (other < nobody)
        first[:, k], second[:, k] = one, other
        first_won[:, k] = played.first_won[name]
        games_luck, match_luck, between_luck = (stratified_uniforms(luck, runs) for _ in range(3))
        between[:, k] = turnovers(turnover, between_luck)
        if name in under_way:
            minutes[:, k] = under_way[name][1]
            continue
        winner = np.where(played.first_won[name], one, other)
        loser = np.where(played.first_won[name], other, one)
        games = _games(laws[name], winner, loser, needed[:, k], games_luck)
        noise = lognormal(ndtri(match_luck), pace.match_sd)
        minutes[:, k] = evening * noise * pace.mean_minutes(games)
    return Evenings(names, needed, minutes, between, first, second, first_won)


def _decided(now: Standing, runs: int) -> dict[str, Bools]:
    """Return the results of the matches in unsettled groups."""
    found = {}
    for name, won in now.winners.items():
        first = now.seats[name][0]
        found[name] = np.full(runs, won == first)
    return found


def _games(law: PairOdds, winner: Ints, loser: Ints, needed: Bools, luck: Floats) -> Ints:
    """Return how many games a match takes, given who wins."""
    games = np.zeros(len(winner), dtype=np.int64)
    ends = law.ends[winner[needed], loser[needed]]
    reached = np.cumsum(ends, axis=1)
    games[needed] = (reached < (luck[needed] * reached[:, -1])[:, None]).sum(axis=1)
    return games


def _under_way(
    now: Standing,
    laws: Mapping[str, PairOdds],
    pace: Pace,
    evening: Floats,
    match: InPlay,
    clock: float,
    rng: np.random.Generator,
) -> tuple[Bools, Floats]:
    """Return who wins a match in progress, and its remaining minutes.

    The minutes it has taken so far make greater lengths likelier.
    """
    one, other = now.seats.get(now.bracket.match(match.match).name, (None, None))
    if match.match in now.winners or one is None or other is None or NOBODY in (one, other):
        raise InputError(
            "playing has {match!r}. Give matches whose players are known.", match=match.match
        )
    since = match.started if match.scored is None else match.scored
    elapsed = clock - since
    if elapsed < 0.0:
        raise InputError(
            "{match} started at {since:g}, but it's only {clock:g} now",
            match=match.match,
            since=since,
            clock=clock,
        )
    ends = np.concatenate([laws[match.match].ends[one, other], laws[match.match].ends[other, one]])
    games = np.tile(np.arange(len(ends) // 2), 2)
    usual = pace.mean_minutes(games) - pace.mean_minutes(match.games)
    kind, left = minutes_left(ends, usual, pace.match_sd, evening, elapsed, rng)
    return kind < len(ends) // 2, left


def minutes_left(
    chances: Floats, usual: Floats, match_sd: float, evening: Floats, elapsed: float, rng: Generator
) -> tuple[Ints, Floats]:
    """Return how a match in progress ends in each run, and its remaining minutes, shape (runs,).

    `chances` has each possible ending's chance, and `usual` its total minutes at the usual pace;
    the `elapsed` minutes make longer endings likelier. `evening` is each run's pace.
    """
    median = evening[:, None] * np.maximum(usual, 1e-9) * lognormal(0.0, match_sd)
    with np.errstate(divide="ignore"):
        passed = np.log(elapsed / median) / max(match_sd, 1e-9)
    lasts = ndtr(-passed)  # P(it takes longer than it has)
    reached = np.cumsum(chances * lasts, axis=1)
    luck = stratified_uniforms(rng, len(evening)) * reached[:, -1]
    kind = np.minimum((reached < luck[:, None]).sum(axis=1), len(chances) - 1)
    row = np.arange(len(evening))
    tail = np.maximum(lasts[row, kind] * (1.0 - stratified_uniforms(rng, len(evening))), 1e-300)
    total = median[row, kind] * np.exp(-match_sd * ndtri(tail))
    return kind, np.maximum(total - elapsed, 0.0)


_AT_ONCE = 0.62  # with table and players free, so many real turnovers take under a minute


def turnovers(turnover: Turnover | None, luck: Floats) -> Floats:
    """Return the times between two matches on a table, from uniform random numbers.

    None: as in real events when the table and the players are free, 0 in 62 of 100 cases and
    otherwise the usual time, 4.1 minutes on average.

    >>> turnovers(None, np.array([0.6, 0.81]))
    array([0. , 7.5])
    """
    at_once, law = (_AT_ONCE, Turnover()) if turnover is None else (0.0, turnover)
    later = (luck - at_once) / (1.0 - at_once)
    normal = ndtri(later.clip(1e-12, 1.0 - 1e-12))
    minutes: Floats = law.mean * lognormal(normal, law.log_sd)
    minutes[later <= 0.0] = 0.0
    return minutes


def lognormal(normal: Any, log_sd: float) -> Any:
    """Return lognormal factors with mean 1, from standard normal numbers."""
    return np.exp(log_sd * normal - log_sd**2 / 2.0)
