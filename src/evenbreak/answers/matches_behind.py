"""The matches behind the ratings of two players, and what each is worth to them."""

from __future__ import annotations

from typing import Any

import numpy as np

from evenbreak.answers.one_more_match import Refit
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.results import Results

MATCH = ("player", "date", "opponent", "opponent_rating", "score", "result", "worth")
"""The columns of a match: the player comes first, and the score is that player's."""


def matches_behind(
    results: Results, ratings: Ratings, pair: tuple[int, int], refit: Refit
) -> list[tuple[Any, ...]]:
    """Return the matches of both players that count, each with what it is worth to the rating."""
    counts = ~results.given_away & ((results.score_a > 0) | (results.score_b > 0))
    if results.unscored is not None:
        counts |= results.unscored & ~results.given_away
    if ratings.as_of is not None and results.date is not None:
        counts &= results.date <= ratings.as_of
    here = np.isin(results.player_a, pair) | np.isin(results.player_b, pair)
    rows = []
    for row in np.flatnonzero(counts & here).tolist():
        without = refit(results.select(np.arange(len(results)) != row)).rating
        for player in pair:
            if player in (results.player_a[row], results.player_b[row]):
                worth = float(ratings.rating[player] - without[player])
                rows.append((pair.index(player), row, _match(results, ratings, row, player), worth))
    rows.sort(key=lambda one: one[:2])
    return [(*match, worth) for _, _, match, worth in rows]


def _match(results: Results, ratings: Ratings, row: int, player: int) -> tuple[Any, ...]:
    first = int(results.player_a[row]) == player
    opponent = int((results.player_b if first else results.player_a)[row])
    own, other = int(results.score_a[row]), int(results.score_b[row])
    needs, others = (int(games[row]) for games in results.races)
    stated = 0 if results.winner is None else int(results.winner[row])
    if not first:
        own, other, needs, others = other, own, others, needs
    if stated:
        won = stated == (1 if first else 2)
    elif needs and others:
        won = own >= needs
    else:
        won = own > other
    scored = results.unscored is None or not results.unscored[row]
    result = "won" if won else "lost" if stated or own != other or needs else "level"
    day = None if results.date is None or np.isnat(results.date[row]) else str(results.date[row])
    return (
        ratings.players[player],
        day,
        ratings.players[opponent],
        float(ratings.rating[opponent]),
        f"{own}-{other}" if scored else None,
        result,
    )
