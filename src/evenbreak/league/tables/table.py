"""A league's current table, of players or teams, from the results of their matches."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from evenbreak.arrays import Bools, Floats, Ints, array_values, own_arrays
from evenbreak.checks import column, names, one_of
from evenbreak.errors import InputError
from evenbreak.league.tables.ladder import Record, ladder, standings_of
from evenbreak.league.tables.rules import POINTS, Outcomes, TableRules
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.results import Results

BOTH, HOME, AWAY = "both", "home", "away"
_COUNTED = {BOTH: (1, 1), HOME: (1, 0), AWAY: (0, 1)}


@own_arrays
@array_values
@dataclass(frozen=True, eq=False)
class TableMatches:
    """The matches counted in a table, one per row.

    Parameters
    ----------
    names
        the players or teams, each once.
    pairs
        who met whom, as positions in `names`; the first is at home, if that is known.
    date
        when (`datetime64[D]`, NaT where not stated).
    rows
        the matches' rows in the results; for a team match, its first row.
    undecided
        how many forfeits are left out because the winner is unknown.
    unscored
        how many matches are known only by their winner, and count as 0-0 in games.
    """

    names: tuple[str, ...]
    pairs: Ints
    outcomes: Outcomes
    date: NDArray[np.datetime64]
    rows: Ints
    undecided: int = 0
    unscored: int = 0

    def __len__(self) -> int:
        return len(self.pairs)

    def until(self, day: str) -> TableMatches:
        """Return the matches up to and including a day; those without a date are left out."""
        return self.among(self.date <= np.datetime64(day, "D"))

    def among(self, kept: Bools) -> TableMatches:
        """Return the matches in the given rows."""
        return replace(
            self,
            pairs=self.pairs[kept],
            outcomes=self.outcomes.among(kept),
            date=self.date[kept],
            rows=self.rows[kept],
        )


def player_matches(results: Results) -> TableMatches:
    """Return the matches between players; 0-0 rows that aren't forfeits were not played.

    The winner is the player who reached their race, if races are stated.

    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [3, 2], [2, 4],
    ...                             race_a=[5, 4], race_b=[2, 4])
    >>> player_matches(season).outcomes.winner.tolist()
    [2, 2]
    """
    check_results(results)
    score = np.stack([results.score_a, results.score_b], axis=1)
    race = np.stack(results.races, axis=1)
    forfeit = results.given_away
    raced = (race > 0).all(axis=1) & ~forfeit
    reached = (score >= race) & raced[:, None]
    by_race = np.where(reached[:, 0], 1, 2)
    winner = np.where(reached[:, 0] == reached[:, 1], Outcomes(score).winner, by_race)
    if results.winner is not None:
        winner = np.where(results.winner > 0, results.winner, winner)
    unscored = np.zeros(len(results), dtype=bool)
    if results.unscored is not None:
        unscored = results.unscored & ~forfeit
    undecided = forfeit & (winner == 0)
    rows = ((score > 0).any(axis=1) | unscored | forfeit) & ~undecided
    date = np.full(len(results), "NaT", dtype="datetime64[D]")
    return TableMatches(
        results.players,
        np.stack([results.player_a, results.player_b], axis=1)[rows],
        Outcomes(score[rows], winner[rows], race[rows], forfeit[rows]),
        (date if results.date is None else results.date)[rows],
        np.flatnonzero(rows),
        int(undecided.sum()),
        int((unscored & rows).sum()),
    )


def team_matches(
    results: Results, *, count_games: bool = False, rules: TableRules | None = None
) -> TableMatches:
    """Return the matches between teams, from the matches between their players.

    All sets between two teams on the same date, in the same division, form one team match; the home
    team is the one named first. If the rules split the points of each set, as in the APA, they are
    added up.

    Parameters
    ----------
    results
        results with the teams of both players; rows without them are left out.
    count_games
        whether a team's score is the games won by its players, instead of the sets.

    Raises
    ------
    InputError
        if no row states both players' teams.

    >>> season = Results.from_names(["Ann", "Bo"], ["Xi", "Yu"], [5, 2], [3, 4],
    ...                             team_a=["Acers"] * 2, team_b=["Bankers"] * 2)
    >>> team_matches(season).outcomes.score, team_matches(season, count_games=True).outcomes.score
    (array([[1, 1]]), array([[7, 7]]))
    """
    check_results(results)
    if results.team_a is None or results.team_b is None:
        raise InputError("{results} doesn't name any teams. Add the columns team_a and team_b.")
    stated = (results.team_a != "") & (results.team_b != "")
    if not stated.any():
        raise InputError("{results} doesn't name any teams. Add the columns team_a and team_b.")
    sets = player_matches(results.select(stated))
    titles = np.stack([results.team_a, results.team_b], axis=1)[stated][sets.rows].astype(str)
    teams, both = np.unique(titles, return_inverse=True)
    both = both.reshape(titles.shape)
    parts = [results.division, results.event]
    more = ["" if part is None else part[stated][sets.rows].astype(str) for part in parts]
    key: Any = np.rec.fromarrays(
        [sets.date.astype(np.int64), *np.broadcast_arrays(*more, both.min(1), both.max(1))]
    )
    _, first, match = np.unique(key, return_index=True, return_inverse=True)
    swapped = both[:, 0] > both[:, 1]  # against the order of the alphabet
    many = len(first)
    at_home = np.bincount(match, np.where(swapped, -1, 1), many) >= 0  # as most rows have it
    turned = (swapped == at_home[match])[:, None]

    def summed(values: NDArray[Any]) -> NDArray[Any]:
        total = np.zeros((many, 2), dtype=values.dtype)
        np.add.at(total, match, np.where(turned, values[:, ::-1], values))
        return total

    won = summed(sets.outcomes.won.astype(np.int64))
    score = summed(sets.outcomes.score) if count_games else won
    winner, given = Outcomes(score).winner, None
    if rules is not None and rules.split:
        # A match is won on points; where those are equal, on sets.
        given = summed(rules.points_of(sets.outcomes))
        winner = np.where(given[:, 0] == given[:, 1], winner, Outcomes(given).winner)
    gone = np.bincount(match, ~sets.outcomes.forfeit, many) == 0
    pairs = np.stack([both.min(axis=1), both.max(axis=1)], axis=1)[first]
    return TableMatches(
        tuple(teams.tolist()),
        np.where(at_home[:, None], pairs, pairs[:, ::-1]),
        Outcomes(score, winner, forfeit=gone & (winner > 0), given=given),
        sets.date[first],
        sets.rows[first],
        sets.undecided,
        sets.unscored,
    )


@own_arrays
@array_values
@dataclass(frozen=True, eq=False)
class LeagueTable:
    """A league table: one row per player or team, first place at the top.

    Parameters
    ----------
    place
        place, from 1; ties share a place.
    level
        how many share the place.
    played, won, drawn, lost
        matches.
    scored, conceded
        games (or sets) won and lost.
    forfeits
        matches lost by forfeit.
    decided_by
        the rule that separates each row from the one above it; '' if none does.
    rules
        the rules of the table.
    """

    names: tuple[str, ...]
    place: Ints
    level: Ints
    played: Ints
    won: Ints
    drawn: Ints
    lost: Ints
    scored: Ints
    conceded: Ints
    forfeits: Ints
    points: Floats
    decided_by: tuple[str, ...]
    rules: TableRules

    def __len__(self) -> int:
        return len(self.names)

    @property
    def difference(self) -> Ints:
        """Games (or sets) won minus lost."""
        return np.asarray(self.scored - self.conceded)


def league_table(
    matches: TableMatches,
    rules: TableRules | None = None,
    *,
    head_start: ArrayLike | None = None,
    byes: ArrayLike | None = None,
    side: str = BOTH,
) -> LeagueTable:
    """Return the table of a league.

    Parameters
    ----------
    rules
        the rules of the table.
    head_start
        points for each in addition to its matches, such as a deduction, in the order of their
        names.
    byes
        how many rounds without an opponent each has had.
    side
        'both', or 'home' or 'away' for a table of the matches at home or away.

    >>> season = Results.from_names(["Ann", "Bo", "Cy"], ["Bo", "Cy", "Ann"], [5, 5, 5], [3, 1, 4])
    >>> table = league_table(player_matches(season))
    >>> table.names, table.place, table.points, table.decided_by
    (('Bo', 'Ann', 'Cy'), array([1, 2, 3]), array([2., 2., 2.]), ('', 'difference', 'difference'))
    """
    rules = rules or TableRules()
    count = len(names(matches.names, "names"))
    counted = _COUNTED[one_of(side, "side", tuple(_COUNTED))]
    start = (
        np.zeros(count) if head_start is None else column(head_start, "head_start", count, "row")
    )
    if byes is not None:
        start = start + rules.bye * column(byes, "byes", count, "row")
    record = Record(count, rules, matches.pairs, matches.outcomes, start, counted)
    codes = [(rule, code[:, 0]) for rule, code in ladder(record)]
    standings = standings_of(codes[-1][1][:, None])
    ahead = standings.ahead[:, 0]
    order = sorted(range(count), key=lambda k: (ahead[k], matches.names[k].casefold()))

    def sums(gains: Callable[[Outcomes], NDArray[Any]]) -> Ints:
        return record.total(gains)[order, 0]

    won, lost = sums(lambda of: of.won), sums(lambda of: of.won[:, ::-1])
    played = sums(lambda of: np.ones(of.score.shape, dtype=np.int64))
    decided = [
        next((rule for rule, code in codes if code[one] != code[other]), "")
        for one, other in pairwise(order)
    ]
    return LeagueTable(
        tuple(matches.names[k] for k in order),
        ahead[order] + 1,
        standings.level[order, 0],
        played,
        won,
        played - won - lost,
        lost,
        sums(lambda of: of.score),
        sums(lambda of: of.score[:, ::-1]),
        sums(lambda of: of.won[:, ::-1] & of.forfeit[:, None]),
        record.values(POINTS, record.ends)[order, 0] / 100.0,
        ("", *decided),
        rules,
    )
