"""Reading a list of rated players as a `Roster`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

import numpy as np

from evenbreak.arrays import array_values
from evenbreak.errors import InputError
from evenbreak.files.tables.header import missing_column
from evenbreak.files.tables.names import Name, hidden_letter_warnings, same_name
from evenbreak.files.tables.problems import quoted, warning
from evenbreak.files.tables.schema import Number, Parsed, Schema, Text, Whole, YesNo
from evenbreak.files.tables.similar_names import similar_name_warnings, similar_names
from evenbreak.files.tables.table import TextTable
from evenbreak.ratings.roster import NOT_STATED, Roster
from evenbreak.ratings.scale import SCALES, Scale, refuse_contradicted, scale_of, unstated_scale
from evenbreak.words import say

if TYPE_CHECKING:
    from numpy.typing import NDArray

LARGEST = 1_000_000
"""The largest rating or error accepted, in points."""

_ERROR = Number(least=0, most=LARGEST, write=say("points such as 9.5"))
_COUNT = Whole(nothing=NOT_STATED)


def _known_scale(text: str) -> Scale | None:
    try:
        scale: Scale = scale_of(text.replace(",", "."))
    except InputError:
        return None
    return scale


ROSTER = Schema(
    "players",
    player=Name(
        "name, player name, full name",
        "the player's name; each name is listed once",
        needed=True,
        instead=("given_name surname",),
    ),
    given_name=Text("", "used with `surname`, or with the rest of the name in `player`"),
    surname=Text("", "used with `given_name`, instead of `player`"),
    rating=Number(
        "points, handicap, fargo rating, fargo, elo",
        "the rating; the column title may name the scale (`Fargo rating`, `Elo`); not needed if "
        "there are levels",
        least=-LARGEST,
        most=LARGEST,
        grouped=True,
        write=say("points such as 85"),
        empty=say("for a new player"),
    ),
    effective_rating=Number(
        "",
        "in a list saved from FargoRate: the provisional rating of a player whose `rating` is 0 "
        "because they have fewer than 200 games",
        least=0,
        most=LARGEST,
        write=say("points such as 85"),
    ),
    level=Number(
        "skill level, sl",
        "the skill level, for charts by skill level and for caps. If there are no ratings, the "
        "levels replace them; this requires a chart by skill level, or `--scale` with the "
        "number of levels that doubles the odds",
        least=0,
        most=1000,
        write=say("a skill level"),
    ),
    standard_error=_ERROR.called(
        "se, sd, error, plus or minus, uncertainty",
        "how far off the rating may be: one standard deviation, in rating points",
    ),
    quasi_error=_ERROR.called(
        "quasi standard error, qse",
        "the standard error for rating differences, which leaves out the uncertainty that all "
        "ratings share; used instead of `standard_error` if given",
    ),
    games=_COUNT.called(
        "games played, racks, robustness",
        "the number of games that the rating is based on; 0 for a new player",
    ),
    component=Whole(
        "group", "players linked by a chain of opponents have the same number", least=1
    ),
    matches=_COUNT.called(
        "matches played",
        "how many matches the player has played, for [systems](systems.md) with larger steps "
        "for newcomers; players without a value are treated as established",
    ),
    provisional=YesNo(
        "preliminary",
        "whether the rating is based on too few games for the player to be ranked",
        values={"yes": True, "no": False, "true": True, "false": False, "1": True, "0": False},
    ),
    races_won=_COUNT.called(
        "",
        "matches won for which only the winner is known; like games, they show that a player "
        "isn't new",
    ),
    races_lost=_COUNT.called("", "matches lost for which only the winner is known"),
    match_form=Number(
        about="[day-to-day form](../explanation/ratings.md#day-to-day-form): how much the "
        "log-odds of a game vary from match to match; the same in every row",
        least=0,
        most=3,
        write=say("the standard deviation of log-odds from 0 to 3, such as 0.35"),
    ),
    scale=Parsed(
        "rating scale, points that double the odds",
        "the scale of all ratings; the same in every row",
        parse=_known_scale,
        nothing=None,
        kind=say("a scale"),
        write=say("{scales} or the points that double the odds", scales=", ".join(SCALES)),
    ),
)

WRITTEN = Schema(
    **dict.fromkeys(
        (
            *("won", "lost"),
            *("rating_before", "change", "matches_won", "matches_lost", "why"),
            *("prior_mean", "prior", "as_of"),
        ),
        Text(),
    )
)
"""Additional columns in the lists that `evenbreak rate` and `evenbreak report` write."""


FARTHEST = 10_000
"""The largest rating or skill that can be simulated, in points."""

LARGEST_SD = 1_000
"""The largest standard deviation, or drift per week, that can be simulated, in points."""

LAST_WEEK = 10_000
"""The largest number accepted as a week."""

_WEEK = Whole(most=LAST_WEEK, write=say("1 for the first week, 2, ..."))

OF_SEASON = Schema(
    skill=Number(
        "true skill, true rating, strength",
        "the player's true skill at the start, in points. If this is empty, a skill is drawn "
        "for each season from a normal distribution around the rating, with `standard_error` "
        "as its standard deviation; if that is empty too, the rating is treated as exact",
        least=-FARTHEST,
        most=FARTHEST,
        write=say("points such as 85"),
    ),
    day_sd=Number(
        "day, day fluctuation, form",
        "how much the skill varies from day to day: one standard deviation, in points; if this "
        "is empty, `--day-sd` applies",
        least=0,
        most=LARGEST_SD,
        write=say("points such as 5"),
    ),
    drift=Number(
        "points a week, improves by",
        "how many points the true skill rises each week",
        least=-LARGEST_SD,
        most=LARGEST_SD,
        write=say("points a week such as 0.1"),
    ),
    joins=_WEEK.called("first week, joins in week", "the player's first week; 1 if empty"),
    leaves=_WEEK.called(
        "last week, leaves after week", "the player's last week; empty or 0 if they stay to the end"
    ),
    absence=Number(
        "absent, p absent",
        "the chance that the player misses a week; 0 if empty",
        least=0,
        most=1,
        write=say("the chance of being absent, such as 0.1"),
    ),
    team=Name(
        "team name, club",
        "the player's team, in a team league; the fixtures are then between teams",
        write=say("each player's team"),
    ),
)
"""The columns that a simulated season adds to a roster; other readers skip them."""

# Each name by itself: two columns with one meaning are a problem only for a season.
_SKIPPED = Schema(
    **{
        title: Text()
        for name, column in OF_SEASON.columns.items()
        for title in (name, *column.aliases)
    }
)


class RatedList(Protocol):
    """A file of rated players: a roster, or a season's file."""

    @property
    def roster(self) -> Roster:
        """The players and their ratings."""

    @property
    def source(self) -> str:
        """What messages call the file."""

    @property
    def scale(self) -> Scale | None:
        """The ratings' scale; None if the file doesn't state it."""

    @property
    def levels(self) -> bool:
        """Whether the ratings are skill levels."""


