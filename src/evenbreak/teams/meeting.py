"""Two squads that meet tonight, and what they play."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.teams.night import TeamNight, mirrored, order_of
from evenbreak.teams.pairs import SetRace, pairs_of
from evenbreak.teams.set_laws import Count, law_in_play, set_laws, set_lengths
from evenbreak.teams.squad import Squad

SEALED = "sealed"
"""The order in which both lineups are handed in before the night."""


@dataclass(frozen=True, eq=False)
class Meeting:
    """Two squads that meet tonight, and what they play.

    Everyone has a rating; `sizes` is the number of players per side in each set; `order` is who
    names first, or `SEALED`. `form` is the standard deviation of a game's log-odds from set to set;
    with `levels`, chances come from their strengths, not ratings.
    """

    ours: Roster
    theirs: Roster
    squads: tuple[Squad, Squad]
    race: SetRace
    scale: Scale
    sizes: tuple[int, ...]
    order: str
    count: Count = "sets"
    form: float = 0.0
    levels: LevelSkills | None = None

    def night(self, order: str | None = None) -> TeamNight:
        """Return the night as a game, with another order if one is given."""
        asked = self.order if order is None else order
        return TeamNight(
            *self.squads,
            self.laws(),
            sizes=self.sizes,
            order="blind" if asked == SEALED else order_of(asked, len(self.sizes), [SEALED]),
        )

    def laws(self, *skills: Floats) -> list[Floats]:
        """Return the possible results of each set if the players have these skills."""
        made = {
            size: set_laws(
                self.ours,
                self.theirs,
                self.race,
                scale=self.scale,
                count=self.count,
                size=size,
                skills=(skills[0], skills[1]) if skills else None,
                form=self.form,
                levels=self.levels,
            )
            for size in set(self.sizes)
        }
        return [made[size] for size in self.sizes]

    @cached_property
    def lengths(self) -> tuple[Floats, ...]:
        """The number of games in each set, by pick; see `set_lengths`."""
        made = {
            size: set_lengths(
                self.ours,
                self.theirs,
                self.race,
                scale=self.scale,
                size=size,
                form=self.form,
                levels=self.levels,
            )
            for size in set(self.sizes)
        }
        return tuple(made[size] for size in self.sizes)

    def needs(self, ours: Sequence[str], theirs: Sequence[str]) -> tuple[int, int]:
        """Return the games (or points) that our pick and theirs need against each other."""
        mine, others = _some(self.ours, ours), _some(self.theirs, theirs)
        found = pairs_of(mine, others, self.race, self.scale, size=len(mine), levels=self.levels)
        return int(found.needs_1[0, 0]), int(found.needs_2[0, 0])

    def law_in_play(
        self, ours: Sequence[str], theirs: Sequence[str], score: tuple[int, int] = (0, 0)
    ) -> Floats:
        """Return a set's possible results between two picks from a score; see `law_in_play`."""
        mine, others = _some(self.ours, ours), _some(self.theirs, theirs)
        return law_in_play(
            mine,
            others,
            self.race,
            score,
            scale=self.scale,
            count=self.count,
            form=self.form,
            levels=self.levels,
        )

    def mirrored(self) -> Meeting:
        """Return the same meeting from the other team's point of view.

        >>> from evenbreak.ratings import SCALES, Roster
        >>> us, them = Roster(["Ann"], [600]), Roster(["Cy"], [560])
        >>> squads = Squad(us.players), Squad(them.players)
        >>> meeting = Meeting(us, them, squads, 5, SCALES["fargo"], (1,), "home").mirrored()
        >>> meeting.ours.players, meeting.order
        (('Cy',), 'B')
        """
        order = self.order
        if order != SEALED:
            order = mirrored(order_of(order, len(self.sizes)))
        return replace(
            self, ours=self.theirs, theirs=self.ours, squads=self.squads[::-1], order=order
        )

    @property
    def uncertain(self) -> bool:
        """Whether any rating has a standard error."""
        return self.levels is None and any(
            np.nan_to_num(side.standard_error).any() for side in (self.ours, self.theirs)
        )


def _some(roster: Roster, names: Sequence[str]) -> Roster:
    places = [roster.position(name) for name in names]
    return Roster(
        names, roster.rating[places], roster.standard_error[places], level=roster.level[places]
    )
