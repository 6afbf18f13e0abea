"""Participants in a round robin, and lists of fixtures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from evenbreak.files.lists.teams import PAIR, TEAM
from evenbreak.files.lists.typed_list import read_players
from evenbreak.files.tables.dates import Day
from evenbreak.files.tables.names import same_name
from evenbreak.files.tables.problems import quoted
from evenbreak.files.tables.schema import Schema, Text, Whole
from evenbreak.league.tables.fixtures import Fixture, left_of
from evenbreak.league.tables.table import player_matches, team_matches
from evenbreak.ratings.results import Results

SIDES = TEAM.but(player={"instead": ("team",)}, team={"also": "team name"}) | Schema(
    venue=Text("home venue, location, place", "where the team plays its home matches"),
    tables=Whole("tables there", "the number of tables at that venue", most=1000),
)
"""The participants: players, or teams with their venues."""

FIXTURE_LIST = PAIR | Schema(
    round=Whole("week, matchday, night", "the round", most=10_000),
    date=Day("day, match date", "the day"),
    venue=Text("location, place", "where it is played"),
    table=Whole("table number", "the table", most=1000),
    turn=Whole("", "whether it's the first match there that night, the second, ...", most=1000),
)
"""Fixtures as written by `league fixtures`."""


@dataclass(frozen=True)
class Sides:
    """The participating teams or players, in file order; venues may be ''."""

    names: tuple[str, ...]
    of_teams: bool
    venues: tuple[str, ...]
    tables: dict[str, int]
    warnings: tuple[str, ...]


def read_sides(path: str | Path, *, of: str | None = None) -> Sides:
    r"""Read the participants: a list of names, a roster, or a list of teams with their venues.

    Parameters
    ----------
    of
        'players' or 'teams'; None: teams if the file has a column team.

    Raises
    ------
    DataError
        listing every problem in the file: fewer than two names, or a player listed twice.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "teams.csv"
    ...     _ = path.write_text("team,venue,tables\nAcers,Corner,2\nBankers,Corner,\nCaroms,,\n")
    ...     sides = read_sides(path)
    >>> sides.names, sides.venues, sides.tables
    (('Acers', 'Bankers', 'Caroms'), ('Corner', 'Corner', ''), {'Corner': 2})
    """
    table = SIDES.only("player", "team", "venue", "tables").of(read_players(path, SIDES))
    teams = "team" in table if of is None else of == "teams"
    column = "team" if teams else "player"
    if column not in table:
        table.problems.add(
            None, "has no column {column}. Add it, or ask for the other table.", column=column
        )
        table.problems.raise_any()
    names: dict[str, str] = {}
    venues: dict[str, str] = {}
    for line, name, venue in zip(
        table.lines.tolist(), table.cells(column), table.cells("venue"), strict=True
    ):
        if not name.strip():
            continue
        known = same_name(name)
        if known in names and not teams:
            table.problems.add(line, "{name} is listed twice. Delete one.", name=quoted(name))
        names.setdefault(known, " ".join(name.split()))
        venues[known] = venues.get(known) or venue.strip()
    if len(names) < 2:
        table.problems.add(None, "has fewer than two names. List everyone who is taking part.")
    table.problems.raise_any()
    tables = {
        venue.strip(): int(many)
        for venue, many in zip(table.cells("venue"), table["tables"].tolist(), strict=True)
        if many
    }
    return Sides(
        tuple(names.values()), teams, tuple(venues[key] for key in names), tables, table.warnings
    )


def read_fixture_list(path: str | Path) -> tuple[list[Fixture], tuple[str, ...]]:
    r"""Read fixtures, and anything to check in their file.

    Raises
    ------
    DataError
        listing every problem in the file.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "fixtures.csv"
    ...     _ = path.write_text("round,date,home,away\n1,2026-09-01,Acers,Bankers\n")
    ...     read_fixture_list(path)[0][0].date
    datetime.date(2026, 9, 1)
    """
    table = FIXTURE_LIST.read(path)
    for row, (home, away) in enumerate(zip(table["home"], table["away"], strict=True)):
        if home and same_name(home) == same_name(away):
            table.note(row, "{name} is on both sides. Correct one of the names.", name=quoted(home))
    table.problems.raise_any()
    days = [None if np.isnat(day) else day.astype(object) for day in table["date"]]
    columns = (
        table["round"].tolist(),
        table["home"],
        table["away"],
        days,
        table["venue"],
        table["table"].tolist(),
        [max(turn, 1) for turn in table["turn"].tolist()],
    )
    return [Fixture(*row) for row in zip(*columns, strict=True)], table.warnings


def without_played(
    listed: Sequence[Fixture], results: Results
) -> tuple[list[Fixture], set[str], int]:
    """Return the fixtures that haven't been played yet, according to the results.

    Also return the names that are in the results but in no fixture, and how many matches were
    played outside the fixtures. The matches are team matches unless the fixtures name players.

    >>> season = Results.from_names(["Ann"], ["Bo"], [5], [3])
    >>> without_played([Fixture(1, "Bo", "Ann"), Fixture(2, "Ann", "Cy")], season)[0][0].away
    'Cy'
    """
    keys = [(same_name(one.home), same_name(one.away)) for one in listed]
    known = {name for key in keys for name in key}
    teams = results.team_a is not None and (results.team_a != "").any()
    teams = teams and not known & set(map(same_name, results.players))
    matches = team_matches(results) if teams else player_matches(results)
    place = {name: k for k, name in enumerate(sorted(known))}
    at = [place.get(same_name(name), -1) for name in matches.names]
    pairs = [(at[a], at[b]) for a, b in matches.pairs.tolist() if min(at[a], at[b]) >= 0]
    kept = left_of([(place[a], place[b]) for a, b in keys], pairs)
    unknown = {name for name, k in zip(matches.names, at, strict=True) if k < 0}
    return [listed[k] for k in kept], unknown, len(matches) - len(listed) + len(kept)
