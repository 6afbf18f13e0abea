"""The fair-race sheet: its players, their ratings, and the fairest races."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import count, pairwise
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from evenbreak import __version__
from evenbreak.answers.kit.remarks import file_name, fingerprints
from evenbreak.answers.kit.scales import decimals_of, like_scale_words
from evenbreak.answers.league.roster_matchups import OfferedRaces, pairs_of, roster_matchups
from evenbreak.errors import InputError
from evenbreak.files.csv_writer import DECIMALS
from evenbreak.files.results.results_file import ResultsFile
from evenbreak.files.tables.names import KnownNames, clean_name
from evenbreak.files.tables.problems import quoted
from evenbreak.handicaps.charts.gap import MOST_DOUBLINGS, Gap
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.prior import PriorChoice
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.words import FilePath, joined, race


def most_active(ratings: Ratings, top: int) -> list[int]:
    """Return the players with the most games (positions in `ratings.players`), in that order.

    Players with the same number of games are ordered by their matches with only a winner stated,
    then by name.
    """
    races = ratings.races_won + ratings.races_lost
    order = sorted(range(len(ratings.players)), key=lambda k: (-ratings.games[k], -races[k], k))
    return order[:top]


def find_players(
    ratings: Ratings | Results | Roster,
    names: Sequence[str],
    *,
    said: str = "players",
    where: str = "the results",
) -> list[int]:
    """Return the named players' positions, each once, ignoring case.

    Parameters
    ----------
    names
        as typed.
    said
        the parameter or option that named them, for the error.
    where
        where they should be, for the error.

    Raises
    ------
    InputError
        if names are not among the players; it lists all such names, each with similar ones.
    """
    known = KnownNames(ratings.players)
    found: dict[int, None] = {}
    unknown: dict[str, None] = {}
    for name in map(clean_name, names):
        place = known.place(name)
        if place is None:
            unknown[quoted(name) + known.hint(name)] = None
        else:
            found[place] = None
    if unknown:
        raise InputError(
            "{said}: not in {where}: {names}. Write each name as it appears in that file.",
            said=said,
            where=FilePath(where),
            names=joined(unknown, ", "),
        )
    return list(found)


def matchups_frame(ratings: Ratings, players: Sequence[int], offered: OfferedRaces) -> pd.DataFrame:
    """Return the fairest race for each pair of players, stronger player first.

    The races are calculated by `roster_matchups` from the ratings list that a report writes, so a
    pair has the same race here and wherever that list is read.

    Parameters
    ----------
    players
        the players to pair: positions in `ratings.players`.
    offered
        the races to choose from.

    Returns
    -------
    pandas.DataFrame
        the frame from `roster_matchups`. If no chain of opponents links the two players, their
        ratings can't be compared: the row has no numbers, and its note says so.
    """
    roster = as_listed(ratings)
    pairs = pairs_of(roster, ratings.strongest_first(players))
    return roster_matchups(
        roster, pairs, scale=ratings.scale, offered=offered, form=ratings.match_form
    ).frame


def as_listed(ratings: Ratings) -> Roster:
    """Return the ratings as on their list: rounded, with an error for each player."""
    # An error beyond this says that nothing is known; numbers would not change much.
    most = MOST_DOUBLINGS * ratings.scale.points_per_doubling / 2.0
    return Roster(
        ratings.players,
        np.round(ratings.rating, DECIMALS),
        np.minimum(np.round(ratings.quasi_error, DECIMALS), most),
        ratings.games + ratings.races_won + ratings.races_lost,
        component=ratings.component,
        provisional=ratings.provisional,
    )


class SurePair(NamedTuple):
    """A pair's rating difference, its error, and P(A wins the race).

    `p_win` is averaged over the error; `low` and `high` are the chances two errors either way.
    """

    player_a: str
    player_b: str
    race: str
    difference: float
    error: float
    p_win: float
    low: float
    high: float


def sure_pairs(paired: pd.DataFrame, scale: Scale) -> list[SurePair]:
    """Return the pairs that have a race in a `roster_matchups` frame, best known first."""
    found = []
    rows: Any = paired.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        difference, error = pair.difference, pair.difference_error
        ends = [scale.win_probability(difference + 2 * side * error) for side in (-1, 1)]
        low, high = race_win_probability(ends, pair.race_a, pair.race_b).tolist()
        needs = race((pair.race_a, pair.race_b))
        found.append(
            SurePair(
                pair.player_a, pair.player_b, needs, difference, error, pair.p_win_a, low, high
            )
        )
    # Rounded, so that the last bits do not decide.
    return sorted(found, key=lambda pair: round(pair.error / scale.points_per_doubling, 9))


def how_sure(scale: Scale, pairs: Sequence[SurePair]) -> Iterator[str]:
    """Yield what the standard errors mean for a rating and for a race."""
    yield (
        "Each bar reaches two standard errors on either side of the rating. If the model below "
        "holds, a player's true strength lies within the bar about 19 times in 20."
    )
    if pairs:
        middle = pairs[(len(pairs) - 1) // 2]
        several = len(pairs) > 1
        yield (
            f"{'For half of the pairs, the' if several else 'The'} rating difference is known to "
            f"within {2 * middle.error:.{decimals_of(scale)}f} points (two standard errors)"
            f"{' or better' if several else ''}. So a race that looks even may really favor "
            "one of the two:"
        )


def three_pairs(pairs: Sequence[SurePair]) -> list[tuple[str, SurePair]]:
    """Return the best known, a typical and the least known pair, each once."""
    if len(pairs) < 2:
        return [("", pair) for pair in pairs]
    named = {(len(pairs) - 1) // 2: "typical", 0: "best known", len(pairs) - 1: "least known"}
    return [(name, pairs[k]) for k, name in sorted(named.items())]


MOST_BANDS = 40
"""A chart with more lines than this is too long to read."""


class Band(NamedTuple):
    """A range of rating differences with one race, up to just below `after`.

    `p_first` and `p_after` are the stronger player's chances at its two ends.
    """

    first: float
    after: float
    stronger: int
    weaker: int
    p_first: float
    p_after: float


def chart_bands(offered: OfferedRaces, typical: Gap, furthest: float) -> list[Band]:
    """Return the chart by rating difference based on the fairest races; [] if over 40 lines.

    Its differences are whole multiples of the last decimal shown. If races may differ in length,
    the fairest race jumps back and forth between lengths, and there is no chart. `typical` gives a
    difference's uncertainty.
    """
    if offered.games is not None and offered.games[0] != offered.games[1]:
        return []
    decimals = decimals_of(typical.scale)
    unit = 10.0**-decimals
    # One step beyond, so that the furthest pair is in a band even where one begins with it.
    last = math.ceil(furthest / unit) + 1

    # From one band to the next the stronger gives one game more, or the weaker gets one.
    _, (most, least) = offered.fairest(typical.at([0.0, last * unit]))
    if most - least >= MOST_BANDS:
        return []
    difference = np.arange(last + 1) * unit
    stronger, weaker = offered.fairest(typical.at(difference))
    starts = np.flatnonzero(np.diff(stronger) | np.diff(weaker)) + 1
    bands = []
    for first, after in pairwise([0, *starts[starts < last].tolist(), last]):
        m, n = int(stronger[first]), int(weaker[first])
        ends = np.round(difference[[first, after]], decimals)
        chances = typical.at(difference[[first, after]]).win(m, n)
        (low, high), (p_low, p_high) = ends.tolist(), chances.tolist()
        bands.append(Band(low, high, m, n, p_low, p_high))
    return bands


NO_RACE = "-"
"""Shown in place of a race if two players can't be compared."""


