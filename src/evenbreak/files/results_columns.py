"""The columns of a results file: what each may be called, and what its cells mean."""

from __future__ import annotations

import unicodedata
from functools import partial

from evenbreak.files.cells import Values, texts, whole_numbers, words
from evenbreak.files.date_cells import DateOrder, dates
from evenbreak.files.player_names import PlayerNames
from evenbreak.files.results_layout import BY_WINNER
from evenbreak.files.text_table import TextTable
from evenbreak.ratings.result_words import FORFEIT_WORDS, FORMAT_WORDS
from evenbreak.ratings.results_frame import GROUPS

NAMES = ("player_a", "player_b")

REQUIRED = {
    "player_a": ("player 1", "player a name", "home", "home player", "a"),
    "player_b": ("player 2", "player b name", "away", "away player", "b"),
    "score_a": ("score 1", "games a", "games 1", "home score", "frames a", "racks won a"),
    "score_b": ("score 2", "games b", "games 2", "away score", "frames b", "racks won b"),
}
"""The columns that a results file must have, with their other names."""

OPTIONAL = {
    "date": ("day", "match date", "played", "played on"),
    "race_a": ("race 1", "race to a", "needs a", "home race"),
    "race_b": ("race 2", "race to b", "needs b", "away race"),
    "winner": ("won by", "match winner", "winning player", "winner name"),
    "first_break": ("first breaker", "breaks first", "lag won by"),
    "break_format": ("who breaks", "breaks next"),
    "racks": ("rack winners", "games in order"),
    "event": ("tournament", "competition", "league"),
    "team_a": ("team 1", "home team"),
    "team_b": ("team 2", "away team"),
    "division": ("class", "flight"),
    "level_a": ("level 1", "skill level a", "skill level 1", "class a", "class 1", "rating a"),
    "level_b": ("level 2", "skill level b", "skill level 2", "class b", "class 2", "rating b"),
    "forfeit": ("walkover", "forfeited", "no show", "w/o"),
    **BY_WINNER,
}
"""The columns that a results file may have, with their other names."""

_NO_SCORE = (
    ("race_a", "race_b", "winner"),
    ("race", "winner"),
    ("racks",),
    ("score",),
    ("winner_score", "loser_score", "winner", "loser"),
    ("winner_race", "loser_race", "winner", "loser"),
)
INSTEAD = {
    **dict.fromkeys(("player_a", "player_b"), (("winner", "loser"),)),
    **dict.fromkeys(("score_a", "score_b"), _NO_SCORE),
}
"""What can take the place of a column: winner and loser, a score in one cell, who won which
race, or who won each rack."""


def results_columns(
    table: TextTable, names: PlayerNames, order: DateOrder | None = None
) -> dict[str, Values]:
    """Return what the cells of a results file mean, column by column.

    Cells without a meaning are added to the table's problems. A column that the file lacks
    is empty throughout. `order` is that of day and month in dates such as 9/3/2024.
    """
    sides = ("player_a", "loser") if "loser" in table else NAMES
    a, b = (names.read(table, name) for name in sides)
    columns = {
        "player_a": a,
        "player_b": b,
        "date": dates(table, "date", order),
        "forfeit": words(table, "forfeit", FORFEIT_WORDS, choices="yes or no", empty=False),
    }
    for name in ("score_a", "score_b"):
        columns[name] = whole_numbers(table, name, may_be_empty=True)
    for name in ("race_a", "race_b"):
        remedy = "write 1, 2, 3, ..., or leave both races empty"
        columns[name] = whole_numbers(table, name, at_least=1, remedy=remedy, may_be_empty=True)
    for name in ("winner", "first_break"):
        columns[name] = names.read_side(table, name, a, b)
    choices = "winner, loser, alternate, a or b"
    columns["break_format"] = words(table, "break_format", FORMAT_WORDS, choices=choices, empty=0)
    columns["racks"] = texts(table, "racks", _without_blanks)
    for name in ("event", *GROUPS):
        columns[name] = texts(table, name, partial(unicodedata.normalize, "NFC"))
    return columns


def _without_blanks(text: str) -> str:
    return "".join(text.casefold().split())
