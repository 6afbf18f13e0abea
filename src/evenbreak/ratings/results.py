"""Match results, stored by column.

A `Results` holds one match per row, as arrays. It knows nothing of files: a reader builds a
`Results`, asks `find_problems` for contradictions in it, and reports the line of the file for each
one. Every check is a mask over all rows; a message is made only for the rows that fail it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from evenbreak.arrays import Bools, Ints, own_arrays
from evenbreak.checks import column, names
from evenbreak.errors import InputError
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.results_frame import FORMATS, FrameReader, columns_of
from evenbreak.words import Parameter

if TYPE_CHECKING:
    import pandas as pd


_TYPES: dict[str, Any] = {
    "player_a": np.int64,
    "player_b": np.int64,
    "score_a": np.int64,
    "score_b": np.int64,
    "date": "datetime64[D]",
    "race_a": np.int64,
    "race_b": np.int64,
    "winner": np.int8,
    "first_break": np.int8,
    "break_format": np.int8,
    "racks": object,
    "event": object,
    "team_a": object,
    "team_b": object,
    "division": object,
    "level_a": object,
    "level_b": object,
    "forfeit": np.bool_,
    "unscored": np.bool_,
}
_CODES = {"winner": 3, "first_break": 3, "break_format": len(FORMATS)}


class Played(NamedTuple):
    """The matches played, and how many rows were left out as forfeits or 0-0."""

    results: Results
    forfeits: int
    empty: int


@own_arrays
@dataclass(frozen=True, eq=False)
class Results:
    """Matches as columns: one row per match, in read-only arrays of equal length.

    Parameters
    ----------
    players
        the names, each once.
    player_a, player_b
        who played: positions in `players`. It makes no difference which player is called a; in
        particular, a is not assumed to break.
    score_a, score_b
        games won by each.
    date
        days (`datetime64[D]`, NaT where not stated).
    race_a, race_b
        the games that each needed to win the match, 0 where not stated. If they are stated, the
        player who reached their race won, even with fewer games.
    winner, first_break
        the winner of the match and the first breaker: 1 for a, 2 for b, 0 where not stated.
    break_format
        who breaks the next rack: positions in `FORMATS`, 0 where not stated.
    racks
        who won each rack, in order, as a string like 'abba'; '' where not stated.
    event
        any text.
    team_a, team_b, division
        the team of each player and the division of the match; '' where not stated.
    level_a, level_b
        the class, the skill level or the rating by which the league handicaps each player, as a
        string; '' where not stated.
    forfeit
        whether the match was a forfeit; its scores then do not count as games played.
    unscored
        whether only the race and the winner are known; both must then be stated, and
        the scores are 0.

    Optional columns that don't exist are None.

    Raises
    ------
    InputError
        if columns differ in length, hold a value of the wrong type (a score of 2.5, a forfeit
        marked NaN or 'no'), or a position or code is out of range. Contradictions from typing
        errors are left to `find_problems`.

    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 0], [5, 0])
    >>> season.players, season.player_a, len(season)
    (('Ann', 'Bo', 'Cy'), array([0, 1]), 2)
    """

    players: tuple[str, ...]
    player_a: Ints
    player_b: Ints
    score_a: Ints
    score_b: Ints
    _: KW_ONLY
    date: NDArray[np.datetime64] | None = None
    race_a: Ints | None = None
    race_b: Ints | None = None
    winner: NDArray[np.int8] | None = None
    first_break: NDArray[np.int8] | None = None
    break_format: NDArray[np.int8] | None = None
    racks: NDArray[np.object_] | None = None
    event: NDArray[np.object_] | None = None
    team_a: NDArray[np.object_] | None = None
    team_b: NDArray[np.object_] | None = None
    division: NDArray[np.object_] | None = None
    level_a: NDArray[np.object_] | None = None
    level_b: NDArray[np.object_] | None = None
    forfeit: Bools | None = None
    unscored: Bools | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "players", names(self.players, "players"))
        rows = len(self.player_a)
        for name, kind in _TYPES.items():
            stated = getattr(self, name)
            if stated is None:
                continue
            values = column(stated, name, rows, "rows", kind)
            object.__setattr__(self, name, values)
            limit = len(self.players) if name.startswith("player_") else _CODES.get(name)
            if limit is not None and rows and not (0 <= values.min() <= values.max() < limit):
                raise InputError("{name} must hold codes below {n}", name=Parameter(name), n=limit)
        self._refuse_unknown()

    def _refuse_unknown(self) -> None:
        """Raise an error if an unscored match has no stated race or winner."""
        if self.unscored is None:
            return
        for name in ("race_a", "race_b", "winner"):
            values = getattr(self, name)
            if (self.unscored if values is None else self.unscored & (values <= 0)).any():
                raise InputError(
                    "{unscored} marks a match without {name}. Give {name} or the scores.", name=name
                )
        if (self.unscored & ((self.score_a != 0) | (self.score_b != 0))).any():
            raise InputError("unscored marks a match that has a score. Unmark that match.")

    @classmethod
    def from_names(
        cls,
        player_a: Sequence[str],
        player_b: Sequence[str],
        score_a: ArrayLike,
        score_b: ArrayLike,
        **columns: Any,
    ) -> Results:
        """Return the results of named players, sorted by name.

        The other columns are given by keyword, as `Results` describes them.
        """
        players = sorted(names({*player_a, *player_b}, "player_a or player_b"))
        position = {name: k for k, name in enumerate(players)}
        return cls(
            tuple(players),
            np.array([position[name] for name in player_a], dtype=np.int64),
            np.array([position[name] for name in player_b], dtype=np.int64),
            score_a,  # type: ignore[arg-type]  # made an array by __post_init__
            score_b,  # type: ignore[arg-type]
            **columns,
        )

    @classmethod
    def from_frame(cls, frame: pd.DataFrame) -> Results:
        """Return the results from a DataFrame with one match per row.

        Parameters
        ----------
        frame
            a DataFrame with the columns of a results file: `player_a`, `player_b`, `score_a`,
            `score_b`, and any known ones of `date`, `race_a`, `race_b`, `winner`, `first_break`,
            `break_format`, `racks`, `event`, `team_a`, `team_b`, `division`, `level_a`, `level_b`
            and `forfeit`. `winner` and `first_break` are a, b or a name. The scores may be left
            empty for a forfeit, and for a match whose races and winner are known. Other columns are
            ignored, and names that differ only in case or spaces are treated as one player;
            warnings say so.

        Raises
        ------
        DataError
            listing every invalid cell and every contradiction, one per line, with the row's index
            label.

        >>> import pandas as pd
        >>> frame = pd.DataFrame({"player_a": ["Ann", "Bo"], "player_b": ["Bo", "Cy"],
        ...                       "score_a": [7, 4], "score_b": [5, 7], "race_a": 7, "race_b": 7})
        >>> Results.from_frame(frame)
        <Results of 2 matches between 3 players>
        >>> Results.from_frame(frame.assign(score_b=[5, 6.5]))
        Traceback (most recent call last):
        ...
        evenbreak.errors.DataError: row 1: score_b must be a whole number, 0 or more; you gave 6.5
        """
        if not all(hasattr(frame, name) for name in ("columns", "index", "iloc")):
            raise InputError("{frame} must be a DataFrame; it is {value!r:.60}", value=frame)
        reader = FrameReader(frame)
        columns = columns_of(reader)
        reader.raise_any()
        results = cls.from_names(**columns)
        for problem in find_problems(results):
            reader.add(problem.row, problem.message)
        reader.raise_any()
        return results

    def __len__(self) -> int:
        return len(self.player_a)

    def __repr__(self) -> str:
        return f"<Results of {len(self):,} matches between {len(self.players):,} players>"

    @property
    def races(self) -> tuple[Ints, Ints]:
        """The games that a and b needed to win each match, 0 where not stated."""
        zeros = np.zeros(len(self), dtype=np.int64)
        return (
            zeros if self.race_a is None else self.race_a,
            zeros if self.race_b is None else self.race_b,
        )

    @property
    def given_away(self) -> Bools:
        """Which matches were forfeits."""
        return np.zeros(len(self), dtype=bool) if self.forfeit is None else self.forfeit

    @property
    def counted(self) -> Bools:
        """Which matches count in ratings: those with games or a known winner, except forfeits."""
        played = (self.score_a > 0) | (self.score_b > 0)
        if self.unscored is not None:
            played = played | self.unscored
        return np.asarray(played & ~self.given_away)

    def select(self, rows: NDArray[Any]) -> Results:
        """Return the rows selected by a mask or by positions; `players` is unchanged."""
        columns = {name: getattr(self, name) for name in _TYPES}
        picked: dict[str, Any] = {
            name: None if values is None else values[rows] for name, values in columns.items()
        }
        return Results(self.players, **picked)

    def joined(self, later: Results) -> Results:
        """Return these results followed by `later`, which has the same players.

        Columns that only one of the two has are filled with "not stated".

        >>> season = Results.from_names(["Ann"], ["Bo"], [7], [5], race_a=[7], race_b=[7])
        >>> more = season.joined(Results.from_names(["Bo"], ["Ann"], [7], [2]))
        >>> more.player_a, more.score_b, more.race_a
        (array([0, 1]), array([5, 2]), array([7, 0]))
        """
        if self.players != later.players:
            raise InputError("the two results must have the same list of players; they don't")
        columns: dict[str, Any] = {}
        for name in _TYPES:
            parts = [getattr(self, name), getattr(later, name)]
            if any(part is not None for part in parts):
                unstated = [_unstated(name, len(self)), _unstated(name, len(later))]
                filled = [
                    empty if part is None else part
                    for part, empty in zip(parts, unstated, strict=True)
                ]
                columns[name] = np.concatenate(filled)
        return Results(self.players, **columns)

    def unplayed(self) -> Results:
        """Return the matches as they were before play: at 0-0, without a winner."""
        columns = {name: getattr(self, name) for name in _TYPES}
        for name in ("score_a", "score_b", "winner", "racks", "forfeit", "unscored"):
            if columns[name] is not None:
                columns[name] = _unstated(name, len(self))
        return Results(self.players, **columns)

    def played(self) -> Played:
        """Return the matches with at least one game, and how many rows were left out.

        A forfeit is left out regardless of its score; a 0-0 that is not a forfeit counts as empty.
        For matches known only by their winner, see `won_only`.

        >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 0], [5, 0])
        >>> season.played()[1:]
        (0, 1)
        """
        empty = (self.score_a == 0) & (self.score_b == 0)
        forfeit = self.given_away
        left_out = empty | forfeit
        kept = self.select(~left_out) if left_out.any() else self
        if self.unscored is not None:
            empty &= ~self.unscored
        return Played(kept, int(forfeit.sum()), int((empty & ~forfeit).sum()))

    def won_only(self) -> Results:
        """Return the matches known only by race and winner, without forfeits."""
        if self.unscored is None:
            return self.select(np.zeros(0, dtype=np.int64))
        return self.select(self.unscored & ~self.given_away)


def _unstated(name: str, rows: int) -> NDArray[Any]:
    """Return a column with no value stated."""
    kind = _TYPES[name]
    if name == "date":
        return np.full(rows, "NaT", dtype=kind)
    return np.full(rows, "" if kind is object else 0, dtype=kind)


# Where the columns contradict each other.

_Finding = tuple[Bools, str, str]
"""The rows that fail a check, the column at fault, and a message for `_words` to fill in."""


class Problem(NamedTuple):
    """A problem with one cell: the row (from 0), the column, and a remedy in words."""

    row: int
    column: str
    message: str


def find_problems(results: Results) -> list[Problem]:
    """Return every contradiction in the rows, in row order.

    It looks for scores and races below zero, players on both sides of a match, a race given for one
    player only, scores that do not fit the races, a stated winner who fits neither, and racks that
    fit none of these. Forfeits and 0-0 rows need not fit their race: they were not played out.

    >>> from evenbreak.ratings import Results
    >>> season = Results.from_names(["Ann"], ["Bo"], [4], [5], race_a=[7], race_b=[5], winner=[1])
    >>> for problem in find_problems(season):
    ...     print(problem.row, problem.column, problem.message)
    0 winner winner is a, but b reached the race (4-5 in a race 7:5). Write b, or correct the
    scores or the race.
    """
    check_results(results)
    problems = [
        Problem(row, column, message.format(**_words(results, row)))
        for check in (_cells, _races, _winners, _racks)
        for mask, column, message in check(results)
        for row in np.flatnonzero(mask).tolist()
    ]
    # Stable: within a row the checks keep their order, plain mistakes first.
    return sorted(problems, key=lambda problem: problem.row)


def _words(results: Results, row: int) -> dict[str, Any]:
    """Return the values that messages about a row may quote."""
    scores = int(results.score_a[row]), int(results.score_b[row])
    race = tuple(int(needed[row]) for needed in results.races)
    score = f"{scores[0]}-{scores[1]}"
    racks = "" if results.racks is None else str(results.racks[row])
    winner = 0 if results.winner is None else int(results.winner[row])
    return {
        "player": repr(results.players[results.player_b[row]]),
        "cells": dict(zip(_COUNTS, (*scores, *race), strict=True)),
        "bare": score,
        "score": f"{score} in a race {race[0]}:{race[1]}" if all(race) else score,
        "winner": " ab"[winner],
        "other": " ba"[winner],
        "racks": repr(racks),
        "counted": f"{racks.count('a')}-{racks.count('b')}",
    }


_COUNTS = ("score_a", "score_b", "race_a", "race_b")


def _cells(results: Results) -> Iterator[_Finding]:
    """Find what is wrong regardless of the rest of the row."""
    for name in _COUNTS:
        values: Ints | None = getattr(results, name)
        if values is not None:
            least = "0, 1, 2, ..." if name.startswith("score") else "1, 2, 3, ..."
            message = f"{name} is {{cells[{name}]}}, below zero. Write {least}."
            yield values < 0, name, message
    message = "{player} is on both sides of the match. Correct one of the names."
    yield results.player_a == results.player_b, "player_b", message


def _finished(results: Results) -> Bools:
    """Return which rows hold a finished match with possible scores."""
    whole = (results.score_a >= 0) & (results.score_b >= 0)
    return whole & ((results.score_a > 0) | (results.score_b > 0)) & ~results.given_away


def _races(results: Results) -> Iterator[_Finding]:
    """Find races stated for only one player, and scores that do not fit their races."""
    race_a, race_b = results.races
    for missing, stated, lone in (
        ("race_b", "race_a", (race_a > 0) & (race_b == 0)),
        ("race_a", "race_b", (race_b > 0) & (race_a == 0)),
    ):
        yield lone, missing, f"{missing} is empty, but {stated} isn't. Give both, or neither."
    raced = _finished(results) & (race_a > 0) & (race_b > 0)
    over_a, over_b = results.score_a > race_a, results.score_b > race_b
    for name, over in (("score_a", over_a), ("score_b", over_b)):
        message = (
            " is more than the race ({score}). Correct the score or the race, or leave "
            "both races empty."
        )
        yield raced & over, name, name + message
    reached_a, reached_b = results.score_a >= race_a, results.score_b >= race_b
    message = "both players reached their race ({score}). Correct the scores or the race."
    yield raced & reached_a & reached_b & ~over_a & ~over_b, "score_b", message
    message = (
        "neither player reached their race ({score}). Correct the scores or the race, "
        "mark the match as a forfeit, or leave both races empty."
    )
    yield raced & ~reached_a & ~reached_b, "score_a", message


def who_won(results: Results) -> NDArray[np.int8]:
    """Return 1 or 2 where the scores and races determine the winner, else 0.

    With a race, that is the player who reached it; without one, the player with more games.
    Forfeits and 0-0 have no winner.

    >>> from evenbreak.ratings import Results
    >>> season = Results.from_names(["Ann"] * 2, ["Bo"] * 2, [4, 4], [3, 3], race_a=[5, 0],
    ...                             race_b=[3, 0])
    >>> who_won(season)
    array([2, 1], dtype=int8)
    """
    race_a, race_b = results.races
    reached_a, reached_b = results.score_a >= race_a, results.score_b >= race_b
    raced = (race_a > 0) & (race_b > 0)
    plain = (race_a == 0) & (race_b == 0)
    a = np.where(raced, reached_a & ~reached_b, plain & (results.score_a > results.score_b))
    b = np.where(raced, reached_b & ~reached_a, plain & (results.score_b > results.score_a))
    won = a.astype(np.int8) + 2 * b.astype(np.int8)
    return np.where(_finished(results), won, 0).astype(np.int8)


def _winners(results: Results) -> Iterator[_Finding]:
    """Find stated winners who did not reach the race or, without one, did not win more games."""
    if results.winner is None:
        return
    stated, won = results.winner, who_won(results)
    race_a, race_b = results.races
    wrong = (stated > 0) & (won > 0) & (stated != won)
    message = (
        "winner is {winner}, but {other} reached the race ({score}). Write {other}, or "
        "correct the scores or the race."
    )
    yield wrong & (race_a > 0), "winner", message
    message = (
        "winner is {winner}, but {other} won more games ({score}). Write {other}, or "
        "give race_a and race_b if it was a handicap race."
    )
    yield wrong & (race_a <= 0), "winner", message
    tied = _finished(results) & (results.score_a == results.score_b)
    message = (
        "winner is {winner}, but the score is tied ({score}). Correct the score, or give "
        "race_a and race_b if it was a handicap race."
    )
    yield (stated > 0) & tied & (race_a == 0) & (race_b == 0), "winner", message


def _racks(results: Results) -> Iterator[_Finding]:
    """Find racks that do not add up to the scores, or go on after the race was won."""
    if results.racks is None:
        return
    counts = np.array([(text.count("a"), text.count("b"), len(text)) for text in results.racks])
    a, b, long = counts.reshape(-1, 3).T
    last = np.array([" ab".find(text[-1:] or " ") for text in results.racks], dtype=np.int8)
    strange = a + b < long
    message = "racks {racks} has letters other than a and b. Write an a or a b for each rack."
    yield strange, "racks", message
    adds_up = (a == results.score_a) & (b == results.score_b)
    message = "racks {racks} adds up to {counted}, but the score is {bare}. Correct one of them."
    yield (long > 0) & ~strange & ~adds_up, "racks", message
    race_a, race_b = results.races
    won = np.where((race_a > 0) & (race_b > 0), who_won(results), 0)
    message = (
        "racks {racks} goes on after the race was won ({score}). Correct the racks, the "
        "scores or the race."
    )
    yield (long > 0) & ~strange & adds_up & (won > 0) & (won != last), "racks", message
