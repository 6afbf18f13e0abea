"""A roster: a league's players, their ratings, and the uncertainty of each rating."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Bools, Floats, Ints, array_values
from evenbreak.checks import column, names
from evenbreak.errors import InputError
from evenbreak.ratings.provisional import is_provisional
from evenbreak.ratings.scale import Scale, scale_of


def error_of_games(games: ArrayLike, scale: Scale | str | float, most: float) -> Floats:
    """Return the standard error, at most `most`, of a rating if only its games are known.

    A game between equals has the information p (1 - p) = 1/4 about the difference in log-odds, so n
    games against opponents whose ratings are known leave an error of 2 / sqrt(n): on the Fargo
    scale, on which 144 points are one unit of log-odds, 288.5 / sqrt(n) points. Until the games say
    more than that, the error is that for a new player.

    >>> error_of_games([0, 1, 12, 200], "fargo", 100.0).round(1)
    array([100. , 100. ,  83.3,  20.4])
    """
    played = np.maximum(np.asarray(games, dtype=float), 1.0)
    return np.asarray(np.minimum(most, 2.0 * scale_of(scale).points_per_log_odds / np.sqrt(played)))


NOT_STATED = -1
"""Number of games or matches of a player for whom the list does not state it."""


@array_values
@dataclass(frozen=True, eq=False, init=False)
class Roster:
    """A league's players and ratings, as read-only columns in list order.

    Parameters
    ----------
    players
        the names, each once.
    rating
        points, one for each player; NaN for a new player who has none yet.
    level
        the skill level, used by charts by skill level and by caps; NaN where not stated. If a list
        states only levels, the ratings are those levels.
    standard_error
        uncertainty of a rating, in points (one standard deviation); NaN where not stated. The error
        of a difference is computed as the root of the sum of two squares, so it should not include
        uncertainty that all ratings share: use `Ratings.quasi_error`.
    games
        the games that each rating rests on, 0 for a new player; `NOT_STATED` where the list does
        not say.
    component
        players linked by a chain of opponents share a number from 1 up, and only their ratings can
        be compared; 0 where not stated.
    matches
        the number of matches that each player has played, which some systems use to recognize
        newcomers; `NOT_STATED` where the list does not say.
    provisional
        whose rating is not ranked in the list; None: new players, and those whom `is_provisional`
        finds from their games.

    For any other column, None means that it is not stated for any player.

    Raises
    ------
    InputError
        if a name appears twice, the columns differ in length or hold something that is not a
        number, a rating is infinite, an error is negative or infinite, or games or matches are
        negative.

    >>> club = Roster(["Ann", "Bo"], [92.0, np.nan], games=[140, 0])
    >>> len(club), club.position("Bo"), club.standard_error
    (2, 1, array([nan, nan]))
    """

    players: tuple[str, ...]
    rating: Floats
    standard_error: Floats
    games: Ints
    component: Ints
    matches: Ints
    provisional: Bools
    level: Floats

    def __init__(
        self,
        players: Iterable[str],
        rating: ArrayLike,
        standard_error: ArrayLike | None = None,
        games: ArrayLike | None = None,
        *,
        component: ArrayLike | None = None,
        matches: ArrayLike | None = None,
        provisional: ArrayLike | None = None,
        level: ArrayLike | None = None,
    ) -> None:
        object.__setattr__(self, "players", names(players, "players"))
        many = len(self.players)
        for name, stated, kind, unstated in (
            ("rating", rating, np.float64, math.nan),
            ("standard_error", standard_error, np.float64, math.nan),
            ("games", games, np.int64, NOT_STATED),
            ("component", component, np.int64, 0),
            ("matches", matches, np.int64, NOT_STATED),
            ("level", level, np.float64, math.nan),
        ):
            values = np.full(many, unstated) if stated is None else stated
            object.__setattr__(self, name, column(values, name, many, "players", kind))
        if provisional is None:
            provisional = np.isnan(self.rating) | is_provisional(self.games)
        few = column(provisional, "provisional", many, "players", np.bool_)
        object.__setattr__(self, "provisional", few)
        if np.isinf(self.rating).any():
            raise InputError(
                "rating must have finite numbers, or NaN for a new player; one is infinite"
            )
        if (self.standard_error < 0).any() or np.isinf(self.standard_error).any():
            raise InputError("standard_error must be 0 or more; one value is negative or infinite")
        for name in ("games", "matches"):
            if (getattr(self, name) < NOT_STATED).any():
                raise InputError(
                    "{name} must be 0 or more, or NOT_STATED if unknown; one value is negative",
                    name=name,
                )

    def __len__(self) -> int:
        return len(self.players)

    def strongest_first(self, places: ArrayLike | None = None) -> Ints:
        """Return positions in list order: strongest first, with provisional ratings at the end.

        `places` are the positions to list; None: all. Equal ratings stay in their order.
        """
        chosen = np.arange(len(self)) if places is None else np.asarray(places)
        return chosen[np.lexsort((-self.rating[chosen], self.provisional[chosen]))]

    def position(self, player: str) -> int:
        """Return the position of a player in the list, counted from 0.

        Raises
        ------
        InputError
            if the roster has no such player.
        """
        try:
            return self._places[player]
        except KeyError:
            raise InputError(
                "player {player!r} isn't in the roster. Write the name as in the roster.",
                player=player,
            ) from None

    @cached_property
    def _places(self) -> dict[str, int]:
        return {name: place for place, name in enumerate(self.players)}

    def with_starters(
        self, rating: float, standard_error: float, scale: Scale | str | float
    ) -> Roster:
        """Return the roster with a rating for new players, and errors for ratings with known games.

        Parameters
        ----------
        rating
            the rating for every player without one, in points.
        standard_error
            the error for every player without a rating or games and without a stated error: the
            prior's standard deviation, in points. If games are stated but no error, the error
            follows from the number of games (`error_of_games`), and is never more than this. If the
            roster states the games of only some ratings, the other ratings may rest on none, so
            they get this error.
        scale
            of the ratings.

        Raises
        ------
        InputError
            if the rating is not finite, or the error is not a finite number from 0 on.

        >>> club = Roster(["Ann", "Bo"], [92.0, np.nan], [9.5, np.nan], [140, 0])
        >>> started = club.with_starters(80.0, 30.0, "npl")
        >>> started.rating, started.standard_error
        (array([92., 80.]), array([ 9.5, 30. ]))
        """
        if not math.isfinite(rating):
            raise InputError(
                "{rating} must be a finite number of points; you gave {value!r}", value=rating
            )
        if not 0.0 <= standard_error < math.inf:
            raise InputError(
                "{standard_error} must be 0 or more points; you gave {value!r}",
                value=standard_error,
            )
        unrated = np.isnan(self.rating)
        games = np.where(unrated, 0, self.games)
        open_error = np.isnan(self.standard_error)
        if (self.games[open_error & ~unrated] > 0).any():  # 0 alone only marks who is new
            games = np.maximum(games, 0)
        by_games = open_error & (games != NOT_STATED)
        return Roster(
            self.players,
            np.where(unrated, rating, self.rating),
            np.where(by_games, error_of_games(games, scale, standard_error), self.standard_error),
            self.games,
            component=self.component,
            matches=self.matches,
            provisional=self.provisional,
            level=self.level,
        )
