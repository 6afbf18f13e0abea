"""A season: its players, its system, who meets whom in which week, and its length."""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats, Ints, array_values
from evenbreak.checks import one_of, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.systems.by_match import StepSystem
from evenbreak.handicaps.systems.catalog import steps_of
from evenbreak.handicaps.systems.match_table import MatchTable, match_table
from evenbreak.league.lookup import Lookup, lookup_of
from evenbreak.league.players import LeaguePlayers
from evenbreak.league.schedule import FixedSchedule, RandomPairing, RoundRobin

_DOUBLINGS = 3.0
"""Narrowest table of races and moves: up to where the odds of a game are 8 to 1."""

_SDS = 5.0
"""A league's skills are assumed to lie within this many standard deviations."""


@dataclass(frozen=True, eq=False)
class Season:
    """A season to be simulated.

    In each week a player's skill of the day is the true skill plus the form of that day, in whole
    points, and holds for all of the player's matches. The ratings before the week set its races,
    and all moves are added at its end, as `evenbreak.handicaps.apply_results` does for a night.
    Then skills drift.

    Parameters
    ----------
    system
        the handicap system, or its name.
    chart
        the chart that sets the races, or its name; None: the system's own.
    schedule
        who meets whom; None: a repeated round robin.
    play
        'matches': the winner of each match is drawn with the exact chance. 'racks': the match is
        played rack by rack, which also gives final scores. Both have the same distribution.

    Raises
    ------
    InputError
        if a parameter has an invalid value.

    >>> season = Season(LeaguePlayers.of([92, 80, 71, 64]), "npl", "npl_10", weeks=12)
    >>> season.chart.name, season.schedule
    ('npl_10', RoundRobin(players=4, matches_a_week=1))
    """

    players: LeaguePlayers
    system: Any
    chart: Any = None
    schedule: Any = None
    weeks: int = 30
    play: str = "matches"

    def __post_init__(self) -> None:
        if not isinstance(self.players, LeaguePlayers):
            raise InputError(
                "{players} must be LeaguePlayers; you gave {value!r}", value=self.players
            )
        put = object.__setattr__
        if not isinstance(self.system, StepSystem):
            put(self, "system", steps_of(self.system))
        if self.chart is None:
            put(self, "chart", self.system.usual_chart())
        else:
            put(self, "chart", chart_of(self.chart))
        if self.schedule is None:
            put(self, "schedule", RoundRobin(len(self.players)))
        put(self, "weeks", whole(self.weeks, "weeks", at_least=1))
        put(self, "play", one_of(self.play, "play", ("matches", "racks")))
        _check_schedule(self.schedule, len(self.players))

    @cached_property
    def table(self) -> MatchTable:
        """The races, moves and chances in the season's matches."""
        doubling = self.system.scale.points_per_doubling
        least = max(self.chart.rows[-1].difference_from, round(_DOUBLINGS * doubling))
        # If no two ratings are further apart than the table is wide, none need be clipped.
        spread = int(self.players.rating.max() - self.players.rating.min()) + round(doubling)
        return match_table(self.system, self.chart, widest=max(least, min(spread, 2 * least)))

    @cached_property
    def lookup(self) -> Lookup:
        """The same as flat integer tables, for fast draws."""
        return lookup_of(self.table, self.widest_gap)

    @cached_property
    def widest_gap(self) -> int:
        """The largest difference of two skills of the day, five standard deviations included."""
        players = self.players
        around = _SDS * np.hypot(players.skill_sd, players.day_sd)
        drifted = players.drift * (self.weeks - 1)
        high = players.skill + np.maximum(drifted, 0.0) + around
        low = players.skill + np.minimum(drifted, 0.0) - around
        # One point more, since drift is added up in another order.
        return int(np.rint(high.max()) - np.rint(low.min())) + 1

    @cached_property
    def longest_move(self) -> int:
        """The most points that a match may move a rating."""
        steps = self.system.newcomer_steps
        anybody_new = (self.players.played < sum(matches for matches, _ in steps)).any()
        factors = [factor for _, factor in steps] if anybody_new else []
        return int(np.abs(self.table.moves).max()) * max(factors, default=1)

    @cached_property
    def fifths(self) -> Ints:
        """Each player's fifth by skill at the start, 0 being the weakest; one column."""
        return fifths_of(self.players.skill[:, None])

    def __reduce__(self) -> Any:
        # Tables are not sent: they are larger than what they are made from.
        arguments = (self.players, self.system, self.chart, self.schedule, self.weeks, self.play)
        return Season, arguments


