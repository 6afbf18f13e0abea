"""The races of a round as one HTML file: for the wall, a phone and a screen reader."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from evenbreak.answers.remarks import warnings_of
from evenbreak.answers.report_frames import file_name
from evenbreak.answers.round import Round
from evenbreak.answers.round_words import (
    about_method,
    about_model,
    about_pairs,
    about_players,
    evening_words,
    races_of,
    which_races,
)
from evenbreak.answers.scale_words import scale_words
from evenbreak.answers.sheet import NO_RACE, races_by_name
from evenbreak.answers.sheet_words import how_even, how_to_read
from evenbreak.answers.wording import race
from evenbreak.errors import InputError
from evenbreak.files.csv_writer import rows_of
from evenbreak.sheets.html_page import html_page
from evenbreak.sheets.race_blocks import Block, RaceCard, race_blocks, race_cards
from evenbreak.sheets.rating_bars import Bars, PlayerLine, player_lines

if TYPE_CHECKING:
    import pandas as pd

MOST_ACROSS = 48
"""The most players whose races against each other stand on a page."""

MOST_MATCHES = 500
"""The most matches of a list on a page."""


class MatchLine(NamedTuple):
    """A match as the page shows it; the numbers of one without a race are empty."""

    a: PlayerLine
    b: PlayerLine
    needs_a: str
    needs_b: str
    chance: str = ""
    chance_b: str = ""
    games: str = ""
    games_p90: str = ""
    minutes: str = ""
    minutes_p90: str = ""
    fairest: str = ""
    fairest_chance: str = ""


class Kind(NamedTuple):
    """All races of one kind: by the chart, or the fairest."""

    id: str
    title: str
    which_races: str
    how_to_read: str
    blocks: Sequence[Block]
    cards: Sequence[RaceCard]
    remarks: Sequence[str]


def round_html(tonight: Round) -> bytes:
    """Return the races of a round as one HTML file that asks no other host for anything.

    A list of matches becomes a table with the races in large letters and room for the
    scores; all pairs of a roster become a table with names on both sides, on a narrow page
    each player's races, and the ratings below it.

    Returns
    -------
    bytes
        UTF-8; the same input gives the same bytes. A control character in a name is shown
        as a mark, since HTML cannot hold it.

    Raises
    ------
    InputError
        if there are more than 500 listed matches, or all pairs of more than 48 players.

    >>> from evenbreak.answers.roster_matchups import all_pairs
    >>> from evenbreak.files.roster import RosterFile
    >>> from evenbreak.handicaps import chart
    >>> from evenbreak.ratings import SCALES
    >>> from evenbreak.ratings.roster import Roster
    >>> club = Roster(["Ann", "Bo"], [92, 71])
    >>> file = RosterFile(club, np.array([2, 3]), "club.csv", (), "0123456789abcdef")
    >>> asked = {"scale": SCALES["npl"], "chart": chart("npl_10")}
    >>> page = round_html(Round(file=file, roster=club, pairs=all_pairs(club), **asked)).decode()
    >>> page[:15], "<td>6:4</td>" in page, "://" in page
    ('<!doctype html>', True, False)
    """
    rated = _rated(tonight)
    _check(tonight, len(rated))
    bars = Bars(rated)
    grouped = bool(rated["component"].max() > 1)
    lines = player_lines(rated, tonight.scale, bars, grouped=grouped)
    kinds = [] if tonight.listed else [_kind(tonight, prefix, lines) for prefix in tonight.kinds]
    links = [(kind.id, kind.title) for kind in kinds]
    links += [("ratings", "Ratings")] if kinds else [("matches", "Matches")]
    return html_page(
        "round.html",
        title=f"Races of the round from {file_name(tonight.file)}",
        source=file_name(tonight.file),
        links=[*links, ("assumed", "What was assumed")],
        evening=list(map(evening_words, tonight.evening)),
        which_races=[which_races(tonight, prefix) for prefix in tonight.kinds],
        matches=_matches(tonight, lines) if tonight.listed else [],
        both=len(tonight.kinds) > 1,
        minutes=tonight.minutes_per_game is not None,
        about_pairs=list(about_pairs(tonight.matchups.frame)),
        kinds=kinds,
        about_ratings=[f"Ratings {scale_words(tonight.scale)}."],
        lines=lines,
        ticks=bars.ticks(),
        assumed=[
            *about_players(tonight),
            *about_method(tonight),
            *warnings_of(tonight.file),
        ],
        model=about_model(tonight),
        made_of="a list of players",
        file=tonight.file,
    )


def _check(tonight: Round, players: int) -> None:
    matches = len(tonight.pairs)
    if tonight.listed and matches > MOST_MATCHES:
        raise InputError(f"there are {matches:,} matches; give {MOST_MATCHES:,} at most")
    if not tonight.listed and players > MOST_ACROSS:
        raise InputError(f"there are {players:,} players; give {MOST_ACROSS} at most, or a list")


def _rated(tonight: Round) -> pd.DataFrame:
    """Return the players who are on the page, the strongest first."""
    import pandas as pd

    roster = tonight.roster
    here = np.unique(tonight.pairs)
    order = here[np.argsort(-roster.rating[here], kind="stable")]
    columns = ("rating", "standard_error", "games", "component")
    return pd.DataFrame(
        {
            "player": [roster.players[place] for place in order.tolist()],
            **{name: getattr(roster, name)[order] for name in columns},
        }
    )


def _kind(tonight: Round, prefix: str, lines: Sequence[PlayerLine]) -> Kind:
    paired = races_of(tonight.matchups.frame, prefix)
    races = races_by_name(paired)
    first = prefix == next(iter(tonight.kinds))
    return Kind(
        "races" if first else "fairest",
        "The races" if first else "The fairest races",
        which_races(tonight, prefix),
        how_to_read(paired),
        race_blocks(lines, races),
        race_cards(lines, races, paired),
        list(how_even(paired)),
    )


def _matches(tonight: Round, lines: Sequence[PlayerLine]) -> list[MatchLine]:
    by_name = {line.name: line for line in lines}
    main, *others = tonight.kinds
    frame = tonight.matchups.frame
    matches = []
    for values in rows_of(frame):
        row: dict[str, Any] = dict(zip(frame.columns, values, strict=True))
        a, b = by_name[row["player_a"]], by_name[row["player_b"]]
        if row["difference"] is None:
            matches.append(MatchLine(a, b, NO_RACE, NO_RACE))
            continue
        # Rounded first, so that the two chances are 1 together.
        chance = round(row[f"{main}p_win_a"], 2)
        match = MatchLine(
            a,
            b,
            f"{row[f'{main}race_a']}",
            f"{row[f'{main}race_b']}",
            f"{chance:.2f}",
            f"{1.0 - chance:.2f}",
            f"{row[f'{main}mean_games']:.1f}",
            f"{row[f'{main}games_p90']}",
        )
        if tonight.minutes_per_game is not None:
            match = match._replace(
                minutes=f"{row[f'{main}mean_minutes']:.0f}",
                minutes_p90=f"{row[f'{main}minutes_p90']:.0f}",
            )
        if others:
            fairest = race((row["race_a"], row["race_b"]))
            match = match._replace(fairest=fairest, fairest_chance=f"{row['p_win_a']:.2f}")
        matches.append(match)
    return matches
