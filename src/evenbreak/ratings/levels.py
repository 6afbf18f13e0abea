"""What a file says about players before their results: newcomers, teams, divisions, handicaps.

Inexperienced players tend to be weaker than experienced ones, players of the same team or division
tend to be alike, and a handicap league's races show how strong the league believes its players to
be. `Levels` says how much each of these counts; `Knowledge` gathers, match by match, what a file
says about each player, and turns it into the means of their priors.

A race m:n is even where the first player wins a game with the chance p for which W(p; m, n) = 1/2;
the implied difference in strength is ln p/(1 - p). The players' strengths according to their races
(`StatedStrength`) are those whose differences come closest to the implied ones, by least squares
over all matches so far. Leagues follow their players from season to season, so a race counts half
once both have had `RECENT` more.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import cg
from scipy.special import betaincinv, logit

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.checks import number
from evenbreak.ratings.beginning import Beginning, Known, PriorMeans
from evenbreak.ratings.first_evenings import FirstEvenings
from evenbreak.ratings.results import Results

SETTLED = 50.0
"""Games after which half of a newcomer's disadvantage is gone."""

OPENING = 28.0
"""Days within which everyone counts as having been there from the start."""

BROUGHT_SD = math.log(2.0) / 2.0
"""Assumed error of a rating that players bring with them, if nothing states it."""

BESIDES_GAMES = 0.05
"""Extra error of a rating that players bring with them, if only its games are stated."""

GROUPS = {"team": ("team_a", "team_b"), "division": ("division", "division")}
"""The columns that name the groups of player a and player b."""


@dataclass(frozen=True)
class Levels:
    """What is known about players before their results, in natural log-odds.

    Parameters
    ----------
    newcomers
        how far below an experienced player someone who has never played is expected to be. The
        fraction 1 / (1 + games / 50) of this is left after some games.
    joined
        how far below the original players someone who joins after the first four weeks is expected
        to be; it does not shrink with games.
    race
        the difference between players per unit of difference that their stated races make up for: 1
        if the races are fair (see `evenbreak.ratings.handicap_slope`).
    field
        newcomers' expected share of the strength of the field on their first evening (see
        `evenbreak.ratings.first_evenings`); it does not shrink with games.
    team_sd, division_sd
        standard deviation between teams, or divisions; 0: they do not matter.
    brought_sd
        standard deviation of the error of ratings from elsewhere that do not state one, in addition
        to the uncertainty from their number of games; 0: such ratings are not used.
    beginning
        the ratings from elsewhere; None: there are none.

    Raises
    ------
    InputError
        if a number is not finite, or a standard deviation is not in 0 to 100.

    >>> bool(Levels()), bool(Levels(newcomers=0.4, team_sd=0.2))
    (False, True)
    """

    newcomers: float = 0.0
    joined: float = 0.0
    race: float = 0.0
    field: float = 0.0
    team_sd: float = 0.0
    division_sd: float = 0.0
    brought_sd: float = 0.0
    beginning: Beginning | None = dataclasses.field(default=None, repr=False)

    def __post_init__(self) -> None:
        for name in SIZES:
            low = 0.0 if name.endswith("_sd") else -100.0
            number(getattr(self, name), name, low=low, high=100.0)

    def __bool__(self) -> bool:
        """Return whether anything is known."""
        return any(getattr(self, size.name) not in (0.0, None) for size in fields(self))


SIZES = tuple(each.name for each in fields(Levels) if each.name != "beginning")
"""The fields of `Levels` that are numbers."""


def begun(beginning: Beginning | None) -> Levels:
    """Return what is known if nothing is estimated: the ratings that players bring with them.

    Ratings without a stated uncertainty are assumed to be off by half of the difference that
    doubles the odds or, if all of them state games, by the uncertainty that follows from those
    games.
    """
    if beginning is None or not beginning.unknown_error:
        return Levels(beginning=beginning)
    all_by_games = (beginning.by_games | ~np.isnan(beginning.standard_error)).all()
    return Levels(beginning=beginning, brought_sd=BESIDES_GAMES if all_by_games else BROUGHT_SD)