@array_values
@dataclass(frozen=True, eq=False)
class RosterFile:
    """The content of a list of rated players.

    Parameters
    ----------
    source
        the file's name in messages.
    warnings
        things to check although the file can be used, one per line.
    sha256
        the fingerprint of the bytes read.
    by_quasi
        the places of players whose error is the file's quasi_error.
    scale
        the ratings' scale; None if the file doesn't state it.
    levels
        whether the ratings are skill levels, because of their title or because there are no other
        ratings.
    form
        how much a game's log-odds vary from match to match; 0 if the file doesn't say.
    """

    roster: Roster
    lines: NDArray[np.int64]
    source: str
    warnings: tuple[str, ...]
    sha256: str
    by_quasi: frozenset[int] = frozenset()
    scale: Scale | None = None
    levels: bool = False
    form: float = 0.0

    def scale_by(self, stated: Scale | None, remedy: str, levels: str = "") -> Scale:
        """Return the scale stated by the user or the file, or implied by the ratings themselves.

        Raises
        ------
        InputError
            if none of these shows the scale, as from `unstated_scale`; `remedy` ends the message,
            or `levels` if the ratings look like skill levels.
        """
        rated = self.roster
        return (
            stated
            or self.scale
            or unstated_scale(rated.rating.tolist(), rated.players, remedy, self.source, levels)
        )


def refuse_to_read(file: RatedList, scale: Scale, whose: str, remedy: str) -> None:
    """Reject, as `refuse_contradicted` does, a list without a scale whose ratings contradict it."""
    if file.scale is not None:
        return
    try:
        refuse_contradicted(
            scale, file.roster.rating.tolist(), file.roster.players, whose=whose, remedy=remedy
        )
    except InputError as error:
        raise InputError(warning(file.source, None, error.sentence)) from None


def read_roster(path: str | Path) -> RosterFile:
    r"""Read a list of rated players from a CSV file; '-' is standard input.

    A player without a rating is new and must have no games. An empty standard_error, games or
    matches counts as not stated. If a quasi_error is stated, it is used instead of the
    standard_error, because a roster's errors are used for rating differences.

    Raises
    ------
    DataError
        listing every problem in the file: missing columns, no rows, cells that are not numbers, a
        name that appears twice.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "roster.csv"
    ...     _ = path.write_text("Name;Rating;SE;Games\nAnn;92,5;9;140\nBo;;;0\n")
    ...     club = read_roster(path).roster
    >>> club.players, club.rating, club.games
    (('Ann', 'Bo'), array([92.5,  nan]), array([140,   0]))
    """
    return roster_of((ROSTER | WRITTEN | _SKIPPED).read(path))


