"""A league as its site shows it, with public names only: everything the pages are made from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
import pandas as pd

from evenbreak.answers.kit.scales import decimals_of
from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.sheet import places_in_list
from evenbreak.answers.league.why import OneMore, Standing, one_more_match
from evenbreak.league.tables.rules import TableRules
from evenbreak.league.tables.table import (
    LeagueTable,
    TableMatches,
    league_table,
    player_matches,
    team_matches,
)
from evenbreak.ratings.fit import fit
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.results import Results, who_won
from evenbreak.ratings.usual import rated_alike
from evenbreak.site.look import Accent
from evenbreak.site.names import PublicNames, by_appearance, file_names
from evenbreak.site.races import LeagueRaces

MOST_POINTS = 24
"""How many dates the history of ratings is drawn for."""

MOST_REFITS = 800
"""How many of the last matches get a worth, each calculated by rating the league without it."""

RECENT = 8
"""How many matches a player's form shows."""

WEEK = np.timedelta64(7, "D")


class Played(NamedTuple):
    """A match from one player's side; `won` is None if it ended level."""

    day: str
    opponent: str
    score: str
    race: str
    won: bool | None
    worth: float | None


class Rated(NamedTuple):
    """A player's line in the ratings list; `place` is None for a provisional rating."""

    place: int | None
    player: str
    rating: float
    error: float
    games: int
    provisional: bool


