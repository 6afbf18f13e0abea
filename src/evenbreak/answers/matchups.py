"""Which race each pair of a round plays, who wins it how often, and how long it takes."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import pandas as pd

from evenbreak.answers.answer import Answer
from evenbreak.answers.file_words import file_name
from evenbreak.answers.form_words import form_used_words
from evenbreak.answers.parts import Column, Part, Table
from evenbreak.answers.remarks import Remarks
from evenbreak.answers.round import AT_A_TIME, Round
from evenbreak.answers.round_words import (
    about_levels,
    about_method,
    about_pairs,
    about_players,
    about_time,
    doubtful,
    evening_words,
    game_model,
    least_even,
    races_of,
    ratings_words,
    which_races,
)
from evenbreak.answers.wording import chance, decimals, race
from evenbreak.files.csv_writer import rows_of


def matchups_answer(tonight: Round, *, warnings: Sequence[str] = ()) -> Answer:
    """Return the races of a round.

    Of more than 20,000 pairs the rows are worked out while they are read, and the sentences
    are only those that do not depend on all of them.

    >>> import numpy as np
    >>> from evenbreak.answers.roster_matchups import all_pairs
    >>> from evenbreak.files.lists.roster import RosterFile
    >>> from evenbreak.handicaps import chart
    >>> from evenbreak.ratings import SCALES
    >>> from evenbreak.ratings.roster import Roster
    >>> club = Roster(["Ann", "Bo"], [92, 71])
    >>> file = RosterFile(club, np.array([2, 3]), "club.csv", (), "0123456789abcdef")
    >>> asked = {"scale": SCALES["npl"], "chart": chart("npl_10")}
    >>> tonight = Round(file=file, roster=club, pairs=all_pairs(club), **asked)
    >>> matchups_answer(tonight).sentences[0]
    'The races come from the chart npl_10. The race is 6:4 for Ann against Bo: Ann wins 53% of
    the time.'
    """
    at_once = len(tonight.pairs) <= AT_A_TIME
    frame = tonight.matchups.frame if at_once else None
    table = _table(tonight)
    parts: list[Part] = []
    for prefix in tonight.kinds:
        least = "" if frame is None else least_even(races_of(frame, prefix))
        parts.append(f"{which_races(tonight, prefix)} {least}".rstrip())
    if tonight.evening:
        parts.append("\n".join([*map(evening_words, tonight.evening), about_time(tonight)]))
    parts.append(table)
    if tonight.pace is not None and not tonight.evening:
        parts.append(about_time(tonight))
    if doubtful(tonight):
        parts.append("'A wins' is averaged over how far the ratings may be off.")
    parts += filter(None, [form_used_words(tonight.form, tonight.scale)])
    parts += [" ".join(about_levels(tonight))] if tonight.levels is not None else []
    remarks = [*([] if frame is None else about_pairs(frame)), *about_players(tonight)]
    parts += [Remarks(remarks)] if remarks else []
    method = list(about_method(tonight))
    return Answer(
        f"Races for {file_name(tonight.file)}\n{ratings_words(tonight)}",
        parts,
        details=[*([Remarks(method)] if method else []), game_model(tonight)],
        warnings=[*tonight.file.warnings, *warnings],
        data={
            "evening": tonight.evening,
            "pace": _pace(tonight),
            "form": tonight.form,
            "levels": tonight.levels
            and dict(zip(tonight.levels.levels, tonight.levels.strengths, strict=True)),
        },
        csv=table,
    )


def _pace(tonight: Round) -> dict[str, Any] | None:
    """Return what the minutes assume, in minutes and standard deviations of logarithms."""
    if tonight.pace is None:
        return None
    return {**asdict(tonight.pace), "turnover": tonight.turnover.mean}


def _table(tonight: Round) -> Table:
    columns = [Column("player_a", "A", left=True), Column("player_b", "B", left=True)]
    columns += [Column("difference"), Column("difference_error")]
    columns += [Column("p_game_a"), Column("p_game_a_plug_in")]
    both = len(tonight.kinds) > 1
    for prefix in tonight.kinds:
        columns += _race_columns(tonight, prefix, both=both)
    return Table("pairs", [*columns, Column("note")], _Rows(tonight, columns))


def _race_columns(tonight: Round, prefix: str, *, both: bool) -> Iterator[Column]:
    kind = ("chart\n" if prefix else "fair\n") if both else ""
    yield Column((f"{prefix}race_a", f"{prefix}race_b"), f"{kind}race", race)
    yield Column(f"{prefix}p_win_a", "A wins", chance)
    sure = "if ratings\nare right" if doubtful(tonight) and not both else None
    yield Column(f"{prefix}p_win_a_plug_in", sure, chance, detail=True)
    if prefix:
        yield Column(f"{prefix}unfairness")
    timed = tonight.pace is not None
    within = None if both else "9 of 10\nwithin"
    average = "" if both else ",\naverage"
    yield Column(f"{prefix}mean_games", None if timed else f"games{average}", decimals(1))
    yield Column(f"{prefix}games_p90", None if timed else within)
    if timed:
        yield Column(f"{prefix}mean_minutes", f"min{average}", decimals(0))
        yield Column(f"{prefix}minutes_p90", within, decimals(0))


@dataclass(frozen=True, eq=False)
class _Rows:
    """The rows of the table, worked out each time they are read."""

    round: Round
    columns: Sequence[Column]

    def __iter__(self) -> Iterator[Sequence[Any]]:
        small = len(self.round.pairs) <= AT_A_TIME
        for part in [self.round.matchups] if small else self.round.in_parts():
            yield from self._rows(part.frame)

    def _rows(self, frame: pd.DataFrame) -> Iterator[Sequence[Any]]:
        by_name = dict(zip(frame.columns, zip(*rows_of(frame), strict=True), strict=True))
        columns: list[Sequence[Any]] = []
        for column in [*self.columns, Column("note")]:
            values = [by_name[name] for name in column.names]
            columns.append(values[0] if len(values) == 1 else _races(*values))
        return zip(*columns, strict=True)


def _races(m: Sequence[Any], n: Sequence[Any]) -> list[tuple[int, int] | None]:
    return [None if need is None else (need, other) for need, other in zip(m, n, strict=True)]
