"""Reading a list of rated players as a `Roster`."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.arrays import array_values
from evenbreak.errors import InputError
from evenbreak.files.tables.cells import numbers, read_cells, whole_numbers
from evenbreak.files.tables.names import (
    LONGEST_NAME,
    NAME,
    WRITE_IT,
    clean_name,
    hidden_letter_warnings,
    is_name,
    same_name,
)
from evenbreak.files.tables.problems import quoted
from evenbreak.files.tables.similar_names import similar_name_warnings, similar_names
from evenbreak.files.tables.table import TextTable, read_table
from evenbreak.ratings.roster import NOT_STATED, Roster
from evenbreak.ratings.scale import SCALES, Scale, refuse_contradicted, scale_of, unstated_scale

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.files.lists.league import LeagueFile


REQUIRED = {
    "player": ("name", "player name", "full name"),
    "rating": ("points", "skill level", "level", "handicap", "fargo rating", "elo"),
}
"""The columns that a roster must have, with their other names."""

OPTIONAL = {
    "standard_error": ("se", "sd", "error", "plus or minus", "uncertainty"),
    "quasi_error": ("quasi standard error", "qse"),
    "games": ("games played", "racks", "robustness"),
    "component": ("group",),
    "matches": ("matches played",),
    "races_won": (),
    "races_lost": (),
    "match_form": (),
    "scale": ("rating scale", "points that double the odds"),
}
"""The columns that a roster may have, with their other names."""

WRITTEN = dict.fromkeys(
    (
        *("won", "lost"),
        *("rating_before", "change", "matches_won", "matches_lost", "why"),
        *("prior_mean", "prior", "as_of"),
    ),
    (),
)
"""Further columns of the lists that `evenbreak rate` and `evenbreak report` write."""

LEAGUE = {
    "skill": ("true skill", "true rating", "strength"),
    "day_sd": ("day", "day fluctuation", "form"),
    "drift": ("points a week", "improves by"),
    "joins": ("first week", "joins in week"),
    "leaves": ("last week", "leaves after week"),
    "absence": ("absent", "p absent"),
}
"""The columns that a simulated season uses, with their other names; others skip them."""

LARGEST = 1_000_000
"""The largest rating or error that is accepted, in points."""

FARTHEST = 10_000
"""The largest rating or skill that can be simulated, in points."""


@array_values
@dataclass(frozen=True, eq=False)
class RosterFile:
    """What a list of rated players says.

    Parameters
    ----------
    roster
        its players, in the order of the file.
    lines
        the line of each player.
    source
        what the file is called in messages.
    warnings
        what to check although the file can be used, a line each.
    sha256
        fingerprint of the bytes that were read.
    by_quasi
        the places of those whose error is the quasi_error of the file.
    scale
        the scale of the ratings; None if the file does not state it.
    levels
        whether the title of the ratings says that they are skill levels.
    form
        how much the log-odds of a game vary from match to match, 0 where the file does not say it.
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

    def scale_by(self, stated: Scale | None, remedy: str) -> Scale:
        """Return the scale that the user states, else the file, else the ratings themselves.

        Raises
        ------
        InputError
            if nothing says it, as `unstated_scale` does; `remedy` ends the message.
        """
        rated = self.roster
        return (
            stated
            or self.scale
            or unstated_scale(rated.rating.tolist(), rated.players, remedy, self.source)
        )


def refuse_to_read(file: RosterFile | LeagueFile, scale: Scale, whose: str, remedy: str) -> None:
    """Refuse to read a list that states no scale on one that its ratings contradict.

    Raises
    ------
    InputError
        as `refuse_contradicted` does, with the name of the file.
    """
    if file.scale is not None:
        return
    try:
        refuse_contradicted(
            scale, file.roster.rating.tolist(), file.roster.players, whose=whose, remedy=remedy
        )
    except InputError as error:
        raise InputError(f"{file.source}: {error}") from None


def read_roster(path: str | Path) -> RosterFile:
    r"""Read a list of rated players from a CSV file; '-' is standard input.

    A player without a rating is new and must have no games. An empty standard_error, games or
    matches is not stated. Where a quasi_error is stated, it is used in place of the
    standard_error, because a roster's errors are used for differences of ratings.

    Raises
    ------
    DataError
        with every problem of the file: missing columns, no rows, cells that are not
        numbers, a name that appears twice.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "roster.csv"
    ...     _ = path.write_text("Name;Rating;SE;Games\nAnn;92,5;9;140\nBo;;;0\n")
    ...     club = read_roster(path).roster
    >>> club.players, club.rating, club.games
    (('Ann', 'Bo'), array([92.5,  nan]), array([140,   0]))
    """
    # Each name by itself: two columns with one meaning are a problem only for a season.
    seasons = {name: () for known, others in LEAGUE.items() for name in (known, *others)}
    return roster_of(read_table(path, REQUIRED, {**OPTIONAL, **WRITTEN, **seasons}, rows="players"))


