r"""Fargo-like: after every night, all ratings are re-estimated from all games.

A game between ratings x and y is won with the chance p = 1 / (1 + 2^(-(x - y) / 100)), and a game
of age t counts 2^(-t / half-life). The ratings are the maximum of

    sum over games log p  +  sum over players c_i / 2 (log p(x_i - r_i) + log p(r_i - x_i))

where r_i is the rating on the list, and c_i is the number of games that it rests on, aged likewise,
and a few pseudo-games, without which a player who won everything would have no rating. A player
with n games of 200 is published at the maximum of their own games, against the ratings of the
others, and 200 - n games against the starter r_i, half of them won; the starter does not affect
anyone else's rating.

Published: the scale, the use of all games by maximum likelihood, the 200 games, and the 200 - n
games against a starter. Reported: the half-life of three years. Assumed: the pseudo-games; that
ratings on the list rest on as many games as the list states, `past` at most (200 where it states
none); and that the level of the scale is held by the list (the real one's anchor is unpublished).

All replicas are solved at once: Newton's method starts from the last ratings, with each step solved
by conjugate gradients with a scaled diagonal, or densely in a single small league. A pair's games
are one entry, so the work does not grow with the number of its matches.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import number, whole
from evenbreak.errors import AccuracyError
from evenbreak.handicaps.charts.chart import Chart, chart
from evenbreak.handicaps.charts.design import fixed_length_chart
from evenbreak.handicaps.systems.history import Entries, History, Matches, column_of
from evenbreak.handicaps.systems.system import System
from evenbreak.ratings.scale import SCALES

_SCALE = SCALES["fargo"]
_UNIT = _SCALE.points_per_log_odds
_YEAR = 365.25
_GAMES_A_MATCH = 7.0
"""Games assumed per stated match, if a list states matches but no games."""

_ENOUGH = 1e-8
"""A fit ends when a step is below this many log-odds."""

_LONGEST = 2.0
"""The longest step, in log-odds: from farther away, Newton's method may overshoot."""

_STEPS = 100

_DENSE = 20_000
"""Matrix entries in total up to which the steps are solved with dense matrices."""


class _Games(NamedTuple):
    """Games by pair: `low` and `high` are the two players' positions among players and replicas."""

    low: Ints
    high: Ints
    won: Floats
    played: Floats


