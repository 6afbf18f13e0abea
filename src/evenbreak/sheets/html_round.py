"""The races of a round as one HTML file: for the wall, a phone and a screen reader."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from evenbreak.answers.fair_pairs import RaceLimits
from evenbreak.answers.frames import file_name
from evenbreak.answers.roster_matchups import RosterMatchups
from evenbreak.answers.round_words import Way, about_races, assumed, notes_of, races_of, rests_on
from evenbreak.answers.sheet_parts import (
    Block,
    PlayerLine,
    RaceCard,
    bar_ticks,
    race_blocks,
    race_cards,
    roster_lines,
)
from evenbreak.answers.sheet_words import NO_RACE, how_to_read, remarks
from evenbreak.errors import InputError
from evenbreak.files.roster import RosterFile
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.sheets.html_page import html_page

if TYPE_CHECKING:
    import pandas as pd

MOST_ACROSS = 48
"""The most players whose races against each other stand on a page."""

MOST_MATCHES = 500
"""The most matches of a list on a page."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Round:
    """What the races of a round were made of.

    Parameters
    ----------
    file
        the list of players, as it was read.
    roster
        its players, the new ones filled in.
    scale, chart, limits, minutes_per_game
        as `roster_matchups` was asked.
    listed
        whether the pairs are a list of matches; otherwise they are all pairs.
    evening
        sentences that say when the evening ends.
    """

    file: RosterFile
    roster: Roster
    scale: Scale
    chart: Chart | LevelChart | None
    limits: RaceLimits | None
    minutes_per_game: float | None
    listed: bool
    evening: Sequence[str] = ()

    @property
    def kinds(self) -> dict[str, Way]:
        """What says which races they are, by what the columns of each kind begin with.

        Those to play come first: where there is a chart, those of the chart.
        """
        by_chart: dict[str, Way] = {} if self.chart is None else {"chart_": self.chart}
        return by_chart if self.limits is None else {**by_chart, "": self.limits}


class Match(NamedTuple):
    """A match as the page shows it; the numbers of one without a race are empty."""

    a: PlayerLine
    b: PlayerLine
    needs_a: str
    needs_b: str
    chance: str
    chance_b: str
    games: str
    games_p90: str
    minutes: str
    minutes_p90: str
    fairest: str
    fairest_chance: str


class Kind(NamedTuple):
    """All races of one kind: by the chart, or the fairest."""

    id: str
    title: str
    which_races: str
    how_to_read: str
    blocks: Sequence[Block]
    cards: Sequence[RaceCard]
    remarks: Sequence[str]


def round_html(made_of: Round, answer: RosterMatchups) -> bytes:
    """Return the races of a round as one HTML file that asks no other host for anything.

    A list of matches becomes a table with the races in large letters and room for the
    scores; all pairs of a roster become a table with names on both sides, on a narrow page
    each player's races, and the ratings below it.

    Parameters
    ----------
    made_of
        what was asked for.
    answer
        the races, as `roster_matchups` returns them; 500 listed matches at most, or all
        pairs of 48 players at most.

    Returns
    -------
    bytes
        UTF-8; the same input gives the same bytes. A control character in a name is shown
        as a mark, since HTML cannot hold it.

    Raises
    ------
    InputError
        if there are more matches or players than a page holds.

    >>> from evenbreak.handicaps import chart
    >>> from evenbreak.ratings import SCALES
    >>> from evenbreak.answers.roster_matchups import all_pairs, roster_matchups
    >>> club = Roster(["Ann", "Bo"], [92, 71])
    >>> races = {"scale": SCALES["npl"], "chart": chart("npl_10"), "limits": None}
    >>> file = RosterFile(club, np.array([2, 3]), "club.csv", (), "0123456789abcdef")
    >>> answer = roster_matchups(club, all_pairs(club), **races)
    >>> made_of = Round(file=file, roster=club, **races, minutes_per_game=None, listed=False)
    >>> page = round_html(made_of, answer).decode()
    >>> page[:15], "<td>6:4</td>" in page, "://" in page
    ('<!doctype html>', True, False)
    """
    frame = answer.frame
    names = {*frame["player_a"], *frame["player_b"]}
    rated = _rated(made_of.roster, names)
    _check(made_of, len(frame), len(rated))
    lines = roster_lines(rated, made_of.scale)
    if made_of.listed:
        links = [("matches", "Matches")]
        matches, kinds = _matches(made_of, frame, lines), []
    else:
        matches, kinds = [], [_kind(made_of, frame, kind, lines) for kind in made_of.kinds]
        links = [*((kind.id, kind.title) for kind in kinds), ("ratings", "Ratings")]
    return html_page(
        "round.html",
        title=f"Races of the round from {file_name(made_of.file)}",
        source=file_name(made_of.file),
        links=[*links, ("assumed", "What was assumed")],
        evening=made_of.evening,
        which_races=" Beside them: ".join(
            about_races(way, races_of(frame, prefix)) for prefix, way in made_of.kinds.items()
        ),
        matches=matches,
        both=len(made_of.kinds) > 1,
        minutes=made_of.minutes_per_game is not None,
        notes=notes_of(frame),
        kinds=kinds,
        lines=lines,
        ticks=bar_ticks(rated),
        assumed=list(
            assumed(
                made_of.file,
                made_of.roster,
                names,
                scale=made_of.scale,
                chart=made_of.chart,
                minutes_per_game=made_of.minutes_per_game,
            )
        ),
        model=rests_on(made_of.scale),
        made_of="a list of players",
        file=made_of.file,
    )


