"""A season: its roster, with everything a simulation needs, and who plays who."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import array_values
from evenbreak.errors import InputError
from evenbreak.files.lists.entrants import check_one_scale, entered
from evenbreak.files.lists.roster import (
    FARTHEST,
    LAST_WEEK,
    OF_SEASON,
    ROSTER,
    WRITTEN,
    RosterFile,
    roster_of,
)
from evenbreak.files.lists.teams import PLACE, ROUND
from evenbreak.files.results.columns import RESULTS
from evenbreak.files.tables.names import KnownNames, Name, clean_name
from evenbreak.files.tables.problems import first_ones, quoted, refusal, warning
from evenbreak.files.tables.schema import Schema, Whole
from evenbreak.files.tables.table import TextTable
from evenbreak.league.players import ESTABLISHED, LeaguePlayers
from evenbreak.league.schedule import FixedSchedule
from evenbreak.ratings.roster import NOT_STATED, Roster
from evenbreak.ratings.scale import Scale
from evenbreak.words import listed, say, say_count

SEASON = ROSTER.but(rating={"least": -FARTHEST, "most": FARTHEST}) | WRITTEN | OF_SEASON
"""A season's roster."""


@array_values
@dataclass(frozen=True, eq=False)
class SeasonPlayers:
    """The players on a league's roster.

    Parameters
    ----------
    players
        as `Season` takes them, in file order; ratings in whole points.
    roster
        the same players as a list of ratings.
    source
        the file's name in messages.
    warnings
        one per line; the file can be used anyway.
    drawn
        the number of players whose skill is drawn from their rating and standard error.
    exact
        the number of players whose rating is used as their skill, because the file has neither a
        skill nor a standard error.
    scale
        the ratings' scale; None if the file doesn't state it.
    levels
        whether the column title says that the ratings are skill levels.
    teams, team_names
        each player's team, from 0, and the teams' names; None and empty in a league of individual
        players.
    """

    players: LeaguePlayers
    roster: Roster
    source: str
    warnings: tuple[str, ...]
    drawn: int
    exact: int
    scale: Scale | None = None
    levels: bool = False
    teams: NDArray[np.int64] | None = None
    team_names: tuple[str, ...] = ()


def read_season_players(path: str | Path, *, day_sd: float = 0.0) -> SeasonPlayers:
    r"""Read a season's roster from a CSV file; '-' is standard input.

    It has a roster's columns and the columns in `OF_SEASON`. If no skill is stated, it is drawn for
    each replica from a normal distribution around the rating with the standard error; if the
    standard error isn't stated either, the skill is the rating. A player without a rating is a
    newcomer: they get the median of the others' ratings, and a skill drawn around it with the
    others' spread. Ratings are rounded to whole points, halves upwards.

    Parameters
    ----------
    day_sd
        standard deviation of day-to-day form, in points, if the file doesn't state it.

    Raises
    ------
    DataError
        listing every problem in the file: the problems that `read_roster` finds, no rating at all,
        cells out of range, a player who leaves before joining.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "club.csv"
    ...     _ = path.write_text("player,rating,se,skill\nAnn,92.5,9,\nBo,71,9,75\nCy,60,,\n")
    ...     club = read_season_players(path)
    >>> club.players.rating, club.players.skill, club.players.skill_sd
    (array([93, 71, 60]), array([92.5, 75. , 60. ]), array([9., 0., 0.]))
    """
    table = SEASON.read(path)
    skill, days, joins, leaves = (table[name] for name in ("skill", "day_sd", "joins", "leaves"))
    table.note(
        (leaves > 0) & (leaves < joins),
        "leaves in week {leaves}, before week {joins}. Correct one of them.",
        leaves=leaves,
        joins=joins,
    )
    if len(table) == 1:
        table.problems.add(None, "has 1 player; a league needs two or more")
    in_teams = "team" in table.found
    if in_teams:
        table.note(table["team"] == "", "team is empty. Name each player's team.")
    file = roster_of(table)
    roster, newcomers = _with_newcomers(file)
    sd = np.where(np.isnan(skill), roster.standard_error, 0.0)
    whole = np.floor(roster.rating + 0.5)
    try:
        players = LeaguePlayers.of(
            whole.astype(np.int64),
            names=roster.players,
            skill=np.where(np.isnan(skill), roster.rating, skill),
            skill_sd=np.nan_to_num(sd),
            day_sd=np.where(np.isnan(days), day_sd, days),
            drift=np.nan_to_num(table["drift"]),
            joins=np.maximum(joins, 1),
            leaves=leaves,
            absence=np.nan_to_num(table["absence"]),
            # Players without a number of matches are established.
            played=np.where(roster.matches == NOT_STATED, ESTABLISHED, roster.matches),
        )
    except InputError as error:
        raise refusal(table.source, error.sentence) from None
    warnings = [*file.warnings, *newcomers]
    rounded = int((whole != roster.rating).sum())
    if rounded:
        note = say_count(
            "{n} rating was rounded to whole points, because charts need them",
            "{n:,} ratings were rounded to whole points, because charts need them",
            rounded,
        )
        warnings.append(warning(table.source, None, note))
    return SeasonPlayers(
        players,
        roster,
        table.source,
        tuple(warnings),
        drawn=int((sd > 0).sum()),
        exact=int(np.isnan(sd).sum()),
        scale=file.scale,
        levels=file.levels,
        **(_teams(table["team"].tolist()) if in_teams else {}),
    )


