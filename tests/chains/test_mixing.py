"""The spectral gap where it is known in closed form, and mixing times by brute force."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.chains import chain_from_arrays, chain_of, limit_matrix
from evenbreak.chains.mixing import (
    _average_of_powers,
    apparent_period,
    mixing_time,
    spectral_gap,
)
from evenbreak.errors import AccuracyError, ChainError, InputError
from evenbreak.games import Ahead, OneBall, Race, Rack
from rows import each_of
from tiers import examples


def walk(n, stay=0.0):
    """A fair walk on 0..n-1 that bounces: period 2 unless it may stay."""
    arcs = [(0, 1, 1.0 - stay), (n - 1, n - 2, 1.0 - stay)]
    arcs += [(i, i + d, (1.0 - stay) / 2) for i in range(1, n - 1) for d in (1, -1)]
    arcs += [(i, i, stay) for i in range(n) if stay]
    return chain_of(arcs, start=0)


class TestGap:
    @pytest.mark.parametrize("n", [3, 4, 20, 5001])
    def test_ladder_of_period_2(self, n):
        """The eigenvalues of the bouncing walk are cos(k pi / (n - 1)); -1 does not count."""
        assert spectral_gap(walk(n)) == pytest.approx(1 - np.cos(np.pi / (n - 1)), rel=1e-5)

    def test_the_most_negative_eigenvalue_counts(self):
        """The walk that stays with chance 0.01: the lowest eigenvalue is -0.98."""
        assert spectral_gap(walk(30, 0.01)) == pytest.approx(
            min(0.02, 0.99 * (1 - np.cos(np.pi / 29))), rel=1e-10
        )
        assert spectral_gap(walk(4, 0.01)) == pytest.approx(0.02, rel=1e-10)

    @each_of("rare", [0.0, 1e-20, 1e-15, 1e-12, 1e-10])
    @each_of("period", [2, 3, 4])
    def test_a_period_that_ends_once_in_ages_counts_as_one(self, period, rare):
        """A cycle of pairs of states, with a rare wait in one: what goes round is left out."""
        cycle = [
            ((k, i), ((k + 1) % period, j), (0.75, 0.25)[i ^ j])
            for k in range(period)
            for i in (0, 1)
            for j in (0, 1)
        ]
        arcs = [(a, b, p * (1.0 - rare * (a == (0, 0)))) for a, b, p in cycle]
        chain = chain_of([*arcs, ((0, 0), (0, 0), rare)] if rare else arcs, start=(0, 0))
        assert apparent_period(chain) == period
        assert spectral_gap(chain) == pytest.approx(0.5, rel=1e-6)
        assert mixing_time(chain, 0.01) == mixing_time(chain_of(cycle), 0.01)

    def test_a_chain_that_nearly_falls_apart_has_no_period(self):
        """Its second eigenvalue lies next to 1 itself: no average over steps takes that away."""
        chain = chain_of([(1, 1, 1 - 1e-12), (1, 2, 1e-12), (2, 2, 1 - 1e-12), (2, 1, 1e-12)])
        assert apparent_period(chain) == 1
        assert spectral_gap(chain) == pytest.approx(2e-12, rel=1e-3)

    def test_match_ahead(self):
        """From within: 2 sqrt(p q) cos(pi / (m + n))."""
        gap = spectral_gap(chain_of(Ahead(40, 60, Rack(0.55))))
        assert gap == pytest.approx(1 - 2 * np.sqrt(0.55 * 0.45) * np.cos(np.pi / 100), rel=1e-10)

    def test_a_race_is_over_after_finitely_many_racks(self):
        assert spectral_gap(chain_of(Race(30, 30, Rack(0.6)))) == 1.0

    def test_waiting(self):
        assert spectral_gap(chain_of([("go", "go", 0.75), ("go", "end", 0.25)])) == 0.25

    def test_cycle(self):
        """A cycle of 3 with a way to wait in one state: two complex eigenvalues."""
        chain = chain_of([(0, 1, 0.5), (0, 0, 0.5), (1, 2, 1.0), (2, 0, 1.0)])
        moduli = np.sort(np.abs(np.roots([1, -0.5, 0, -0.5])))
        assert spectral_gap(chain) == pytest.approx(1 - moduli[-2], rel=1e-12)

    def test_a_bare_cycle_has_all_its_eigenvalues_on_the_unit_circle(self):
        for n in (2, 3, 1500):
            assert spectral_gap(chain_of([(i, (i + 1) % n, 1.0) for i in range(n)])) == 1.0

    def test_large_class(self):
        """Every state to 1 of 40 others evenly or to the hub: the rank-one part decides."""
        n = 1200
        rng = np.random.default_rng(5)
        targets = rng.integers(0, n, (n, 3))
        j = np.repeat(np.arange(n), 4)
        i = np.column_stack([np.full(n, 0), targets]).ravel()
        p = np.tile([0.4, 0.2, 0.2, 0.2], n)
        M = np.zeros((n, n))
        np.add.at(M, (i, j), p)
        j, i = np.nonzero(M.T)
        gap = spectral_gap(chain_from_arrays(list(range(n)), j, i, M[i, j]))
        assert 0.4 < gap < 0.8

    @pytest.mark.slow_after(1)
    @pytest.mark.parametrize(("period", "size"), [(1, 40), (2, 40), (7, 30), (2, 600), (20, 60)])
    def test_what_goes_round_settles_as_a_whole_period_does(self, period, size):
        """From each state to three of the next phase: M^d is within one of the phases."""
        draw = np.random.default_rng(size)
        ways = [np.argsort(draw.random((size, size)), axis=1)[:, :3] for _ in range(period)]
        arcs = [
            ((k, i), ((k + 1) % period, j), chance)
            for k, targets in enumerate(ways)
            for i, row in enumerate(targets.tolist())
            for j, chance in zip(row, draw.dirichlet(np.ones(3)), strict=True)
        ]
        chain = chain_of(arcs)
        assert apparent_period(chain) == period
        phase = [chain.states.index(state) for state in chain.states if state[0] == 0]
        power = np.linalg.matrix_power(chain.matrix.toarray(), period)[np.ix_(phase, phase)]
        second = np.sort(np.abs(np.linalg.eigvals(power)))[-2]
        assert spectral_gap(chain) == pytest.approx(1 - second ** (1 / period), rel=1e-6)

    @pytest.mark.slow
    def test_a_large_class_that_goes_round_for_ages(self):
        """A drift about a torus, even but for a wait that hardly ever comes."""
        side, rare = 34, 1e-12
        moves = {(1, 0): 0.4, (-1, 0): 0.1, (0, 1): 0.3, (0, -1): 0.2}
        arcs = [
            ((i, j), ((i + a) % side, (j + b) % side), p * (1.0 - rare))
            for i in range(side)
            for j in range(side)
            for (a, b), p in moves.items()
        ]
        arcs += [((i, j), (i, j), rare) for i in range(side) for j in range(side)]
        chain = chain_of(arcs)
        assert len(chain) > 1000
        assert apparent_period(chain) == 2
        turn = np.exp(2j * np.pi * np.arange(side) / side)
        x, y = turn[:, None], turn[None, :]
        moduli = np.sort(np.abs(0.4 * x + 0.1 / x + 0.3 * y + 0.2 / y).ravel())
        assert spectral_gap(chain) == pytest.approx(1.0 - moduli[-3], rel=1e-6)

    def test_a_nearly_defective_eigenvalue_is_refused(self):
        """Twelve waits in a row and a way back so rare that rounding hides it."""
        arcs = [(i, i, 0.999) for i in range(12)] + [(i, i + 1, 0.001) for i in range(12)]
        assert spectral_gap(chain_of(arcs)) == pytest.approx(0.001, rel=1e-12)
        with pytest.raises(AccuracyError, match="the gap is about"):
            spectral_gap(chain_of([*arcs, (11, 0, 1e-17)]))


class TestMixingTime:
    @settings(max_examples=examples(40), deadline=None)
    @given(st.integers(0, 2**32 - 1), st.sampled_from([0.4, 0.1, 1e-3]))
    def test_by_brute_force(self, seed, eps):
        rng = np.random.default_rng(seed)
        n = int(rng.integers(1, 6))
        A = rng.random((n, n)) * (rng.random((n, n)) < 0.5)
        A[rng.integers(n, size=n), range(n)] += 0.2
        j, i = np.nonzero(A.T)
        chain = chain_from_arrays(list(range(n)), j, i, (A / A.sum(axis=0))[i, j])
        structure = chain.structure
        d = int(np.lcm.reduce(structure.periods[structure.closed]))
        M, limit = chain.matrix.toarray(), limit_matrix(chain).toarray()

        def distance(t):
            mean = sum(np.linalg.matrix_power(M, t + k) for k in range(d)) / d
            return np.abs(mean - limit).sum(axis=0).max() / 2

        t = mixing_time(chain, eps)
        assert distance(t) <= eps
        assert t == 0 or distance(t - 1) > eps

    def test_a_long_time(self):
        """Two states that change places with chance e: (1 - 2 e)^t / 2 is the distance."""
        e = 1e-9
        chain = chain_of([(0, 1, e), (0, 0, 1 - e), (1, 0, e), (1, 1, 1 - e)])
        assert mixing_time(chain, 0.25) == pytest.approx(np.log(0.5) / np.log1p(-2 * e), rel=1e-6)

    def test_periodic_chains_mix_on_average(self):
        assert mixing_time(chain_of(OneBall(0, 0)), 0.01) == 0
        assert mixing_time(walk(5), 0.01) < 60

    @pytest.mark.parametrize("terms", [1, 2, 3, 6, 13])
    def test_the_average_of_powers(self, terms):
        M = walk(5, 0.25).matrix.toarray()
        brute = sum(np.linalg.matrix_power(M, k) for k in range(terms)) / terms
        assert _average_of_powers(M, terms) == pytest.approx(brute, rel=1e-14)

    @pytest.mark.slow
    def test_a_common_period_beyond_64_bits(self):
        """Rings of 16 prime lengths: once round them all takes some 3e19 steps."""
        primes = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53]
        arcs = [((p, k), (p, (k + 1) % p), 1.0) for p in primes for k in range(p)]
        arcs += [("s", (p, 0), 1 / 16) for p in primes]
        assert mixing_time(chain_of(arcs), 1e-9) == 0

    def test_a_race_mixes_when_it_is_over(self):
        assert mixing_time(chain_of(Race(3, 3, Rack(0.5))), 1e-6) == 5

    def test_refusals(self):
        with pytest.raises(InputError, match="eps must"):
            mixing_time(walk(3), 0)
        with pytest.raises(ChainError, match="5001 states"):
            mixing_time(walk(5001))
        with pytest.raises(AccuracyError, match="Give a larger eps"):
            mixing_time(walk(40, 0.3), 1e-30)
