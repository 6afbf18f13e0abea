"""The fair-race sheet as one HTML file: for a phone, a screen, a printer and a screen reader."""

from dataclasses import replace

from evenbreak.answers.kit.scales import decimals_of
from evenbreak.answers.league.pairs import how_sure, three_pairs
from evenbreak.answers.league.report import NOTHING_LEFT_OUT, how_even, how_to_read, report_answer
from evenbreak.answers.league.sheet import MOST_ON_SHEET, Sheet, count_groups
from evenbreak.sheets.answer_page import Section, drawn_page
from evenbreak.sheets.evenness_plot import HEIGHT, WIDTH, evenness_plot
from evenbreak.sheets.html_page import drawn
from evenbreak.sheets.race_blocks import race_blocks, race_cards
from evenbreak.sheets.rating_bars import Bars, player_lines

MOST_LISTED = 500
"""Players in the list of ratings; the CSV files hold all."""


def sheet_html(sheet: Sheet) -> bytes:
    """Return the sheet as one HTML file that asks no other host for anything.

    Its Content-Security-Policy allows its own style, the script of its search box, and nothing
    else. A wide page and paper show the table of races, a narrow one each player's races. The 500
    strongest players are listed, and the races of the `MOST_ON_SHEET` strongest of those who are
    paired. All else is what `report_answer` says.

    Returns
    -------
    bytes
        UTF-8; the same sheet gives the same bytes. A control character in a name is shown
        as a mark, since HTML cannot hold it.

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
        form = shown.ratings.match_form
        plot = evenness_plot(shown.bands, shown.sure, scale, shown.typical_error, form)
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
