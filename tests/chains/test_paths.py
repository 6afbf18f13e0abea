"""Random paths: only along arcs, each arc as often as its probability says."""

import numpy as np
import pytest
from scipy.sparse import csc_array

from evenbreak.chains import Chain, chain_of, propagate
from evenbreak.errors import ChainError, InputError
from evenbreak.games import Race, Rack

MATRIX = np.array([[0.5, 0.25, 0.0], [0.0, 0.75, 0.125], [0.5, 0.0, 0.875]])


def test_steps_are_as_frequent_as_the_arcs_say() -> None:
    paths = Chain("abc", MATRIX, "a").simulate(50, np.random.default_rng(3), paths=2000)
    assert paths.shape == (2000, 51)
    assert (paths[:, 0] == 0).all()
    counts = np.zeros((3, 3))
    np.add.at(counts, (paths[:, 1:].ravel(), paths[:, :-1].ravel()), 1)
    assert (counts[MATRIX == 0.0] == 0).all()
    left = counts.sum(axis=0)
    error = np.sqrt(MATRIX * (1 - MATRIX) / left)
    assert (np.abs(counts / left - MATRIX) <= 5 * error).all()


def test_the_state_after_some_steps_has_the_density_of_propagate() -> None:
    chain = chain_of(Race(3, 3, Rack(0.6)))
    ends = chain.simulate(4, np.random.default_rng(5), paths=40_000)[:, -1]
    density = propagate(chain, steps=4)
    found = np.bincount(ends, minlength=len(chain)) / 40_000
    assert np.abs(found - density).max() < 5 * 0.5 / np.sqrt(40_000)
    assert (found[density == 0.0] == 0.0).all()


def test_arcs_of_chance_0_are_never_taken() -> None:
    matrix = csc_array(([0.0, 1.0, 0.0, 0.0, 1.0, 0.0], [0, 1, 2, 0, 1, 2], [0, 3, 6, 6]))
    matrix = csc_array((np.append(matrix.data, 1.0), np.append(matrix.indices, 1), [0, 3, 6, 7]))
    paths = Chain("abc", matrix).simulate(3, np.random.default_rng(1), start="c", paths=500)
    assert (paths[:, 1:] == 1).all()


def test_a_density_as_the_start_and_the_same_paths_for_the_same_seed() -> None:
    chain = Chain("abc", MATRIX)
    start = {"a": 0.25, "c": 0.75}
    one, other = (
        chain.simulate(2, np.random.default_rng(7), start=start, paths=4000) for _ in "ab"
    )
    assert (one == other).all()
    assert (one == chain.simulate(2, 7, start=start, paths=4000)).all()
    assert set(one[:, 0]) == {0, 2}
    assert abs((one[:, 0] == 2).mean() - 0.75) < 5 * np.sqrt(0.1875 / 4000)


def test_refusals() -> None:
    chain, rng = Chain("abc", MATRIX, "a"), np.random.default_rng(1)
    assert chain.simulate(0, rng).tolist() == [[0]]
    assert chain.simulate(5, rng, paths=0).shape == (0, 6)
    with pytest.raises(InputError, match="steps is -1"):
        chain.simulate(-1, rng)
    with pytest.raises(InputError, match=r"paths is 1\.5"):
        chain.simulate(1, rng, paths=1.5)  # type: ignore[arg-type]
    with pytest.raises(ChainError, match="'z'"):
        chain.simulate(1, rng, start="z")
