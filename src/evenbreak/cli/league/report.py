"""`evenbreak report`: from a results file to the fair-race sheet."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING

import click

from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import aliases_option, refuse_both, scale_option, which_races
from evenbreak.cli.kit.terminal import say
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.cli.league.rate_options import how_to_rate, rated

if TYPE_CHECKING:
    from evenbreak.answers.answer import Answer
    from evenbreak.answers.sheet import Sheet
    from evenbreak.files.results import ResultsFile
    from evenbreak.ratings.scale import Scale

TOP, MOST_PAIRED = 10, 1000
RACE_TO = 7

EXAMPLES = """\b
Examples:
  evenbreak report season.csv --out sheet
  evenbreak report season.csv --out sheet --scale fargo --race-to 9
  evenbreak report season.csv --out sheet --games 7..13 --players "Ann Lee,Bo Diaz"
  evenbreak report season.csv --out sheet --top 24 --html --excel
  evenbreak report season.csv --out sheet --prior best --half-life 365
"""


@click.command("report", epilog=EXAMPLES)
@click.argument("results", metavar="RESULTS.csv")
@click.option(
    "--out",
    required=True,
    metavar="DIR",
    type=click.Path(file_okay=False),
    help="The folder for ratings.csv, matchups.csv, summary.csv and sheet.pdf; created if needed.",
)
@scale_option()
@how_to_rate
@which_races
@click.option(
    "--players",
    multiple=True,
    metavar="NAMES",
    help="The players to pair: names separated by commas; may be given again.",
)
@click.option(
    "--top",
    type=Whole(2, MOST_PAIRED),
    metavar="N",
    help=f"Pair the N players with the most games.  [default: {TOP}, without --players]",
)
@aliases_option
@click.option(
    "--html", is_flag=True, help="Also write sheet.html, one file for phones, screens and printers."
)
@click.option("--excel", is_flag=True, help="Also write sheet.xlsx, a workbook of all tables.")
@click.option(
    "--excel-csv", is_flag=True, help="Write the CSV files as Excel likes them: BOM and CRLF."
)
@faces(page=False, always_text=True)
def command(
    results: str,
    out: str,
    scale: Scale,
    prior: float | str | None,
    half_life: float | None,
    as_of: str | None,
    games: tuple[int, int] | None,
    race_to: int | None,
    players: tuple[str, ...],
    top: int | None,
    aliases: str | None,
    html: bool,
    excel: bool,
    excel_csv: bool,
) -> Answer:
    """Make the fair-race sheet of a league from its results file.

    RESULTS.csv has a match in each row, with the columns player_a, player_b, score_a,
    score_b and, if you like, date, race_a, race_b, winner, first_break, break_format,
    racks, event and forfeit; - reads standard input. The sheet says how strong each
    player is and which race is nearest to even for each pair: races to 7, unless --games
    or --race-to says otherwise. The sheet is printed, and sheet.pdf has it for the wall;
    --html adds a page to hand out, --excel a workbook.
    """
    refuse_both(games, race_to)
    if players and top is not None:
        refuse("--players and --top exclude each other; leave one out")
    if not out.strip():
        refuse("--out is empty; name a folder, or . for this one")
    if excel:
        from evenbreak.sheets.workbook import check_workbook

        check_workbook()
    from evenbreak.answers.chosen_players import find_players, most_active
    from evenbreak.answers.offered_races import OfferedRaces
    from evenbreak.answers.report import report_answer
    from evenbreak.answers.sheet import Sheet
    from evenbreak.files.folder import check_folder, write_files

    check_folder(out)
    offered = OfferedRaces(games, RACE_TO if games is None and race_to is None else race_to)
    say(f"Reading {'standard input' if results == '-' else results}")
    file, warnings = _read(results, aliases)
    say(f"Rating {len(file.results.players):,} players")
    ratings, choice = rated(file, scale, prior=prior, half_life=half_life, as_of=as_of)
    if players:
        chosen = find_players(ratings, _names(players, ratings.players), said="--players")
    else:
        chosen = most_active(ratings, TOP if top is None else top)
    if len(chosen) < 2:
        refuse("--players names one player; name two or more")
    more = not players and top is None and len(chosen) < len(ratings.players)
    hint = " (--top N pairs more, --players those you name)" if more else ""
    say(f"Pairing {len(chosen):,} of them{hint}")
    sheet = Sheet.of(file, ratings, offered, chosen, choice)
    files = _files(sheet, html=html, excel=excel, excel_csv=excel_csv)
    write_files(out, files)
    say(f"Wrote {', '.join(files)} to {out}")
    return replace(report_answer(sheet), warnings=warnings)


def _read(results: str, aliases: str | None) -> tuple[ResultsFile, Sequence[str]]:
    """Return the results and the warnings about them; the file's own name no private folder."""
    from evenbreak.files.results import read_results

    file = read_results(results, aliases=aliases)
    if aliases is None:
        return file, file.warnings
    # The sheet is handed out, and folders are private.
    public = [text.replace(aliases, PurePath(aliases).name) for text in file.warnings]
    return replace(file, warnings=tuple(public)), file.warnings


def _files(sheet: Sheet, *, html: bool, excel: bool, excel_csv: bool) -> dict[str, bytes]:
    """Return the content of each file by its name."""
    from evenbreak.files.csv_writer import to_csv
    from evenbreak.sheets.pdf_sheet import sheet_pdf

    files = {
        "ratings.csv": to_csv(sheet.rated, excel=excel_csv),
        "matchups.csv": to_csv(sheet.paired, excel=excel_csv),
        "summary.csv": to_csv(sheet.summary, excel=excel_csv),
        "sheet.pdf": sheet_pdf(sheet),
    }
    if html:
        from evenbreak.sheets.sheet_page import sheet_html

        files["sheet.html"] = sheet_html(sheet)
    if excel:
        from evenbreak.sheets.workbook import report_tables, workbook_bytes

        files["sheet.xlsx"] = workbook_bytes(report_tables(sheet))
    return files


def _names(given: Sequence[str], players: Collection[str]) -> list[str]:
    """Return the names that --players lists; a name with a comma in it is given by itself."""
    names = []
    for text in given:
        parts = [text] if text.strip() in players else text.split(",")
        names += [" ".join(part.split()) for part in parts if part.strip()]
    return names
