"""Captains who submit the best lineup that the cap allows, for a simulated team league."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.league.contest import Doublings
from evenbreak.matches.win import race_win_probability
from evenbreak.teams.night import TeamNight
from evenbreak.teams.sealed import SealedLineUp, sealed
from evenbreak.teams.squad import Squad, caps_of

_Numbers = tuple[float, ...]


@dataclass(frozen=True, eq=False)
class SealedCaptains:
    """Captains who know only the published numbers and write their lineups unseen.

    Both submit a lineup from `sealed`, drawn from the mixture that no one can exploit; the pairs
    are random. The team that wins more matches wins the night. A team whose weakest lineup is over
    the cap plays that lineup.
    """

    sets: int
    cap: float | None = None
    _known: dict[Any, tuple[Sequence[SealedLineUp], ...]] = field(default_factory=dict, repr=False)

    def __call__(
        self, doublings: Doublings, ours: Floats, theirs: Floats, luck: Floats
    ) -> tuple[Ints, Ints]:
        """Return who plays for both teams, as places among the numbers of players present."""
        # Teams of the same numbers have the same lineups, whoever has them.
        orders = [np.argsort(side, kind="stable") for side in (ours, theirs)]
        sides = tuple(
            tuple(side[order].tolist()) for side, order in zip((ours, theirs), orders, strict=True)
        )
        key = doublings.system.name, sides
        if key not in self._known:
            self._known[key] = self._mixtures(doublings, sides[0], sides[1])
        drawn = (
            _drawn(line_ups, float(x)) for line_ups, x in zip(self._known[key], luck, strict=True)
        )
        mine, others = (order[places] for order, places in zip(orders, drawn, strict=True))
        return mine, others

    def _mixtures(
        self, doublings: Doublings, ours: _Numbers, theirs: _Numbers
    ) -> tuple[Sequence[SealedLineUp], ...]:
        system = doublings.system
        m, n = system.race(*np.meshgrid(ours, theirs, indexing="ij"))
        gap = doublings.skill(np.array(ours))[:, None] - doublings.skill(np.array(theirs))
        wins = race_win_probability(1.0 / (1.0 + 2.0**-gap), m, n)
        law = np.zeros((*gap.shape, 2, 3))
        law[..., 0, 2], law[..., 1, 0] = wins, 1.0 - wins
        mine, others = (self._squad(side, system.publishes == "levels") for side in (ours, theirs))
        night = sealed(TeamNight(mine, others, [law] * self.sets))
        return night.ours, night.theirs

    def _squad(self, side: _Numbers, capped: bool) -> Squad:
        """Return a team, with its numbers ascending, and the cap that it can keep."""
        cap = max(self.cap, sum(side[: self.sets])) if capped and self.cap is not None else None
        return Squad(tuple(map(str, range(len(side)))), caps_of(side, cap, None))


def _drawn(line_ups: Sequence[SealedLineUp], x: float) -> Ints:
    """Return the places in a lineup drawn from a mixture with a uniform number."""
    reached = np.cumsum([line_up.mix for line_up in line_ups])
    chosen = line_ups[min(int(np.searchsorted(reached, x)), len(line_ups) - 1)]
    return np.array([int(name) for name in chosen.names])
