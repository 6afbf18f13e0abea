"""The limits from all states at once: column j is the limit from state j."""

import numpy as np
import pytest

from evenbreak.chains import chain_from_arrays, chain_of, limit_matrix, stochastic_limit
from evenbreak.errors import InputError

RUIN = chain_of([(1, 0, 0.5), (1, 2, 0.5), (2, 1, 0.25), (2, 3, 0.75)])
ROUND = chain_of([("S", "A", 0.25), ("S", "end", 0.75), ("A", "B", 1.0), ("B", "A", 1.0)])


@pytest.mark.parametrize("chain", [RUIN, ROUND], ids=["two ends", "an end and a cycle"])
def test_each_column_is_the_limit_from_its_state(chain):
    table = limit_matrix(chain).toarray()
    for column, state in enumerate(chain.states):
        assert table[:, column] == pytest.approx(stochastic_limit(chain, state).probability)


def test_it_is_a_projection_that_the_chain_leaves_alone():
    table, matrix = limit_matrix(ROUND).toarray(), ROUND.matrix.toarray()
    assert np.allclose(table @ table, table, atol=1e-15)
    assert np.allclose(matrix @ table, table, atol=1e-15)


def test_only_closed_classes_have_entries():
    table = limit_matrix(RUIN)
    assert table.nnz == 6  # 0 and 3 from themselves, and both from 1 and 2


def test_a_matrix_that_would_fill_the_memory_is_refused():
    states = np.arange(8_000)
    chain = chain_from_arrays(
        states.tolist(), np.tile(states, 2), np.append((states + 1) % 8_000, (states + 7) % 8_000),
        np.full(16_000, 0.5),
    )  # fmt: skip
    with pytest.raises(InputError, match="64,000,000"):
        limit_matrix(chain)
