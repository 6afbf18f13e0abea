"""The sheet that a tournament director reads or prints: how strong, and who gives whom what."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from rich.cells import cell_len
from rich.console import Console, RenderableType
from rich.table import Table
from rich.text import Text

from evenbreak.ratings.fit import Ratings
from evenbreak.ratings.scale import Scale
from evenbreak.reports.frames import count_groups, dates_of, file_name, scale_text
from evenbreak.reports.matchups import RaceLimits
from evenbreak.reports.read_results import ResultsFile

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["sheet_text"]

MOST_PRINTED = 30
"""Players that are printed; the files hold all."""

LONGEST_NAME = 24
NO_RACE = "-"
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
    first, last = dates_of(file.results)
    days = f", {first}" if first else ""
    days += f" to {last}" if last != first else ""
    yield f"FAIR RACES from {file_name(file)}{days}"
    yield ""
    idle = int((ratings.games == 0).sum())
    facts = [
        f"{_count(ratings.matches, 'match', 'matches')} of {len(ratings.players) - idle:,} "
        f"players, {_count(int(ratings.won.sum()), 'game', 'games')}."
    ]
    left_out = [
        f"{count:,} {what}"
        for count, what in ((ratings.forfeits, "forfeited"), (ratings.empty, "at 0-0"))
        if count
    ]
    if left_out:
        facts.append(f"Left out: {' and '.join(left_out)}.")
    if idle:
        names = _count(idle, "more player has", "more players have")
        facts.append(f"{names} no game: rated in the middle for want of knowledge.")
    groups = count_groups(ratings)
    if groups > 1:
        facts.append(
            f"{groups:,} groups of players never met; ratings compare only within a group."
        )
    yield " ".join(facts)
    yield (
        f"Ratings on {scale_text(ratings.scale)}, mean {ratings.anchor:g}. "
        "They are nobody's official ratings."
    )


def _tables(
    rated: pd.DataFrame, paired: pd.DataFrame, limits: RaceLimits, scale: Scale, width: int
) -> Iterator[RenderableType]:
    """Yield the ratings and the races of the players that are paired."""
    listed = rated["player"].isin({*paired["player_a"], *paired["player_b"]})
    shown = rated[listed].head(MOST_PRINTED)
    yield _ratings_table(shown, _decimals(scale))
    place = f"#: place among all {len(rated):,} players. " if len(rated) > len(shown) else ""
    yield f"{place}±: standard error of the rating."
    yield ""
    if limits.race_to is not None:
        yield f"The fairest races in which the stronger player needs {limits.race_to} games."
    elif limits.games is not None:
        low, high = limits.games
        yield f"The fairest races whose longest possible match has {low} to {high} games."
    yield "Row: you. Column: your opponent. 7:4: you need 7 games, your opponent 4."
    for table in _race_tables(shown, paired, width):
        yield ""
        yield table
    yield ""
    yield from _remarks(paired)
    if listed.sum() > len(shown):
        more = _count(listed.sum() - len(shown), "more player is", "more players are")
        yield f"{more} paired in matchups.csv."
    if len(rated) > listed.sum():
        more = _count(len(rated) - listed.sum(), "more player is", "more players are")
        yield f"{more} rated in ratings.csv; --top and --players say whom to pair."


def _count(number: int, one: str, many: str) -> str:
    return f"{number:,} {one if number == 1 else many}"


def _decimals(scale: Scale) -> int:
    """Return how many decimals of a rating a person needs: about a hundredth of a doubling."""
    return max(0, 2 - math.floor(math.log10(scale.points_per_doubling)))


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
    races = _races(matchups)
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


def _races(matchups: pd.DataFrame) -> dict[tuple[str, str], str]:
    races = {}
    rows: Any = matchups.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        races[pair.player_a, pair.player_b] = f"{pair.race_a}:{pair.race_b}"
        races[pair.player_b, pair.player_a] = f"{pair.race_b}:{pair.race_a}"
    return races


def _remarks(matchups: pd.DataFrame) -> Iterator[str]:
    """Yield what the numbers of the races come to."""
    offered = matchups.dropna(subset=["race_a"])
    if len(offered):
        low, high = offered["p_win_a"].min(), offered["p_win_a"].max()
        yield (
            f"The stronger player wins these with a chance of {low:.3f}"
            + (f" to {high:.3f}." if high > low else ".")
        )
        yield (
            f"The longest of them lasts {offered['mean_games'].max():.1f} games on average; "
            f"9 of 10 end within {offered['games_p90'].max()}."
        )
    missing = len(matchups) - len(offered)
    if missing:
        yield (
            f"{NO_RACE} is a pair without a race: no chain of opponents links the two, so that "
            f"their ratings cannot be compared ({_count(missing, 'such pair', 'such pairs')})."
        )
