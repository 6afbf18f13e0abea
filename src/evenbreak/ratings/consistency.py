"""Where the columns of a results table contradict each other.

Every check is a mask over all rows; a message is made only for the rows that fail it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.ratings.results import Results

Mask = NDArray[np.bool_]
_Finding = tuple[Mask, str, Callable[[int], str]]


class Problem(NamedTuple):
    """What is wrong in one cell: the row (from 0), the column, and a remedy in words."""

    row: int
    column: str
    message: str


def find_problems(results: Results) -> list[Problem]:
    """Return every contradiction in the rows, in the order of the rows.

    It looks for scores and races below zero, players who play against themselves, a race
    given for one player only, scores that do not fit the races, a stated winner who fits
    neither, and racks that fit none of these. Forfeits and 0-0 rows need not fit their
    race: they were not played out.

    >>> season = Results.from_names(["Ann"], ["Bo"], [4], [5], race_a=[7], race_b=[5], winner=[1])
    >>> for problem in find_problems(season):
    ...     print(problem.row, problem.column, problem.message)
    0 winner winner is a, but b reached the race (4-5 in a race 7:5); write b, or correct the
    scores or the race
    """
    checks = (_cells, _races, _winners, _racks)
    found = [
        Problem(int(row), column, message(int(row)))
        for check in checks
        for mask, column, message in check(results)
        for row in np.flatnonzero(mask)
    ]
    # Stable: within a row the checks keep their order, plain mistakes first.
    return sorted(found, key=lambda problem: problem.row)


def _cells(results: Results) -> Iterator[_Finding]:
    """Find what is wrong whatever else the row says."""
    for column in ("score_a", "score_b", "race_a", "race_b"):
        values: NDArray[np.int64] | None = getattr(results, column)
        if values is not None:
            yield values < 0, column, partial(_below_zero, column, values)
    yield (
        results.player_a == results.player_b,
        "player_b",
        lambda row: (
            f"{results.players[results.player_b[row]]!r} is on both sides of the match; correct "
            "one of the names"
        ),
    )


def _below_zero(column: str, values: NDArray[np.int64], row: int) -> str:
    least = "0, 1, 2, ..." if column.startswith("score") else "1, 2, 3, ..."
    return f"{column} is {values[row]}, below zero; write {least}"


def _finished(results: Results) -> Mask:
    """Return which rows hold a match played to its end, with scores that are possible."""
    whole = (results.score_a >= 0) & (results.score_b >= 0)
    return whole & ((results.score_a > 0) | (results.score_b > 0)) & ~results.given_away


def _score(results: Results, row: int) -> str:
    race_a, race_b = results.races
    score = f"{results.score_a[row]}-{results.score_b[row]}"
    if race_a[row] and race_b[row]:
        score += f" in a race {race_a[row]}:{race_b[row]}"
    return score


def _races(results: Results) -> Iterator[_Finding]:
    """Find races that are stated for one player only, and scores that do not fit them."""
    race_a, race_b = results.races
    for column, other, lone in (
        ("race_b", "race_a", (race_a > 0) & (race_b == 0)),
        ("race_a", "race_b", (race_b > 0) & (race_a == 0)),
    ):
        text = f"{column} is empty, but {other} is not; give both, or neither"
        yield lone, column, partial(_same_text, text)
    raced = _finished(results) & (race_a > 0) & (race_b > 0)
    over_a, over_b = results.score_a > race_a, results.score_b > race_b
    yield raced & over_a, "score_a", partial(_beyond, results, "score_a")
    yield raced & over_b, "score_b", partial(_beyond, results, "score_b")
    reached_a, reached_b = results.score_a >= race_a, results.score_b >= race_b
    yield (
        raced & reached_a & reached_b & ~over_a & ~over_b,
        "score_b",
        lambda row: (
            f"both players reached their race ({_score(results, row)}); correct the scores or "
            "the race"
        ),
    )
    yield (
        raced & ~reached_a & ~reached_b,
        "score_a",
        lambda row: (
            f"neither player reached their race ({_score(results, row)}); correct the scores or "
            "the race, mark the match as a forfeit, or leave both races empty"
        ),
    )


def _same_text(text: str, _: int) -> str:
    return text


def _beyond(results: Results, column: str, row: int) -> str:
    return (
        f"{column} is more than the race ({_score(results, row)}); correct the score or the race, "
        "or leave both races empty"
    )


def who_won(results: Results) -> NDArray[np.int8]:
    """Return 1 or 2 where the scores and races determine the winner, else 0.

    With a race that is the player who reached it, without one the player with more games.
    Forfeits and 0-0 have no winner.

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

    def message(row: int) -> str:
        said, other = "ab"[stated[row] - 1], "ab"[won[row] - 1]
        score = _score(results, row)
        if race_a[row] > 0:
            return (
                f"winner is {said}, but {other} reached the race ({score}); write {other}, or "
                "correct the scores or the race"
            )
        return (
            f"winner is {said}, but {other} won more games ({score}); write {other}, or give "
            "race_a and race_b if it was a handicap race"
        )

    yield (stated > 0) & (won > 0) & (stated != won), "winner", message
    tied = _finished(results) & (results.score_a == results.score_b) & (results.score_a > 0)
    yield (
        (stated > 0) & tied & (race_a == 0) & (race_b == 0),
        "winner",
        lambda row: (
            f"winner is {'ab'[stated[row] - 1]}, but the score is tied ({_score(results, row)}); "
            "correct the score, or give race_a and race_b if it was a handicap race"
        ),
    )


def _racks(results: Results) -> Iterator[_Finding]:
    """Find racks that do not add up to the scores, or go on after the race was won."""
    if results.racks is None:
        return
    racks = results.racks
    rows = np.flatnonzero([bool(text) for text in racks])
    count_a, count_b = np.zeros(len(results), np.int64), np.zeros(len(results), np.int64)
    other, last = np.zeros(len(results), bool), np.zeros(len(results), np.int8)
    for row in rows:
        text = racks[row]
        count_a[row], count_b[row] = text.count("a"), text.count("b")
        other[row] = count_a[row] + count_b[row] < len(text)
        last[row] = 1 if text[-1] == "a" else 2
    stated = np.zeros(len(results), bool)
    stated[rows] = True
    yield (
        other,
        "racks",
        lambda row: (
            f"racks {racks[row]!r} has letters other than a and b; write an a or a b for each rack"
        ),
    )
    adds_up = (count_a == results.score_a) & (count_b == results.score_b)
    yield (
        stated & ~other & ~adds_up,
        "racks",
        lambda row: (
            f"racks {racks[row]!r} is {count_a[row]}-{count_b[row]}, but the score is "
            f"{results.score_a[row]}-{results.score_b[row]}; correct one of them"
        ),
    )
    race_a, race_b = results.races
    won = np.where((race_a > 0) & (race_b > 0), who_won(results), 0)
    yield (
        stated & ~other & adds_up & (won > 0) & (won != last),
        "racks",
        lambda row: (
            f"racks {racks[row]!r} goes on after the race was won ({_score(results, row)}); "
            "correct the racks, the scores or the race"
        ),
    )