def _teams(names: list[str]) -> dict[str, Any]:
    """Return each player's team number, and the teams' names in that order."""
    every = tuple(dict.fromkeys(names))
    return {"teams": np.array([every.index(name) for name in names]), "team_names": every}


def _with_newcomers(file: RosterFile) -> tuple[Roster, list[str]]:
    """Return a roster in which newcomers have a rating, and warnings that name them."""
    roster = file.roster
    new, stated = np.isnan(roster.rating), roster.rating[~np.isnan(roster.rating)]
    if not new.any():
        return roster, []
    if not len(stated):
        raise refusal(file.source, "has no ratings at all. Fill in the ones you know.")
    middle, spread = float(np.median(stated)), float(stated.std())
    error = np.where(new & np.isnan(roster.standard_error), spread, roster.standard_error)
    started = replace(
        roster,
        rating=np.where(new, middle, roster.rating),
        standard_error=error,
        matches=np.where(new & (roster.matches == NOT_STATED), 0, roster.matches),
    )
    text = say_count(
        "{names} has no rating and starts as a newcomer at the median, {middle:g}",
        "{names} have no rating and start as newcomers at the median, {middle:g}",
        int(new.sum()),
        names=listed([quoted(roster.players[place]) for place in np.flatnonzero(new).tolist()]),
        middle=middle,
    )
    return started, [warning(file.source, None, text)]


def league_of_entrants(
    file: SeasonPlayers, entrants: RosterFile, *, starter: float, starter_sd: float
) -> SeasonPlayers:
    """Return the entrants as a league, including new players who aren't on its list.

    Parameters
    ----------
    entrants
        as `read_entrants` reads them.
    starter, starter_sd
        the rating for new players who have none in `entrants`, and its uncertainty (standard
        deviation); their skill is drawn around it.

    Raises
    ------
    DataError
        if fewer than two players have entered, or the two files' ratings are on different scales.
    """
    check_one_scale(file, entrants)
    if len(entrants.roster) < 2:
        raise refusal(entrants.source, "has 1 player; a league needs two or more")
    who = entered(entrants, file.roster.players, file.source)
    at = np.array(who.places, dtype=np.int64)
    new = at < 0
    own = np.where(np.isnan(entrants.roster.rating), starter, entrants.roster.rating)
    error = np.where(np.isnan(entrants.roster.rating), starter_sd, entrants.roster.standard_error)
    listed_players = file.players
    players = LeaguePlayers.of(
        np.where(new, np.floor(own + 0.5).astype(np.int64), listed_players.rating[at]),
        names=who.names,
        skill=np.where(new, own, listed_players.skill[at]),
        skill_sd=np.where(new, np.nan_to_num(error), listed_players.skill_sd[at]),
        day_sd=np.where(new, np.median(listed_players.day_sd), listed_players.day_sd[at]),
        drift=np.where(new, 0.0, listed_players.drift[at]),
        joins=np.where(new, 1, listed_players.joins[at]),
        leaves=np.where(new, 0, listed_players.leaves[at]),
        absence=np.where(new, 0.0, listed_players.absence[at]),
        played=np.where(new, 0, listed_players.played[at]),
    )
    roster = Roster(
        who.names,
        np.where(new, own, file.roster.rating[at]),
        np.where(new, error, file.roster.standard_error[at]),
    )
    exact = np.isnan(roster.standard_error) & (players.skill == roster.rating)
    return replace(
        file,
        players=players,
        roster=roster,
        warnings=(*file.warnings, *who.warnings),
        drawn=int((players.skill_sd > 0.0).sum()),
        exact=int(exact.sum()),
        scale=file.scale or entrants.scale,
        levels=file.levels or entrants.levels,
    )


_NOBODY = KnownNames(())


