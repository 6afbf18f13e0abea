"""Lists of rated players: from a CSV file to a `Roster`."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.files.cells import numbers, whole_numbers
from evenbreak.files.problems import quoted
from evenbreak.files.results_columns import clean_name
from evenbreak.files.similar_names import similar_names
from evenbreak.files.text_table import Table, read_table
from evenbreak.ratings.roster import NOT_STATED, Roster

if TYPE_CHECKING:
    from numpy.typing import NDArray

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
}
"""The columns that a roster may have, with their other names."""

WRITTEN = dict.fromkeys(
    (
        *("won", "lost", "races_won", "races_lost"),
        *("rating_before", "change", "matches_won", "matches_lost", "why"),
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

LARGEST = 1e6
"""The largest rating or error that is accepted, in points."""

WARNED = 20
"""How many groups of similar names are listed; the rest are counted."""


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
        what to look at although the file can be used, a line each.
    sha256
        fingerprint of the bytes that were read.
    by_quasi
        the places of those whose error is the quasi_error of the file.
    """

    roster: Roster
    lines: NDArray[np.int64]
    source: str
    warnings: tuple[str, ...]
    sha256: str
    by_quasi: frozenset[int] = frozenset()


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
    return roster_of(read_table(path, REQUIRED, {**OPTIONAL, **WRITTEN, **seasons}))


def roster_of(table: Table, *, all_rated: bool = False) -> RosterFile:
    """Return the roster in a table, or raise all the problems found in it.

    Parameters
    ----------
    table
        with the columns of `REQUIRED` and any of `OPTIONAL`.
    all_rated
        whether a player without a rating is a problem.

    Raises
    ------
    DataError
        as `read_roster` does, with the problems that the table had before.
    """
    if not len(table) and not len(table.problems):
        table.problems.add(None, "has no players below its header; write one line for each")
    names = _names(table)
    remedy = "write points such as 85, or leave it empty for a new player"
    rating = _points(table, "rating", remedy, least=-LARGEST)
    remedy = "write points such as 9.5, or leave it empty"
    error = _points(table, "standard_error", remedy, least=0.0)
    quasi = _points(table, "quasi_error", remedy, least=0.0)
    error = np.where(np.isnan(quasi), error, quasi)
    games, matches = _counts(table, "games"), _counts(table, "matches")
    component = whole_numbers(table, "component", at_least=1, may_be_empty=True).values
    unrated = np.array([not text for text in table.cells("rating")], dtype=bool)
    table.problems.add_rows(
        table.lines,
        np.flatnonzero(unrated & (games > 0)) if "rating" in table else np.zeros(0, np.int64),
        lambda row: f"rating is empty after {games[row]} games; write it, or 0 games if new",
    )
    if all_rated and "rating" in table:
        table.problems.add_rows(
            table.lines,
            np.flatnonzero(unrated & (games <= 0)),
            lambda _: "rating is empty; write the rating that the player starts with",
        )
    table.problems.raise_any()
    roster = Roster(names, rating, error, games, component=component, matches=matches)
    warnings = (*table.warnings, *_alike(names, table.source))
    sha256 = hashlib.sha256(table.content).hexdigest()
    by_quasi = frozenset(np.flatnonzero(~np.isnan(quasi)).tolist())
    return RosterFile(roster, table.lines, table.source, warnings, sha256, by_quasi)


def _names(table: Table) -> list[str]:
    """Return the names, noting those that are empty or appear twice."""
    names = [clean_name(text) for text in table.cells("player")]
    first: dict[str, int] = {}
    for name, line in zip(names, table.lines.tolist(), strict=True):
        if not name:
            if "player" in table:
                table.problems.add(line, "player is empty; write a name")
        elif first.setdefault(name, line) != line:
            table.problems.add(
                line,
                f"player {quoted(name)} is already in line {first[name]}; delete one of the two, "
                "or tell two players of the same name apart, for example with a number",
            )
    return names


def _counts(table: Table, name: str) -> NDArray[np.int64]:
    """Read a column of counts, `NOT_STATED` where a cell is empty."""
    counts, good = whole_numbers(table, name, may_be_empty=True)
    stated = np.array([bool(text) for text in table.cells(name)], dtype=bool)
    return np.where(stated & good, counts, NOT_STATED)


def _points(table: Table, name: str, remedy: str, *, least: float) -> NDArray[np.float64]:
    """Read a column of points from `least` to `LARGEST`, NaN where a cell is empty."""
    points: NDArray[np.float64] = numbers(table, name, remedy=remedy, may_be_empty=True).values
    table.problems.add_rows(
        table.lines,
        np.flatnonzero((points < least) | (points > LARGEST)),
        lambda row: f"{name} {points[row]:g} is not from {least:,.0f} to {LARGEST:,.0f}; {remedy}",
    )
    return points


def _alike(names: list[str], source: str) -> list[str]:
    groups = similar_names(names)
    listed = [
        f"{source}: {', '.join(map(quoted, group[:-1]))} and {quoted(group[-1])} may be one "
        "player; if so, keep only one of them"
        for group in groups[:WARNED]
    ]
    more = len(groups) - WARNED
    more_groups = [f"{source}: and {more:,} more groups of similar names"] if more > 0 else []
    return [*listed, *more_groups]
