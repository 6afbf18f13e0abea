"""What was played, column by column.

A `Results` holds one match a row, as arrays. It knows nothing of files: a reader builds a
`Results`, asks `evenbreak.ratings.consistency` for contradictions in it, and says in which
line of the file each of them is.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from evenbreak.arrays import Bools, Ints, own_arrays
from evenbreak.checks import column, names
from evenbreak.errors import InputError
from evenbreak.ratings.consistency import find_problems
from evenbreak.ratings.results_frame import FORMATS, FrameReader, columns_of

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
    """The matches that were played, and how many rows were left out: forfeits and 0-0."""

    results: Results
    forfeits: int
    empty: int


@own_arrays
@dataclass(frozen=True, eq=False)
class Results:
    """Matches as columns: one row a match, read-only arrays of one length.

    Parameters
    ----------
    players
        the names, each once.
    player_a, player_b
        who played: positions in `players`. Which of the two is called a has no
        meaning; in particular, a is not assumed to break.
    score_a, score_b
        games won by each.
    date
        days (`datetime64[D]`, NaT where not stated).
    race_a, race_b
        the games that each needed to win the match, 0 where not stated. Where they are
        stated, the player who reached their race won, whoever won more games.
    winner, first_break
        the winner of the match and the first breaker: 1 for a, 2 for b, 0 where not stated.
    break_format
        who breaks the next rack: positions in `FORMATS`, 0 where not stated.
    racks
        who won each rack, in order, as text like 'abba'; '' where not stated.
    event
        any text.
    team_a, team_b, division
        the team of each player and the division of the match; '' where not stated.
    level_a, level_b
        the class, the skill level or the rating by which the league handicaps each player, as
        text; '' where not stated.
    forfeit
        whether the match was a forfeit; its scores then do not count as games played.
    unscored
        whether only the race and the winner are known; both must then be stated, and
        the scores are 0.

    The optional columns are None where there is no such column.

    Raises
    ------
    InputError
        if columns differ in length, hold what is not of their type (a score of 2.5, a
        forfeit marked NaN or 'no'), or a position or code is out of range. Contradictions
        that a person may have typed are left to `find_problems`.

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
            given = getattr(self, name)
            if given is None:
                continue
            values = column(given, name, rows, "rows", kind)
            object.__setattr__(self, name, values)
            limit = len(self.players) if name.startswith("player_") else _CODES.get(name)
            if limit is not None and rows and not (0 <= values.min() <= values.max() < limit):
                raise InputError(f"{name} holds a code outside 0..{limit - 1}; give codes in range")
        self._refuse_unknown()

    def _refuse_unknown(self) -> None:
        """Refuse unscored matches whose race or winner is not stated."""
        if self.unscored is None:
            return
        for name in ("race_a", "race_b", "winner"):
            values = getattr(self, name)
            if (self.unscored if values is None else self.unscored & (values <= 0)).any():
                raise InputError(f"unscored marks a match without {name}; give it, or the scores")
        if (self.unscored & ((self.score_a != 0) | (self.score_b != 0))).any():
            raise InputError("unscored marks a match with games in its score; unmark it")

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
        """Return the results in a DataFrame, a match a row.

        Parameters
        ----------
        frame
            with the columns of a results file: `player_a`, `player_b`, `score_a` and
            `score_b`, and those of `date`, `race_a`, `race_b`, `winner`, `first_break`,
            `break_format`, `racks`, `event`, `team_a`, `team_b`, `division`, `level_a`, `level_b`
            and `forfeit` that are known. `winner` and `first_break` are a, b or a name. A forfeit
            may leave its scores empty, and so may a match of which the races and the winner are
            known. Other columns are not used, and names that differ in case or blanks
            alone are one player's; warnings say so.

        Raises
        ------
        DataError
            with every cell that has no meaning and every contradiction, a line each, which
            names the row by its label in the index.

        >>> import pandas as pd
        >>> frame = pd.DataFrame({"player_a": ["Ann", "Bo"], "player_b": ["Bo", "Cy"],
        ...                       "score_a": [7, 4], "score_b": [5, 7], "race_a": 7, "race_b": 7})
        >>> Results.from_frame(frame)
        <Results of 2 matches between 3 players>
        >>> Results.from_frame(frame.assign(score_b=[5, 6.5]))
        Traceback (most recent call last):
        ...
        evenbreak.errors.DataError: row 1: score_b is 6.5; give a whole number, 0 or more
        """
        if not all(hasattr(frame, name) for name in ("columns", "index", "iloc")):
            raise InputError(f"frame is {type(frame).__name__} {frame!r:.60}; give a DataFrame")
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
        """Which matches enter ratings: those with games or a known winner, without forfeits."""
        played = (self.score_a > 0) | (self.score_b > 0)
        if self.unscored is not None:
            played = played | self.unscored
        return np.asarray(played & ~self.given_away)

    def select(self, rows: NDArray[Any]) -> Results:
        """Return the rows that a mask or positions pick; `players` stays as it is."""
        columns = {name: getattr(self, name) for name in _TYPES}
        picked: dict[str, Any] = {
            name: None if values is None else values[rows] for name, values in columns.items()
        }
        return Results(self.players, **picked)

    def with_match(
        self, a: int, b: int, score_a: int, score_b: int, date: np.datetime64 | None = None
    ) -> Results:
        """Return the results with one more match at the end; what else they hold is not stated.

        Parameters
        ----------
        a, b
            who plays: positions in `players`.
        score_a, score_b
            the games that each wins.
        date
            the day, where the results have days.

        >>> season = Results.from_names(["Ann"], ["Bo"], [7], [5], race_a=[7], race_b=[7])
        >>> more = season.with_match(1, 0, 7, 2)
        >>> more.player_a, more.score_b, more.race_a
        (array([0, 1]), array([5, 2]), array([7, 0]))
        """
        given = {"player_a": a, "player_b": b, "score_a": score_a, "score_b": score_b}
        given["date"] = np.datetime64("NaT", "D") if date is None else date  # type: ignore[assignment]
        columns: dict[str, Any] = {}
        for name, kind in _TYPES.items():
            values = getattr(self, name)
            more = np.array([given[name]], dtype=kind) if name in given else _unstated(name, 1)
            columns[name] = None if values is None else np.concatenate([values, more])
        return Results(self.players, **columns)

    def joined(self, later: Results) -> Results:
        """Return the results with those of `later`, which are between the same players, at the end.

        Columns that only one of them has are filled up with what is not stated.
        """
        if self.players != later.players:
            raise InputError("the results are not between the same players; give one list of names")
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
        """Return the matches as they stood before they were played: at 0-0, without a winner."""
        columns = {name: getattr(self, name) for name in _TYPES}
        for name in ("score_a", "score_b", "winner", "racks", "forfeit", "unscored"):
            if columns[name] is not None:
                columns[name] = _unstated(name, len(self))
        return Results(self.players, **columns)

    def played(self) -> Played:
        """Return the matches with games in them, and how many rows were left out.

        A forfeit is left out whatever its score; a 0-0 that is not a forfeit counts as
        empty. For matches known by their winner alone see `won_only`.

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
        """Return the matches known by race and winner alone, without forfeits."""
        if self.unscored is None:
            return self.select(np.zeros(0, dtype=np.int64))
        return self.select(self.unscored & ~self.given_away)


def _unstated(name: str, rows: int) -> NDArray[Any]:
    """Return a column of which nothing is stated."""
    kind = _TYPES[name]
    if name == "date":
        return np.full(rows, "NaT", dtype=kind)
    return np.full(rows, "" if kind is object else 0, dtype=kind)
