"""Where the columns of a results table contradict each other.

Every check is a mask over all rows; a message is made only for the rows that fail it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Ints
from evenbreak.ratings.doors import check_results

if TYPE_CHECKING:
    from evenbreak.ratings.results import Results

_Finding = tuple[Bools, str, str]
"""The rows that fail a check, the column to blame, and a message for `_words` to fill in."""


class Problem(NamedTuple):
    """What is wrong in one cell: the row (from 0), the column, and a remedy in words."""

    row: int
    column: str
    message: str


def find_problems(results: Results) -> list[Problem]:
    """Return every contradiction in the rows, in the order of the rows.

    It looks for scores and races below zero, players on both sides of a match, a race given
    for one player only, scores that do not fit the races, a stated winner who fits neither,
    and racks that fit none of these. Forfeits and 0-0 rows need not fit their race: they
    were not played out.

    >>> from evenbreak.ratings import Results
    >>> season = Results.from_names(["Ann"], ["Bo"], [4], [5], race_a=[7], race_b=[5], winner=[1])
    >>> for problem in find_problems(season):
    ...     print(problem.row, problem.column, problem.message)
    0 winner winner is a, but b reached the race (4-5 in a race 7:5); write b, or correct the
    scores or the race
    """
    check_results(results)
    found = [
        Problem(row, column, message.format(**_words(results, row)))
        for check in (_cells, _races, _winners, _racks)
        for mask, column, message in check(results)
        for row in np.flatnonzero(mask).tolist()
    ]
    # Stable: within a row the checks keep their order, plain mistakes first.
    return sorted(found, key=lambda problem: problem.row)


def _words(results: Results, row: int) -> dict[str, Any]:
    """Return what messages about a row may quote."""
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
    """Find what is wrong whatever else the row says."""
    for column in _COUNTS:
        values: Ints | None = getattr(results, column)
        if values is not None:
            least = "0, 1, 2, ..." if column.startswith("score") else "1, 2, 3, ..."
            message = f"{column} is {{cells[{column}]}}, below zero; write {least}"
            yield values < 0, column, message
    message = "{player} is on both sides of the match; correct one of the names"
    yield results.player_a == results.player_b, "player_b", message


def _finished(results: Results) -> Bools:
    """Return which rows hold a match played to its end, with scores that are possible."""
    whole = (results.score_a >= 0) & (results.score_b >= 0)
    return whole & ((results.score_a > 0) | (results.score_b > 0)) & ~results.given_away


def _races(results: Results) -> Iterator[_Finding]:
    """Find races that are stated for one player only, and scores that do not fit them."""
    race_a, race_b = results.races
    for column, other, lone in (
        ("race_b", "race_a", (race_a > 0) & (race_b == 0)),
        ("race_a", "race_b", (race_b > 0) & (race_a == 0)),
    ):
        yield lone, column, f"{column} is empty, but {other} is not; give both, or neither"
    raced = _finished(results) & (race_a > 0) & (race_b > 0)
    over_a, over_b = results.score_a > race_a, results.score_b > race_b
    for column, over in (("score_a", over_a), ("score_b", over_b)):
        message = (
            " is more than the race ({score}); correct the score or the race, or leave both races "
            "empty"
        )
        yield raced & over, column, column + message
    reached_a, reached_b = results.score_a >= race_a, results.score_b >= race_b
    message = "both players reached their race ({score}); correct the scores or the race"
    yield raced & reached_a & reached_b & ~over_a & ~over_b, "score_b", message
    message = (
        "neither player reached their race ({score}); correct the scores or the race, mark the "
        "match as a forfeit, or leave both races empty"
    )
    yield raced & ~reached_a & ~reached_b, "score_a", message


def who_won(results: Results) -> NDArray[np.int8]:
    """Return 1 or 2 where the scores and races determine the winner, else 0.

    With a race that is the player who reached it, without one the player with more games.
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
        "winner is {winner}, but {other} reached the race ({score}); write {other}, or correct "
        "the scores or the race"
    )
    yield wrong & (race_a > 0), "winner", message
    message = (
        "winner is {winner}, but {other} won more games ({score}); write {other}, or give race_a "
        "and race_b if it was a handicap race"
    )
    yield wrong & (race_a <= 0), "winner", message
    tied = _finished(results) & (results.score_a == results.score_b)
    message = (
        "winner is {winner}, but the score is tied ({score}); correct the score, or give race_a "
        "and race_b if it was a handicap race"
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
    message = "racks {racks} has letters other than a and b; write an a or a b for each rack"
    yield strange, "racks", message
    adds_up = (a == results.score_a) & (b == results.score_b)
    message = "racks {racks} is {counted}, but the score is {bare}; correct one of them"
    yield (long > 0) & ~strange & ~adds_up, "racks", message
    race_a, race_b = results.races
    won = np.where((race_a > 0) & (race_b > 0), who_won(results), 0)
    message = (
        "racks {racks} goes on after the race was won ({score}); correct the racks, the scores or "
        "the race"
    )
    yield (long > 0) & ~strange & adds_up & (won > 0) & (won != last), "racks", message


# Scores that can hardly be games won: they say nothing about how games within a match go.


FEWEST_MATCHES = 20
"""Matches from which a file shows how long its matches are."""

HIGH = 25
"""A score below this is never doubted: few races are longer."""

TIMES = 2.5
"""How many times what 95% of the winners need a score must be to be doubted."""


def doubtful_scores(results: Results) -> Bools:
    """Return which scores are so much higher than the others that they can hardly be games won.

    A score is compared with all others, but where its race is stated, it is not doubted.

    >>> from evenbreak.ratings import Results
    >>> season = Results.from_names(["Ann"] * 30, ["Bo"] * 30, [7] * 29 + [67], [5] * 29 + [45])
    >>> np.flatnonzero(doubtful_scores(season))
    array([29])
    """
    score = np.maximum(results.score_a, results.score_b)
    played = (score > 0) & ~results.given_away
    if played.sum() < FEWEST_MATCHES:
        return np.zeros(len(results), dtype=bool)
    judged = played & (results.races[0] == 0) & (score >= HIGH)
    return np.asarray(judged & (score > TIMES * usual_score(score[played])))


def usual_score(score: Ints) -> float:
    """Return what 95% of the winners need at most."""
    return float(np.quantile(score, 0.95, method="inverted_cdf"))
