"""The fair-race sheet as an answer: the races, the ratings behind them, what was left out."""

from typing import Any

import pandas as pd

from evenbreak.answers.answer import Answer
from evenbreak.answers.left_out import left_out
from evenbreak.answers.parts import Column, Table
from evenbreak.answers.prior_words import prior_warnings
from evenbreak.answers.remarks import Remarks
from evenbreak.answers.report_frames import count_groups
from evenbreak.answers.scale_words import decimals_of
from evenbreak.answers.sheet import MOST_ON_SHEET, NO_RACE, Sheet
from evenbreak.answers.sheet_words import (
    about_ratings,
    heading,
    how_even,
    how_rated,
    how_to_read,
    played,
    rating_model,
)
from evenbreak.files.csv_writer import rows_of

MOST_ACROSS = 30
"""Players whose races are a table on a terminal; of more only the ratings are shown there."""


def report_answer(sheet: Sheet, *, across: int = MOST_ACROSS, listed: int | None = None) -> Answer:
    """Return a fair-race sheet as an answer.

    Parameters
    ----------
    sheet
        the sheet.
    across
        up to how many players the races are shown as a table.
    listed
        how many players the face lists with their ratings, if it lists others than those.

    >>> from evenbreak.answers.offered_races import OfferedRaces
    >>> from evenbreak.files.results.results_file import ResultsFile
    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> file = ResultsFile(season, "season.csv", (), (), "0123456789abcdef")
    >>> answer = report_answer(Sheet.of(file, fit(season), OfferedRaces(race_to=7), [0, 1, 2]))
    >>> answer.parts[1].title
    "Find your row and your opponent's column. 7:6 means that you need 7 games and your opponent 6."
    """
    shown = sheet.strongest(MOST_ON_SHEET)
    many = len(shown.listed)
    races = (
        _race_table(shown)
        if many <= across
        else f"sheet.pdf has the races between the {many} players listed below."
    )
    items = list(left_out(sheet, listed=listed, in_table=many))
    return Answer(
        "\n".join([*heading(sheet), played(sheet)]),
        [
            " ".join([sheet.offered.in_words, *how_even(shown.paired)]),
            races,
            " ".join([*about_ratings(sheet), how_rated(sheet)]),
            _ratings_table(shown),
            *([Remarks(items, "Left out")] if items else []),
        ],
        details=[rating_model(sheet)],
        warnings=list(prior_warnings(sheet.file, sheet.ratings, sheet.choice)),
        csv=Table("matchups", _columns(sheet.paired), rows_of(sheet.paired)),
        data={
            "ratings": _records(sheet.rated),
            "summary": dict(rows_of(sheet.summary)),
            "left_out": [str(item) for item in items],
        },
    )


def _race_table(sheet: Sheet) -> Table:
    """Return the races with a row and a column for each player."""
    names = sheet.listed["player"].tolist()
    places = [str(place + 1) for place in sheet.listed.index]
    wide = max(map(len, places))
    columns = [Column("player", "", left=True)]
    columns += [Column(place, place) for place in places]
    rows = [
        (
            f"{place:>{wide}}  {name}",
            *(
                None if name == other else sheet.races.get((name, other), NO_RACE)
                for other in names
            ),
        )
        for place, name in zip(places, names, strict=True)
    ]
    return Table("", columns, rows, how_to_read(sheet.paired))


def _ratings_table(sheet: Sheet) -> Table:
    decimals = decimals_of(sheet.ratings.scale)

    def points(value: float) -> str:
        return f"{value:.{decimals}f}"

    counts = ["games", "won", "lost"]
    listed = sheet.listed
    if count_groups(sheet.ratings) > 1:
        counts.append("component")
    words = {"component": "group"}
    columns = [
        Column("place", "#"),
        Column("player", "player", left=True),
        Column("rating", "rating", points),
        Column("standard_error", "give or\ntake", points),
        *(Column(name, words.get(name, name), "{:,}".format) for name in counts),
    ]
    frame = listed[["player", "rating", "standard_error", *counts]]
    rows = [(place + 1, *row) for place, row in zip(frame.index, rows_of(frame), strict=True)]
    more = len(sheet.rated) > len(listed)
    title = f"#: place among all {len(sheet.rated):,} players. " if more else ""
    return Table("", columns, rows, f"{title}Give or take: one standard error.")


def _columns(frame: pd.DataFrame) -> list[Column]:
    return [Column(str(name)) for name in frame.columns]


def _records(frame: pd.DataFrame) -> list[dict[str, Any]]:
    return Table("", _columns(frame), rows_of(frame)).to_dicts()
