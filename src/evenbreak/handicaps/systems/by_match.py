"""Systems that move ratings match by match, by whole points: a scale, charts and a rule.

An update rule is a plain function from a match to the points that winner and loser move. Under such
a rule, a rating is a Markov chain, which `Ladder` follows.
"""

from __future__ import annotations

from collections.abc import Callable, MutableMapping, Sequence
from dataclasses import dataclass, field
from math import gcd
from numbers import Integral
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart, chart
from evenbreak.handicaps.systems.history import Entries, History, Matches, positions
from evenbreak.handicaps.systems.system import System
from evenbreak.ratings.scale import Scale


class PlayedMatch(NamedTuple):
    """A match as an update rule sees it; the winner comes first.

    Parameters
    ----------
    rating
        ratings before the match; a rule may use only their difference.
    games
        games won; None if only the winner is known.
    race
        games needed; None if unknown.
    played
        number of earlier matches; None: an established player.
    """

    rating: tuple[float, float]
    games: tuple[int, int] | None
    race: tuple[int, int] | None
    played: tuple[int | None, int | None] = (None, None)


UpdateRule = Callable[[PlayedMatch], tuple[int, int]]


@dataclass(frozen=True)
class StepSystem(System):
    """A handicap system that moves ratings match by match, by whole points.

    Parameters
    ----------
    name
        the name of the system; `system_of` finds it by this name.
    scale
        the scale of its ratings.
    charts
        the names of the printed charts that set its races; may be empty.
    rule
        function from a match to the whole points that winner and loser move.
    own_chart
        the chart used if no other is named; None: the first of `charts`.
    asks
        what the rule needs to know about a match besides its winner: 'games', 'race', both or
        nothing.
    conserving
        whether the winner gains what the loser loses, once both are established. If so, the
        distribution of rating errors is symmetric.
    newcomer_steps
        (matches, factor) for each stage of a newcomer: for that many matches a newcomer moves by
        an established player's points times the factor. Empty: newcomers move like everyone
        else.
    winner_never_falls
        whether winning a match never costs points.
    """

    name: str
    scale: Scale = field()
    charts: tuple[str, ...]
    rule: UpdateRule
    in_words: str = field()
    own_chart: Chart | None = None
    asks: tuple[str, ...] = ()
    conserving: bool = True
    newcomer_steps: tuple[tuple[int, int], ...] = ()
    winner_never_falls: bool = True

    def moves(self, match: PlayedMatch) -> tuple[int, int]:
        """Return how many points the rule moves the winner and the loser of a match.

        Raises
        ------
        InputError
            if the rule does not return a pair of whole points.

        >>> from evenbreak.handicaps import system_of
        >>> system_of("step 2 1").moves(PlayedMatch((80, 75), (5, 3), (5, 5)))
        (2, -1)
        """
        points: Any = self.rule(match)
        pair = isinstance(points, tuple | list) and len(points) == 2
        if not pair or not all(isinstance(point, Integral) for point in points):
            raise InputError(
                "the rule of the system {name} returned {points!r}. It must return a pair of "
                "whole numbers, the winner's points and the loser's, such as (1, -1).",
                name=self.name,
                points=points,
            )
        return int(points[0]), int(points[1])

    @property
    def chart(self) -> Chart | None:
        """The default chart, if there is one."""
        return self.usual_chart() if self.charts or self.own_chart is not None else None

    def initial(self, entries: Entries) -> Floats:
        """Return the stated ratings; a player without one starts at the center of the scale."""
        return np.where(np.isnan(entries.rating), self.scale.center, entries.rating)

    def update(self, history: History) -> Floats:
        """Return the ratings after all moves of the last night.

        A newcomer's moves depend on the number of earlier matches, in the order of the night.
        """
        night = history.tonight
        up_a, up_b = self._points(night, history.kept)
        ratings = np.array(history.ratings, dtype=float)
        if not self.newcomer_steps:
            for who, points in ((night.a, up_a), (night.b, up_b)):
                place = positions(who, ratings.shape).ravel()
                moved = np.where(night.played, points, 0).ravel()
                ratings += np.bincount(place, moved, ratings.size).reshape(ratings.shape)
            return ratings
        return self._with_newcomers(history, ratings, (up_a, up_b))

    def _with_newcomers(
        self, history: History, ratings: Floats, points: tuple[Ints, Ints]
    ) -> Floats:
        night = history.tonight
        last = sum(matches for matches, _ in self.newcomer_steps)
        steps = [factor for matches, factor in self.newcomer_steps for _ in range(matches)]
        factors = np.array([*steps, 1])
        flat, played = ratings.reshape(-1), history.matches_before.reshape(-1)
        places = [positions(who, ratings.shape)[night.played] for who in (night.a, night.b)]
        if np.bincount(np.concatenate(places)).max(initial=0) <= 1:  # a match a player
            for place, up in zip(places, points, strict=True):
                flat[place] += up[night.played] * factors[np.minimum(played[place], last)]
            return flat.reshape(ratings.shape)
        for row in range(len(night)):
            there = np.atleast_1d(night.played[row])
            for who, up in ((night.a, points[0]), (night.b, points[1])):
                place = np.atleast_1d(positions(who, ratings.shape)[row])[there]
                flat[place] += (
                    np.atleast_1d(up[row])[there] * factors[np.minimum(played[place], last)]
                )
                played[place] += 1
        return flat.reshape(ratings.shape)

    def _points(self, night: Matches, kept: MutableMapping[str, Any]) -> tuple[Ints, Ints]:
        """Return the whole points of players a and b in each match, if both are established."""
        won = night.won_a
        columns = {
            "games": (night.score_a, night.score_b),
            "race": (night.race_a, night.race_b),
        }
        keys = [np.where(won, 1, -1) * (night.rating_a - night.rating_b)]
        for name in self.asks:
            a, b = columns[name]
            keys += [np.where(won, a, b), np.where(won, b, a)]
        if not won.size:
            return np.zeros(won.shape, dtype=np.int64), np.zeros(won.shape, dtype=np.int64)
        known = kept.setdefault("points", _KnownPoints(self._points_of))
        winner, loser = known(keys)
        return np.where(won, winner, loser), np.where(won, loser, winner)

    def _points_of(self, kind: Sequence[float]) -> tuple[int, int]:
        apart, *values = kind
        stated = {
            name: (int(values[2 * k]), int(values[2 * k + 1])) for k, name in enumerate(self.asks)
        }
        return self.moves(PlayedMatch((apart, 0.0), stated.get("games"), stated.get("race")))

    @property
    def cycle(self) -> int:
        """Number of even matches after which a rating can return: 2 if moves up and down are equal.

        Ratings that move a point either way are an even number of points off after one match and
        an odd number after the next, so their frequencies swing from match to match. Their mean
        over a cycle does not.

        >>> from evenbreak.handicaps import system_of
        >>> [system_of(name).cycle for name in ("npl", "step 4", "step 2 1", "step 5 1")]
        [2, 2, 3, 6]
        """
        won, lost = self.moves(PlayedMatch((0.0, 0.0), (5, 4), (5, 5)))
        apart = won - lost
        return apart // gcd(won, apart) if apart > 0 else 1

    def usual_chart(self) -> Chart:
        """Return the default chart.

        Raises
        ------
        InputError
            if the system has no chart of its own.

        >>> from evenbreak.handicaps import system_of
        >>> system_of("npl").usual_chart().name
        'npl_10'
        """
        if self.own_chart is not None:
            return self.own_chart
        if not self.charts:
            raise InputError("the system {name} has no chart of its own. Give one.", name=self.name)
        return chart(self.charts[0])

    def known_charts(self) -> tuple[Chart, ...]:
        """Return the printed charts of the system, and its own if that is not one of them.

        >>> from evenbreak.handicaps import system_of
        >>> [chart.name for chart in system_of("fixed 9").known_charts()]
        ['fixed_9']
        """
        printed = tuple(chart(name) for name in self.charts)
        own = self.own_chart
        return printed if own is None or own in printed else (*printed, own)