@dataclass(frozen=True, eq=False)
class PublishedLeague:
    """A league whose players have their public names.

    `accent` is the color if it isn't the usual one; `head_start` has points not from matches;
    `count_games`: a team's score is its players' games.
    """

    title: str
    results: Results
    ratings: Ratings
    races: LeagueRaces
    names: PublicNames
    accent: Accent | None
    logo: tuple[str, bytes] | None = None
    rules: TableRules = field(default_factory=TableRules)
    head_start: Mapping[str, float] = field(default_factory=dict)
    count_games: bool = False

    @cached_property
    def pages(self) -> dict[str, str]:
        """Each player's page file, for players who have a page."""
        order = [*by_appearance(self.results)]
        order += [name for name in self.races.roster.players if name not in set(order)]
        hidden = self.names.hidden
        named = file_names(name for name in order if name not in hidden)
        return {name: f"players/{file}.html" for name, file in named.items()}

    @cached_property
    def decimals(self) -> int:
        """How many decimals ratings have."""
        return decimals_of(self.ratings.scale)

    @cached_property
    def days(self) -> list[np.datetime64]:
        """The dates of matches that count, each once, in order."""
        dates = self.results.date
        if dates is None:
            return []
        days = np.unique(dates[self.results.counted])
        return list(days[~np.isnat(days)])

    @cached_property
    def rated(self) -> list[Rated]:
        """The ratings list, provisional ratings last."""
        return list(_rated(self.ratings))

    @cached_property
    def winner(self) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
        """Who won each match: 1, 2, or 0 if it ended level."""
        won = who_won(self.results)
        if self.results.winner is not None:
            won = np.where(self.results.winner > 0, self.results.winner, won)
        return np.asarray(won, dtype=np.int64)

    @cached_property
    def rows(self) -> list[int]:
        """The matches that count, latest first."""
        rows = np.flatnonzero(self.results.counted)
        if self.results.date is not None:
            rows = rows[np.argsort(self.results.date[rows], kind="stable")]
        return [int(row) for row in rows[::-1]]

    @cached_property
    def matches(self) -> dict[str, list[Played]]:
        """Each player's matches, latest first, with the worth of the last few."""
        results, worth = self.results, self._worth
        found: dict[str, list[Played]] = {name: [] for name in results.players}
        for row in self.rows:
            for first in (True, False):
                seats = results.player_a[row], results.player_b[row]
                me, other = (results.players[int(k)] for k in (seats if first else seats[::-1]))
                change = worth.get(row)
                winner = int(self.winner[row])
                found[me].append(
                    Played(
                        self.day_of(row),
                        other,
                        self._pair_of(row, "score", first),
                        self._pair_of(row, "race", first),
                        None if not winner else winner == (1 if first else 2),
                        None if change is None else change[0 if first else 1],
                    )
                )
        return found

    def day_of(self, row: int) -> str:
        """Return a match's date, '' if unknown."""
        dates = self.results.date
        return "" if dates is None or np.isnat(dates[row]) else str(dates[row])

    def _pair_of(self, row: int, name: str, first: bool) -> str:
        columns = (getattr(self.results, f"{name}_a"), getattr(self.results, f"{name}_b"))
        if columns[0] is None or columns[1] is None:
            return ""
        own, other = (int(column[row]) for column in (columns if first else columns[::-1]))
        return f"{own}-{other}" if own or other else ""

    @cached_property
    def _worth(self) -> dict[int, tuple[float, float]]:
        """How much each of the last matches was worth to its two players' ratings."""
        again = rated_alike(self.ratings, self.results)
        everything, worth = np.arange(len(self.results)), {}
        for row in self.rows[:MOST_REFITS]:
            without = again(self.results.select(everything != row)).rating
            a, b = int(self.results.player_a[row]), int(self.results.player_b[row])
            change = self.ratings.rating - without
            worth[row] = float(change[a]), float(change[b])
        return worth

    @cached_property
    def history(self) -> list[tuple[str, Ratings]]:
        """The ratings on some dates in the season, the last ones being current."""
        days = self.days
        chosen = np.unique(np.linspace(0, len(days) - 1, MOST_POINTS).round().astype(int))
        earlier = [days[k] for k in chosen[:-1]] if len(days) > 1 else []
        last = [(str(days[-1]), self.ratings)] if days else []
        return [(str(day), self._on(day)) for day in earlier] + last

    @cached_property
    def week_before(self) -> Ratings | None:
        """The ratings a week before the last match; None if there were none by then."""
        days = self.days
        return self._on(days[-1] - WEEK) if days and days[0] <= days[-1] - WEEK else None

    def _on(self, day: np.datetime64) -> Ratings:
        """Return a date's ratings, with the same prior as today's."""
        ratings, results = self.ratings, self.results
        played = np.zeros(len(results), bool) if results.date is None else results.date <= day
        return fit(
            results.select(results.counted & played),
            prior_sd=ratings.prior_sd,
            scale=ratings.scale,
            anchor=ratings.anchor,
            half_life=ratings.half_life,
            levels=ratings.levels,
            form=ratings.match_form,
        )

    def one_more(self, player: str, opponent: str) -> list[OneMore]:
        """Return what one more match between two players would change; none if a chart decides."""
        offered = self.races.rule
        if not isinstance(offered, OfferedRaces):
            return []
        at = self.results.players.index
        pair = at(player), at(opponent)
        now = Standing.of(self.ratings, pair, offered)
        again = rated_alike(self.ratings, self.results)
        more = one_more_match(self.results, self.ratings, pair, now, offered, again)
        return [one for one in more if one.then.race not in (None, now.race)]

    @cached_property
    def standings(self) -> LeagueTable:
        """The players' standings."""
        return self._table(player_matches(self.results))

    @cached_property
    def team_standings(self) -> LeagueTable | None:
        """The teams' standings; None if there are no teams."""
        teams = self.results.team_a
        if teams is None or not (teams != "").any():
            return None
        counted = team_matches(self.results, count_games=self.count_games, rules=self.rules)
        return self._table(counted)

    def _table(self, matches: TableMatches) -> LeagueTable:
        start = [self.head_start.get(name, 0.0) for name in matches.names]
        return league_table(matches, self.rules, head_start=start)

    @cached_property
    def changes(self) -> pd.DataFrame:
        """How ratings and places have changed since a week before the last match."""
        before, results = self.week_before, self.results
        earlier = {} if before is None else {one.player: one for one in _rated(before)}
        played = np.zeros(len(results.players), dtype=int)
        if results.date is not None and self.days:
            rows = results.counted & (results.date > self.days[-1] - WEEK)
            np.add.at(played, np.concatenate([results.player_a[rows], results.player_b[rows]]), 1)
        since = dict(zip(results.players, played.tolist(), strict=True))
        columns = ("player", "rating_before", "rating", "change", "place_before", "place")
        made = pd.DataFrame(
            [
                (
                    one.player,
                    was and was.rating,
                    one.rating,
                    was and one.rating - was.rating,
                    was and was.place,
                    one.place,
                    since[one.player],
                )
                for one in self.rated
                for was in [earlier.get(one.player)]
            ],
            columns=[*columns, "matches_since"],
        )
        return made.astype(dict.fromkeys(("place_before", "place"), "Int64"))


def _rated(ratings: Ratings) -> Iterator[Rated]:
    """Yield the players on a ratings list who have played, provisional ones last."""
    order = [k for k in ratings.strongest_first() if not ratings.idle[k]]
    for place, k in zip(places_in_list(ratings.provisional[order]), order, strict=True):
        yield Rated(
            None if place.startswith("P") else int(place),
            ratings.players[k],
            float(ratings.rating[k]),
            float(ratings.standard_error[k]),
            int(ratings.games[k] + ratings.races_won[k] + ratings.races_lost[k]),
            bool(ratings.provisional[k]),
        )
