"""Teams: the players on one team or all teams, and a season's matches, played and upcoming."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial
from itertools import compress
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Floats, Ints, array_values
from evenbreak.files.lists.roster import ROSTER, WRITTEN, RosterFile, roster_of
from evenbreak.files.lists.typed_list import read_players
from evenbreak.files.results.columns import LAYOUTS, RESULTS
from evenbreak.files.results.matches import with_scores_apart
from evenbreak.files.results.proposals import TEAMS as TEAMS_CALLED
from evenbreak.files.results.proposals import columns_hint
from evenbreak.files.results.results_file import columns_of_file
from evenbreak.files.results.statuses import played_matches
from evenbreak.files.tables.header import missing_column
from evenbreak.files.tables.names import Name, same_name
from evenbreak.files.tables.problems import quoted, refusal, warning
from evenbreak.files.tables.schema import Number, Schema, Text, Whole
from evenbreak.files.tables.similar_names import similar_name_warnings, similar_names
from evenbreak.files.tables.table import TextTable
from evenbreak.ratings.roster import Roster
from evenbreak.words import say

TEAM = (
    ROSTER.but(
        player={"also": f"{ROSTER['player'].also}, team player"},
        rating={"also": ", ".join(a for a in ROSTER["rating"].aliases if a != "handicap")},
        level={"also": f"{ROSTER['level'].also}, handicap"},
    )
    | WRITTEN
    | Schema(team=Text(), division=Text())
)
"""A team's players."""

SQUADS = TEAM | Schema(team=Name(about="the player's team", write=say("each player's team")))
"""All teams' players."""


def _side(also: str, about: str) -> Name:
    return Name(also, about, needed=True, write=say("the team's name"))


_SETS = Whole(needed=True, empty=None, instead=("score",))
ROUND = Schema(
    round=Text("week, matchday, night", "the round; without this column, the date is used"),
    date=Text("day, match date", "the date"),
)
PLACE = Schema(
    venue=Text("location, place", "where the match is played"),
    table=Text("table number", "the table"),
    turn=Text("", "whether the match is the first on its table that night, the second, ..."),
)
PAIR = Schema(
    "matches",
    home=_side("home team, team a, team 1, player a, a", "the home team"),
    away=_side(
        "away team, visitor, visitors, guest, team b, team 2, player b, b", "the visiting team"
    ),
)
FIXTURES = PAIR | ROUND | PLACE
"""The upcoming matches in a team season."""

TEAM_RESULTS = (
    PAIR
    | Schema(
        home_score=_SETS.called(
            "home sets, home points, score home, score a, score 1",
            "the sets that the home team won",
        ),
        away_score=_SETS.called(
            "away sets, away points, score away, score b, score 2", "the sets that the visitors won"
        ),
    )
    | LAYOUTS.only("score", "status", "remark")
    | Schema(forfeit=RESULTS["forfeit"])
    | ROUND
    | PLACE
)
"""The matches in a team season; matches with no score, or with 0:0, haven't been played."""

TEAMS = Schema(
    "teams",
    team=Name("name, team name", "the team's name; each team is listed once", needed=True),
    points=Number(
        "head start, bonus, deduction, adjustment",
        "extra points, on top of the points that the team won in matches",
        least=-10_000,
        most=10_000,
        write=say("points such as -2"),
    ),
    venue=Text("home venue, location, place", "where the team plays its home matches"),
    tables=Text("tables there", "the number of tables at that venue"),
)
"""The teams in a league."""


@array_values
@dataclass(frozen=True)
class TeamList:
    """A team's players.

    Parameters
    ----------
    file
        their names and ratings; levels are used as ratings if the file has no ratings.
    levels
        each player's skill level; NaN if the file states none.
    """

    file: RosterFile
    levels: Floats

    @property
    def weights(self) -> Floats:
        """What a cap counts: the levels, or the ratings if the file states no levels."""
        return self.file.roster.rating if np.isnan(self.levels).all() else self.levels

    def without(self, places: Collection[int]) -> TeamList:
        """Return the list without the players in some places."""
        kept = np.array([k for k in range(len(self.levels)) if k not in places], dtype=np.int64)
        roster = self.file.roster
        some = {one.name: getattr(roster, one.name)[kept] for one in fields(roster)[1:]}
        names = [roster.players[place] for place in kept.tolist()]
        left = Roster(names, some.pop("rating"), some.pop("standard_error"), **some)
        file = replace(self.file, roster=left, lines=self.file.lines[kept])
        return TeamList(file, self.levels[kept])

    @property
    def without_weight(self) -> str:
        """A player with nothing that a cap can count; '' if there is none."""
        unknown = np.isnan(self.weights)
        return self.file.roster.players[int(unknown.argmax())] if unknown.any() else ""