MOST_ON_SHEET = 96
"""The most players on a sheet in any format: 16 pages of paper."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """A league's ratings, and the fairest race for each pair of the chosen players.

    Parameters
    ----------
    file, ratings
        the results, and the ratings from them.
    offered
        the races to choose from.
    rated, paired
        the tables from `Ratings.to_frame` and `matchups_frame`.
    choice
        how the prior was chosen, if it was.
    title
        the heading, such as the league's name; '' for none.

    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> file = ResultsFile(season, "season.csv", (), (), "0123456789abcdef")
    >>> sheet = Sheet.of(file, fit(season), OfferedRaces(race_to=7), [0, 1, 2])
    >>> sheet.races["Cy", "Ann"], sheet.strongest(2).races
    ('4:7', {('Ann', 'Bo'): '7:6', ('Bo', 'Ann'): '6:7'})
    """

    file: ResultsFile
    ratings: Ratings
    offered: OfferedRaces
    rated: pd.DataFrame
    paired: pd.DataFrame
    choice: PriorChoice | None = None
    title: str = ""

    @classmethod
    def of(
        cls,
        file: ResultsFile,
        ratings: Ratings,
        offered: OfferedRaces,
        players: Sequence[int],
        choice: PriorChoice | None = None,
        title: str = "",
    ) -> Sheet:
        """Return the sheet that pairs these players (positions in `ratings.players`)."""
        paired = matchups_frame(ratings, players, offered)
        return cls(file, ratings, offered, ratings.to_frame(), paired, choice, title)

    def __repr__(self) -> str:
        return f"<Sheet of {len(self.paired):,} pairs of {len(self.listed):,} players>"

    def strongest(self, most: int) -> Sheet:
        """Return the sheet with the races of only the first players on the list."""
        names = set(self.listed["player"].head(most))
        both = self.paired["player_a"].isin(names) & self.paired["player_b"].isin(names)
        return replace(self, paired=self.paired[both])

    @cached_property
    def listed(self) -> pd.DataFrame:
        """The rows of `rated` for the paired players; the index is the row there."""
        names = {*self.paired["player_a"], *self.paired["player_b"]}
        return self.rated[self.rated["player"].isin(names)]

    @cached_property
    def places(self) -> list[str]:
        """The place of each row of `rated`."""
        return places_in_list(self.rated["provisional"])

    @cached_property
    def races(self) -> dict[tuple[str, str], str]:
        """The race between each two players, from the first player's side."""
        return races_by_name(self.paired)

    @cached_property
    def sure(self) -> list[SurePair]:
        """How well each pair's difference is known, best known first."""
        return sure_pairs(self.paired, self.ratings.scale)

    @cached_property
    def bands(self) -> list[Band]:
        """The chart that the races make, empty if there is none.

        It is for a pair whose difference is as well known as the median pair's.
        """
        if not self.sure:
            return []
        furthest = max(pair.difference for pair in self.sure)
        return chart_bands(self.offered, self.typical, furthest)

    @property
    def typical(self) -> Gap:
        """The rating gap of an even pair that is at least as well known as half of the pairs."""
        error = self.sure[(len(self.sure) - 1) // 2].error if self.sure else 0.0
        return Gap(0.0, error, self.ratings.scale, self.ratings.match_form)

    @cached_property
    def summary(self) -> pd.DataFrame:
        """The sheet's sources and settings: the summary.csv table."""
        made = summary_frame(self.file, self.ratings, self.paired, self.offered)
        given = pd.DataFrame({"key": ["title"], "value": [self.title]}, dtype=object)
        return pd.concat([given, made], ignore_index=True) if self.title else made


def places_in_list(provisional: Iterable[bool]) -> list[str]:
    """Return places in a ratings list: 1, 2, ..., and P1, P2, ... for players without a place.

    >>> places_in_list([False, False, True, True])
    ['1', '2', 'P1', 'P2']
    """
    numbers = {False: count(1), True: count(1)}
    return [f"{'P' if few else ''}{next(numbers[bool(few)])}" for few in provisional]


def races_by_name(paired: pd.DataFrame) -> dict[tuple[str, str], str]:
    """Return the race between each two players as text, from the first player's side."""
    races = {}
    rows: Any = paired.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        races[pair.player_a, pair.player_b] = race((pair.race_a, pair.race_b))
        races[pair.player_b, pair.player_a] = race((pair.race_b, pair.race_a))
    return races


def summary_frame(
    file: ResultsFile, ratings: Ratings, paired: pd.DataFrame, offered: OfferedRaces
) -> pd.DataFrame:
    """Return a report's sources and settings, as rows of key and value.

    `components` is the number of components with games; `anchor` is each component's mean rating,
    and so the rating of a player without games; the prior's standard deviation is given in natural
    log-odds and in points on the scale.
    """
    scale = ratings.scale
    first, last = dates_of(file.results, ratings.as_of)
    rows: dict[str, object] = {
        "results_file": file_name(file),
        "results_sha256": fingerprints(file),
        "matches_read": len(file.results),
        "matches_used": ratings.matches,
        "forfeits_left_out": ratings.forfeits,
        "empty_left_out": ratings.empty,
        "later_left_out": ratings.later,
        "first_date": first,
        "last_date": last,
        "games": int(ratings.won.sum()),
        "player_count": len(ratings.players),
        "players_without_games": int(ratings.idle.sum()),
        "components": count_groups(ratings),
        "provisional_below_games": ratings.established_from,
        "players_provisional": int(ratings.provisional.sum()),
        "groups_of_similar_names": len(file.similar_names),
        "scale": f"{like_scale_words(scale)}; not an official rating",
        "points_per_doubling": scale.points_per_doubling,
        "anchor": ratings.anchor,
        "prior_sd_log_odds": ratings.prior_sd,
        "prior_sd_points": float(scale.points(ratings.prior_sd)),
        "joined_below_points": float(scale.points(ratings.levels.joined)),
        "newcomers_below_points": ratings.newcomer,
        "field_counts": ratings.levels.field,
        "race_counts": ratings.levels.race,
        "team_sd_points": float(scale.points(ratings.levels.team_sd)),
        "division_sd_points": float(scale.points(ratings.levels.division_sd)),
        "half_life_days": ratings.half_life,
        "match_form_log_odds": ratings.match_form,
        "as_of": None if ratings.as_of is None else str(ratings.as_of),
        "race_to": offered.race_to,
        "games_lo": offered.games[0] if offered.games else None,
        "games_hi": offered.games[1] if offered.games else None,
        "pairs": len(paired),
        "pairs_without_race": int(paired["race_a"].isna().sum()),
        "evenbreak_version": __version__,
    }
    return pd.DataFrame(
        {"key": list(rows), "value": pd.Series(list(rows.values()), dtype="object")}
    )


def count_groups(ratings: Ratings) -> int:
    """Return how many groups of players never met; a player without results isn't a group."""
    return len(np.unique(ratings.component[~ratings.idle]))


def dates_of(results: Results, as_of: np.datetime64 | None = None) -> tuple[str, str]:
    """Return the first and last dates, up to `as_of`, with a match; '' if unknown."""
    counted = results.played().results, results.won_only()
    stated = [part.date for part in counted if part.date is not None]
    days = np.concatenate(stated) if stated else np.zeros(0, "datetime64[D]")
    days = days[~np.isnat(days) if as_of is None else days <= as_of]
    return (str(days.min()), str(days.max())) if len(days) else ("", "")