def _check(made_of: Round, matches: int, players: int) -> None:
    if made_of.listed and matches > MOST_MATCHES:
        raise InputError(f"there are {matches:,} matches; give {MOST_MATCHES:,} at most")
    if not made_of.listed and players > MOST_ACROSS:
        raise InputError(f"there are {players:,} players; give {MOST_ACROSS} at most, or a list")


def _rated(roster: Roster, names: set[str]) -> pd.DataFrame:
    """Return the players who are on the page, the strongest first."""
    import pandas as pd

    order = [
        place
        for place in np.argsort(-roster.rating, kind="stable").tolist()
        if roster.players[place] in names
    ]
    columns = ("rating", "standard_error", "games", "component")
    return pd.DataFrame(
        {
            "player": [roster.players[place] for place in order],
            **{name: getattr(roster, name)[order] for name in columns},
        }
    )


def _kind(made_of: Round, frame: pd.DataFrame, prefix: str, lines: Sequence[PlayerLine]) -> Kind:
    paired = races_of(frame, prefix)
    first = prefix == next(iter(made_of.kinds))
    return Kind(
        "races" if first else "fairest",
        "Who gives whom what" if first else "The fairest races",
        about_races(made_of.kinds[prefix], paired),
        how_to_read(paired),
        race_blocks(lines, paired),
        race_cards(lines, paired),
        # Of pairs without a race the remarks tell already.
        [*remarks(paired), *([] if prefix else notes_of(frame[frame["difference"].notna()]))],
    )


def _matches(made_of: Round, frame: pd.DataFrame, lines: Sequence[PlayerLine]) -> list[Match]:
    by_name = {line.name: line for line in lines}
    main, *others = made_of.kinds
    matches = []
    for values in frame.itertuples(index=False):
        row: dict[str, Any] = dict(zip(frame.columns, values, strict=True))
        a, b = by_name[row["player_a"]], by_name[row["player_b"]]
        if np.isnan(row["difference"]):
            matches.append(Match(a, b, NO_RACE, NO_RACE, *[""] * 8))
            continue
        # Rounded first, so that the two chances are 1 together.
        chance = round(row[f"{main}p_win_a"], 2)
        minutes = ["", ""]
        if made_of.minutes_per_game is not None:
            minutes = [f"{row[f'{main}mean_minutes']:.0f}", f"{row[f'{main}minutes_p90']:.0f}"]
        fairest = [f"{row['race_a']}:{row['race_b']}", f"{row['p_win_a']:.2f}"] if others else []
        matches.append(
            Match(
                a,
                b,
                f"{row[f'{main}race_a']}",
                f"{row[f'{main}race_b']}",
                f"{chance:.2f}",
                f"{1.0 - chance:.2f}",
                f"{row[f'{main}mean_games']:.1f}",
                f"{row[f'{main}games_p90']}",
                *minutes,
                *(fairest or ["", ""]),
            )
        )
    return matches