@dataclass(frozen=True, kw_only=True)
class _OfRoster(Name):
    """Names of players as places in a roster."""

    players: KnownNames = _NOBODY
    write: str = say("a name from the roster")
    nothing: int = -1

    dtype: ClassVar[Any] = np.int64

    def meaning(self, text: str) -> int | None:
        """Return the place."""
        return self.players.place(clean_name(text))

    def fault(self, text: str) -> str:
        """Return what is wrong with a name that isn't in the roster."""
        name = clean_name(text)
        if not name:
            return super().fault("")
        return say(
            "{name} isn't in the roster{hint}. Write names as they are in the roster.",
            name=quoted(name),
            hint=self.players.hint(name),
        )


PAIRS = Schema(
    "pairs",
    player_a=_OfRoster(RESULTS["player_a"].also, "one of the two players", needed=True),
    player_b=_OfRoster(RESULTS["player_b"].also, "the other player", needed=True),
)
"""A list of who plays who."""

SCHEDULE = Schema(
    "matches",
    week=Whole(
        "round, night, matchday, week number",
        "the week",
        needed=True,
        filled=True,
        least=1,
        most=LAST_WEEK,
        write=say("1 for the first week, 2, ..."),
    ),
    **PAIRS.columns,
    **ROUND.only("date").columns,
    **PLACE.columns,
)
"""A list of who plays who and in which week."""

MOST_LISTED = 5
"""How many repeated matches are listed; the others are only counted."""


@dataclass(frozen=True, eq=False)
class PairsFile:
    """Who plays who: places in the roster, shape (matches, 2), in file order."""

    pairs: NDArray[np.int64]
    warnings: tuple[str, ...]


def read_pairs(path: str | Path, roster: Roster) -> PairsFile:
    """Read a list of pairs from a CSV file, one match per row; '-' is standard input.

    Case is ignored unless that would be ambiguous. Raises DataError listing every problem: missing
    columns, no rows, unknown names, a player on both sides.
    """
    table, pairs = _read(PAIRS, path, roster)
    return PairsFile(pairs, table.warnings)


def _read(schema: Schema, path: str | Path, roster: Roster) -> tuple[TextTable, NDArray[np.int64]]:
    """Return a table without problems, and its pairs as places in the roster."""
    players = {"players": KnownNames(roster.players)}
    table = schema.but(player_a=players, player_b=players).read(path)
    a, b = table["player_a"], table["player_b"]
    for row in np.flatnonzero((a == b) & (a >= 0)):
        name = quoted(roster.players[a[row]])
        table.note(row, "{name} is on both sides. Write two different players.", name=name)
    table.problems.raise_any()
    return table, np.column_stack([a, b])


@dataclass(frozen=True, eq=False)
class ScheduleFile:
    """The content of a fixtures file.

    Parameters
    ----------
    source
        the file's name in messages.
    warnings
        one per line; the file can be used anyway.
    """

    schedule: FixedSchedule
    source: str
    warnings: tuple[str, ...]


def read_schedule(path: str | Path, roster: Roster) -> ScheduleFile:
    r"""Read a schedule from a CSV file, one match per row; '-' is standard input.

    Names are matched to the roster as in `read_pairs`; weeks are numbered from 1, in any order, and
    a player may have several matches in a week.

    Raises
    ------
    DataError
        listing every problem in the file: missing columns, no rows, weeks that are not whole
        numbers from 1 up, names that are not in the roster, a player who plays themselves.

    >>> import tempfile, pathlib
    >>> club = Roster(["Ann", "Bo", "Cy"], [92, 71, 80])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "fixtures.csv"
    ...     _ = path.write_text("week,player_a,player_b\n1,Cy,Ann\n2,bo,Cy\n")
    ...     schedule = read_schedule(path, club).schedule
    >>> schedule.weeks, schedule.a, schedule.b
    (2, array([2, 1]), array([0, 2]))
    """
    table, pairs = _read(SCHEDULE, path, roster)
    week = table["week"]
    warnings = *table.warnings, *_twice(table, week, pairs)
    return ScheduleFile(FixedSchedule(week, *pairs.T), table.source, warnings)


def _twice(table: TextTable, week: NDArray[np.int64], pairs: NDArray[np.int64]) -> list[str]:
    """Return a warning for each match that is already listed in the same week."""
    _, first, same = np.unique(
        np.column_stack([week, np.sort(pairs, axis=1)]),
        axis=0,
        return_index=True,
        return_inverse=True,
    )
    earlier = first[same.ravel()]
    again = np.flatnonzero(earlier != np.arange(len(week)))
    warnings = [
        warning(
            table.source,
            table.lines[row],
            "these two players already meet in week {week} (line {line}); both matches will be "
            "played",
            week=week[row],
            line=table.lines[earlier[row]],
        )
        for row in again.tolist()
    ]
    return first_ones(
        warnings,
        MOST_LISTED,
        table.source,
        lambda n: say_count("and {n} more such match", "and {n:,} more such matches", n),
    )
