"""The matches behind the ratings of two players, and what each is worth to them."""

from __future__ import annotations

from typing import Any

import numpy as np

from evenbreak.answers.one_more_match import Refit
from evenbreak.ratings.consistency import who_won
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.results import Results

MATCH = ("player", "date", "opponent", "opponent_rating", "score", "result", "worth")
"""The columns of a match: the player comes first, and the score is that player's."""


def matches_behind(
    results: Results, ratings: Ratings, pair: tuple[int, int], refit: Refit
) -> list[tuple[Any, ...]]:
    """Return the matches of both players that count, each with what it is worth to the rating."""
    counts = results.counted
    if ratings.as_of is not None and results.date is not None:
        counts = counts & (results.date <= ratings.as_of)
    here = np.isin(results.player_a, pair) | np.isin(results.player_b, pair)
    winner = who_won(results)
    if results.winner is not None:
        winner = np.where(results.winner > 0, results.winner, winner)
    rows = []
    for row in np.flatnonzero(counts & here).tolist():
        without = refit(results.select(np.arange(len(results)) != row)).rating
        for player in pair:
            if player in (results.player_a[row], results.player_b[row]):
                worth = float(ratings.rating[player] - without[player])
                match = _match(results, ratings, row, player, int(winner[row]))
                rows.append((pair.index(player), row, match, worth))
    rows.sort(key=lambda one: one[:2])
    return [(*match, worth) for _, _, match, worth in rows]


def _match(
    results: Results, ratings: Ratings, row: int, player: int, winner: int
) -> tuple[Any, ...]:
    first = int(results.player_a[row]) == player
    opponent = int((results.player_b if first else results.player_a)[row])
    own, other = int(results.score_a[row]), int(results.score_b[row])
    if not first:
        own, other = other, own
    scored = results.unscored is None or not results.unscored[row]
    result = "level" if not winner else "won" if winner == (1 if first else 2) else "lost"
    day = None if results.date is None or np.isnat(results.date[row]) else str(results.date[row])
    return (
        ratings.players[player],
        day,
        ratings.players[opponent],
        float(ratings.rating[opponent]),
        f"{own}-{other}" if scored else None,
        result,
    )
