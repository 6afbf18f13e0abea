"""The fair-race sheet as one HTML file, for a phone, a screen, a printer and a screen reader."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from evenbreak.answers.kit.scales import decimals_of
from evenbreak.answers.league.matchups import matchups_answer, races_of
from evenbreak.answers.league.report import NOTHING_LEFT_OUT, how_even, how_to_read, report_answer
from evenbreak.answers.league.round import Round
from evenbreak.answers.league.sheet import (
    MOST_ON_SHEET,
    NO_RACE,
    Sheet,
    count_groups,
    how_sure,
    races_by_name,
    three_pairs,
)
from evenbreak.errors import InputError
from evenbreak.files.csv_writer import rows_of
from evenbreak.sheets.html_page import Section, drawn, drawn_page
from evenbreak.sheets.race_blocks import (
    HEIGHT,
    WIDTH,
    Bars,
    PlayerLine,
    evenness_plot,
    player_lines,
    race_blocks,
    race_cards,
)
from evenbreak.words import Parameter, race, say

MOST_LISTED = 500
"""The most players in the ratings list; the CSV files have all of them."""


def sheet_html(sheet: Sheet) -> bytes:
    """Return the sheet as one HTML file that loads nothing from any other host.

    Its Content-Security-Policy allows its own style, the script of its search box, and nothing
    else. A wide page and paper show the table of races, and a narrow page shows each player's
    races. The first 500 players are listed, with the races of the first `MOST_ON_SHEET` paired
    players. Everything else is from `report_answer`.

    Returns
    -------
    bytes
        UTF-8; the same sheet gives the same bytes. A control character in a name is shown as a
        mark, because HTML can't contain it.

    >>> from evenbreak.answers.league.roster_matchups import OfferedRaces
    >>> from evenbreak.files.results.results_file import ResultsFile
    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> file = ResultsFile(season, "season.csv", (), (), "0123456789abcdef")
    >>> sheet = Sheet.of(file, fit(season), OfferedRaces(race_to=7), [0, 1, 2])
    >>> page = sheet_html(sheet).decode()
    >>> page[:15], "Fair races from season.csv" in page, "://" in page
    ('<!doctype html>', True, False)
    """
    shown, scale = sheet.strongest(MOST_ON_SHEET), sheet.ratings.scale
    bars = Bars(sheet.rated)
    grouped = count_groups(sheet.ratings) > 1
    lines = player_lines(sheet.rated, scale, bars, grouped=grouped)
    across = [lines[place] for place in shown.listed.index]
    listed = lines[:MOST_LISTED]
    blocks, cards = race_blocks(across, shown.races), race_cards(across, shown.races, shown.paired)
    races = Section("races", "The races", drawn("races", blocks, cards, how_to_read(shown.paired)))
    ratings = [Section("ratings", "Ratings", drawn("ratings", listed, bars.ticks()))]
    if shown.sure:
        plot = evenness_plot(shown.bands, shown.sure, shown.typical)
        first, *_ = how_even(shown.paired)
        chart = drawn("chart", plot, (WIDTH, HEIGHT), shown.bands, decimals_of(scale), first)
        ratings.append(Section("chart", "How even the races are", chart))
    sure = drawn("sure", list(how_sure(scale, shown.sure)), three_pairs(shown.sure))
    ratings.append(Section("sure", "How sure this is", sure))
    answer = report_answer(sheet, across=MOST_ON_SHEET, listed=len(listed))
    return drawn_page(
        replace(answer, warnings=[*sheet.file.warnings, *answer.warnings]),
        [[races], ratings],
        notes=("left-out", "What was left out, and why", NOTHING_LEFT_OUT),
        made_of="results",
        file=sheet.file,
    )


MOST_ACROSS = 48
"""The most players whose races against each other are on a page."""

MOST_MATCHES = 500
"""The most matches from a list on a page."""


def round_html(tonight: Round, *, warnings: Sequence[str] = ()) -> bytes:
    """Return a round's races as one self-contained HTML file.

    A list of matches becomes a table with the races in large letters and space for the scores; all
    pairs on a roster become a table with names on both sides (on a narrow page, each player's
    races), with the ratings below it. Everything else is from `matchups_answer`.

    Parameters
    ----------
    warnings
        as for `matchups_answer`.

    Returns
    -------
    bytes
        UTF-8; the same input gives the same bytes. A control character in a name is shown as a
        mark, because HTML can't contain it.

    Raises
    ------
    InputError
        if there are more than 500 listed matches, or all pairs of more than 48 players.

    >>> from evenbreak.answers.league.roster_matchups import all_pairs
    >>> from evenbreak.files.lists.roster import RosterFile
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
    if tonight.listed:
        minutes, both = tonight.pace is not None, len(tonight.kinds) > 1
        drawing = drawn("matches", _matches(tonight, lines), minutes, both)
        sections = [Section("matches", "Matches", drawing)]
    else:
        sections = [_races(tonight, prefix, lines) for prefix in tonight.kinds]
        sections.append(Section("ratings", "Ratings", drawn("ratings", lines, bars.ticks())))
    return drawn_page(
        matchups_answer(tonight, warnings=warnings),
        [sections],
        notes=("assumed", "What was assumed", ""),
        made_of="a list of players",
        file=tonight.file,
    )


