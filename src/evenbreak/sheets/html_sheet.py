"""The fair-race sheet as one HTML file: for a phone, a screen, a printer and a screen reader."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak.answers import html_words as words
from evenbreak.answers.fair_pairs import RaceLimits
from evenbreak.answers.frames import file_name
from evenbreak.answers.sheet_parts import (
    bar_ticks,
    chart_bands,
    player_lines,
    race_blocks,
    race_cards,
    sure_pairs,
)
from evenbreak.answers.sheet_words import (
    decimals_of,
    how_to_read,
    pairs_of,
    played,
    remarks,
    scale_sentences,
    source_and_dates,
    which_races,
)
from evenbreak.files.results import ResultsFile
from evenbreak.ratings.fitted import Ratings
from evenbreak.sheets.evenness_plot import HEIGHT, WIDTH, evenness_plot
from evenbreak.sheets.html_page import html_page

if TYPE_CHECKING:
    import pandas as pd

MOST_LISTED, MOST_IN_TABLE = 500, 48
"""Players in the list of ratings and in the table of races; the CSV files hold all."""


def sheet_html(
    file: ResultsFile,
    ratings: Ratings,
    limits: RaceLimits,
    rated: pd.DataFrame,
    paired: pd.DataFrame,
) -> bytes:
    """Return the sheet as one HTML file that asks no other host for anything.

    It has no script, and its Content-Security-Policy allows nothing but its own style. A
    wide page and paper show the table of races, a narrow one each player's races.

    Parameters
    ----------
    file, ratings, limits
        what the sheet is made of.
    rated, paired
        as `ratings_frame` and `matchups_frame` make them. The 500 strongest of the players
        in `rated` are listed, and the races of the 48 strongest of those in `paired`.

    Returns
    -------
    bytes
        UTF-8; the same input gives the same bytes. A control character in a name is shown
        as a mark, since HTML cannot hold it.

    >>> from evenbreak.ratings import Results, fit
    >>> from evenbreak.files.results import ResultsFile
    >>> from evenbreak.answers.fair_pairs import matchups_frame
    >>> from evenbreak.answers.frames import ratings_frame
    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> ratings, limits = fit(season), RaceLimits(race_to=7)
    >>> paired = matchups_frame(ratings, [0, 1, 2], limits)
    >>> file = ResultsFile(season, "season.csv", (), (), "0123456789abcdef")
    >>> page = sheet_html(file, ratings, limits, ratings_frame(ratings), paired).decode()
    >>> page[:15], "Fair races from season.csv" in page, "://" in page
    ('<!doctype html>', True, False)
    """
    listed = rated.head(MOST_LISTED)
    chosen = rated[rated["player"].isin({*paired["player_a"], *paired["player_b"]})]
    in_table = chosen.head(MOST_IN_TABLE)
    pairs = pairs_of(paired, set(in_table["player"]))
    lines = player_lines(rated, ratings)
    across = [lines[place] for place in in_table.index]
    sure = sure_pairs(ratings, pairs)
    furthest = max((pair.difference for pair in sure), default=0.0)
    bands = chart_bands(limits, ratings.scale, furthest) if sure else []
    shown = len(listed), len(in_table)
    links = [("races", "Races"), ("ratings", "Ratings")]
    links += [("chart", "How even")] if sure else []
    return html_page(
        "sheet.html",
        links=[*links, ("sure", "How sure"), ("left-out", "Left out")],
        title=f"Fair races from {file_name(file)}",
        source=source_and_dates(file, ratings),
        played=played(ratings),
        which_races=list(which_races(pairs, limits)),
        how_to_read=how_to_read(pairs),
        remarks=list(remarks(pairs)),
        blocks=race_blocks(across, pairs),
        cards=race_cards(across, pairs),
        scale=scale_sentences(ratings),
        lines=lines[:MOST_LISTED],
        ticks=bar_ticks(rated),
        bands=bands,
        decimals=decimals_of(ratings.scale),
        plot=evenness_plot(bands, sure, ratings.scale) if sure else None,
        size=(WIDTH, HEIGHT),
        how_sure=list(words.how_sure(ratings, sure)),
        sure=words.three_pairs(sure),
        left_out=list(words.left_out_and_why(file, ratings, rated, paired, shown)),
        model=words.about_model(ratings),
        made_of="results",
        file=file,
    )
