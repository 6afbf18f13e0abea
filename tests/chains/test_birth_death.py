"""States in a line: limits from every state, against exact arithmetic."""

import random
from fractions import Fraction
from itertools import accumulate

import numpy as np
import pytest
from scipy.sparse import csc_array, diags_array

import oracle
from evenbreak.chains import Chain, chain_from_arrays, limit_matrix, stochastic_limit
from evenbreak.chains.birth_death import (
    LineElimination,
    birth_death_law,
    birth_death_of,
    line_order,
    prefix_products,
    shares,
)
from rows import each_of


def random_line(draw):
    """Return a chain in a line with some arcs missing: classes of all kinds side by side."""
    n = draw.randint(3, 14)
    decades = draw.choice([0.5, 12, 150])
    matrix = np.zeros((n, n))
    for j in range(n):
        for i in (j - 1, j + 1):
            if 0 <= i < n and draw.random() < 0.85:
                matrix[i, j] = 10.0 ** -draw.uniform(0.31, decades)
        if not matrix[:, j].any():
            matrix[j, j] = 1.0
        elif draw.random() < 0.5:
            matrix[j, j] = 1.0 - matrix[:, j].sum()
        else:
            matrix[:, j] /= matrix[:, j].sum()
    return Chain(range(n), csc_array(matrix), 0)


@pytest.mark.slow_after(50)
@pytest.mark.parametrize("seed", range(80))
def test_limit_from_every_state(seed):
    chain = random_line(random.Random(seed))
    columns = oracle.columns_of(chain)
    assert chain.birth_death is not None
    for start in range(len(chain)):
        limit = stochastic_limit(chain, start)
        exact = oracle.limit(columns, {start: Fraction(1)})
        assert oracle.worst_relative_error(limit.probability, exact) < 2e-15
        reached = [c for c in oracle.closed_classes(columns) if any(exact[i] for i in c)]
        assert limit.period == max(oracle.period(chain, states) for states in reached)


@pytest.mark.slow_after(55)
@pytest.mark.parametrize("seed", range(80))
def test_limits_from_all_states_at_once(seed):
    chain = random_line(random.Random(seed))
    columns = oracle.columns_of(chain)
    at_once, table = chain.birth_death.limits(), limit_matrix(chain).toarray()
    spread_out = any(len(states) > 1 for states in oracle.closed_classes(columns))
    assert (at_once is None) == spread_out
    for start in range(len(chain)):
        exact = oracle.limit(columns, {start: Fraction(1)})
        assert oracle.worst_relative_error(table[:, start].tolist(), exact) < 2e-15


def ruin(n, p):
    """Return the walk from any stake to 0 or n, up with chance p."""
    stake = np.arange(1, n)
    sources, targets = np.tile(stake, 2), np.append(stake + 1, stake - 1)
    return chain_from_arrays(range(n + 1), sources, targets, np.repeat([p, 1 - p], n - 1))


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("p", [0.5, 0.4921875, 0.1015625])  # p and 1 - p are exact floats
def test_ruin_from_every_stake(p):
    n = 1_000
    chain = ruin(n, p)
    table = limit_matrix(chain).tocsr()
    r = (1 - Fraction(p)) / Fraction(p)
    sums = [Fraction(s) if r == 1 else (1 - r**s) / (1 - r) for s in range(n + 1)]
    exact = [part / sums[n] for part in sums]
    ruined = [(sums[n] - part) / sums[n] for part in sums]
    assert oracle.worst_relative_error(table[[n], :].toarray()[0].tolist(), exact) < 4e-16
    assert oracle.worst_relative_error(table[[0], :].toarray()[0].tolist(), ruined) < 4e-16


def test_a_line_beyond_the_range_of_long_doubles_is_eliminated():
    n, p = 12_000, 0.1
    chain = ruin(n, p)
    assert chain.birth_death.limits() is None
    table = limit_matrix(chain).tocsr()
    assert table[n, n - 1] == pytest.approx(1 / 9, rel=1e-13)
    assert table[0, n - 2] == pytest.approx(80 / 81, rel=1e-13)


def test_full_storage_is_read_as_it_is_and_other_storage_alike():
    up, down = np.array([0.25, 0.5, 0.125]), np.array([0.5, 0.25, 0.75])
    matrix = csc_array(np.diag(up, -1) + np.diag(down, 1))
    with_loops = matrix + csc_array(np.diag(1.0 - matrix.sum(axis=0)))
    for given in (matrix, csc_array(with_loops)):
        line = birth_death_of(given)
        assert line is not None
        assert (line.up.tolist(), line.down.tolist()) == (up.tolist(), down.tolist())


