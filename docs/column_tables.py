"""The tables of columns in the reference of files, made from the schemas that read them.

`python docs/column_tables.py` (`make column-tables`) writes them between their marks:
`<!-- columns: roster -->` and `<!-- end of columns -->`. The build of the pages adds the other
titles of each column, and those in other languages where `<!-- titles -->` stands.
"""

from __future__ import annotations

import re
from pathlib import Path

from evenbreak.files import arcs, chain_files, charts, practice
from evenbreak.files.lists import roster, saved_ratings, season, teams
from evenbreak.files.results import aliases, columns
from evenbreak.files.tables.dates import Day
from evenbreak.files.tables.names import Name
from evenbreak.files.tables.schema import Column, Parsed, Schema, Text, Whole
from evenbreak.files.tables.titles import BYES, LANGUAGES, NOT_YET, PLAYED, SIDED, SIDES, WHOLE
from evenbreak.ratings.results_frame import FORFEITS, LARGEST_WHOLE

PAGE = Path(__file__).parent / "reference" / "files.md"
TABLE = re.compile(r"(<!-- columns: ([^>]+) -->\n)(?:.*?\n)??(<!-- end of columns -->)", re.DOTALL)
TITLES = "<!-- titles -->"

_NEEDED = [name for name, column in columns.RESULTS.columns.items() if column.needed]
_OTHERS = [name for name in columns.RESULTS.columns if name not in _NEEDED]
SCHEMAS = {
    "results": columns.RESULTS.only(*_NEEDED),
    "more of results": columns.RESULTS.only(*_OTHERS),
    "layouts": columns.LAYOUTS,
    "aliases": aliases.ALIASES,
    "chart by difference": charts.DIFFERENCES,
    "chart by level": charts.LEVELS,
    "chart of points": charts.POINTS,
    "chips": charts.CHIPS,
    "arcs": arcs.ARCS,
    "states": chain_files.STATES,
    "drill log": practice.DRILL_LOG,
    "scores": practice.SCORES,
    "shots": practice.SHOTS,
    "roster": roster.ROSTER,
    "saved ratings": saved_ratings.OF_PRIOR,
    "season": roster.OF_SEASON,
    "pairs": season.PAIRS,
    "schedule": season.SCHEDULE.only("week"),
    "team results": teams.TEAM_RESULTS,
    "teams": teams.TEAMS,
}


def table_of(schema: Schema, *, full: bool) -> str:
    """Return the table of the columns that a person writes, in full with their other titles."""
    told = [(name, column) for name, column in schema.columns.items() if _is_told(column)]
    rows = [
        ["column", "also called", "what it holds", "cells"],
        ["---"] * 4,
        *(_row(name, column) for name, column in told),
    ]
    return "".join(f"| {' | '.join(row if full else [row[0], *row[2:]])} |\n" for row in rows)


def _is_told(column: Column) -> bool:
    return bool(column.about or column.also or column.needed)


def _row(name: str, column: Column) -> list[str]:
    cells = [_cells(column)] if column.about or not isinstance(column, Text) else ["any text"]
    if column.needed and not column.instead:
        cells.append("required")
    if column.empty:
        cells.append(f"empty {column.empty}")
    elif not (column.filled or column.empty is None or isinstance(column, Text)):
        cells.append("may be empty")
    return [f"`{name}`", column.also, column.about, "; ".join(filter(None, cells))]


def _cells(column: Column) -> str:
    """Return what a cell is, with the minus sign of print, and a link to the forms of dates."""
    match column:
        case Name():
            return "a name"
        case Day():
            return "a [date](#dates)"
        case Text():
            return ""
        case Parsed():
            return column.write
        case Whole():
            return column.wanted.removesuffix(f" to {LARGEST_WHOLE:,}")
    return re.sub(r"-(?=\d)", "−", column.wanted)


WORDS = {"a forfeit": FORFEITS, "a bye": BYES, "not played yet": NOT_YET, "played": PLAYED}


def titles_by_language() -> str:
    """Return the table of titles by language, and that of the words for matches not played."""
    languages = [lang for lang in LANGUAGES if lang != "en"]
    lines = [
        f"| column | {' | '.join(LANGUAGES[lang] for lang in languages)} |",
        "|---" * (len(languages) + 1) + "|",
    ]
    sides = [{lang: both[k] for lang, both in SIDES.items()} for k in range(2)]
    titles = {
        **dict(zip(("the first side", "the other side"), sides, strict=True)),
        **{f"`{what}` of a side": words for what, words in SIDED.items()},
        **{f"`{name}`": words for name, words in WHOLE.items()},
    }
    for column, words in titles.items():
        lines.append(f"| {column} | {' | '.join(words.get(lang, '') for lang in languages)} |")
    lines += ["", "| a cell that says | words |", "|---|---|"]
    for meaning, words in WORDS.items():
        every = dict.fromkeys(", ".join(words.values()).split(", "))
        lines.append(f"| {meaning} | {', '.join(every)} |")
    return "\n".join([*lines, ""])


def with_tables(text: str, *, full: bool = False) -> str:
    """Return the page with its tables as they are now."""
    page = TABLE.sub(
        lambda mark: mark[1] + table_of(SCHEMAS[mark[2]], full=full) + mark[3],
        text,
    )
    return page.replace(TITLES, titles_by_language()) if full else page


if __name__ == "__main__":
    PAGE.write_text(with_tables(PAGE.read_text("utf-8")), "utf-8")