def roster_of(table: TextTable, *, rated: bool = True) -> RosterFile:
    """Return the roster in a table, or raise one DataError with all its problems.

    A `rated` roster must have a column of ratings or levels.
    """
    names = table["player"].tolist()
    _refuse_twice(table, names)
    own = "rating" if "rating" in table or "level" not in table else "level"
    if rated and own not in table:
        table.problems.add(None, missing_column("rating", [*ROSTER["rating"].aliases, "level"]))
    rating, quasi = table[own], table["quasi_error"]
    provisional = table["provisional"] if "provisional" in table.found else None
    if own == "rating" and "effective_rating" in table:
        only_effective = ~(rating > 0) & (table["effective_rating"] > 0)
        rating = np.where(only_effective, table["effective_rating"], rating)
        rating = np.where(rating > 0, rating, np.nan)  # 0 stands for none there
        provisional = only_effective if provisional is None else provisional | only_effective
    error = np.where(np.isnan(quasi), table["standard_error"], quasi)
    # A rating can rest on matches of which only the winner is known.
    races = np.maximum(table["races_won"], 0) + np.maximum(table["races_lost"], 0)
    games = np.where(table["games"] == NOT_STATED, NOT_STATED, table["games"] + races)
    ratings = table.read[own]
    if own in table:
        table.note(
            np.isnan(rating) & ratings.good & (games > 0),
            "{column} is empty, but the player has {games} games. Fill it in, or write 0 games.",
            column=own,
            games=games,
        )
    scale, form = _scale(table), _form(table)
    table.problems.raise_any()
    roster = Roster(
        names,
        rating,
        error,
        games,
        component=table["component"],
        matches=table["matches"],
        provisional=provisional,
        level=table["level"],
    )
    similar = similar_name_warnings(
        similar_names(names), table.source, say("If so, keep one of them.")
    )
    by_quasi = frozenset(np.flatnonzero(~np.isnan(quasi)).tolist())
    hidden = hidden_letter_warnings(table, ["player"])
    warnings = (*table.warnings, *hidden, *similar)
    levels = own == "level"
    return RosterFile(
        roster, table.lines, table.source, warnings, table.sha256, by_quasi, scale, levels, form
    )


def _refuse_twice(table: TextTable, names: list[str]) -> None:
    """Note names that appear twice, ignoring case and spacing."""
    first: dict[str, tuple[int, str]] = {}
    for name, line in zip(names, table.lines.tolist(), strict=True):
        if not name:
            continue
        earlier, spelling = first.setdefault(same_name(name), (line, name))
        if earlier != line:
            spelt = "" if spelling == name else say(" as {name}", name=quoted(spelling))
            table.problems.add(
                line,
                "player {name} is already in line {line}{spelt}. Delete one of the two, or give "
                "two players with the same name different names, such as 'Ann Lee 2'.",
                name=quoted(name),
                line=earlier,
                spelt=spelt,
            )


def _scale(table: TextTable) -> Scale | None:
    """Return the scale of all ratings, noting any that differs from the first.

    If the file has no scale, the title of the ratings may name it ("Fargo rating"), or the file may
    have columns that only FargoRate's lists have.
    """
    named = next((name for name in SCALES if name in _title(table)), None)
    if "effective_rating" in table or _title(table, "games") == "robustness":
        named = named or "fargo"
    scales = table["scale"]
    rows = np.flatnonzero(scales != None)  # noqa: E711 (element by element)
    if not len(rows):
        return None if named is None else SCALES[named]
    first: Scale = scales[rows[0]]
    if named is not None and not first.same_points(SCALES[named]):
        table.note(
            rows[0],
            "scale {scale!r} differs from the column title {title}. Correct one of them.",
            scale=first.text,
            title=quoted(table.titles["rating"]),
        )
    for row in rows:
        if not first.same_points(scales[row]):
            table.note(
                row,
                "scale {scale!r} differs from {first!r} in line {line}. Put all ratings "
                "on one scale.",
                scale=scales[row].text,
                first=first.text,
                line=table.lines[rows[0]],
            )
    return first


def _form(table: TextTable) -> float:
    """Return the whole list's day-to-day form, noting any that differs from the first."""
    column = table["match_form"]
    rows = np.flatnonzero(~np.isnan(column))
    if not len(rows):
        return 0.0
    first = float(column[rows[0]])
    table.note(
        rows[column[rows] != first],
        "match_form {form:g} differs from {first:g} in line {line}; it applies to the whole "
        "league, so write the same number in every row",
        form=column,
        first=first,
        line=table.lines[rows[0]],
    )
    return first


def _title(table: TextTable, column: str = "rating") -> str:
    """Return a column's title in lower case; '' if it has none."""
    return table.titles.get(column, "").casefold()
