"""The fair-race sheet as one HTML file: for a phone, a screen, a printer and a screen reader."""

from __future__ import annotations

from evenbreak.answers.left_out import left_out
from evenbreak.answers.remarks import warnings_of
from evenbreak.answers.report_frames import count_groups, file_name
from evenbreak.answers.scale_words import decimals_of
from evenbreak.answers.sheet import Sheet
from evenbreak.answers.sheet_words import (
    about_model,
    about_ratings,
    how_even,
    how_rated,
    how_to_read,
    played,
    source_and_dates,
)
from evenbreak.answers.sure_pairs import how_sure, three_pairs
from evenbreak.sheets.evenness_plot import HEIGHT, WIDTH, evenness_plot
from evenbreak.sheets.html_page import html_page
from evenbreak.sheets.race_blocks import race_blocks, race_cards
from evenbreak.sheets.rating_bars import Bars, player_lines

MOST_LISTED, MOST_IN_TABLE = 500, 48
"""Players in the list of ratings and in the table of races; the CSV files hold all."""


def sheet_html(sheet: Sheet) -> bytes:
    """Return the sheet as one HTML file that asks no other host for anything.

    It has no script, and its Content-Security-Policy allows nothing but its own style. A
    wide page and paper show the table of races, a narrow one each player's races. The 500
    strongest players are listed, and the races of the 48 strongest of those who are paired.

    Returns
    -------
    bytes
        UTF-8; the same sheet gives the same bytes. A control character in a name is shown
        as a mark, since HTML cannot hold it.

    >>> from evenbreak.answers.offered_races import OfferedRaces
    >>> from evenbreak.files.results import ResultsFile
    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> file = ResultsFile(season, "season.csv", (), (), "0123456789abcdef")
    >>> sheet = Sheet.of(file, fit(season), OfferedRaces(race_to=7), [0, 1, 2])
    >>> page = sheet_html(sheet).decode()
    >>> page[:15], "Fair races from season.csv" in page, "://" in page
    ('<!doctype html>', True, False)
    """
    shown, scale = sheet.strongest(MOST_IN_TABLE), sheet.ratings.scale
    bars = Bars(sheet.rated)
    grouped = count_groups(sheet.ratings) > 1
    lines = player_lines(sheet.rated, scale, bars, grouped=grouped)
    across = [lines[place] for place in shown.listed.index]
    listed = lines[:MOST_LISTED]
    links = [("races", "Races"), ("ratings", "Ratings")]
    links += [("chart", "How even")] if shown.sure else []
    return html_page(
        "sheet.html",
        links=[*links, ("sure", "How sure"), ("left-out", "Left out")],
        title=f"Fair races from {file_name(sheet.file)}",
        source=source_and_dates(sheet),
        played=played(sheet),
        which_races=sheet.offered.in_words,
        how_to_read=how_to_read(shown.paired),
        remarks=list(how_even(shown.paired)),
        blocks=race_blocks(across, shown.races),
        cards=race_cards(across, shown.races, shown.paired),
        about_ratings=[*about_ratings(sheet), how_rated(sheet)],
        lines=listed,
        ticks=bars.ticks(),
        bands=shown.bands,
        decimals=decimals_of(scale),
        plot=evenness_plot(shown.bands, shown.sure, scale) if shown.sure else None,
        size=(WIDTH, HEIGHT),
        how_sure=list(how_sure(scale, shown.sure)),
        sure=three_pairs(shown.sure),
        left_out=[
            *left_out(sheet, listed=len(listed), in_table=len(across)),
            *warnings_of(sheet.file),
        ],
        model=about_model(sheet),
        made_of="results",
        file=sheet.file,
    )
