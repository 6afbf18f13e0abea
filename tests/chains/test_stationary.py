"""Stationary laws of closed classes, over any number of decades, against exact arithmetic."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array

import oracle
from evenbreak.chains import Chain, stationary_laws, stochastic_limit
from evenbreak.chains.stationary import laws_of
from evenbreak.errors import AccuracyError


def test_laws_of_all_closed_classes_stand_side_by_side():
    matrix = np.array([[0.5, 0.25, 0], [0.5, 0.75, 0], [0, 0, 1.0]])
    chain = Chain(range(3), csc_array(matrix))
    assert stationary_laws(chain) == pytest.approx([1 / 3, 2 / 3, 1.0])


def two_step_walk(n, up, down, shuffle):
    """Return a walk by one and two steps, not a line, its states shuffled; one closed class."""
    matrix = np.zeros((n, n))
    i = np.arange(n)
    for step, share in ((1, 0.6), (2, 0.4)):
        matrix[i[step:], i[:-step]] = share * up[:-step]
        matrix[i[:-step], i[step:]] = share * down[step:]
    place = np.random.default_rng(shuffle).permutation(n)
    matrix = oracle.with_loops(csc_array(matrix[place][:, place]))
    return Chain(range(n), matrix, 0), np.argsort(place)


@pytest.mark.slow_after(5)
@pytest.mark.parametrize("plain", [True, False])
@pytest.mark.parametrize("shuffle", range(4))
@pytest.mark.parametrize("shape", ["slope", "hill", "valley", "cliffs"])
def test_laws_over_more_decades_than_floats(monkeypatch, shape, shuffle, plain):
    if not plain:
        monkeypatch.setattr("evenbreak.chains.transient._FEW_ARCS", 0)
    n = 22
    up, down = np.full(n, 0.4), np.full(n, 1e-40)
    if shape == "slope":
        up, down = down, up
    elif shape == "hill":
        up[n // 2 :], down[n // 2 :] = 1e-40, 0.4
    elif shape == "valley":
        up[: n // 2], down[: n // 2] = 1e-40, 0.4
    else:
        up[::3], down[1::3] = 1e-120, 1e-60
    chain, _ = two_step_walk(n, up, down, shuffle)
    exact = oracle.limit(oracle.columns_of(chain), {0: Fraction(1)})
    assert min(x for x in exact if x) < Fraction(1, 10**100)
    assert oracle.worst_relative_error(stochastic_limit(chain).probability, exact) < 1e-14


def test_a_long_law_over_a_thousand_decades():
    n = 700
    chain, order = two_step_walk(n, np.full(n, 0.004), np.full(n, 0.5), 1)
    law = stochastic_limit(chain).probability[order]
    assert law.sum() == pytest.approx(1.0, rel=1e-14)
    matrix = csc_array(chain.matrix[:, order])[order].toarray()
    flow = np.minimum(law, 1)[None, :] * matrix
    # In a line of cuts, as much goes up as comes down; each entry above 1e-290 shows in one.
    for cut in range(1, 100):
        assert flow[cut:, :cut].sum() == pytest.approx(flow[:cut, cut:].sum(), rel=1e-12)
    assert law[-1] == 0.0


def test_a_law_too_wide_and_too_large_is_refused(monkeypatch):
    monkeypatch.setattr("evenbreak.chains.elimination.MOST_ARCS", 100)
    n = 60
    chain, _ = two_step_walk(n, np.full(n, 1e-30), np.full(n, 0.5), 2)
    with pytest.raises(AccuracyError, match="span more decades than floats"):
        stochastic_limit(chain)


def test_a_shuffled_line_is_known_for_a_line():
    n = 3_000
    place = np.random.default_rng(3).permutation(n)
    up, down = np.full(n - 1, 0.002), np.full(n - 1, 0.5)
    i = np.arange(n - 1)
    rows, columns = np.concatenate((i + 1, i)), np.concatenate((i, i + 1))
    matrix = csc_array((np.concatenate((up, down)), (place[rows], place[columns])), (n, n))
    law = stochastic_limit(Chain(range(n), oracle.with_loops(matrix)), 0).probability[place]
    for k in (0, 1, 60, 120):
        exact = Fraction(0.002) ** k / Fraction(0.5) ** k * (1 - Fraction(0.002) / Fraction(0.5))
        assert law[k] == pytest.approx(float(exact), rel=1e-13)


def test_two_blocks_that_hardly_meet():
    """The odds between the blocks are those of the two arcs that join them."""
    rng = np.random.default_rng(9)
    size, there, back = 80, 1e-10, 3e-10
    matrix = np.zeros((2 * size, 2 * size))
    matrix[:size, :size], matrix[size:, size:] = rng.random((2, size, size))
    np.fill_diagonal(matrix, 0.0)
    matrix /= matrix.sum(axis=0)
    matrix[size, 0], matrix[5, 2 * size - 1] = there, back
    limit = stochastic_limit(Chain(range(2 * size), csc_array(matrix), 0)).probability
    assert limit[0] * there == pytest.approx(limit[-1] * back, rel=1e-13)
    inflow = matrix @ limit
    outflow = matrix.sum(axis=0) * limit
    assert inflow == pytest.approx(outflow, rel=1e-12)


def test_only_the_classes_that_are_asked_for():
    chain = Chain(range(2), csc_array(np.eye(2)))
    law, bound = laws_of(chain, np.array([False, True]))
    assert law.sum() == 1.0
    assert law[chain.structure.label == 1].tolist() == [1.0]
    assert bound is None


@pytest.mark.parametrize("depth", [30.0, 300.0])
def test_a_cyclic_grid_of_hills_has_its_law_to_the_last_digits(depth):
    """Up with 2^-climb, down with 1/8 at each side: the law is 2^-height, down to 1e-180."""
    side = 40
    turn = 2.0 * np.pi * np.arange(side) / side
    height = np.round(depth * (np.sin(turn)[:, None] * np.cos(2.0 * turn) + 1.0)).ravel()
    place = np.arange(side * side).reshape(side, side)
    near = [np.roll(place, step, axis).ravel() for step in (1, -1) for axis in (0, 1)]
    sources, targets = np.tile(place.ravel(), 4), np.concatenate(near)
    chances = 2.0 ** np.minimum(height[sources] - height[targets], 0.0) / 8.0
    chain = Chain(range(side**2), oracle.with_loops(csc_array((chances, (targets, sources)))), 0)
    limit = stochastic_limit(chain)
    exact = 2.0**-height
    assert (limit.bound or 0.0) < 1e-15
    assert limit.probability == pytest.approx(exact / exact.sum(), rel=1e-13, abs=0.0)
