"""Title odds: the chance of each place for each player, from any point of a tournament.

Who is in each slot is a random variable, and the matches tie these variables together. Processing
one match after another, and keeping only the joint distribution of the open slots, gives exact
odds. If that would take too many states, the first rounds are sampled, and the rest of each sample
is exact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import whole
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Place
from evenbreak.tournaments.brackets.standing import Results, Standing, standing
from evenbreak.tournaments.odds.chances import Chances, Wins, chances_of
from evenbreak.tournaments.odds.passes import conditional, forward_pass
from evenbreak.tournaments.odds.planning import MOST_STATES, exact_plan
from evenbreak.tournaments.odds.rematches import (
    Meeting,
    group_meetings,
    meetings_so_far,
    place_odds,
    plan_meetings,
    settled_ranks,
)
from evenbreak.tournaments.odds.sampled import sampled_odds

if TYPE_CHECKING:
    import pandas as pd

SAMPLES = 10_000
"""The number of samples if the first rounds are sampled."""

WALKOVERS = 0.047
"""The share of walkovers among real double-elimination matches (one city, 2017-2025)."""


@own_arrays
@dataclass(frozen=True, eq=False)
class PlaceOdds:
    """Who finishes where.

    Parameters
    ----------
    p_place
        P(each place), with a row for each player and a column for each of `bracket.places`.
    error
        the standard errors of `p_place`; zeros if it is exact.
    samples
        the number of samples behind the odds; 0 if they are exact.
    by_draw
        P(each player wins) for each draw of the ratings, one per column; None if none were drawn.
    """

    bracket: Bracket
    p_place: Floats
    error: Floats
    samples: int
    by_draw: Floats | None = field(default=None, kw_only=True)

    @property
    def exact(self) -> bool:
        """Whether the odds are exact rather than sampled."""
        return self.samples == 0

    @property
    def title(self) -> Floats:
        """P(each player wins the tournament)."""
        return self.place(Place(1, 1))

    def place(self, place: Place) -> Floats:
        """Return P(each player gets this place), for one of `bracket.places`."""
        return self.p_place[:, self.bracket.places.index(place)]

    def to_frame(self) -> pd.DataFrame:
        """Return P(each place) as a DataFrame: a row per player, a column per place.

        >>> from evenbreak.tournaments import single_elimination
        >>> title_odds(single_elimination(["Ann", "Bo", "Cy"]), np.full((3, 3), 0.5)).to_frame()
        place      1     2    3
        player
        Ann     0.50  0.50  0.0
        Bo      0.25  0.25  0.5
        Cy      0.25  0.25  0.5
        """
        import pandas as pd

        return pd.DataFrame(
            self.p_place,
            index=pd.Index(self.bracket.players, name="player"),
            columns=pd.Index([str(place) for place in self.bracket.places], name="place"),
        )

    def expected_prize(self, payouts: Sequence[float]) -> Floats:
        """Return each player's expected prize.

        Parameters
        ----------
        payouts
            the money for first place, second, ...; places that aren't played off share their money
            equally.
        """
        return self.p_place @ prizes(self.bracket, payouts)


@own_arrays
@dataclass(frozen=True, eq=False)
class TitleOdds(PlaceOdds):
    """Who finishes where, and who meets who.

    Parameters
    ----------
    meetings
        for each match, who meets who and how likely that is.

    The other parameters are as in `PlaceOdds`.
    """

    meetings: Mapping[str, Meeting]

    @property
    def p_second_final(self) -> float:
        """P(a second final is played); 0 if the bracket has none."""
        return self.meetings["F2"].played if "F2" in self.meetings else 0.0

    @property
    def matches_mean(self) -> float:
        """The expected number of matches, including those already played."""
        return float(sum(meeting.played for meeting in self.meetings.values()))

    def expected_meetings(self) -> Floats:
        """Return the expected number of meetings between every two players, a symmetric table."""
        count = len(self.bracket.players)
        table = np.zeros((count, count))
        for meeting in self.meetings.values():
            np.add.at(table, (meeting.first, meeting.second), meeting.probability)
        return table + table.T


def prizes(bracket: Bracket, payouts: Sequence[float]) -> Floats:
    """Return the prize for each of the bracket's places.

    >>> from evenbreak.tournaments import single_elimination
    >>> prizes(single_elimination(8), [50, 30, 15, 5])
    array([50., 30., 10.,  0.])
    """
    paid = np.zeros(len(bracket.players) + 1)
    given = np.asarray(payouts, dtype=float)
    if given.ndim != 1 or len(given) > len(bracket.players) or not np.isfinite(given).all():
        raise InputError(
            "{payouts} must be an amount for each paid place, at most {n_players} of "
            "them; you gave {value!r}",
            value=payouts,
            n_players=len(bracket.players),
        )
    paid[: len(given)] = given
    sums = np.concatenate([[0.0], np.cumsum(paid)])
    return np.array(
        [
            0.0
            if place.event
            else (sums[min(place.last, len(paid))] - sums[place.first - 1])
            / (place.last - place.first + 1)
            for place in bracket.places
        ]
    )


def title_odds(
    bracket: Bracket,
    win: Wins,
    *,
    results: Results | None = None,
    live: Mapping[str, float] | None = None,
    walkovers: float | Mapping[str, float] = 0.0,
    most_states: float = MOST_STATES,
    samples: int = SAMPLES,
    rng: np.random.Generator | None = None,
) -> TitleOdds:
    """Return each player's chances of each place.

    Parameters
    ----------
    win
        P(i beats j) for every two players, in the bracket's order: a table of shape (n, n), or
        a function of two names; or a mapping with one of these for each match, by match name,
        such as `pair_odds` returns.
    results
        the winner of each decided match. The result of a match whose players are not known yet is a
        what-if: the odds are conditional on it.
    live
        P(the player in slot 1 wins) for matches in play.
    walkovers
        the chance that a match is a walkover, equally likely either way: one number, or a mapping
        by match name; `WALKOVERS` is the value for real events.
    most_states
        the largest number of joint states in one match; beyond that, the first rounds are sampled.
    samples
        the number of samples in that case.
    rng
        the random number generator in that case; None: a generator with seed 0.

    Raises
    ------
    InputError
        if a chance or a result is invalid, or the what-if results can't all happen.

    Notes
    -----
    The method is variable elimination on a factor graph: R. Dechter (1999), "Bucket
    elimination: a unifying framework for reasoning", Artificial Intelligence 113. See
    docs/explanation/brackets.md.

    >>> from evenbreak.tournaments import double_elimination
    >>> strength = np.array([4.0, 3.0, 2.0, 1.0])
    >>> win = strength[:, None] / (strength[:, None] + strength)
    >>> odds = title_odds(double_elimination(["Ann", "Bo", "Cy", "Di"]), win)
    >>> odds.title.round(4), round(odds.p_second_final, 4)
    (array([0.5343, 0.3005, 0.1347, 0.0305]), 0.4694)
    >>> title_odds(odds.bracket, win, results={"W1.1": "Di"}).title.round(4)
    array([0.2016, 0.4399, 0.2214, 0.1371])
    """
    now = standing(bracket, results)
    chances = chances_of(now, win, live=live, walkovers=walkovers)
    return odds_now(
        now,
        chances,
        most_states=most_states,
        samples=whole(samples, "samples", at_least=100),
        rng=rng or np.random.default_rng(0),
    )


def odds_now(
    now: Standing,
    chances: Chances,
    *,
    most_states: float = MOST_STATES,
    samples: int = SAMPLES,
    rng: np.random.Generator | None = None,
) -> TitleOdds:
    """Return each player's chances of each place, from the current state on."""
    remaining = now.remaining
    plan = exact_plan(remaining, tuple(now.assumed.items()), most_states)
    if plan is None:
        return _sampled(now, chances, samples, rng or np.random.default_rng(0))
    through = forward_pass(plan, chances, keep=bool(now.assumed))
    if now.assumed:
        through = conditional(plan, chances, through)
    meetings = meetings_so_far(now) | group_meetings(remaining, chances)
    meetings |= plan_meetings(plan, through)
    p_place = place_odds(now.bracket, meetings, {**settled_ranks(now), **through.ranks})
    return TitleOdds(
        now.bracket, p_place, np.zeros_like(p_place), 0, _in_order(now.bracket, meetings)
    )


def _sampled(now: Standing, chances: Chances, samples: int, rng: np.random.Generator) -> TitleOdds:
    if now.assumed:
        raise InputError(
            "results has {assumed!r}, whose players aren't known yet; the odds of this "
            "bracket are sampled, so give only results of matches that can be played",
            assumed=next(iter(now.assumed)),
        )
    found = sampled_odds(now, chances, samples, rng)
    meetings: dict[str, Meeting] = meetings_so_far(now)
    certain = place_odds(now.bracket, meetings, settled_ranks(now))
    meetings |= found.meetings
    p_place = certain + found.p_place
    return TitleOdds(
        now.bracket, p_place, found.error, found.samples, _in_order(now.bracket, meetings)
    )


def _in_order(bracket: Bracket, meetings: Mapping[str, Meeting]) -> dict[str, Meeting]:
    return {match.name: meetings[match.name] for match in bracket.matches}
