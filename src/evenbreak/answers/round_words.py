"""What the page of a round says: which races these are, and what was assumed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak.answers.fair_pairs import RaceLimits
from evenbreak.answers.frames import scale_text
from evenbreak.answers.html_words import Remark, game_chance, some_names, warnings_of
from evenbreak.answers.roster_matchups import NEW
from evenbreak.answers.sheet_words import count_of, which_races
from evenbreak.files.roster import RosterFile
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import NDArray

Way = Chart | LevelChart | RaceLimits
"""What says which races are played."""

MOST_NOTES = 8
"""How many pairs are named of which there is something to say; the rest are counted."""


def races_of(frame: pd.DataFrame, prefix: str) -> pd.DataFrame:
    """Return the races of one kind, named as `matchups_frame` names them."""
    names = ("race_a", "race_b", "p_win_a", "mean_games", "games_p90")
    columns = {"player_a": "player_a", "player_b": "player_b"}
    columns |= {prefix + name: name for name in names}
    return frame[list(columns)].rename(columns=columns)


def about_races(way: Way, paired: pd.DataFrame) -> str:
    """Return which races these are, of pairs as `races_of` names them."""
    if isinstance(way, RaceLimits):
        return " ".join(which_races(paired, way))
    return f"Races by the chart {way.name}."


def notes_of(frame: pd.DataFrame) -> list[str]:
    """Return what there is to say of single pairs, except that somebody is new."""
    rows: Any = frame.itertuples(index=False)
    found = [
        f"{_whom(row.player_a)} (A), {_whom(row.player_b)} (B): {note}."
        for row in rows
        for note in row.note.split("; ")
        if note and note not in NEW
    ]
    more = len(found) - MOST_NOTES
    return found if more <= 0 else [*found[:MOST_NOTES], f"And so {more:,} more."]


def _whom(name: str) -> str:
    return some_names([name])


def rests_on(scale: Scale) -> str:
    """Return the model in a sentence."""
    return f"{game_chance(scale)}, every game independent of the others, whoever breaks."


def assumed(
    file: RosterFile,
    roster: Roster,
    names: set[str],
    *,
    scale: Scale,
    chart: Chart | LevelChart | None,
    minutes_per_game: float | None,
) -> Iterator[Remark]:
    """Yield what the races rest on besides the list of players.

    Parameters
    ----------
    file, roster
        the list as it was read, and with new players filled in.
    names
        the players on the page.
    scale, chart, minutes_per_game
        as `roster_matchups` was asked.
    """
    yield Remark("The ratings", f"on {scale_text(scale)}; nobody's official ratings")
    if chart is not None:
        yield Remark(f"The chart {chart.name}", "asked with ratings rounded to whole points")
    here = np.array([player in names for player in roster.players], dtype=bool)
    yield from _new_players(file.roster, roster, here)
    error = roster.standard_error[here]
    if (error > 0.0).any():
        yield Remark(
            "How far a rating may be off (±, one standard error)",
            "each chance and each length is averaged over it; the errors of two players are "
            "taken as independent, and that of their difference as normal",
        )
        yield from _about(roster, here & np.isnan(roster.standard_error), "taken as rated right")
    else:
        yield Remark("How far a rating may be off", "not stated; every rating is taken as exact")
    if minutes_per_game is not None:
        yield Remark(f"{minutes_per_game:g} minutes a game", "without pauses")
    yield from warnings_of(file)


def _new_players(read: Roster, started: Roster, here: NDArray[np.bool_]) -> Iterator[Remark]:
    """Yield whose rating or error was filled in, by the value that they got."""
    unrated = np.isnan(read.rating)
    error = started.standard_error
    filled = np.isnan(read.standard_error) & ~np.isnan(error)
    for which, why in (
        (unrated & filled, "no rating yet, taken as {0:g} ± {1:g}"),
        (unrated & ~filled, "no rating yet, taken as {0:g}"),
        (~unrated & filled, "no games yet, rating taken as right to ± {1:g}"),
    ):
        places = np.flatnonzero(which & here)
        if len(places):
            first = started.rating[places[0]], error[places[0]]
            yield from _about(started, which & here, why.format(*first))


def _about(roster: Roster, which: NDArray[np.bool_], why: str) -> Iterator[Remark]:
    names = [roster.players[place] for place in np.flatnonzero(which).tolist()]
    if names:
        yield Remark(f"{count_of(len(names), 'player', 'players')}: {some_names(names)}", why)