_MOST_POINTS = 1000
"""Limit on a rating's move in one match, beyond any league's rule."""


def points_of(value: Any, name: str, *, at_least: int = 1) -> int:
    """Return the points by which a rule moves ratings, if they are whole and in range.

    >>> points_of(5000, "up")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: up must be a whole number from 1 to 1000; you gave 5000
    """
    return whole(value, name, at_least=at_least, at_most=_MOST_POINTS)


_ROOM = 256
"""The most kinds of matches that a table has room for, per match in a night."""

_UNKNOWN = np.iinfo(np.int32).min


class _KnownPoints:
    """Table of the points for each kind of match, so that a rule is called once for each kind."""

    def __init__(self, ask: Callable[[Sequence[float]], tuple[int, int]]) -> None:
        self.ask = ask
        self.low: Any = None
        self.size: Any = None
        self.points = np.zeros((2, 0), dtype=np.int32)

    def __call__(self, keys: Sequence[Any]) -> tuple[Ints, Ints]:
        """Return the points of winners and losers, from the columns that define a kind."""
        columns = [np.asarray(key).astype(np.int64) for key in keys]
        if (columns[0] != keys[0]).any():  # ratings between whole points
            rows = np.stack([np.ravel(key) for key in keys], axis=1)
            kinds, kind = np.unique(rows, axis=0, return_inverse=True)
            points = self._asked(kinds)[:, kind.reshape(np.shape(keys[0]))]
            return points[0], points[1]
        low, high = (np.array([end(column) for column in columns]) for end in (np.min, np.max))
        if self.low is None or (low < self.low).any() or (high >= self.low + self.size).any():
            self._widen(low, high)
        code = columns[0] - self.low[0]
        for column, least, size in zip(columns[1:], self.low[1:], self.size[1:], strict=True):
            code = code * size + (column - least)
        if self.size.prod() > _ROOM * code.size:
            kinds, kind = np.unique(code, return_inverse=True)
            points = self._asked(self._kinds(kinds))[:, kind.reshape(code.shape)]
            return points[0], points[1]
        if not self.points.size:
            self.points = np.full((2, self.size.prod()), _UNKNOWN, dtype=np.int32)
        winner = self.points[0].take(code)
        lacks = winner == _UNKNOWN
        if lacks.any():
            new = np.unique(code[lacks])
            self.points[:, new] = self._asked(self._kinds(new))
            winner = self.points[0].take(code)
        return winner, self.points[1].take(code)

    def _kinds(self, codes: Ints) -> Ints:
        return np.asarray(np.stack(np.unravel_index(codes, self.size), axis=1) + self.low)

    def _asked(self, kinds: Any) -> Ints:
        return np.array([self.ask(kind) for kind in kinds.tolist()]).T

    def _widen(self, low: Ints, high: Ints) -> None:
        """Make room for more kinds, with some to spare; known ones are evaluated again."""
        if self.low is not None:
            low, high = np.minimum(low, self.low), np.maximum(high, self.low + self.size - 1)
        spare = (high - low) // 4 + 1
        self.low, self.size = low - spare, high - low + 1 + 2 * spare
        self.points = self.points[:, :0]