def form_of_lists(forms: Iterable[float]) -> float:
    """Return the average day-to-day form of teams whose lists state it.

    >>> form_of_lists([0.3, 0.0]), round(form_of_lists([0.3, 0.4]), 3), form_of_lists([0.0])
    (0.3, 0.354, 0.0)
    """
    stated = [form**2 for form in forms if form]
    return math.sqrt(sum(stated) / len(stated)) if stated else 0.0


def read_team(path: str | Path) -> TeamList:
    r"""Read a team from a CSV file with the columns player, rating and level.

    Rating or level may be missing. The other columns are the same as a roster's. Without a header,
    each line is a name, followed by the rating and the level if they are known.

    Raises
    ------
    DataError
        listing every problem in the file: no players, a name that appears twice, cells that are not
        numbers.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "team.csv"
    ...     _ = path.write_text("player,rating,level\nAnn,612,6\nBo,540,5\n")
    ...     team = read_team(path)
    >>> team.file.roster.rating, team.levels
    (array([612., 540.]), array([6., 5.]))
    """
    return _team_of(read_players(path, TEAM, numbers=("rating", "level")))


def read_squads(path: str | Path) -> dict[str, TeamList]:
    r"""Read all a league's teams from a CSV file with the columns team, player, rating and level.

    Raises
    ------
    DataError
        listing every problem in a team as for `read_team`, players without a team, and fewer than
        two teams.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "teams.csv"
    ...     _ = path.write_text("team,player,rating\nRacks,Ann,612\nCues,Bo,540\nRacks,Cy,500\n")
    ...     {team: one.file.roster.players for team, one in read_squads(path).items()}
    {'Racks': ('Ann', 'Cy'), 'Cues': ('Bo',)}
    """
    table = SQUADS.only("team").of(SQUADS.text(path))
    if "team" not in table:
        table.problems.add(table.header, missing_column("team", SQUADS["team"].aliases))
    teams: dict[str, list[int]] = {}
    for line, name in zip(table.lines.tolist(), table["team"], strict=True):
        teams.setdefault(name, []).append(line)
    table.problems.raise_any()
    if len(teams) < 2:
        raise refusal(table.source, "has only one team; a league needs two or more")
    every = set(table.lines.tolist())
    return {name: _team_of(table.without(every - set(lines))) for name, lines in teams.items()}


def _team_of(table: TextTable) -> TeamList:
    file = roster_of(TEAM.of(table), rated=False)
    return TeamList(file, file.roster.level)


@array_values
@dataclass(frozen=True)
class TeamMatches:
    """The matches in a file.

    Parameters
    ----------
    pairs
        home and away: positions in the list of teams, one match per row.
    scores
        the sets that each team won, one match per row; upcoming matches have no columns.
    rounds
        the round, week or date in the file; '' if it has none.
    warnings
        one per line; the file can be used anyway.
    """

    pairs: Ints
    scores: Ints
    rounds: tuple[str, ...]
    warnings: tuple[str, ...]

    def among(self, rows: NDArray[np.bool_]) -> TeamMatches:
        """Return the matches in some rows."""
        rounds = tuple(compress(self.rounds, rows))
        return replace(self, pairs=self.pairs[rows], scores=self.scores[rows], rounds=rounds)


@dataclass
class TeamNames:
    """The teams, in order of first appearance in the files."""

    names: list[str]
    fixed: bool = False

    def place(self, name: str) -> int | None:
        """Return a team's position, adding new teams unless the list is fixed."""
        wanted = same_name(name)
        for place, own in enumerate(self.names):
            if same_name(own) == wanted:
                return place
        if self.fixed:
            return None
        self.names.append(name)
        return len(self.names) - 1


def read_teams(path: str | Path) -> tuple[TeamNames, Floats, tuple[str, ...]]:
    r"""Read a league's teams, and any points they have apart from their matches.

    Raises
    ------
    DataError
        listing every problem in the file.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "teams.csv"
    ...     _ = path.write_text("team,points\nAcers,\nBankers,-2\n")
    ...     teams, points, _ = read_teams(path)
    >>> teams.names, points.tolist()
    (['Acers', 'Bankers'], [0.0, -2.0])
    """
    table = TEAMS.read(path)
    teams = TeamNames([])
    for line, name in zip(table.lines.tolist(), table["team"], strict=True):
        before = len(teams.names)
        if name and teams.place(name) != before:
            table.problems.add(
                line, "team {name} is listed twice. Delete one of the two.", name=quoted(name)
            )
    table.problems.raise_any()
    points = np.nan_to_num(table["points"])
    return TeamNames(teams.names, fixed=True), points, table.warnings


