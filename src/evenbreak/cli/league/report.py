"""`evenbreak report`: from a results file to the fair-race sheet."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path

from evenbreak import answers, files, sheets
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.league.sheet import MOST_ON_SHEET
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.faces import without_folders
from evenbreak.cli.kit.terminal import say, write_folder
from evenbreak.cli.league.ratings import rated, scale_by_chart
from evenbreak.files.tables.problems import quoted
from evenbreak.questions.ratings import Report
from evenbreak.words import listed

MANY_PAIRS = 50_000
"""Pairs from which a sheet takes so long that a person wonders."""


@command_of(Report, "report", page=False, always_text=True)
def command(asked: Report) -> Answer:
    """Make the fair-race sheet of a league."""
    from evenbreak.files.store.folder import check_folder

    _refuse_names(asked)
    if asked.excel:
        from evenbreak.sheets.workbook import check_workbook

        check_workbook()
    check_folder(asked.out)
    named = ["standard input" if path == "-" else path for path in asked.results]
    say(f"Reading {listed(named)}")
    file, warnings = _read(asked)
    entered = None
    if asked.players_file is not None:
        entered, file, more = _with_entrants(file, asked.players_file)
        warnings = [*warnings, *more]
        public = without_folders(more, asked.players_file, *asked.results)
        file = replace(file, warnings=(*file.warnings, *public))
    say(f"Rating {len(file.results.players):,} players")
    ratings, choice = rated(asked, file, scale_by_chart(asked), provisional=asked.provisional)
    if asked.players:
        names = _names(asked.players, ratings.players)
        chosen = answers.find_players(ratings, names, said="--players")
    elif entered is not None:
        chosen = [ratings.players.index(name) for name in entered.names]
    else:
        chosen = answers.most_active(ratings, MOST_ON_SHEET if asked.top is None else asked.top)
    if len(chosen) < 2:
        way = "{players}" if asked.players else "{players_file}"
        asked.refuse(way + " names one player. Name two or more.")
    _say_pairs(asked, len(chosen), len(ratings.players))
    offered = answers.OfferedRaces(**asked.lengths)
    sheet = answers.Sheet.of(file, ratings, offered, chosen, choice, asked.title)
    write_folder(asked.out, _files(sheet, asked))
    answer = answers.report_answer(sheet)
    return replace(answer, warnings=[*warnings, *answer.warnings])


def _refuse_names(asked: Report) -> None:
    """Refuse a name after an option for a further file, which takes none."""
    for option, suffix in (("page", ".html"), ("excel", ".xlsx")):
        for name in asked.results if getattr(asked, option) else ():
            if name.lower().endswith(suffix) and not Path(name).exists():
                asked.refuse(
                    f"{{{option}}} takes no name: it writes sheet{suffix} to the {{out}} "
                    "folder. Leave {{name}} out.",
                    name=name,
                )


def _say_pairs(asked: Report, chosen: int, players: int) -> None:
    """Say how many are paired, if not all are, or if it takes long."""
    pairs = math.comb(chosen, 2)
    if chosen == players and pairs <= MANY_PAIRS:
        return
    named = asked.players or asked.players_file
    which = "the " if chosen < players and not named else ""
    why = " who have played most" if which else " of them"
    hint = "" if named or asked.top else " (or --top N, or --players to name them)"
    long = f": {pairs:,} pairs, which takes minutes" if pairs > MANY_PAIRS else ""
    say(f"Pairing {which}{chosen:,}{why}{hint}{long}")


def _read(asked: Report) -> tuple[files.ResultsFile, Sequence[str]]:
    """Return the results and the warnings about them; the file's own name no private folder."""
    file = files.read_seasons(asked.results, **asked.reading)
    file = replace(file, warnings=(*file.warnings, *file.ties))
    if asked.aliases is None:
        return file, file.warnings
    # The sheet is handed out, and folders are private.
    public = without_folders(file.warnings, asked.aliases)
    return replace(file, warnings=tuple(public)), file.warnings


def _with_entrants(
    file: files.ResultsFile, path: str
) -> tuple[files.Entered, files.ResultsFile, list[str]]:
    """Return who has entered, the results with those who are new in them, and warnings."""
    entrants = files.read_entrants(path)
    entered = files.entered(entrants, file.results.players, file.source)
    results = replace(file.results, players=(*file.results.players, *entered.new))
    warnings = list(entered.warnings)
    for name, rating in zip(entered.names, entrants.roster.rating.tolist(), strict=True):
        if not math.isnan(rating) and name in entered.new:
            warnings.append(
                f"{path}: the rating of {quoted(name)} is not used, because a report rates players "
                "from results alone; evenbreak matchups uses it"
            )
    return entered, replace(file, results=results), warnings


def _files(sheet: answers.Sheet, asked: Report) -> dict[str, bytes]:
    """Return the content of each file by its name."""
    from evenbreak.files.csv_writer import to_csv

    written = {
        "ratings.csv": to_csv(sheet.rated, excel=asked.excel_csv),
        "matchups.csv": to_csv(sheet.paired, excel=asked.excel_csv),
        "summary.csv": to_csv(sheet.summary, excel=asked.excel_csv),
        "sheet.pdf": sheets.sheet_pdf(sheet, asked.paper or sheets.usual_paper()),
    }
    if asked.page:
        written["sheet.html"] = sheets.sheet_html(sheet)
    if asked.excel:
        written["sheet.xlsx"] = sheets.workbook_bytes(sheets.report_tables(sheet))
    return written


def _names(texts: Sequence[str], players: Collection[str]) -> list[str]:
    """Return the names that --players lists; a name with a comma in it is given by itself."""
    names = []
    for text in texts:
        parts = [text] if text.strip() in players else text.split(",")
        names += [" ".join(part.split()) for part in parts if part.strip()]
    return names