def _check_schedule(schedule: Any, players: int) -> None:
    """Check before the first week for anything that would stop the season in a later week."""
    if isinstance(schedule, RandomPairing):
        return
    if isinstance(schedule, RoundRobin | FixedSchedule):
        schedule.pairs(1, np.random.default_rng(0), players)
    elif not hasattr(schedule, "pairs"):
        raise InputError(
            "{schedule} must be RoundRobin, RandomPairing or FixedSchedule; you gave {value!r}",
            value=schedule,
        )


# What is kept of simulated seasons: counts, which can be added up across workers.


WEEK_COLUMNS = ("players", "error", "error_squared", "near")
"""The quantities summed for each week."""

FIFTHS = 5
"""Groups of players by true skill, weakest first."""


@array_values
@dataclass(frozen=True, eq=False)
class Tally:
    """Results of a season's replicas; two tallies of the same season are added with `+`.

    All counts are integers, so sums of tallies do not depend on how they are grouped; data kept by
    batch keeps the order in which tallies are added.

    The replicas of a batch share the random pairings, and each batch draws its own. So batches are
    independent, but replicas in the same batch are not, and standard errors come from the variation
    of sums between batches.

    Parameters
    ----------
    replicas
        seasons counted in each batch, shape (batches,).
    matches, wins, wins_squared
        for each player, summed over the replicas: matches played, matches won, and the square of
        the number won in a season; shape (players,).
    rating, rating_squared
        for each player, summed over the replicas: the change in rating over the season, in points,
        and its square.
    games
        games that each player won, summed over the replicas; None if matches are not played
        rack by rack.
    products
        for each player, summed over the batches: wins by wins, wins by matches, matches by matches,
        moved by moved, wins by replicas and moved by replicas, each of two sums over the replicas
        of a batch (moved is `rating` of a batch); shape (players, 6). None in a league so large
        that a batch is one replica.
    wins_counts
        the number of replicas in which each player won 0, 1, 2, ... matches: shape (players, most +
        1). None if it would be large.
    rating_counts
        the number of replicas in which each player's rating moved by -most, ..., most points: shape
        (players, 2 * most + 1); moves beyond four doublings are counted at the ends. None if it
        would be large.
    errors
        how many players had each rating error (rating minus true skill, rounded to whole points) at
        the start and after each week, including its drift: shape (weeks + 1, 2 * widest + 1), from
        -widest to widest; larger errors are counted at the ends.
    gap_width
        points of a bin of `gaps`.
    gaps
        shape (batches, bins, 5), for matches in which the skills of the day lie
        [k * gap_width, (k + 1) * gap_width) points apart, k the bin: matches, those that the
        stronger player won (half of them if the two are equal), hill-hill, shutouts (the loser won
        no game), and games in all. If matches are not played rack by rack, the last three are
        means given the two ratings and skills of each match, not drawn.
    weeks
        shape (batches, weeks + 1, 4), the columns of `WEEK_COLUMNS`: players in the league, the
        sums of their rating errors (as in `errors`) and of the squares of these, and how many of
        them are `near` their skill.
    fifths
        shape (batches, 5, 2): matches and wins by fifth of true skill at the start.

    >>> from evenbreak.league import LeaguePlayers, Season, run_chunk
    >>> season = Season(LeaguePlayers.of([60, 50], skill=[50, 50]), "npl", weeks=100)
    >>> one, two = (run_chunk(season, 50, seed) for seed in np.random.SeedSequence(1).spawn(2))
    >>> both = one + two
    >>> both.replicas, both.matches, both.weeks.shape
    (array([50, 50]), array([10000, 10000]), (2, 101, 4))
    """

    replicas: Ints
    matches: Ints
    wins: Ints
    wins_squared: Ints
    rating: Ints
    rating_squared: Ints
    games: Ints | None
    products: Ints | None
    wins_counts: Ints | None
    rating_counts: Ints | None
    errors: Ints
    gap_width: int
    gaps: Floats
    weeks: Floats
    fifths: Ints

    def __add__(self, other: Tally) -> Tally:
        if not isinstance(other, Tally):
            return NotImplemented
        if len(self.matches) != len(other.matches) or self.errors.shape != other.errors.shape:
            raise InputError(
                "only tallies from the same season can be added; these are from different seasons"
            )
        return Tally(**{field.name: _added(self, other, field.name) for field in fields(Tally)})

    @property
    def error_values(self) -> Ints:
        """The rating error for each column of `errors`, in points."""
        most = self.errors.shape[1] // 2
        return np.arange(-most, most + 1)

    def mean_and_error(self, above: Any, below: Any) -> tuple[Any, Any]:
        """Return sum(above) / sum(below) and its Monte Carlo standard error.

        Parameters
        ----------
        above, below
            sums for each batch, of shape (batches, ...), such as wins and matches.

        Returns
        -------
        mean, standard error
            arrays of the shape of one batch; NaN where nothing was counted, and for the error
            if there are fewer than two batches.

        Notes
        -----
        The standard error of a ratio of means, to first order, for k batches:
        sqrt(k / (k - 1) sum (above - mean * below)^2) / sum(below).
        """
        above, below = np.asarray(above, dtype=float), np.asarray(below, dtype=float)
        batches = len(above)
        total = below.sum(axis=0)
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = above.sum(axis=0) / total
            if batches < 2:
                return mean, np.full_like(mean, np.nan)
            off = ((above - mean * below) ** 2).sum(axis=0)
            return mean, np.sqrt(batches / (batches - 1) * off) / total

    def player_errors(self) -> tuple[Floats, Floats, Floats]:
        """Return the Monte Carlo standard errors of each player's expectations.

        Returns
        -------
        matches won in a season, P(win | the player plays a match), change of the rating
            arrays of shape (players,); NaN if there are fewer than two batches, or for a player
            without a match. As in `mean_and_error`; in a league so large that `products` is None
            the error of the chance treats the number of matches as given.
        """
        n = self.replicas.astype(float)
        batches, seasons = len(n), n.sum()
        if batches < 2:
            missing = np.full(len(self.wins), np.nan)
            return missing, missing, missing
        with np.errstate(invalid="ignore", divide="ignore"):
            won, moved, rate = self.wins / seasons, self.rating / seasons, self.wins / self.matches
            if self.products is None:
                squares = self.wins_squared - won * self.wins
                squares_moved = self.rating_squared - moved * self.rating
                squares_rate = squares
            else:
                ww, wm, mm, rr, wn, rn = self.products.T.astype(float)
                squares = ww - 2 * won * wn + won**2 * (n @ n)
                squares_moved = rr - 2 * moved * rn + moved**2 * (n @ n)
                squares_rate = ww - 2 * rate * wm + rate**2 * mm
            sums = (squares, seasons), (squares_rate, self.matches), (squares_moved, seasons)
            one, two, three = (
                np.sqrt(batches / (batches - 1) * np.maximum(off, 0.0)) / total
                for off, total in sums
            )
        return one, two, three