def first_evenings(results: Results, levels: Levels) -> FirstEvenings:
    """Return the first evenings of players who bring no games with them."""
    old = levels.beginning
    return FirstEvenings(results, None if old is None else old.games_of(results.players) > 0.0)


def joined_late(results: Results) -> Floats:
    """Return 1 for each player whose first match is after the first four weeks, else 0.

    >>> season = Results.from_names(
    ...     ["Ann", "Cy"], ["Bo", "Ann"], [7, 7], [5, 5], date=["2026-01-01", "2026-02-05"]
    ... )
    >>> joined_late(season)
    array([0., 0., 1.])
    """
    many = len(results.players)
    if results.date is None or np.isnat(results.date).all():
        return np.zeros(many)
    dated = ~np.isnat(results.date)
    days = (results.date - results.date[dated].min()).astype(float)
    first = np.full(many, np.inf)
    for players in (results.player_a, results.player_b):
        np.minimum.at(first, players[dated], days[dated])
    return np.asarray((first > OPENING) & np.isfinite(first), dtype=float)


def newness(games: Floats | Ints) -> Floats:
    """Return the fraction of a newcomer's disadvantage that is left after some games.

    >>> newness(np.array([0, 50, 450]))
    array([1. , 0.5, 0.1])
    """
    return np.asarray(SETTLED / (SETTLED + games))


NEWER = 0.25
"""Fraction of a newcomer's disadvantage by which a player is clearly newer than an opponent."""


def met_as_newcomers(results: Results) -> Bools:
    """Return whether each player was ever clearly newer than an opponent; all matches are dated.

    If everyone has played equally much, no one was, and nothing can be said about first games.

    >>> season = Results.from_names(
    ...     ["Ann", "Ann"], ["Bo", "Cy"], [50, 5], [40, 7], date=["2026-01-01", "2026-02-05"]
    ... )
    >>> met_as_newcomers(season)
    array([False, False,  True])
    """
    new, many = np.zeros(len(results.players), dtype=bool), len(results)
    if results.date is None:
        return new
    order = np.argsort(results.date, kind="stable")
    ends = np.concatenate([results.player_a[order], results.player_b[order]])
    match = np.tile(np.arange(many), 2)
    by_player = np.lexsort((match, ends))
    games = games_of(results)[order][match][by_player]
    before = np.cumsum(games) - games
    first = np.searchsorted(ends[by_player], ends[by_player])
    left = np.zeros(2 * many)
    left[by_player] = newness(before - before[first])
    newer = left - np.roll(left, many) > NEWER
    new[ends[newer]] = True
    return new


class Knowledge:
    """What is known about each player in a league so far; at first, nothing.

    `levels` determines which of it matters.
    """

    def __init__(
        self,
        results: Results,
        levels: Levels,
        stated: StatedStrength | None = None,
        evenings: FirstEvenings | None = None,
    ) -> None:
        self._levels = levels
        self._players = len(results.players)
        self._sides = results.player_a, results.player_b
        self._games = games_of(results)
        self._behind = np.zeros(self._players)
        self._late = joined_late(results)
        self._known: Known | None = None
        if levels.beginning is not None:
            self._behind = levels.beginning.games_of(results.players)
            self._known = levels.beginning.known(results.players, brought_sd=levels.brought_sd)
        self._stated = (stated or StatedStrength(results)) if levels.race else None
        self._evenings = None
        if levels.field:
            self._evenings = first_evenings(results, levels) if evenings is None else evenings
        self._groups = [
            _Groups(results, kind)
            for kind in GROUPS
            if getattr(levels, f"{kind}_sd") and has_groups(results, kind)
        ]

    def see(self, rows: Any) -> None:
        """Add the races, teams and divisions of matches, which are known before play."""
        for of_file in (self._stated, self._evenings):
            if of_file is not None:
                of_file.see(rows)
        for groups in self._groups:
            groups.see(rows)

    def play(self, rows: Any) -> None:
        """Add the number of games played in some matches."""
        for players in self._sides:
            self._behind += np.bincount(players[rows], self._games[rows], self._players)

    def means(self) -> PriorMeans:
        """Return the players' prior means, which average 0 over those who have played.

        If the field counts, newcomers' means follow the skills of others.
        """
        design = [groups.design for groups in self._groups]
        sds = [
            np.full(len(group.names), getattr(self._levels, f"{group.kind}_sd"))
            for group in self._groups
        ]
        mean = -self._levels.newcomers * newness(self._behind)
        if self._levels.joined:
            mean -= self._levels.joined * self._late
        if self._stated is not None:
            mean += self._levels.race * self._stated.strength()
        whole = PriorMeans(
            mean,
            np.hstack([np.zeros((self._players, 0)), *design]),
            np.concatenate([np.zeros(0), *sds]),
            tuple((group.kind, name) for group in self._groups for name in group.names),
            self._known,
            self._follow(),
        )
        return whole.centered((self._behind > 0).astype(float))

    def _follow(self) -> Callable[[Floats], Floats] | None:
        size, evenings = self._levels.field, self._evenings
        return None if evenings is None else lambda skill: size * evenings.strength(skill)


