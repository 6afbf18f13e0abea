"""`evenbreak report`: from a results file to the fair-race sheet."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Literal

import click

from evenbreak import answers, files, sheets
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.wording import listed
from evenbreak.answers.league.sheet import MOST_ON_SHEET
from evenbreak.cli.kit.faces import faces, without_folders
from evenbreak.cli.kit.options import (
    out_option,
    players_file_option,
    race_limit_options,
    results_options,
    scale_option,
)
from evenbreak.cli.kit.terminal import say, write_folder
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.cli.league.rate_options import how_to_rate, offered_races, rated
from evenbreak.files.tables.names import clean_name, is_name
from evenbreak.files.tables.problems import quoted
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    from evenbreak.files.results.results_file import ResultsFile


MOST_PAIRED = 1000

MANY_PAIRS = 50_000
"""Pairs from which a sheet takes so long that a person wonders."""

EXAMPLES = """\b
Examples:
  evenbreak report season.csv --out sheet
  evenbreak report season.csv --out sheet --scale fargo --race-to 9
  evenbreak report season.csv --out sheet --games 7..13 --players "Ann Lee,Bo Diaz"
  evenbreak report season.csv --out sheet --html --excel --title "Tuesday league"
  evenbreak report season.csv --out sheet --prior 20 --half-life 365
"""


class ReportCommand(click.Command):
    """A command whose options for further files take no name."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the words, and say what becomes of a name after --html or --excel."""
        for option, suffix in (("--html", ".html"), ("--excel", ".xlsx")):
            for word, name in pairwise(args):
                if word == option and name.lower().endswith(suffix):
                    message = (
                        f"{option} takes no name: it writes sheet{suffix} to the folder of --out; "
                        f"leave {name} out"
                    )
                    raise click.UsageError(message, ctx=ctx)
        return super().parse_args(ctx, args)


def _title(ctx: click.Context, param: click.Parameter, value: str) -> str:  # noqa: ARG001
    title = clean_name(value)
    if title and not is_name(title):
        refuse(f"--title has {len(title):,} letters, or some that cannot be printed; give a line")
    return title


@click.command("report", cls=ReportCommand, epilog=EXAMPLES)
@click.argument("results", metavar="RESULTS.csv...", nargs=-1, required=True)
@out_option(
    "The folder for ratings.csv, matchups.csv, summary.csv and sheet.pdf; created if needed."
)
@scale_option()
@how_to_rate
@race_limit_options
@click.option(
    "--players",
    multiple=True,
    metavar="NAMES",
    help="The players to pair, separated by commas; can be repeated.",
)
@click.option(
    "--top",
    type=Whole(2, MOST_PAIRED),
    metavar="N",
    help="Pair only the N players with the most games.  "
    f"[default: everybody, or {MOST_ON_SHEET} of a larger league]",
)
@players_file_option
@results_options
@click.option(
    "--title",
    metavar="TEXT",
    default="",
    show_default=False,
    callback=_title,
    help="What stands above the sheet, such as the league's name.  [default: none]",
)
@click.option(
    "--html", is_flag=True, help="Also write sheet.html, one file for phones, screens and printers."
)
@click.option("--excel", is_flag=True, help="Also write sheet.xlsx, a workbook of all tables.")
@click.option("--excel-csv", is_flag=True, help="Write the CSV files for Excel, with BOM and CRLF.")
@faces(page=False, always_text=True)
def command(
    results: tuple[str, ...],
    out: str,
    scale: Scale,
    prior: float | Literal["best"] | None,
    half_life: float | str | None,
    as_of: str | None,
    begin: str | None,
    games: tuple[int, int] | None,
    race_to: int | None,
    players: tuple[str, ...],
    top: int | None,
    players_file: str | None,
    reading: dict[str, Any],
    title: str,
    html: bool,
    excel: bool,
    excel_csv: bool,
) -> Answer:
    """Make the fair-race sheet of a league from its results file.

    RESULTS.csv has a match in each row, with the columns player_a, player_b, score_a,
    score_b and, if known, date, race_a, race_b, winner, first_break, break_format,
    racks, event and forfeit; `evenbreak rate --help` names other ways. - reads standard
    input. The sheet gives the rating
    of each player and the race nearest to even for each pair, a race to 7 unless --games
    or --race-to says otherwise, and holds all players, the strongest first. Several files are
    read as one. The sheet is printed
    here, and sheet.pdf is for the wall; --html adds a page to hand out, --excel a workbook.
    """
    offered = offered_races(games, race_to)
    ways = {"--players": players, "--top": top, "--players-file": players_file}
    given = [name for name, value in ways.items() if value]
    if len(given) > 1:
        refuse(f"{' and '.join(given)} cannot be combined; leave all but one out")
    if excel:
        from evenbreak.sheets.workbook import check_workbook

        check_workbook()
    from evenbreak.files.store.folder import check_folder

    check_folder(out)
    named = ["standard input" if path == "-" else path for path in results]
    say(f"Reading {listed(named)}")
    file, warnings = _read(results, reading)
    found = None
    if players_file is not None:
        found, file, more = _with_entrants(file, players_file)
        warnings = [*warnings, *more]
        public = without_folders(more, players_file, *results)
        file = replace(file, warnings=(*file.warnings, *public))
    say(f"Rating {len(file.results.players):,} players")
    ratings, choice = rated(file, scale, prior=prior, half_life=half_life, as_of=as_of, begin=begin)
    if players:
        chosen = answers.find_players(ratings, _names(players, ratings.players), said="--players")
    elif found is not None:
        chosen = [ratings.players.index(name) for name in found.names]
    else:
        chosen = answers.most_active(ratings, MOST_ON_SHEET if top is None else top)
    if len(chosen) < 2:
        refuse(f"{given[0]} names one player; name two or more")
    pairs = math.comb(len(chosen), 2)
    if len(chosen) < len(ratings.players) or pairs > MANY_PAIRS:
        few = len(chosen) < len(ratings.players)
        why = " who have played most" if few and not (players or players_file) else ""
        hint = "" if given else " (or --top N, or --players to name them)"
        long = f": {pairs:,} pairs, which takes minutes" if pairs > MANY_PAIRS else ""
        say(f"Pairing {len(chosen):,} of them{why}{hint}{long}")
    sheet = answers.Sheet.of(file, ratings, offered, chosen, choice, title)
    write_folder(out, _files(sheet, html=html, excel=excel, excel_csv=excel_csv))
    answer = answers.report_answer(sheet)
    return replace(answer, warnings=[*warnings, *answer.warnings])


