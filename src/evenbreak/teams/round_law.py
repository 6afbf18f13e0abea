"""The total of a round between two teams, and the head start that makes the round even.

Given the players' skills, the matches in a round are independent, so the distribution of the lead
is the convolution of theirs. Each match is a fixed number of single games, or a race in which every
game counts. If everyone meets everyone and ratings have errors, a player's error is the same in all
their matches, so the distribution is averaged over drawn skills.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from scipy.stats import binom
from scipy.stats.qmc import MultivariateNormalQMC

from evenbreak.arrays import Floats, array_values
from evenbreak.checks import number, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.gap import Gap, averaging_rule
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale, scale_of
from evenbreak.teams.pairs import SetRace, pairs_of
from evenbreak.teams.set_laws import Count, set_laws

_ALIKE = 1e-12  # chances that differ by less are equal
_DRAWS = 512  # of the skills, where everybody meets everybody; they leave an error of about .001


class Outcome(NamedTuple):
    """The outcome of a round: P(we win), P(tie), P(they win)."""

    win: float
    tie: float
    lose: float

    @property
    def unfair(self) -> float:
        """How far the round is from even: the difference between P(win) and P(lose)."""
        return abs(self.win - self.lose)


@array_values
@dataclass(frozen=True)
class RoundLaw:
    """Distribution of our lead at the end of a round, in games.

    Parameters
    ----------
    lead
        P(we lead by k - reach games), for k = 0, 1, ..., 2 reach.
    """

    lead: Floats

    @property
    def reach(self) -> int:
        """The largest lead."""
        return len(self.lead) // 2

    @cached_property
    def mean(self) -> float:
        """Our mean lead."""
        return float(self.lead @ np.arange(-self.reach, self.reach + 1))

    def with_start(self, start: float) -> Outcome:
        """Return the outcome of the round if we start with this many games (negative: they do).

        A start with half a game leaves no ties.

        >>> RoundLaw(np.array([0.25, 0.0, 0.5, 0.0, 0.25])).with_start(1)
        Outcome(win=0.75, tie=0.0, lose=0.25)
        """
        start = number(start, "start")
        leads = np.arange(-self.reach, self.reach + 1) + start
        return Outcome(
            float(self.lead[leads > 0].sum()),
            float(self.lead[leads == 0].sum()),
            float(self.lead[leads < 0].sum()),
        )

    @cached_property
    def fair_start(self) -> int:
        """The start in whole games that makes the round closest to even; the smallest in a tie.

        >>> RoundLaw(np.array([0.6, 0.0, 0.3, 0.0, 0.1])).fair_start
        1
        """
        starts = sorted(range(-self.reach - 1, self.reach + 2), key=abs)
        unfair = [self.with_start(start).unfair for start in starts]
        least = min(unfair) + _ALIKE
        return next(start for start, off in zip(starts, unfair, strict=True) if off <= least)


def round_law(
    ours: Roster,
    theirs: Roster,
    *,
    games: int | None = None,
    race: SetRace | None = None,
    everybody: bool = False,
    count: Count = "games",
    scale: Scale | str | float = "fargo",
    form: float = 0.0,
    levels: LevelSkills | None = None,
) -> RoundLaw:
    """Return the distribution of our lead, in games or as they count, at the end of a round.

    Parameters
    ----------
    ours, theirs
        the two teams with their ratings. If they state standard errors, the chances of each match
        are averaged over the uncertainty of the ratings.
    games, race
        the format of each match, exactly one of the two: a number of single games, or a race in
        which all games count.
    everybody
        whether each of our players meets each of theirs; else the first meets the first, and so on.
    count
        what is added up over a race.
    form
        how much the log-odds of a game vary from match to match (standard deviation).
    levels
        the strength of skill levels, if the chances come from levels.

    Raises
    ------
    InputError
        if a player has no rating, the teams have different sizes but meet one to one, or not
        exactly one of `games` and `race` is given.

    >>> law = round_law(Roster(["Ann"], [500]), Roster(["Bo"], [600]), games=2)
    >>> law.lead.round(4), law.fair_start
    (array([0.4444, 0.    , 0.4444, 0.    , 0.1111]), 1)
    """
    if (games is None) == (race is None):
        raise InputError("give either games or race, not both")
    if not everybody and len(ours) != len(theirs):
        raise InputError(
            "one team has {n_ours} players and the other has {n_theirs}. Leave out those who "
            "don't play, or let everyone play everyone.",
            n_ours=len(ours),
            n_theirs=len(theirs),
        )
    scale = scale_of(scale)
    if race is None:
        whole(games, "games", at_least=1)
    errors = np.nan_to_num(np.concatenate([ours.standard_error, theirs.standard_error]))
    met = [(i, j) for i in range(len(ours)) for j in range(len(theirs)) if everybody or i == j]

    def law(skills: tuple[Floats, Floats] | None) -> Floats:
        if race is None:
            laws = _single_games(ours, theirs, int(games or 1), scale, skills, form, levels)
        else:
            asked: Any = {"scale": scale, "skills": skills, "form": form, "levels": levels}
            found = set_laws(ours, theirs, race, count=count, **asked)
            laws = found.sum(axis=2)
        lead = np.ones(1)
        for pair in met:
            lead = np.convolve(lead, laws[pair])
        return lead

    if levels is not None or not (everybody and errors.any()):
        return RoundLaw(law(None))
    ratings = np.concatenate([ours.rating, theirs.rating])
    drawn = MultivariateNormalQMC(ratings, np.diag(errors**2), rng=0).random(_DRAWS)
    split = len(ours)
    return RoundLaw(np.mean([law((one[:split], one[split:])) for one in drawn], axis=0))


def _single_games(
    ours: Roster,
    theirs: Roster,
    games: int,
    scale: Scale,
    skills: tuple[Floats, Floats] | None,
    form: float,
    levels: LevelSkills | None,
) -> Floats:
    """Return the distribution of the lead after single games: shape (ours, theirs, 2 games + 1)."""
    pairs = pairs_of(ours, theirs, 1, scale, levels=levels)
    points, errors = pairs.points, pairs.errors
    if skills is not None:
        points, errors = skills[0][:, None] - skills[1], np.zeros(points.shape)
    points, errors = Gap(points, errors, scale, form).normal
    nodes, weights = averaging_rule(float(errors.max()), games, scale)
    p = scale.win_probability(points + nodes[:, None, None] * errors)
    law = np.zeros((*points.shape, 2 * games + 1))
    for won in range(games + 1):
        law[..., 2 * won] = np.tensordot(weights, binom.pmf(won, games, p), axes=1)
    return law


def known_starts(law: RoundLaw, *others: int) -> Sequence[int]:
    """Return the starts worth listing: none, up to one beyond the fair one, and others."""
    sign = 1 if law.fair_start >= 0 else -1
    listed = {sign * k for k in range(abs(law.fair_start) + 2)} | set(others)
    return sorted(listed, key=lambda start: sign * start)