class _Groups:
    """A league's teams or divisions, and how often each player was seen in each."""

    def __init__(self, results: Results, kind: str) -> None:
        self.kind = kind
        texts = [np.asarray(getattr(results, name)).astype(str) for name in GROUPS[kind]]
        names, code = np.unique(np.concatenate(texts), return_inverse=True)
        self.names = tuple(names[names != ""].tolist())
        stated = code - int(names[0] == "")
        self._code: tuple[Ints, Ints] = tuple(np.split(stated, 2))  # type: ignore[assignment]
        self._sides = results.player_a, results.player_b
        self._seen = np.zeros((len(results.players), len(self.names)))

    def see(self, rows: Any) -> None:
        for players, code in zip(self._sides, self._code, strict=True):
            stated = code[rows] >= 0
            np.add.at(self._seen, (players[rows][stated], code[rows][stated]), 1.0)

    @property
    def design(self) -> Floats:
        """Fraction of each player's matches in each group, 0 where no group was stated."""
        total = self._seen.sum(1, keepdims=True)
        return np.asarray(self._seen / np.maximum(total, 1.0))


def known_levels(results: Results, beginning: Beginning | None = None) -> tuple[str, ...]:
    """Return the fields of `Levels` that the results and a beginning say something about."""
    says = {
        "race": has_handicaps(results),
        "division_sd": has_groups(results, "division"),
        "team_sd": has_groups(results, "team"),
        "joined": bool(joined_late(results).any()),
        "newcomers": True,
        "field": bool(FirstEvenings(results)),
        "brought_sd": beginning is not None and beginning.unknown_error,
    }
    return tuple(name for name, says_it in says.items() if says_it)


MOST_SHARES = 20_000_000
"""Players times groups above which groups are too many to estimate: 200 of 100,000 players."""


def has_groups(results: Results, kind: str) -> bool:
    """Return whether results name at least two teams, or two divisions, and not too many."""
    return 1 < _count_groups(results, kind) <= MOST_SHARES // len(results.players)


def too_many_groups(results: Results) -> dict[str, int]:
    """Return the number of teams, or divisions, if they are too many to estimate.

    >>> too_many_groups(Results.from_names(["Ann"], ["Bo"], [7], [5], team_a=["X"], team_b=["Y"]))
    {}
    """
    groups = {kind: _count_groups(results, kind) for kind in GROUPS}
    most = MOST_SHARES // max(len(results.players), 1)
    return {kind: many for kind, many in groups.items() if many > max(most, 1)}


def _count_groups(results: Results, kind: str) -> int:
    columns = [getattr(results, name) for name in GROUPS[kind]]
    if any(column is None for column in columns):
        return 0
    return len({text for column in columns for text in column.tolist()} - {""})


def games_of(results: Results) -> Floats:
    """Return the number of games in each match; the longer race if only the winner is known."""
    games = (results.score_a + results.score_b).astype(float)
    if results.unscored is not None:
        games = np.where(results.unscored, np.maximum(*results.races), games)
    return np.asarray(np.where(results.given_away, 0.0, games))