@dataclass(frozen=True)
class FargoLike(System):
    """Refit all results every night, on the Fargo scale.

    Parameters
    ----------
    half_life
        the years after which a game counts half.
    established
        the number of games after which a player's starter no longer counts.
    pseudo_games
        games against the list's rating, half of them won, that never age.
    past
        the most games that a rating on the list rests on.
    starter
        the rating of a player without one.
    games
        the most games in a match, for the most even race at each difference; None: races come from
        the chart.
    own_chart
        the chart that sets the races; None: `fargo_r6_hot`.
    """

    half_life: float = 3.0
    established: int = 200
    pseudo_games: float = 2.0
    past: int = 500
    starter: float = 525.0
    games: int | None = None
    own_chart: Chart | None = None
    name: str = "fargo-like"

    scale = _SCALE
    asks = ("games",)

    def __post_init__(self) -> None:
        number(self.half_life, "half_life", above=0.0, high=1e6)
        number(self.pseudo_games, "pseudo_games", above=0.0, high=1e6)
        whole(self.established, "established", at_least=0)
        whole(self.past, "past", at_least=0)
        number(self.starter, "starter", low=-1e4, high=1e4)
        if self.games is not None:
            _of_games(self.games)

    @property
    def in_words(self) -> str:  # type: ignore[override]
        """The rule in words."""
        years = "a year" if self.half_life == 1.0 else f"{self.half_life:g} years"
        return (
            f"ratings fitted anew every night to all games, with a half-life of {years}; below "
            f"{self.established} games, a starter rating stands in for the missing ones"
        )

    @property
    def chart(self) -> Chart:
        """The chart that sets the races."""
        if self.own_chart is not None or self.games is None:
            return self.own_chart or chart("fargo_r6_hot")
        return _of_games(self.games)

    def initial(self, entries: Entries) -> Floats:
        """Return the stated ratings, or the starter for a player without one."""
        return np.where(np.isnan(entries.rating), self.starter, entries.rating)

    def robustness(self, history: History) -> Floats:
        """Return the games behind each rating, including those before the first night."""
        return self._behind(history) + history.counts("games", Matches.games_played)

    def _behind(self, history: History) -> Floats:
        """Return the games that the list's ratings rest on."""
        games, matches = (
            column_of(values, history.initial.shape).astype(float)
            for values in (history.entries.games, history.entries.matches)
        )
        unstated = np.where(matches < 0, self.established, _GAMES_A_MATCH * matches)
        stated = np.where(games < 0, unstated, games)
        unrated = column_of(np.isnan(history.entries.rating), history.initial.shape)
        return np.where(unrated, 0.0, np.minimum(stated, self.past))

    def update(self, history: History) -> Floats:
        """Return the ratings fitted to all games."""
        now = float(history.days[history.night - 1]) if history.days is not None else None
        age = 7.0 * (history.night - 1) if now is None else now
        faded = 0.5 ** (age / _YEAR / self.half_life)
        games = self._by_pair(history)
        aged = games._replace(won=games.won * faded, played=games.played * faded)
        start = history.initial.reshape(-1) / _UNIT
        before = self._behind(history).reshape(-1)
        counted = self.pseudo_games + before * faded
        fit = history.kept.get("fit", start)
        fit = history.kept["fit"] = _fitted(aged, start, counted, fit, history.initial.shape)
        lacking = np.maximum(self.established - self.robustness(history).reshape(-1), 0.0)
        published = _alone(aged, fit, start, counted + lacking, lacking > 0.0)
        return (published * _UNIT).reshape(history.initial.shape)

    def _by_pair(self, history: History) -> _Games:
        """Return the games of each pair, each worth 2^(its day / half-life)."""
        shape, size = history.initial.shape, history.initial.size
        across = size // shape[0]
        days = 7.0 * np.arange(history.night) if history.days is None else history.days

        def add(state: tuple[Ints, Floats, Floats], night: Matches) -> tuple[Ints, Floats, Floats]:
            weight = 2.0 ** (float(days[night.night[0] - 1]) / _YEAR / self.half_life)
            replica = np.broadcast_to(np.arange(across), (len(night), across))
            sides = [np.reshape(x, (len(night), -1)) for x in (night.a, night.b)]
            there = np.broadcast_to(sides[0] >= 0, replica.shape)
            a, b, won, lost = (
                np.broadcast_to(np.reshape(x, (len(night), -1)), replica.shape)[there]
                for x in (night.a, night.b, night.score_a, night.score_b)
            )
            turned = a > b
            low, high = np.where(turned, b, a), np.where(turned, a, b)
            keys = (low * shape[0] + high) * across + replica[there]
            of_low = np.where(turned, lost, won) * weight
            return _joined(state, keys, of_low, (won + lost) * weight)

        def start() -> tuple[Ints, Floats, Floats]:
            return np.empty(0, dtype=np.int64), np.empty(0), np.empty(0)

        keys, won, played = history.fold("games of pairs", start, add)
        pair, replica = np.divmod(keys, across)
        low, high = np.divmod(pair, shape[0])
        return _Games(low * across + replica, high * across + replica, won, played)


_of_games = lru_cache(maxsize=8)(partial(fixed_length_chart, scale=_SCALE))


def _joined(
    state: tuple[Ints, Floats, Floats], keys: Ints, won: Floats, played: Floats
) -> tuple[Ints, Floats, Floats]:
    """Return sums by key with more values added; the keys stay sorted."""
    old, old_won, old_played = state
    new, place = np.unique(keys, return_inverse=True)
    won = np.bincount(place, won, len(new)).astype(float)
    played = np.bincount(place, played, len(new)).astype(float)
    at = np.searchsorted(old, new)
    known = at < len(old)
    known[known] = old[at[known]] == new[known]
    old_won[at[known]] += won[known]
    old_played[at[known]] += played[known]
    into, lacks = at[~known], ~known
    return (
        np.insert(old, into, new[lacks]),
        np.insert(old_won, into, won[lacks]),
        np.insert(old_played, into, played[lacks]),
    )


def _pull(games: _Games, at: Floats, start: Floats, counted: Floats) -> tuple[Floats, Floats]:
    """Return the gradient of the log-likelihood by player, and the curvature of each pair."""
    p = expit(at[games.low] - at[games.high])
    left = games.won - games.played * p
    slope = np.bincount(games.low, left, at.size) - np.bincount(games.high, left, at.size)
    return slope + counted * (0.5 - expit(at - start)), games.played * p * (1.0 - p)


