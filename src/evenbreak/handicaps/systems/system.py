"""What a handicap system is: a scale, the charts by which it is played, and how ratings move.

An update rule is a plain function from a match to the points that winner and loser move.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from evenbreak.errors import InputError
from evenbreak.handicaps.chart import Chart, chart
from evenbreak.ratings.scale import Scale

__all__ = ["PlayedMatch", "System", "UpdateRule"]


class PlayedMatch(NamedTuple):
    """A match as an update rule sees it, winner first.

    Parameters
    ----------
    rating
        the two ratings before the match; a rule reads no more from them than how far they are
        apart.
    games
        games won; None where only the winner is known.
    race
        games needed; None where that is not known.
    played
        matches that each had played before; None: an established player.
    """

    rating: tuple[float, float]
    games: tuple[int, int] | None
    race: tuple[int, int] | None
    played: tuple[int | None, int | None] = (None, None)


UpdateRule = Callable[[PlayedMatch], tuple[int, int]]


@dataclass(frozen=True)
class System:
    """A handicap system.

    Parameters
    ----------
    name
        what the system is called; `system_of` finds it by that.
    scale
        what a difference of its ratings means.
    charts
        the names of the printed charts by which it is played; empty where there are none.
    rule
        from a match to the points that winner and loser move, in whole points.
    in_words
        the rule, for a person.
    own_chart
        the chart by which it is played where nobody names one; None: the first of `charts`.
    asks
        what the rule must know of a match besides who won: 'games', 'race', both or nothing.
    conserving
        whether the winner gains what the loser loses, once both are established. A player's
        rating error then has a law that is the same when turned upside down.
    newcomer_steps
        (matches, factor) for each stage of a newcomer: in so many matches his moves are the
        established player's times the factor. Empty: newcomers move like all others.
    """

    name: str
    scale: Scale
    charts: tuple[str, ...]
    rule: UpdateRule
    in_words: str
    own_chart: Chart | None = None
    asks: tuple[str, ...] = ()
    conserving: bool = True
    newcomer_steps: tuple[tuple[int, int], ...] = ()

    def usual_chart(self) -> Chart:
        """Return the chart by which the system is played where nobody names one.

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
            raise InputError(f"chart is not given, and the system {self.name} has none; give one")
        return chart(self.charts[0])
