"""Who has entered: a list of entrants, and their ratings from the league's list."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.errors import DataError
from evenbreak.files.lists.roster import (
    ROSTER,
    WRITTEN,
    RatedList,
    RosterFile,
    refuse_to_read,
    roster_of,
)
from evenbreak.files.lists.typed_list import read_players
from evenbreak.files.tables.names import KnownNames
from evenbreak.files.tables.problems import quoted, refusal, warning
from evenbreak.ratings.roster import Roster
from evenbreak.words import say

ENTRANTS = ROSTER | WRITTEN
"""A list of entrants: a roster that may lack everything but the names."""

APART = 0.5
"""How far an entrant's rating may differ from the league's, in points, without a warning."""


def read_entrants(path: str | Path) -> RosterFile:
    r"""Read the entrants: one player per line, or a table with the columns of a roster.

    A line is a name, or a name and a rating, such as `Ann Lee,612`; lines without a name are
    skipped. In a table, every column but the name may be missing.

    Raises
    ------
    DataError
        listing every problem in the file: no names, a name that appears twice, cells that cannot be
        read.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "entrants.txt"
    ...     _ = path.write_text("Ann Lee,612\n\n Bo  Diaz\n")
    ...     read_entrants(path).roster.players
    ('Ann Lee', 'Bo Diaz')
    """
    if str(path) == "-":
        raise DataError([say("the entrants can't come from standard input. Name a file.")])
    return roster_of(ENTRANTS.of(read_players(path, ENTRANTS)), rated=False)


def nobody() -> RosterFile:
    """Return an empty list of entrants.

    >>> len(nobody().roster)
    0
    """
    return RosterFile(Roster([], []), np.empty(0, dtype=np.int64), say("the list"), (), "")


@dataclass(frozen=True, eq=False)
class Entered:
    """Entrants matched to a list of players.

    Parameters
    ----------
    names
        in the list's spelling, for players who are on it.
    places
        each entrant's place in the list; -1 if not on it.
    warnings
        entrants who are not on the list, with similar names, and entrants whose rating differs.
    """

    names: tuple[str, ...]
    places: tuple[int, ...]
    warnings: tuple[str, ...]

    @property
    def new(self) -> list[str]:
        """The names of entrants who are not on the list."""
        return [name for name, place in zip(self.names, self.places, strict=True) if place < 0]


def entered(entrants: RosterFile, players: Sequence[str], whose: str) -> Entered:
    """Match entrants to a list of players, ignoring case and spacing.

    Parameters
    ----------
    entrants
        from `read_entrants`.
    whose
        the list's name in warnings.

    >>> file = RosterFile(Roster(["ann lee", "Bo Dias"], [80, 70]), np.array([1, 2]), "e", (), "")
    >>> found = entered(file, ["Ann Lee", "Bo Diaz"], "r.csv")
    >>> found.names, found.places
    (('Ann Lee', 'Bo Dias'), (0, -1))
    >>> found.warnings
    ("e:2: 'Bo Dias' isn't in r.csv (did you mean 'Bo Diaz'?) and is treated as a new player",)
    """
    listed_players = KnownNames(players)
    names, places, warnings = [], [], []
    for line, name in zip(entrants.lines.tolist(), entrants.roster.players, strict=True):
        place = listed_players.place(name)
        names.append(name if place is None else players[place])
        places.append(-1 if place is None else place)
        if place is None:
            new = say(
                "{name} isn't in {whose}{hint} and is treated as a new player",
                name=quoted(name),
                whose=whose,
                hint=listed_players.hint(name),
            )
            warnings.append(warning(entrants.source, line, new))
    return Entered(tuple(names), tuple(places), (*entrants.warnings, *warnings))


def roster_of_entrants(league: RosterFile, entrants: RosterFile) -> RosterFile:
    """Return the entrants with their ratings from the league's list.

    Entrants who aren't on it are new players: they keep the rating in the list of entrants, if any.

    Raises
    ------
    DataError
        if the two files' ratings are on different scales.
    """
    check_one_scale(league, entrants)
    who = entered(entrants, league.roster.players, league.source)
    known, stated = league.roster, entrants.roster
    at = np.array(who.places, dtype=np.int64)
    on_list = at >= 0

    def column(name: str) -> NDArray[Any]:
        values: NDArray[Any] = np.where(on_list, getattr(known, name)[at], getattr(stated, name))
        return values

    # A player without any rating has not played here yet.
    games = np.where(~on_list & np.isnan(stated.rating), 0, column("games"))
    roster = Roster(
        who.names,
        column("rating"),
        column("standard_error"),
        games,
        component=column("component"),
        matches=column("matches"),
        provisional=column("provisional"),
        level=column("level"),
    )
    differ = on_list & (np.abs(stated.rating - roster.rating) > APART)
    warnings = [
        warning(
            entrants.source,
            entrants.lines[k],
            "the rating {stated:g} for {player} isn't used, because the rating in {list} is "
            "{rating:g}",
            stated=stated.rating[k],
            player=quoted(roster.players[k]),
            list=league.source,
            rating=roster.rating[k],
        )
        for k in np.flatnonzero(differ).tolist()
    ]
    return replace(
        league,
        roster=roster,
        lines=entrants.lines,
        source=entrants.source,
        warnings=(*league.warnings, *who.warnings, *warnings),
        by_quasi=frozenset(np.flatnonzero(on_list & np.isin(at, list(league.by_quasi))).tolist()),
        scale=league.scale or entrants.scale,
        levels=league.levels or entrants.levels,
    )


def check_one_scale(league: RatedList, entrants: RosterFile) -> None:
    """Reject entrants whose ratings are on a different scale than the league's list.

    Raises DataError, even if one file has skill levels and the other has points.
    """
    if np.isnan(entrants.roster.rating).all():
        return None
    if league.scale and entrants.scale and not league.scale.same_points(entrants.scale):
        ours, theirs = league.scale.text, entrants.scale.text
    elif league.levels != entrants.levels and not (league.scale and entrants.scale):
        ours, theirs = (
            say("of skill levels") if levels else say("of points")
            for levels in (league.levels, entrants.levels)
        )
    elif league.scale:
        return refuse_to_read(
            entrants, league.scale, league.source, say("put all ratings on one scale")
        )
    else:
        return None
    raise refusal(
        entrants.source,
        "its scale {theirs} differs from {ours} in {list}. Put all ratings on one scale.",
        theirs=theirs,
        ours=ours,
        list=league.source,
    )
