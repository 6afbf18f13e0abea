"""`evenbreak report`: from a results file to the fair-race sheet."""

from __future__ import annotations

import sys
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import PurePath
from typing import TYPE_CHECKING

import click

from evenbreak.cli.kit.callbacks import refuse, refuse_both, wants_aliases, which_races
from evenbreak.cli.kit.output import say
from evenbreak.cli.league.rate_options import how_to_rate, rated

if TYPE_CHECKING:
    from evenbreak.answers.fair_pairs import RaceLimits
    from evenbreak.files.results import ResultsFile
    from evenbreak.ratings.fitted import Ratings

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
    help="Where ratings.csv, matchups.csv, summary.csv and sheet.pdf go; made if it is not there.",
)
@click.option(
    "--scale",
    "scale_name",
    default="npl",
    show_default=True,
    metavar="npl|fargo|elo|POINTS",
    help="The scale of the ratings: POINTS of difference double the odds of a game.",
)
@how_to_rate
@which_races
@click.option(
    "--players",
    multiple=True,
    metavar="NAMES",
    help="Whom to pair: names with commas between them; may be given again.",
)
@click.option(
    "--top",
    type=click.IntRange(2, MOST_PAIRED),
    metavar="N",
    help=f"Pair the N players with the most games.  [default: {TOP}, without --players]",
)
@wants_aliases
@click.option(
    "--html", is_flag=True, help="Also write sheet.html, one file for phones, screens and printers."
)
@click.option("--excel", is_flag=True, help="Also write sheet.xlsx, a workbook of all tables.")
@click.option(
    "--excel-csv", is_flag=True, help="Write the CSV files as Excel likes them: BOM and CRLF."
)
def command(
    results: str,
    out: str,
    scale_name: str,
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
) -> None:
    """Make the fair-race sheet of a league from its results file.

    RESULTS.csv has a match in each row, with the columns player_a, player_b, score_a,
    score_b and, if you like, date, race_a, race_b, winner, first_break, break_format,
    racks, event and forfeit; - reads standard input. The sheet says how strong each
    player is and which race is nearest to even for each pair; races to 7, unless --games
    or --race-to says otherwise. It is printed, and sheet.pdf has it for paper; --html makes
    a page of it to hand out, --excel a workbook.
    """
    refuse_both(games, race_to)
    if players and top is not None:
        refuse("--players and --top exclude each other; leave one out")
    if not out.strip():
        refuse("--out is empty; name a folder, or . for this one")
    if excel:
        from evenbreak.sheets.workbook import check_workbook

        check_workbook()
    from evenbreak.answers.fair_pairs import RaceLimits, find_players, most_active
    from evenbreak.answers.rate import choice_words
    from evenbreak.files.folder import check_folder, write_files
    from evenbreak.files.results import read_results
    from evenbreak.ratings.scale import scale_of

    check_folder(out)
    scale = scale_of(scale_name)
    limits = RaceLimits(games, RACE_TO if games is None and race_to is None else race_to)
    say(f"Reading {'standard input' if results == '-' else results}")
    file = read_results(results, aliases=aliases)
    for warning in file.warnings:
        say(f"Warning: {warning}")
    if aliases is not None:
        # The sheet is handed out, and folders are nobody else's business.
        told = [text.replace(aliases, PurePath(aliases).name) for text in file.warnings]
        file = replace(file, warnings=tuple(told))
    say(f"Rating {len(file.results.players):,} players")
    ratings, choice = rated(file, scale, prior=prior, half_life=half_life, as_of=as_of)
    if choice is not None:
        say(choice_words(ratings, choice))
    if players:
        chosen = find_players(ratings, _names(players, ratings.players), said="--players")
    else:
        chosen = most_active(ratings, TOP if top is None else top)
    if len(chosen) < 2:
        refuse("--players names one player; name two or more")
    say(f"Pairing {len(chosen):,} of them")
    files, text = _sheets(
        file, ratings, limits, chosen, html=html, excel=excel, excel_csv=excel_csv
    )
    write_files(out, files)
    say(f"Wrote {', '.join(files)} to {out}")
    # Names may have letters that the terminal's encoding lacks.
    click.echo(text.encode(sys.stdout.encoding or "utf-8", "replace"), nl=False)


def _sheets(
    file: ResultsFile,
    ratings: Ratings,
    limits: RaceLimits,
    chosen: Sequence[int],
    *,
    html: bool,
    excel: bool,
    excel_csv: bool,
) -> tuple[dict[str, bytes], str]:
    """Return the content of each file by its name, and the sheet as text."""
    from evenbreak.answers.fair_pairs import matchups_frame
    from evenbreak.answers.frames import file_name, ratings_frame, summary_frame
    from evenbreak.files.csv_writer import to_csv
    from evenbreak.sheets.pdf_page import pdf_bytes
    from evenbreak.sheets.pdf_sheet import sheet_pages
    from evenbreak.sheets.text_sheet import sheet_text

    rated = ratings_frame(ratings)
    paired = matchups_frame(ratings, chosen, limits)
    told = summary_frame(file, ratings, paired, limits)
    pages = sheet_pages(file, ratings, limits, rated, paired)
    files = {
        "ratings.csv": to_csv(rated, excel=excel_csv),
        "matchups.csv": to_csv(paired, excel=excel_csv),
        "summary.csv": to_csv(told, excel=excel_csv),
        "sheet.pdf": pdf_bytes(pages, f"Fair races from {file_name(file)}"),
    }
    if html:
        from evenbreak.sheets.html_sheet import sheet_html

        files["sheet.html"] = sheet_html(file, ratings, limits, rated, paired)
    if excel:
        from evenbreak.sheets.workbook import report_tables, workbook_bytes

        tables = report_tables(file, ratings, limits, rated, paired, told)
        files["sheet.xlsx"] = workbook_bytes(tables)
    return files, sheet_text(file, ratings, limits, rated, paired)


def _names(given: Sequence[str], players: Collection[str]) -> list[str]:
    """Return the names that --players lists; a name that itself has a comma is given alone."""
    names = []
    for text in given:
        parts = [text] if text.strip() in players else text.split(",")
        names += [" ".join(part.split()) for part in parts if part.strip()]
    return names