def fifths_of(skill: NDArray[Any]) -> Ints:
    """Return each player's fifth by skill, 0 being the weakest; ties go by position.

    Players are rows, and replicas are columns.

    >>> fifths_of(np.array([[50.0], [90.0], [70.0], [60.0], [80.0]])).ravel()
    array([0, 4, 2, 1, 3])
    """
    many = len(skill)
    order = np.argsort(skill, axis=0, kind="stable")
    fifth: Ints = np.empty(skill.shape, dtype=np.int64)
    ranks = (np.arange(many) * FIFTHS // many)[:, None]
    np.put_along_axis(fifth, order, np.broadcast_to(ranks, skill.shape), axis=0)
    return fifth


_IN_BATCHES = ("replicas", "gaps", "weeks", "fifths")
_WIDENED = {"wins_counts": 0, "rating_counts": 1}
"""Tables by player as wide as was needed, and how many columns are to be added before each other.

Wins begin at 0; moves are around the middle.
"""


def _added(first: Tally, second: Tally, name: str) -> Any:
    mine, theirs = getattr(first, name), getattr(second, name)
    if name == "gap_width":
        return mine
    if mine is None or theirs is None:
        return None
    if name in _IN_BATCHES:
        return np.concatenate([mine, theirs])
    if name in _WIDENED and mine.shape != theirs.shape:
        most, around = max(mine.shape[1], theirs.shape[1]), _WIDENED[name]
        mine, theirs = (
            np.pad(x, ((0, 0), (around * left // 2, left - around * left // 2)))
            for x in (mine, theirs)
            for left in (most - x.shape[1],)
        )
    return mine + theirs