@pytest.mark.parametrize(
    "matrix",
    [
        np.eye(2),
        np.roll(np.eye(4), 1, axis=0),
        np.array([[0, 0, 1.0], [1, 0, 0], [0, 1, 0]]),
        np.ones((5, 5)) / 5,
    ],
)
def test_what_is_no_line_is_not_taken_for_one(matrix):
    assert birth_death_of(csc_array(matrix)) is None


def test_a_law_over_thousands_of_decades():
    law = birth_death_law(np.full(20_000, 1e-3), np.full(20_000, 0.5))
    for k in (0, 1, 50, 110):
        assert law[k] == pytest.approx(float(Fraction(1, 500) ** k * Fraction(499, 500)), rel=1e-13)
    assert law[200] == 0.0


def test_a_valley_deeper_than_floats_between_two_heights():
    n = 200
    up, down = np.full(2 * n, 1e-3), np.full(2 * n, 0.5)
    up[n:], down[n:] = 0.5, 1e-3
    law = birth_death_law(up, down)
    assert law[0] == pytest.approx(0.499, rel=1e-13)
    assert law[-1] == pytest.approx(0.499, rel=1e-13)
    assert law[n] == 0.0


@pytest.mark.parametrize(("p", "start"), [(0.49, 5000), (0.5, 17), (0.4, 9000), (0.51, 9950)])
def test_gamblers_ruin_with_ten_thousand_states(p, start):
    last = 10_000
    i = np.arange(1, last)
    entries = np.concatenate((np.full(last - 1, p), np.full(last - 1, 1 - p), [1.0, 1.0]))
    rows = np.concatenate((i + 1, i - 1, [0, last]))
    columns = np.concatenate((i, i, [0, last]))
    chain = Chain(range(last + 1), csc_array((entries, (rows, columns))), start)
    limit = stochastic_limit(chain)
    if p == 0.5:
        win, lose = Fraction(start, last), Fraction(last - start, last)
    else:
        # The exact powers have millions of digits; 400 binary places of the ratio are plenty.
        r = Fraction(round(Fraction(1 - p) / Fraction(p) * 2**400), 2**400)
        a, b = (_power(r, k) for k in (start, last))
        win, lose = (a - 1) / (b - 1), (b - a) / (b - 1)
    assert oracle.worst_relative_error(limit.probability[[last, 0]], [win, lose]) < 1e-13
    assert not limit.probability[1:-1].any()


def _power(base: Fraction, exponent: int) -> Fraction:
    """Return base**exponent to some 400 binary digits."""
    result, square = Fraction(1), base
    while exponent:
        if exponent & 1:
            result = _rounded(result * square)
        square, exponent = _rounded(square * square), exponent >> 1
    return result


def _rounded(x: Fraction) -> Fraction:
    scale = Fraction(2) ** (400 - x.numerator.bit_length() + x.denominator.bit_length())
    return Fraction(round(x * scale)) / scale


def exact_products(numerators, denominators):
    ratios = [Fraction(a) / Fraction(b) for a, b in zip(numerators, denominators, strict=True)]
    return list(accumulate([Fraction(1), *ratios], lambda x, y: x * y))


@each_of("n", [0, 1, 31, 32, 33, 200])
@each_of("decades", [0.5, 5, 300])
def test_products_are_right_to_the_number_of_factors(n, decades):
    rng = np.random.default_rng(n)
    up, down = 10.0 ** -rng.uniform(0, decades, n), 10.0 ** -rng.uniform(0, decades, n)
    value, exponent = prefix_products(up, down)
    exact = exact_products(up, down)
    top = max(exact)
    found = [Fraction(v) * Fraction(2) ** int(e) for v, e in zip(value, exponent, strict=True)]
    assert 0.5 <= max(found) < 1
    scale = found[exact.index(top)] / top
    for x, y, e in zip(found, exact, exponent, strict=True):
        if e > -5000:
            assert abs(x / (y * scale) - 1) < 1e-13


