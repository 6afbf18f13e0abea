"""In which blocks a matrix is eliminated."""

import numpy as np
import pytest
from scipy import sparse

from evenbreak.ratings.inverse_diagonal import fronts_of


def league(players, neighbours):
    """Return the matrix of players who meet so many neighbours on a line."""
    bands = [-np.ones(players - k) for k in range(1, neighbours + 1)]
    upper = sparse.diags_array(bands, offsets=list(range(1, neighbours + 1)), shape=(players,) * 2)
    whole = upper + upper.T
    return sparse.csc_array(whole + sparse.diags_array(1.0 - whole.sum(axis=0)))


@pytest.mark.parametrize("neighbours", [1, 3])
def test_fronts_eliminate_every_player_once_children_first(neighbours):
    fronts = fronts_of(league(800, neighbours))
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
