"""Selected inversion against the dense inverse and against exact fractions."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import sparse

from evenbreak.errors import AccuracyError
from evenbreak.ratings import inverse_diagonal as module
from evenbreak.ratings.inverse_diagonal import fronts_of, inverse_diagonal


def laplacian(players, low, high, weight, row_sum):
    """Return the Hessian of a league in which the pairs low-high weigh so much."""
    pairs = sparse.coo_array((weight, (low, high)), shape=(players, players))
    pairs = (pairs + pairs.T).tocsc()
    return sparse.csc_array(sparse.diags_array(pairs.sum(axis=0) + row_sum) - pairs)


def random_pairs(rng, players, pairs):
    low = rng.integers(0, players, pairs)
    return low, (low + rng.integers(1, players, pairs)) % players


def mixed(rng, players=350):
    return random_pairs(rng, players, 30 * players)


def divisions(rng, players=600, size=60, bridges=20):
    low = rng.integers(0, players, 20 * players)
    high = low - low % size + (low % size + rng.integers(1, size, len(low))) % size
    across = random_pairs(rng, players, bridges)
    return np.concatenate((low, across[0])), np.concatenate((high, across[1]))


def thin(rng, players=500):
    return random_pairs(rng, players, 650)


def star(_, players=450):
    return np.zeros(players - 1, dtype=int), np.arange(1, players)


def path(_, players=450):
    return np.arange(players - 1), np.arange(1, players)


def islands(_, players=500):
    return np.arange(0, players // 2, 2), np.arange(1, players // 2, 2)


LEAGUES = [mixed, divisions, thin, star, path, islands]


@pytest.mark.slow_after(13)
@pytest.mark.parametrize("league", LEAGUES)
@pytest.mark.parametrize("row_sum", [1e-2, 1.0, 30.0])
def test_every_kind_of_league_equals_the_dense_inverse(monkeypatch, league, row_sum):
    monkeypatch.setattr(module, "_LARGE", 100)
    rng = np.random.default_rng(5)
    players = league.__defaults__[0]
    low, high = league(rng)
    matrix = laplacian(players, low, high, rng.uniform(0.05, 3, len(low)), row_sum)
    dense = np.diagonal(np.linalg.inv(matrix.toarray()))
    np.testing.assert_allclose(inverse_diagonal(matrix, row_sum).value, dense, rtol=1e-9)


@given(st.integers(2, 9), st.integers(0, 12), st.integers(0, 10**6))
def test_small_leagues_equal_exact_fractions(players, pairs, seed):
    rng = np.random.default_rng(seed)
    low, high = random_pairs(rng, players, pairs)
    matrix = laplacian(players, low, high, rng.integers(1, 9, pairs) / 8, 0.125)
    exact = exact_inverse_diagonal(matrix.toarray())
    np.testing.assert_allclose(inverse_diagonal(matrix, 0.125).value, exact, rtol=1e-12)


def exact_inverse_diagonal(matrix):
    """Gauss and Jordan, with fractions."""
    size = len(matrix)
    rows = [
        [Fraction(float(x)) for x in row] + [Fraction(int(i == k)) for k in range(size)]
        for i, row in enumerate(matrix)
    ]
    for k in range(size):
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(size):
            if i != k:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k], strict=True)]
    return [float(rows[k][size + k]) for k in range(size)]


@pytest.mark.parametrize("league", LEAGUES)
def test_fronts_eliminate_every_player_once_and_children_first(league):
    rng = np.random.default_rng(5)
    players = league.__defaults__[0]
    low, high = league(rng)
    fronts = fronts_of(laplacian(players, low, high, np.ones(len(low)), 1.0))
    assert sorted(np.concatenate([front.pivots for front in fronts])) == list(range(players))
    for number, front in enumerate(fronts):
        own = {*front.pivots.tolist(), *front.rows.tolist()}
        for child in front.children:
            assert child < number
            assert set(fronts[child].rows.tolist()) <= own


@pytest.mark.slow
def test_a_league_in_divisions_is_cut_up_and_a_mixed_one_is_not():
    rng = np.random.default_rng(5)
    low, high = divisions(rng)
    cut = fronts_of(laplacian(600, low, high, np.ones(len(low)), 1.0))
    assert max(len(front.pivots) + len(front.rows) for front in cut) < 200
    low, high = mixed(rng, 1500)
    assert not fronts_of(laplacian(1500, low, high, np.ones(len(low)), 1.0))


@pytest.mark.parametrize("size", [1, 2, 5])
def test_a_matrix_that_is_not_definite_is_refused(size):
    with pytest.raises(AccuracyError, match="smaller prior_sd"):
        inverse_diagonal(sparse.csc_array(-np.eye(size)), -1.0)


# In which blocks a matrix is eliminated.


def league(players, neighbors):
    """Return the matrix of players who meet so many neighbors on a line."""
    bands = [-np.ones(players - k) for k in range(1, neighbors + 1)]
    upper = sparse.diags_array(bands, offsets=list(range(1, neighbors + 1)), shape=(players,) * 2)
    whole = upper + upper.T
    return sparse.csc_array(whole + sparse.diags_array(1.0 - whole.sum(axis=0)))


@pytest.mark.parametrize("neighbors", [1, 3])
def test_fronts_eliminate_every_player_once_children_first(neighbors):
    fronts = fronts_of(league(800, neighbors))
    assert len(fronts) > 1
    assert sorted(np.concatenate([front.pivots for front in fronts])) == list(range(800))
    for number, front in enumerate(fronts):
        assert all(child < number for child in front.children)


def test_a_front_touches_all_that_its_columns_reach_later():
    matrix = league(800, 2)
    fronts = fronts_of(matrix)
    done = set()
    for front in fronts:
        own = set(front.pivots.tolist())
        rows = set(front.rows.tolist())
        for pivot in own:
            near = set(matrix.indices[matrix.indptr[pivot] : matrix.indptr[pivot + 1]].tolist())
            assert near <= own | rows | done
        for child in front.children:
            assert set(fronts[child].rows.tolist()) <= own | rows
        done |= own


def test_a_league_where_all_meet_is_one_front():
    assert len(fronts_of(sparse.csc_array(np.full((400, 400), -1.0) + 401 * np.eye(400)))) == 1
