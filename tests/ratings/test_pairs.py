import numpy as np

from evenbreak.ratings.covariance import count_pairs, sums_by_player

A, B = np.array([0, 2, 1, 0]), np.array([1, 0, 0, 2])
WON, LOST = np.array([7, 5, 3, 0]), np.array([4, 7, 7, 2])


def test_games_of_a_pair_are_added_up_whoever_is_named_first():
    counts = count_pairs(3, A, B, WON, LOST)
    assert counts.won.tolist() == [7 + 7 + 7 + 0, 4 + 3, 5 + 2]
    assert counts.lost.tolist() == [4 + 5 + 3 + 2, 7 + 7, 7 + 0]
    assert counts.games.toarray().tolist() == [[0, 21, 14], [0, 0, 0], [0, 0, 0]]
    assert list(zip(counts.low, counts.high, strict=True)) == [(0, 1), (0, 2)]


def test_sums_count_each_pair_for_both_players():
    low, high = np.array([0, 0, 1]), np.array([1, 2, 2])
    each = np.array([1.0, 10.0, 100.0])
    assert sums_by_player(4, low, high, each).tolist() == [11, 101, 110, 0]
    assert sums_by_player(4, low, high, each, -each).tolist() == [11, 99, -110, 0]


def test_a_sum_over_many_opponents_is_right_to_a_rounding():
    many = 50_000
    low, high = np.zeros(many, dtype=int), np.arange(1, many + 1)
    each = np.full(many, 2.999999)
    assert sums_by_player(many + 1, low, high, each)[0] == 2.999999 * many
