"""The sheet that a tournament director reads or prints: how strong, and who gives whom what."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rich.cells import cell_len
from rich.console import Console, RenderableType
from rich.table import Table
from rich.text import Text

from evenbreak.answers.fair_pairs import RaceLimits
from evenbreak.answers.sheet_words import (
    NO_RACE,
    count_of,
    decimals_of,
    how_rated,
    how_to_read,
    left_out,
    pairs_of,
    played,
    races_by_name,
    remarks,
    scale_sentences,
    source_and_dates,
    unlike_others,
    which_races,
)
from evenbreak.files.results import ResultsFile
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    import pandas as pd

MOST_PRINTED = 30
"""Players that are printed; the files hold all."""

LONGEST_NAME = 24
GAP = 2
"""Characters between two columns."""


def sheet_text(
    file: ResultsFile,
    ratings: Ratings,
    limits: RaceLimits,
    rated: pd.DataFrame,
    paired: pd.DataFrame,
) -> str:
    """Return the sheet as text for standard output: styled on a terminal, plain elsewhere.

    Parameters
    ----------
    file, ratings, limits
        what the sheet is made of.
    rated, paired
        as `ratings_frame` and `matchups_frame` make them. Of the players in `rated` those
        that `paired` pairs are printed, 30 at most.
    """
    console = Console(highlight=False, markup=False, emoji=False)
    with console.capture() as captured:
        for line in _heading(file, ratings):
            console.print(line)
        console.print()
        for part in _tables(rated, paired, limits, ratings.scale, console.width):
            console.print(part)
    return "".join(f"{line.rstrip()}\n" for line in captured.get().splitlines())


def _heading(file: ResultsFile, ratings: Ratings) -> Iterator[str]:
    yield f"FAIR RACES from {source_and_dates(file, ratings)}"
    yield ""
    yield " ".join([played(ratings), *left_out(ratings), *unlike_others(ratings)])
    yield f"{scale_sentences(ratings)} {how_rated(ratings)}"


def _tables(
    rated: pd.DataFrame, paired: pd.DataFrame, limits: RaceLimits, scale: Scale, width: int
) -> Iterator[RenderableType]:
    """Yield the ratings and the races of the players that are paired."""
    listed = rated["player"].isin({*paired["player_a"], *paired["player_b"]})
    shown = rated[listed].head(MOST_PRINTED)
    pairs = pairs_of(paired, set(shown["player"]))
    yield _ratings_table(shown, decimals_of(scale))
    place = f"#: place among all {len(rated):,} players. " if len(rated) > len(shown) else ""
    yield f"{place}±: standard error of the rating."
    yield ""
    yield from which_races(pairs, limits)
    yield how_to_read(pairs)
    for table in _race_tables(shown, pairs, width):
        yield ""
        yield table
    yield ""
    yield from remarks(pairs)
    if listed.sum() > len(shown):
        more = count_of(listed.sum() - len(shown), "more player is", "more players are")
        yield f"{more} paired in matchups.csv."
    if len(rated) > listed.sum():
        more = count_of(len(rated) - listed.sum(), "more player is", "more players are")
        yield f"{more} rated in ratings.csv."
        yield "--top N pairs those with the most games, --players whom you name."


def _table() -> Table:
    # Without lines a sheet survives every printer, every pipe and a line of 80 characters.
    return Table(box=None, pad_edge=False, header_style="bold")


def _name(name: str) -> Text:
    """Return a name as it stands: square brackets in it are no markup."""
    return Text(name, overflow="ellipsis", no_wrap=True)


def _ratings_table(ratings: pd.DataFrame, decimals: int) -> Table:
    """Return the table of ratings; # is the place among all players."""
    table = _table()
    grouped = len(set(ratings["component"][ratings["games"] > 0])) > 1
    table.add_column("#", justify="right")
    table.add_column("player", max_width=LONGEST_NAME)
    for heading in ("rating", "±", "games", "won", "lost", *(["group"] if grouped else [])):
        table.add_column(heading, justify="right")
    rows: Any = ratings.itertuples(index=True)
    for row in rows:
        counts = (row.games, row.won, row.lost, *([row.component] if grouped else []))
        table.add_row(
            str(row.Index + 1),
            _name(row.player),
            f"{row.rating:.{decimals}f}",
            f"{row.standard_error:.{decimals}f}",
            *(f"{count:,}" for count in counts),
        )
    return table


def _race_tables(ratings: pd.DataFrame, matchups: pd.DataFrame, width: int) -> Iterator[Table]:
    """Yield the table of races, with as many columns at a time as fit."""
    races = races_by_name(matchups)
    players = [
        (str(place), name) for place, name in zip(ratings.index + 1, ratings["player"], strict=True)
    ]
    widest = max(len(text) for text in (*races.values(), NO_RACE, *(place for place, _ in players)))
    longest = min(max(cell_len(name) for _, name in players), LONGEST_NAME)
    label = max(len(place) for place, _ in players) + longest + 2 * GAP
    fitting = max(1, (width - label + GAP) // (widest + GAP))
    tables = math.ceil(len(players) / fitting)
    at_a_time = math.ceil(len(players) / tables)
    for first in range(0, len(players), at_a_time):
        block = players[first : first + at_a_time]
        table = _table()
        table.add_column("", justify="right")
        table.add_column("", max_width=LONGEST_NAME)
        for place, _ in block:
            table.add_column(place, justify="right", no_wrap=True, min_width=widest)
        for place, name in players:
            cells = [
                "" if name == other else races.get((name, other), NO_RACE) for _, other in block
            ]
            table.add_row(place, _name(name), *cells)
        yield table