def test_equal_ratios_do_not_repeat_one_rounding_error():
    n, up, down = 40_000, 0.4999, 0.5001
    value, exponent = prefix_products(np.full(n, up), np.full(n, down))
    ratio = Fraction(up) / Fraction(down)
    first = Fraction(value[0]) * Fraction(2) ** int(exponent[0])
    for k in (1_000, 9_999, 40_000):
        found = Fraction(value[k]) * Fraction(2) ** int(exponent[k])
        # The thousandth power is exact and rounded once; its own powers add little to that.
        exact = float(ratio**1000) ** (k / 1000)
        assert float(found / first) == pytest.approx(exact, rel=1e-12)


def test_shares_far_apart_keep_their_digits():
    value = np.array([1.0, 0.5, 1.0])
    left, right = shares(value, np.array([0, 0, -900]), 2)
    assert left == 1.0
    assert right == pytest.approx(2.0**-900 / 1.5, rel=1e-15)
    left, right = shares(value, np.array([-3000, -3000, -3900]), 2)
    assert (left, right) == (1.0, pytest.approx(2.0**-900 / 1.5, rel=1e-15))


# Lines of states: found in any order, and solved against exact arithmetic and known laws.


def line(n, shuffle):
    T = np.zeros((n, n))
    i = np.arange(n - 1)
    T[i + 1, i], T[i, i + 1] = 0.25, 0.5
    place = np.random.default_rng(shuffle).permutation(n)
    return csc_array(T[place][:, place]), place


@pytest.mark.parametrize("shuffle", range(3))
def test_a_line_is_found_from_one_end_to_the_other(shuffle):
    T, place = line(50, shuffle)
    order = place[line_order(T)].tolist()
    assert order in (list(range(50)), list(range(49, -1, -1)))


def test_what_has_two_ends_but_is_no_line():
    T = np.zeros((5, 5))
    for a, b in ((0, 1), (1, 2), (2, 0), (0, 3), (3, 0), (1, 4), (4, 1), (2, 1)):
        T[b, a] = 0.25
    assert line_order(csc_array(T)) is None
    assert line_order(csc_array(np.ones((4, 4)) - np.eye(4))) is None


@each_of("n", [1, 2, 3, 4, 5, 8, 13, 32])
@each_of("decades", [0.5, 12])
def test_both_solves(n, decades):
    rng = np.random.default_rng(n)
    up, down = 10.0 ** -rng.uniform(0.4, decades, (2, n - 1))
    leak = np.where(rng.random(n) < 0.4, 10.0 ** -rng.uniform(2, 14, n), 0.0)
    leak[rng.integers(n)] = 1e-13
    b = np.where(rng.random((n, 2)) < 0.6, rng.random((n, 2)), 0.0)
    matrix = [[Fraction(0)] * n for _ in range(n)]
    for k in range(n - 1):
        matrix[k + 1][k], matrix[k][k + 1] = -Fraction(up[k]), -Fraction(down[k])
    for k in range(n):
        matrix[k][k] = Fraction(leak[k]) - sum(matrix[i][k] for i in range(n) if i != k)
    order = rng.permutation(n)
    place = np.argsort(order)
    line = csc_array(diags_array([up, down], offsets=[-1, 1], shape=(n, n)))[order][:, order]
    found = LineElimination(csc_array(line), leak[order], place)
    transposed = [list(row) for row in zip(*matrix, strict=True)]
    for column in range(2):
        right = [Fraction(x) for x in b[:, column].tolist()]
        visits = found.visits(b[order])[place, column]
        values = found.values(b[order])[place, column]
        assert oracle.worst_relative_error(visits, oracle.solve(matrix, right)) < 2e-15
        assert oracle.worst_relative_error(values, oracle.solve(transposed, right)) < 2e-15


def test_a_long_line_of_equal_arcs_keeps_twelve_digits():
    """Steps up with 0.49, down with 0.51, left at the bottom: each step down takes 50."""
    n, up, down = 20_000, 0.49, 0.51
    leak = np.zeros(n)
    leak[0] = down
    leak[-1] = up
    T = diags_array([np.full(n - 1, up), np.full(n - 1, down)], offsets=[-1, 1])
    found = LineElimination(csc_array(T), leak, np.arange(n))
    steps = found.values(np.ones((n, 1)))[:, 0]
    drift = Fraction(down) - Fraction(up)
    for k in (0, 99, 9_999):
        # The top is so far that the chance to reach it is below 1e-170.
        assert steps[k] == pytest.approx(float((k + 1) / drift), rel=1e-13)
