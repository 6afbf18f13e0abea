"""Reading the roster of a season: ratings, and what else a simulation needs."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from evenbreak.errors import InputError
from evenbreak.files.lists.entrants import check_one_scale, entered
from evenbreak.files.lists.roster import (
    FARTHEST,
    OF_SEASON,
    ROSTER,
    WRITTEN,
    RosterFile,
    roster_of,
)
from evenbreak.files.tables.problems import refusal, warning
from evenbreak.league.players import ESTABLISHED, LeaguePlayers
from evenbreak.ratings.roster import NOT_STATED, Roster
from evenbreak.ratings.scale import Scale
from evenbreak.words import say, say_count

SEASON = (
    ROSTER.but(
        rating={"filled": True, "least": -FARTHEST, "most": FARTHEST},
    )
    | WRITTEN
    | OF_SEASON
)
"""The roster of a season, in which every player has a rating."""


@dataclass(frozen=True, eq=False)
class LeagueFile:
    """What a league's roster contains.

    Parameters
    ----------
    players
        as `Season` takes them, in the order of the file; ratings in whole points.
    roster
        the same players as a list of ratings.
    source
        the name of the file in messages.
    warnings
        what to check although the file can be used, a line each.
    drawn
        for how many players the skill is drawn, from rating and standard error.
    exact
        for how many the rating is taken as the skill, for lack of a skill and a standard error.
    scale
        the scale of the ratings; None if the file does not state it.
    levels
        whether the title of the ratings says that they are skill levels.
    """

    players: LeaguePlayers
    roster: Roster
    source: str
    warnings: tuple[str, ...]
    drawn: int
    exact: int
    scale: Scale | None = None
    levels: bool = False


def read_league(path: str | Path, *, day_sd: float = 0.0) -> LeagueFile:
    r"""Read the roster of a season from a CSV file; '-' is standard input.

    It has the columns of a roster and those of `OF_SEASON`. A skill that is not stated is drawn for
    each replica from a normal distribution around the rating with the standard error; if that is
    not stated either, the skill is the rating. Ratings are rounded to whole points, halves
    upwards.

    Parameters
    ----------
    path
        the file.
    day_sd
        standard deviation of form from day to day, in points, where the file does not state it.

    Raises
    ------
    DataError
        with every problem of the file: those that `read_roster` finds, players without a rating,
        cells out of range, a player who leaves before joining.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "club.csv"
    ...     _ = path.write_text("player,rating,se,skill\nAnn,92.5,9,\nBo,71,9,75\nCy,60,,\n")
    ...     club = read_league(path)
    >>> club.players.rating, club.players.skill, club.players.skill_sd
    (array([93, 71, 60]), array([92.5, 75. , 60. ]), array([9., 0., 0.]))
    """
    table = SEASON.read(path)
    skill, days, joins, leaves = (table[name] for name in ("skill", "day_sd", "joins", "leaves"))
    table.problems.add_rows(
        table.lines,
        np.flatnonzero((leaves > 0) & (leaves < joins)),
        lambda row: say(
            "leaves in week {leaves}, before week {joins}; correct one of them",
            leaves=leaves[row],
            joins=joins[row],
        ),
    )
    if len(table) == 1:
        table.problems.add(None, "has 1 player; a league needs two or more")
    file = roster_of(table)
    roster = file.roster
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
    warnings = [*file.warnings]
    rounded = int((whole != roster.rating).sum())
    if rounded:
        note = say_count(
            "{n} rating is rounded to whole points, as charts need",
            "{n:,} ratings are rounded to whole points, as charts need",
            rounded,
        )
        warnings.append(warning(table.source, None, note))
    return LeagueFile(
        players,
        roster,
        table.source,
        tuple(warnings),
        drawn=int((sd > 0).sum()),
        exact=int(np.isnan(sd).sum()),
        scale=file.scale,
        levels=file.levels,
    )


def league_of_entrants(
    file: LeagueFile, entrants: RosterFile, *, starter: float, starter_sd: float
) -> LeagueFile:
    """Return the league of the entrants, with new players where they are not on its list.

    Parameters
    ----------
    file
        the league.
    entrants
        as `read_entrants` reads them.
    starter, starter_sd
        the rating of a new player for whom the entrants have none, and how far off it may be
        (standard deviation); the skill is drawn from around it.

    Raises
    ------
    DataError
        if fewer than two players have entered, or the ratings of the two files are not on one
        scale.
    """
    check_one_scale(file, entrants)
    if len(entrants.roster) < 2:
        raise refusal(entrants.source, "has 1 player; a league needs two or more")
    who = entered(entrants, file.roster.players, file.source)
    at = np.array(who.places, dtype=np.int64)
    new = at < 0
    own = np.where(np.isnan(entrants.roster.rating), starter, entrants.roster.rating)
    error = np.where(np.isnan(entrants.roster.rating), starter_sd, entrants.roster.standard_error)
    known = file.players
    players = LeaguePlayers.of(
        np.where(new, np.floor(own + 0.5).astype(np.int64), known.rating[at]),
        names=who.names,
        skill=np.where(new, own, known.skill[at]),
        skill_sd=np.where(new, np.nan_to_num(error), known.skill_sd[at]),
        day_sd=np.where(new, np.median(known.day_sd), known.day_sd[at]),
        drift=np.where(new, 0.0, known.drift[at]),
        joins=np.where(new, 1, known.joins[at]),
        leaves=np.where(new, 0, known.leaves[at]),
        absence=np.where(new, 0.0, known.absence[at]),
        played=np.where(new, 0, known.played[at]),
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