def read_team_results(
    path: str | Path, teams: TeamNames, *, columns: Mapping[str, str] | None = None
) -> tuple[TeamMatches, TeamMatches]:
    r"""Read matches, played and unplayed, with the sets that each team won.

    A match without a score, or with 0:0, has not been played. `columns` has column titles, as for
    `read_results`.

    Raises
    ------
    DataError
        listing every problem in the file.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "results.csv"
    ...     rows = "home,away,home_score,away_score\nAcers,Bankers,3,2\nBankers,Acers,,\n"
    ...     _ = path.write_text(rows)
    ...     played, to_come = read_team_results(path, TeamNames([]))
    >>> played.pairs.tolist(), played.scores.tolist(), to_come.pairs.tolist()
    ([[0, 1]], [[3, 2]], [[1, 0]])
    """
    table, _ = played_matches(
        TEAM_RESULTS.text(
            path,
            called=columns_of_file(columns or {}, path),
            hint=partial(columns_hint, called=TEAMS_CALLED),
        ),
        tuple(PAIR.columns),
        to_come=True,
    )
    table = TEAM_RESULTS.of(with_scores_apart(table, ("home_score", "away_score")))
    home, away = table.read["home_score"], table.read["away_score"]
    table.note(
        table["forfeit"] & (home.values + away.values == 0),
        "is a forfeit without a score. Write how many sets each team gets for it, such as 3 and 0.",
    )
    table.note(
        (home.stated != away.stated) & home.good & away.good,
        "one score is empty. Write both, or neither if the match wasn't played.",
    )
    scores = np.stack([home.values, away.values], axis=1)
    unplayed = (scores.sum(axis=1) == 0) & home.good & away.good
    every = _matches(table, teams, scores)
    if unplayed.all():
        raise refusal(table.source, "none of its matches has been played. Fill in the scores.")
    to_come = replace(every.among(unplayed), scores=np.zeros((unplayed.sum(), 0), dtype=np.int64))
    return every.among(~unplayed), replace(to_come, warnings=())


def read_fixtures(path: str | Path, teams: TeamNames) -> TeamMatches:
    """Read the upcoming matches: home and away, and the round if the file has it.

    Raises
    ------
    DataError
        listing every problem in the file.
    """
    table = FIXTURES.read(path)
    return _matches(table, teams, np.zeros((len(table), 0), dtype=np.int64))


def _matches(table: TextTable, teams: TeamNames, scores: Ints) -> TeamMatches:
    pairs = np.zeros((len(table), 2), dtype=np.int64)
    sides = zip(table["home"], table["away"], strict=True)
    for row, (line, both) in enumerate(zip(table.lines.tolist(), sides, strict=True)):
        for side, (column, name) in enumerate(zip(PAIR.columns, both, strict=True)):
            place = teams.place(name) if name else 0  # an empty cell is a problem already
            if place is None:
                table.problems.add(
                    line,
                    "{column} {name} isn't in the list of teams. Write the team's name.",
                    column=column,
                    name=quoted(name),
                )
            else:
                pairs[row, side] = place
        if both[0] and same_name(both[0]) == same_name(both[1]):
            table.problems.add(
                line, "{name} is on both sides. Correct one of the teams.", name=quoted(both[0])
            )
    table.problems.raise_any()
    rounds = tuple(table.cells("round" if "round" in table else "date"))
    twice = _twice(table, pairs, scores, rounds, teams.names)
    similar: Sequence[str] = ()
    if not teams.fixed:
        similar = similar_name_warnings(
            similar_names(teams.names),
            table.source,
            say("If so, write both the same way."),
            of=say("team"),
        )
    return TeamMatches(pairs, scores, rounds, (*table.warnings, *similar, *twice))


def _twice(
    table: TextTable, pairs: Ints, scores: Ints, rounds: Sequence[str], names: Sequence[str]
) -> list[str]:
    """Return warnings about matches that may be entered twice, and teams twice in a round."""
    seen: dict[tuple[object, ...], int] = {}
    busy: dict[tuple[str, int], int] = {}
    warnings: list[str] = []

    def warn(text: str, line: int) -> None:
        warnings.append(warning(table.source, line, text))

    for row, line in enumerate(table.lines.tolist()):
        home, away = pairs[row].tolist()
        key = (home, away, rounds[row], *scores[row].tolist())
        if key in seen:
            again = say(
                "{home} against {away} is already in line {line}; if it was entered twice, "
                "delete one",
                home=names[home],
                away=names[away],
                line=seen[key],
            )
            warn(again, line)
            continue
        seen[key] = line
        for team in (home, away) if rounds[row] else ():
            if (rounds[row], team) in busy:
                also = say(
                    "{team} already plays in round {round}, in line {line}",
                    team=names[team],
                    round=rounds[row],
                    line=busy[rounds[row], team],
                )
                warn(also, line)
            busy.setdefault((rounds[row], team), line)
    return warnings
