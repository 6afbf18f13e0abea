"""Systems that move ratings match by match, by whole points: a scale, charts and a rule.

An update rule is a plain function from a match to the points that winner and loser move. What
such a rule does to a rating is a Markov chain, which `Ladder` follows.
"""

from __future__ import annotations

from collections.abc import Callable
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
    """A match as an update rule sees it, winner first.

    Parameters
    ----------
    rating
        the two ratings before the match; a rule may use only their difference.
    games
        games won; None where only the winner is known.
    race
        games needed; None where that is not known.
    played
        matches each had played before; None: an established player.
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
        what the system is called; `system_of` finds it by this name.
    scale
        what a difference of its ratings means.
    charts
        the names of the printed charts that set its races; may be empty.
    rule
        from a match to the whole points that winner and loser move.
    in_words
        the rule in words.
    own_chart
        the chart used if no other is named; None: the first of `charts`.
    asks
        what the rule must know about a match besides who won: 'games', 'race', both or nothing.
    conserving
        whether the winner gains what the loser loses, once both are established. The
        distribution of rating errors is then symmetric.
    newcomer_steps
        (matches, factor) for each stage of a newcomer: for that many matches a newcomer moves by
        an established player's points times the factor. Empty: newcomers move like everybody
        else.
    winner_never_falls
        whether nobody loses points by a match won.
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
        """Return by how many points the rule moves the winner and the loser of a match.

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
                "the rule of the system {name} returned {points!r}; let it return a pair, "
                "the whole points of the winner and of the loser, such as (1, -1)",
                name=self.name,
                points=points,
            )
        return int(points[0]), int(points[1])

    @property
    def chart(self) -> Chart | None:
        """The chart used if no other is named, if there is one."""
        return self.usual_chart() if self.charts or self.own_chart is not None else None

    def initial(self, entries: Entries) -> Floats:
        """Return the stated ratings; a player without one starts at the centre of the scale."""
        return np.where(np.isnan(entries.rating), self.scale.centre, entries.rating)

    def update(self, history: History) -> Floats:
        """Return the ratings after all moves of the last night.

        A newcomer's moves go by the matches played before each, in the order of the night.
        """
        night = history.tonight
        up_a, up_b = self._points(night)
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
        for row in range(len(night)):
            there = np.atleast_1d(night.played[row])
            for who, up in ((night.a, points[0]), (night.b, points[1])):
                place = np.atleast_1d(positions(who, ratings.shape)[row])[there]
                flat[place] += (
                    np.atleast_1d(up[row])[there] * factors[np.minimum(played[place], last)]
                )
                played[place] += 1
        return flat.reshape(ratings.shape)

    def _points(self, night: Matches) -> tuple[Ints, Ints]:
        """Return the whole points of player a and of player b in each match; established ones."""
        won, shape = night.won_a, night.a.shape
        columns = {
            "games": (night.score_a, night.score_b),
            "race": (night.race_a, night.race_b),
        }
        keys = [np.where(won, 1, -1) * (night.rating_a - night.rating_b)]
        for name in self.asks:
            a, b = columns[name]
            keys += [np.where(won, a, b), np.where(won, b, a)]
        table = np.stack([np.broadcast_to(key, shape).ravel() for key in keys], axis=1)
        if not table.size:
            return np.zeros(shape, dtype=np.int64), np.zeros(shape, dtype=np.int64)
        # Matches of one kind are moved alike: each kind is asked about once.
        _, first, kind = np.unique(_packed(table), return_index=True, return_inverse=True)
        points = np.array([self._points_of(table[place]) for place in first.tolist()])
        moved = points[kind.reshape(shape)]
        winner, loser = moved[..., 0], moved[..., 1]
        return np.where(won, winner, loser), np.where(won, loser, winner)

    def _points_of(self, kind: Any) -> tuple[int, int]:
        apart, *values = kind.tolist()
        stated = {
            name: (int(values[2 * k]), int(values[2 * k + 1])) for k, name in enumerate(self.asks)
        }
        return self.moves(PlayedMatch((apart, 0.0), stated.get("games"), stated.get("race")))

    @property
    def cycle(self) -> int:
        """After how many even matches a rating can be where it was: 2 if it moves up or down alike.

        Ratings that move a point either way are an even number of points off after one match and
        an odd number after the next, so shares of them swing from match to match. Their mean over
        a cycle does not.

        >>> from evenbreak.handicaps import system_of
        >>> [system_of(name).cycle for name in ("npl", "step 4", "step 2 1", "step 5 1")]
        [2, 2, 3, 6]
        """
        won, lost = self.moves(PlayedMatch((0.0, 0.0), (5, 4), (5, 5)))
        apart = won - lost
        return apart // gcd(won, apart) if apart > 0 else 1

    def usual_chart(self) -> Chart:
        """Return the chart used if no other is named.

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
            raise InputError("the system {name} has no chart of its own; give one", name=self.name)
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
"""No league moves a rating further in one match."""


def points_of(value: Any, name: str, *, at_least: int = 1) -> int:
    """Return the points by which a rule moves ratings, if they are whole and in range.

    >>> points_of(5000, "up")
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: up is 5000; give a whole number from 1 to 1000
    """
    return whole(value, name, at_least=at_least, at_most=_MOST_POINTS)


def _packed(table: Any) -> Any:
    """Return one number for each different row: sorting these is far faster than sorting rows."""
    packed = np.zeros(len(table), dtype=np.int64)
    for column in table.T:
        values, place = np.unique(column, return_inverse=True)
        packed = packed * len(values) + place.reshape(-1)
    return packed