def roster_of(table: TextTable, *, season: bool = False) -> RosterFile:
    """Return the roster in a table, or raise all the problems found in it.

    Parameters
    ----------
    table
        with the columns of `REQUIRED` and any of `OPTIONAL`.
    season
        whether a season is simulated, for which every player needs a rating.

    Raises
    ------
    DataError
        as `read_roster` does, with the problems that the table had before.
    """
    names = _names(table)
    most = FARTHEST if season else LARGEST
    remedy = "write points such as 85" + ("" if season else ", or leave it empty for a new player")
    rating = numbers(
        table,
        "rating",
        at_least=-most,
        at_most=most,
        remedy=remedy,
        may_be_empty=not season,
        points_may_group=True,
    ).values
    error, quasi = (_error(table, name) for name in ("standard_error", "quasi_error"))
    error = np.where(np.isnan(quasi), error, quasi)
    games, matches = _counts(table, "games"), _counts(table, "matches")
    # A rating can rest on matches of which only the winner is known.
    races = np.maximum(_counts(table, "races_won"), 0) + np.maximum(_counts(table, "races_lost"), 0)
    games = np.where(games == NOT_STATED, games, games + races)
    component = whole_numbers(table, "component", at_least=1, may_be_empty=True).values
    unrated = np.array([not text for text in table.cells("rating")], dtype=bool)
    if "rating" in table and not season:
        table.problems.add_rows(
            table.lines,
            np.flatnonzero(unrated & (games > 0)),
            lambda row: f"rating is empty after {games[row]} games; fill it in, or write 0 games",
        )
    scale, form = _scale(table), _form(table)
    table.problems.raise_any()
    roster = Roster(names, rating, error, games, component=component, matches=matches)
    similar = similar_name_warnings(similar_names(names), table.source, "if so, keep one of them")
    sha256 = hashlib.sha256(table.content).hexdigest()
    by_quasi = frozenset(np.flatnonzero(~np.isnan(quasi)).tolist())
    hidden = hidden_letter_warnings(table, ["player"])
    warnings = (*table.warnings, *hidden, *similar)
    levels = "level" in _title(table)
    return RosterFile(
        roster, table.lines, table.source, warnings, sha256, by_quasi, scale, levels, form
    )


def _names(table: TextTable) -> list[str]:
    """Return the names, noting those that are empty or appear twice, in any case and spacing."""
    names = [clean_name(text) for text in table.cells("player")]
    first: dict[str, tuple[int, str]] = {}
    for name, line in zip(names, table.lines.tolist(), strict=True):
        if not name:
            if "player" in table:
                table.problems.add(line, "player is empty; write a name")
            continue
        if len(name) > LONGEST_NAME:
            table.problems.add(
                line,
                f"player {quoted(name)} has {len(name):,} letters; write a name of up to "
                f"{LONGEST_NAME}, and look for a missing quotation mark",
            )
        elif not is_name(name):
            table.problems.add(line, f"player {quoted(name)} is not {NAME}; {WRITE_IT}")
        earlier, spelling = first.setdefault(same_name(name), (line, name))
        if earlier != line:
            spelt = "" if spelling == name else f" as {quoted(spelling)}"
            table.problems.add(
                line,
                f"player {quoted(name)} is already in line {earlier}{spelt}; delete one of the "
                "two, or give two players of the same name different names, such as 'Ann Lee 2'",
            )
    return names


def _scale(table: TextTable) -> Scale | None:
    """Return the scale of all ratings, noting one that is unknown or unlike the first.

    Where the file has no scale, the title of the ratings may name it: "Fargo rating".
    """
    named = next((name for name in SCALES if name in _title(table)), None)
    scales = read_cells(
        table,
        "scale",
        _known_scale,
        wanted="a scale",
        remedy=f"write {', '.join(SCALES)} or the points that double the odds, or leave it empty",
        dtype=object,
        empty=None,
        may_be_empty=True,
    )
    rows = np.flatnonzero(scales.stated & scales.good)
    if not len(rows):
        return None if named is None else SCALES[named]
    first: Scale = scales.values[rows[0]]
    if named is not None and not first.same_points(SCALES[named]):
        table.problems.add(
            int(table.lines[rows[0]]),
            f"scale {first.text!r} differs from the title {quoted(table.titles['rating'])}; "
            "correct one of them",
        )
    table.problems.add_rows(
        table.lines,
        np.array([row for row in rows if not first.same_points(scales.values[row])], dtype=int),
        lambda row: (
            f"scale {scales.values[row].text!r} differs from {first.text!r} in line "
            f"{table.lines[rows[0]]}; put all ratings on one scale"
        ),
    )
    return first


def _form(table: TextTable) -> float:
    """Return form of the day, which is that of the whole list, noting one unlike the first."""
    remedy = "write the standard deviation of log-odds from 0 to 3, such as 0.35"
    column = numbers(
        table, "match_form", at_least=0, at_most=3, remedy=remedy, may_be_empty=True
    ).values
    rows = np.flatnonzero(~np.isnan(column))
    if not len(rows):
        return 0.0
    first = float(column[rows[0]])
    table.problems.add_rows(
        table.lines,
        rows[column[rows] != first],
        lambda row: (
            f"match_form {column[row]:g} differs from {first:g} in line {table.lines[rows[0]]}; it "
            "is that of the whole league, so write one number"
        ),
    )
    return first


def _title(table: TextTable) -> str:
    """Return the title of the ratings in lower case; '' where there are none."""
    return table.titles.get("rating", "").casefold()


def _known_scale(text: str) -> Scale | None:
    try:
        scale: Scale = scale_of(text.replace(",", "."))
    except InputError:
        return None
    return scale


def _counts(table: TextTable, name: str) -> NDArray[np.int64]:
    """Read a column of counts, `NOT_STATED` where a cell is empty."""
    counts = whole_numbers(table, name, may_be_empty=True)
    return np.where(counts.stated & counts.good, counts.values, NOT_STATED)


def _error(table: TextTable, name: str) -> NDArray[np.float64]:
    remedy = "write points such as 9.5, or leave it empty"
    errors: NDArray[np.float64] = numbers(
        table, name, at_least=0, at_most=LARGEST, remedy=remedy, may_be_empty=True
    ).values
    return errors