def _check(tonight: Round, players: int) -> None:
    matches = len(tonight.pairs)
    if tonight.listed and matches > MOST_MATCHES:
        raise InputError(
            f"{matches:,} matches are too many for one page, which holds at most {MOST_MATCHES}. "
            "Make a separate list and page for each part of the round."
        )
    if not tonight.listed and players > MOST_ACROSS:
        raise InputError(
            say(
                "{players:,} players are too many for one page, which can show all pairs of at "
                "most {most_across}. List who plays who with {pairs} PAIRS.csv.",
                players=players,
                most_across=MOST_ACROSS,
                pairs=Parameter("pairs"),
            )
        )


def _rated(tonight: Round) -> pd.DataFrame:
    """Return the players who are on the page, in list order."""
    roster = tonight.roster
    order = roster.strongest_first(np.unique(tonight.pairs))
    columns = ("rating", "standard_error", "games", "component", "provisional")
    return pd.DataFrame(
        {
            "player": [roster.players[place] for place in order.tolist()],
            **{name: getattr(roster, name)[order] for name in columns},
        }
    )


def _races(tonight: Round, prefix: str, lines: Sequence[PlayerLine]) -> Section:
    paired = races_of(tonight.matchups.frame, prefix)
    races = races_by_name(paired)
    blocks, cards = race_blocks(lines, races), race_cards(lines, races, paired)
    table = drawn("races", blocks, cards, how_to_read(paired))
    first = prefix == next(iter(tonight.kinds))
    return Section(
        "races" if first else "fairest",
        "The races" if first else "The fairest races",
        table + drawn("sentences", list(how_even(paired))),
    )


def _matches(tonight: Round, lines: Sequence[PlayerLine]) -> list[dict[str, Any]]:
    by_name = {line.name: line for line in lines}
    main, *others = tonight.kinds
    frame = tonight.matchups.frame
    matches = []
    for values in rows_of(frame):
        row: dict[str, Any] = dict(zip(frame.columns, values, strict=True))
        a, b = by_name[row["player_a"]], by_name[row["player_b"]]
        # What is not set is empty on the page.
        match: dict[str, Any] = defaultdict(str, a=a, b=b, needs_a=NO_RACE, needs_b=NO_RACE)
        matches.append(match)
        if row["difference"] is None:
            continue
        # Rounded first, so that the two chances are 1 together.
        chance = round(row[f"{main}p_win_a"], 2)
        match |= {f"needs_{side}": str(row[f"{main}race_{side}"]) for side in "ab"}
        match |= {"chance": f"{chance:.2f}", "chance_b": f"{1.0 - chance:.2f}"}
        match["games"] = f"{row[f'{main}mean_games']:.1f}"
        match["games_p90"] = str(row[f"{main}games_p90"])
        if tonight.pace is not None:
            match["minutes"] = f"{row[f'{main}mean_minutes']:.0f}"
            match["minutes_p90"] = f"{row[f'{main}minutes_p90']:.0f}"
        if others:
            match["fairest"] = race((row["race_a"], row["race_b"]))
            match["fairest_chance"] = f"{row['p_win_a']:.2f}"
    return matches
