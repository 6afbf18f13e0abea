"""Two squads that meet tonight, and what they play."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.handicaps.charts.race_of_pair import Fairest, Race
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.teams.night import TeamNight
from evenbreak.teams.set_laws import Count, set_laws
from evenbreak.teams.squad import Squad

SEALED = "sealed"
"""The order in which both line-ups are handed in before the night."""


@dataclass(frozen=True, eq=False)
class Meeting:
    """Two squads that meet tonight, and what they play.

    Parameters
    ----------
    ours, theirs
        the rosters, with a rating for everybody.
    squads
        the same players with their caps.
    race
        what is played in each set.
    scale
        the scale of the ratings.
    sizes
        the players a side in each set.
    order
        who names first, or `SEALED`.
    count
        what decides the night.
    """

    ours: Roster
    theirs: Roster
    squads: tuple[Squad, Squad]
    race: Race
    scale: Scale
    sizes: tuple[int, ...]
    order: str
    count: Count = "sets"

    def night(self, order: str | None = None) -> TeamNight:
        """Return the night as a game, in another order if one is given."""
        asked = self.order if order is None else order
        return TeamNight(
            *self.squads,
            self.laws(),
            sizes=self.sizes,
            order="blind" if asked == SEALED else asked,
        )

    def laws(self, *skills: Floats) -> list[Floats]:
        """Return what each set can bring, if the players have these skills."""
        made = {
            size: set_laws(
                self.ours,
                self.theirs,
                self.race,
                scale=self.scale,
                count=self.count,
                size=size,
                skills=(skills[0], skills[1]) if skills else None,
            )
            for size in set(self.sizes)
        }
        return [made[size] for size in self.sizes]

    @property
    def uncertain(self) -> bool:
        """Whether a rating has a standard error."""
        return any(np.nan_to_num(side.standard_error).any() for side in (self.ours, self.theirs))


def race_words(race: Race) -> str:
    """Return what is played in a set.

    >>> race_words(5), race_words(Fairest(7))
    ('races to 5', 'the fairest races to 7')
    """
    if isinstance(race, Fairest):
        return f"the fairest races to {race.race_to}"
    return f"races to {race}" if isinstance(race, int) else f"races by {race.name}"


def cost_words(cost: float) -> str:
    """Return a difference of chances.

    >>> cost_words(0.041), cost_words(0.0)
    ('4.1%', '')
    """
    return f"{100.0 * cost:.1f}%" if cost >= 5e-4 else ""
