"""Reading the players of one team, with their skill levels for caps."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from evenbreak.arrays import Floats, array_values
from evenbreak.errors import DataError
from evenbreak.files.cells import numbers
from evenbreak.files.player_names import clean_name
from evenbreak.files.roster import OPTIONAL, REQUIRED, WRITTEN, RosterFile, roster_of
from evenbreak.files.text_table import TextTable, read_table
from evenbreak.files.typed_list import read_players

_LEVELS = ("skill level", "handicap", "sl")
COLUMNS = {"player": (*REQUIRED["player"], "team player")}
MORE = {
    "rating": tuple(name for name in REQUIRED["rating"] if name not in (*_LEVELS, "level")),
    "level": _LEVELS,
    **OPTIONAL,
    **WRITTEN,
    "team": (),
    "division": (),
}


@array_values
@dataclass(frozen=True)
class TeamList:
    """The players of one team.

    Parameters
    ----------
    file
        their names and ratings; the levels stand in for the ratings where the file has no others.
    levels
        each player's skill level; NaN where the file states none.
    """

    file: RosterFile
    levels: Floats

    @property
    def weights(self) -> Floats:
        """What a cap counts: the levels, or the ratings where the file states no level."""
        return self.file.roster.rating if np.isnan(self.levels).all() else self.levels

    @property
    def without_weight(self) -> str:
        """A player for whom there is nothing to count; '' if there is none."""
        unknown = np.isnan(self.weights)
        return self.file.roster.players[int(unknown.argmax())] if unknown.any() else ""


def read_team(path: str | Path) -> TeamList:
    r"""Read a team from a CSV file with the columns player, rating and level.

    Either of rating and level may be missing. Other columns are those of a roster. Without a
    header, each line is a name and the rating and the level if they are known.

    Raises
    ------
    DataError
        with every problem of the file: no players, a name that appears twice, cells that are not
        numbers.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "team.csv"
    ...     _ = path.write_text("player,rating,level\nAnn,612,6\nBo,540,5\n")
    ...     team = read_team(path)
    >>> team.file.roster.rating, team.levels
    (array([612., 540.]), array([6., 5.]))
    """
    return _team_of(read_players(path, COLUMNS, MORE, numbers=("rating", "level")))


def read_squads(path: str | Path) -> dict[str, TeamList]:
    r"""Read all teams of a league from a CSV file with the columns team, player, rating and level.

    Raises
    ------
    DataError
        with every problem of a team as for `read_team`, if a player has no team, or there are
        fewer than two teams.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "teams.csv"
    ...     _ = path.write_text("team,player,rating\nRacks,Ann,612\nCues,Bo,540\nRacks,Cy,500\n")
    ...     {team: one.file.roster.players for team, one in read_squads(path).items()}
    {'Racks': ('Ann', 'Cy'), 'Cues': ('Bo',)}
    """
    table = read_table(path, {"team": MORE["team"], **COLUMNS}, MORE, rows="players")
    teams: dict[str, list[int]] = {}
    for line, name in zip(table.lines.tolist(), map(clean_name, table.cells("team")), strict=True):
        if not name:
            table.problems.add(line, "team is empty; name the team of each player")
        teams.setdefault(name, []).append(line)
    table.problems.raise_any()
    if len(teams) < 2:
        raise DataError([f"{table.source}: names one team only; a league has two or more"])
    every = set(table.lines.tolist())
    return {name: _team_of(table.without(every - set(lines))) for name, lines in teams.items()}


def _team_of(table: TextTable) -> TeamList:
    levels = numbers(
        table, "level", at_least=0, at_most=1000, remedy="write a skill level", may_be_empty=True
    ).values
    if "rating" not in table and "level" in table:
        table = replace(
            table,
            columns={**table.columns, "rating": table.columns["level"]},
            found=table.found | {"rating"},
            titles={**table.titles, "rating": table.titles["level"]},
        )
    return TeamList(roster_of(table), np.asarray(levels))
