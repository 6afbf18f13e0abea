"""What is counted of a chunk, against the arrays that were counted."""

import numpy as np
import pytest

from evenbreak.league import LeaguePlayers, Season
from evenbreak.league.counting import Counting, Ended

SEASON = Season(LeaguePlayers.of([60, 50, 70, 80, 40], skill=[60, 55, 70, 75, 40]), "npl", weeks=2)


def ended(rng, batches=2, replicas=3):
    """Return the arrays of a chunk that might have been played."""
    rows = 5 * batches
    rating = np.tile(SEASON.players.rating, batches)[:, None] + rng.integers(
        -4, 5, (rows, replicas)
    )
    wins = rng.integers(0, 3, (rows, replicas)).astype(np.int32)
    skill = np.tile(SEASON.players.skill, batches)[:, None]
    return Ended(rating.astype(np.int16), wins, None, np.full((rows, 1), 2, np.int32), skill)


@pytest.fixture(scope="module")
def chunk():
    end = ended(np.random.default_rng(1))
    return end, Counting(SEASON, 3, 2).tally(end)


def by_player(rows):
    """Return the values of each player in both batches side by side."""
    return np.hstack([rows[:5], rows[5:]])


def test_wins_and_moves_are_summed_with_their_squares(chunk):
    end, tally = chunk
    wins, moved = by_player(end.wins), by_player(end.rating) - SEASON.players.rating[:, None]
    assert tally.wins.tolist() == wins.sum(axis=1).tolist()
    assert tally.wins_squared.tolist() == (wins**2).sum(axis=1).tolist()
    assert tally.rating.tolist() == moved.sum(axis=1).tolist()
    assert tally.rating_squared.tolist() == (moved**2).sum(axis=1).tolist()
    assert tally.matches.tolist() == [2 * 6] * 5


def test_histograms_have_every_replica(chunk):
    end, tally = chunk
    for player, wins in enumerate(by_player(end.wins)):
        counted = np.bincount(wins, minlength=tally.wins_counts.shape[1])
        assert tally.wins_counts[player].tolist() == counted.tolist()
    assert tally.rating_counts.sum(axis=1).tolist() == [6] * 5


def test_fifths_are_by_skill_and_batch(chunk):
    end, tally = chunk
    order = np.argsort(SEASON.players.skill)
    for batch in range(2):
        wins = end.wins[5 * batch : 5 * batch + 5].sum(axis=1)
        assert tally.fifths[batch, :, 1].tolist() == wins[order].tolist()


def test_rating_errors_are_counted_and_cut_at_the_widest():
    count = Counting(SEASON, 1, 1)
    rating = SEASON.players.rating[:, None].astype(np.int16)
    skill = (SEASON.players.rating - [0, 3, -2, 500, 1])[:, None].astype(np.int16)
    count.week(1, rating, skill, None)
    count.count_kept()
    values = np.arange(-count.widest, count.widest + 1)
    found = {int(value): int(n) for value, n in zip(values, count.errors[1], strict=True) if n}
    assert found == {0: 1, 3: 1, -2: 1, count.widest: 1, 1: 1}
    assert count.weeks[0, 1].tolist() == [5, 2 + count.widest, 14 + count.widest**2, 4]


def test_players_who_are_not_there_are_not_counted():
    count = Counting(SEASON, 1, 1)
    rating = SEASON.players.rating[:, None].astype(np.int16)
    count.week(1, rating, rating, np.array([True, False, True, False, False]))
    assert count.errors[1].sum() == 2