def _read(results: Sequence[str], reading: dict[str, Any]) -> tuple[ResultsFile, Sequence[str]]:
    """Return the results and the warnings about them; the file's own name no private folder."""
    file = files.read_seasons(results, **reading)
    file = replace(file, warnings=(*file.warnings, *file.ties))
    aliases = reading["aliases"]
    if aliases is None:
        return file, file.warnings
    # The sheet is handed out, and folders are private.
    public = without_folders(file.warnings, aliases)
    return replace(file, warnings=tuple(public)), file.warnings


def _with_entrants(file: ResultsFile, path: str) -> tuple[files.Entered, ResultsFile, list[str]]:
    """Return who has entered, the results with those who are new in them, and warnings."""
    entrants = files.read_entrants(path)
    found = files.entered(entrants, file.results.players, file.source)
    results = replace(file.results, players=(*file.results.players, *found.new))
    warnings = list(found.warnings)
    for name, rating in zip(found.names, entrants.roster.rating.tolist(), strict=True):
        if not math.isnan(rating) and name in found.new:
            warnings.append(
                f"{path}: the rating of {quoted(name)} is not used, because a report rates players "
                "from results alone; evenbreak matchups uses it"
            )
    return found, replace(file, results=results), warnings


def _files(sheet: answers.Sheet, *, html: bool, excel: bool, excel_csv: bool) -> dict[str, bytes]:
    """Return the content of each file by its name."""
    from evenbreak.files.csv_writer import to_csv

    written = {
        "ratings.csv": to_csv(sheet.rated, excel=excel_csv),
        "matchups.csv": to_csv(sheet.paired, excel=excel_csv),
        "summary.csv": to_csv(sheet.summary, excel=excel_csv),
        "sheet.pdf": sheets.sheet_pdf(sheet),
    }
    if html:
        written["sheet.html"] = sheets.sheet_html(sheet)
    if excel:
        written["sheet.xlsx"] = sheets.workbook_bytes(sheets.report_tables(sheet))
    return written


def _names(given: Sequence[str], players: Collection[str]) -> list[str]:
    """Return the names that --players lists; a name with a comma in it is given by itself."""
    names = []
    for text in given:
        parts = [text] if text.strip() in players else text.split(",")
        names += [" ".join(part.split()) for part in parts if part.strip()]
    return names