def means_of(
    results: Results,
    levels: Levels,
    stated: StatedStrength | None = None,
    evenings: FirstEvenings | None = None,
) -> PriorMeans:
    """Return the players' prior means after all of the given results.

    The parameters are those of `Knowledge`. Upcoming matches, at 0-0, show who is on which team.

    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [50, 0], [50, 0])
    >>> means_of(season, Levels(newcomers=0.6)).mean.round(3)
    array([ 0. ,  0. , -0.4])
    """
    knowledge = Knowledge(results, levels, stated, evenings)
    rows = slice(None)
    knowledge.see(rows)
    knowledge.play(rows)
    return knowledge.means()


RIDGE = 0.01
"""Weight toward 0, in matches, that decides between groups that never met."""

RECENT = 5.0
"""Later matches after which a race counts half, by the player who has had fewer."""

_SOLVED_UP_TO = 100
"""Players up to which the equations are solved exactly, which is then faster than iterating."""


def implied_difference(results: Results) -> Floats:
    """Return how much stronger a is than b if the race is fair, in log-odds; NaN without a race.

    >>> season = Results.from_names(["A", "A"], ["B", "B"], [7, 5], [2, 5], race_a=[7, 5],
    ...     race_b=[3, 5])
    >>> implied_difference(season).round(3)
    array([0.914, 0.   ])
    """
    race_a, race_b = results.races
    stated = (race_a > 0) & (race_b > 0)
    p = betaincinv(np.where(stated, race_a, 1), np.where(stated, race_b, 1), 0.5)
    return np.where(stated, logit(p), np.nan)


def has_handicaps(results: Results) -> bool:
    """Return whether any stated race is uneven."""
    race_a, race_b = results.races
    return bool(((race_a > 0) & (race_b > 0) & (race_a != race_b)).any())


class StatedStrength:
    """Players' strengths according to the races seen so far."""

    def __init__(self, results: Results) -> None:
        self._players = len(results.players)
        self._a, self._b = results.player_a, results.player_b
        self._implied = implied_difference(results)
        self._stated = ~np.isnan(self._implied)
        self._day = np.zeros(len(results), dtype=np.int64)
        if results.date is not None:  # NaT comes last
            self._day = np.unique(results.date, return_inverse=True)[1]
        self._seen = np.zeros(len(results), dtype=bool)
        self._last = np.zeros(self._players)
        self._up_to_date = False

    def see(self, rows: Any) -> None:
        """Add the races of some matches."""
        self._up_to_date &= bool(self._seen[rows].all())
        self._seen[rows] = True

    def strength(self) -> Floats:
        """Return each player's strength in natural log-odds, 0 if no race mentions the player."""
        if self._up_to_date:
            return self._last
        self._up_to_date = True
        rows = self._seen & self._stated
        matches, players = int(rows.sum()), self._players
        sign = np.repeat([1.0, -1.0], matches)
        ends = np.concatenate([self._a[rows], self._b[rows]])
        which = np.tile(np.arange(matches), 2)
        contrast = sparse.coo_array((sign, (which, ends)), shape=(matches, players)).tocsr()
        weighted = contrast.T @ sparse.diags_array(self._weights(rows))
        normal = weighted @ contrast + RIDGE * sparse.eye_array(players)
        right = weighted @ self._implied[rows]
        if players <= _SOLVED_UP_TO:
            self._last = np.linalg.solve(normal.toarray(), right)
        else:
            self._last, _ = cg(normal, right, self._last, rtol=1e-8)
        return self._last

    def _weights(self, rows: Any) -> Floats:
        """Return how much each race counts; one without a date counts in full."""
        matches = int(rows.sum())
        # A number for each player and day, in that order.
        key = np.tile(self._day[rows], 2) + len(self._day) * np.concatenate(
            [self._a[rows], self._b[rows]]
        )
        in_order = np.sort(key)
        last = np.searchsorted(in_order, len(self._day) * (key // len(self._day) + 1))
        since = last - np.searchsorted(in_order, key, side="right")
        return np.asarray(0.5 ** (np.minimum(since[:matches], since[matches:]) / RECENT))