def _of_start(at: Floats, start: Floats, counted: Floats) -> Floats:
    p = expit(at - start)
    return counted * p * (1.0 - p)


def _fitted(
    games: _Games, start: Floats, counted: Floats, at: Floats, shape: tuple[int, ...]
) -> Floats:
    """Return the maximum, in log-odds, by Newton's method starting from `at`."""
    for _ in range(_STEPS):
        slope, curvature = _pull(games, at, start, counted)
        held = _of_start(at, start, counted)
        step = _solved(games, curvature, held, slope, shape)
        longest = np.abs(step).max(initial=0.0)
        at = at + step * min(1.0, _LONGEST / max(longest, _LONGEST))
        if longest < _ENOUGH:
            return at
    raise AccuracyError("the ratings didn't settle within {steps} steps of the fit", steps=_STEPS)


def _solved(
    games: _Games, curvature: Floats, held: Floats, right: Floats, shape: tuple[int, ...]
) -> Floats:
    """Return the Newton step of all replicas: by dense solves, or by conjugate gradients."""
    low, high, size = games.low, games.high, right.size
    diagonal = held + np.bincount(low, curvature, size) + np.bincount(high, curvature, size)
    if size * shape[0] <= _DENSE:
        return _solved_densely(games, curvature, diagonal, right, shape[0])

    def image(of: Floats) -> Floats:
        force = curvature * (of[low] - of[high])
        return held * of + np.bincount(low, force, size) - np.bincount(high, force, size)

    def product(one: Floats, other: Floats) -> NDArray[Any]:
        return np.asarray((one * other).reshape(shape[0], -1).sum(axis=0))

    def spread(of_replicas: Any) -> Floats:
        return np.broadcast_to(of_replicas, (shape[0], len(of_replicas))).reshape(-1)

    step, residual = np.zeros(size), right.copy()
    direction = residual / diagonal
    square = product(residual, direction)
    # Newton's method mends what is left over, so a step need be no better than the next one.
    enough = 1e-6 * square + 1e-20
    for _ in range(10 * shape[0] + 10):
        if (square <= enough).all():
            break
        forward = image(direction)
        curved = product(direction, forward)
        length = spread(np.divide(square, curved, out=np.zeros_like(square), where=curved > 0.0))
        step += length * direction
        residual -= length * forward
        scaled = residual / diagonal
        before, square = square, product(residual, scaled)
        turn = np.divide(square, before, out=np.zeros_like(square), where=before > 0.0)
        direction = scaled + spread(turn) * direction
    return step


def _solved_densely(
    games: _Games, curvature: Floats, diagonal: Floats, right: Floats, players: int
) -> Floats:
    across = right.size // players
    (low, replica), (high, _) = np.divmod(games.low, across), np.divmod(games.high, across)
    matrix = np.zeros((across, players, players))
    matrix[replica, low, high] = matrix[replica, high, low] = -curvature
    own = np.arange(players)
    matrix[:, own, own] = diagonal.reshape(players, across).T
    steps = np.linalg.solve(matrix, right.reshape(players, across).T[..., None])[..., 0]
    return np.asarray(steps.T.reshape(-1), dtype=float)


def _alone(games: _Games, fit: Floats, start: Floats, counted: Floats, few: Any) -> Floats:
    """Return players with few games at their own maximum, against the others as fitted."""
    if not few.any():
        return fit
    concerned = few[games.low] | few[games.high]
    games = _Games(*(column[concerned] for column in games))
    at = fit.copy()
    for _ in range(_STEPS):
        slope, curvature = counted * (0.5 - expit(at - start)), _of_start(at, start, counted)
        of_low = expit(at[games.low] - fit[games.high])
        of_high = expit(at[games.high] - fit[games.low])
        for who, won, p in (
            (games.low, games.won, of_low),
            (games.high, games.played - games.won, of_high),
        ):
            slope = slope + np.bincount(who, won - games.played * p, at.size)
            curvature = curvature + np.bincount(who, games.played * p * (1.0 - p), at.size)
        step = np.where(few, np.clip(slope / curvature, -_LONGEST, _LONGEST), 0.0)
        at = at + step
        if np.abs(step).max() < _ENOUGH:
            return at
    raise AccuracyError("the ratings didn't settle within {steps} steps of the fit", steps=_STEPS)
