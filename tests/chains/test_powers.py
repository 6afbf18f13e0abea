"""Densities after some steps by hand and by fractions, and after very many."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.chains import chain_from_arrays, chain_of, stochastic_limit
from evenbreak.chains.powers import propagate
from evenbreak.errors import InputError
from evenbreak.games import OneBall
from tiers import examples


@st.composite
def chains(draw):
    """Random chains with probabilities that are exact in binary: k/16."""
    n = draw(st.integers(1, 6))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    M = rng.multinomial(16, rng.dirichlet(np.full(n, draw(st.sampled_from([0.1, 1.0]))), n)).T / 16
    j, i = np.nonzero(M.T)
    return chain_from_arrays(list(range(n)), j, i, M[i, j], start=0)


class TestManySteps:
    """Beyond what can be followed step by step: squares of M, or a refusal."""

    @settings(max_examples=examples(40), deadline=None)
    @given(chains())
    def test_squares_are_as_good_as_steps(self, chain):
        """1000 steps of so few states are squared; a path never is."""
        by_squares = propagate(chain, 0, 1000)
        one_by_one = propagate(chain, 0, 1000, path=True)[-1]
        np.testing.assert_allclose(by_squares, one_by_one, rtol=1e-12, atol=0)

    def test_each_entry_keeps_its_digits(self):
        """Still in A after n steps: (1 - 2^-20)^n, 1e-260 of it left in the end."""
        stay = 1 - 2.0**-20
        chain = chain_of([("A", "A", stay), ("A", "B", 2.0**-20)], start="A")
        for n in (10, 10**6, 627_000_000):
            found = propagate(chain, steps=n)
            exact = math.exp(n * math.log1p(-(2.0**-20)))
            np.testing.assert_allclose(found, [exact, -math.expm1(math.log(exact))], rtol=1e-7)

    @pytest.mark.parametrize("n", [2, 100, 500])
    def test_a_billion_steps_come_to_the_limit(self, n):
        i = np.arange(n)
        chain = chain_from_arrays(
            list(range(n)), np.tile(i, 2), np.concatenate([i, (i + 1) % n]), np.full(2 * n, 0.5), 0
        )
        np.testing.assert_allclose(propagate(chain, 0, 10**9), 1 / n, rtol=1e-6)
        assert propagate(chain, 0, 10**9).sum() == pytest.approx(1.0, abs=1e-12)

    def test_a_period_is_kept(self):
        ring = chain_of([(0, 1, 1.0), (1, 2, 1.0), (2, 0, 1.0)])
        assert propagate(ring, 0, 10**9).tolist() == [0.0, 1.0, 0.0]

    def test_refusals_say_what_to_do(self):
        small = chain_of([(0, 1, 1.0), (1, 0, 1.0)], start=0)
        with pytest.raises(InputError, match=r"Give 4000000000 or fewer, .* stochastic limit"):
            propagate(small, steps=10**30)
        with pytest.raises(InputError, match="one by one"):
            propagate(small, steps=10**9, path=True)
        large = chain_from_arrays(
            list(range(600)), np.arange(600), (np.arange(600) + 1) % 600, np.ones(600), start=0
        )
        with pytest.raises(InputError, match=r"600 states\. Give [0-9]+ or fewer"):
            propagate(large, steps=10**8)
        with pytest.raises(InputError, match=r"doesn't fit in memory. Give 166665 or fewer"):
            propagate(large, steps=200_000, path=True)


class TestPropagate:
    def test_one_ball_by_hand(self):
        """P5.23: W after 1, 3, 5 innings is p1, p1 (1 + q1 q2), p1 (1 + q1 q2 + (q1 q2)^2)."""
        p1, q1, p2, q2 = 0.25, 0.75, 0.5, 0.5
        chain = chain_of(OneBall(p1, p2))
        path = propagate(chain, steps=5, path=True)
        w, ell = path[:, chain.index("W")], path[:, chain.index("L")]
        r = q1 * q2
        np.testing.assert_allclose(w, p1 * np.array([0, 1, 1, 1 + r, 1 + r, 1 + r + r * r]))
        np.testing.assert_allclose(
            ell, q1 * p2 * np.array([0, 0, 1, 1, 1 + r, 1 + r]), rtol=1e-15, atol=0
        )

    @given(chains(), st.integers(0, 12))
    def test_against_fractions(self, chain, steps):
        path = propagate(chain, 0, steps, path=True)
        M = np.vectorize(Fraction)(chain.matrix.toarray())
        exact = np.array([Fraction(int(j == 0)) for j in range(len(chain))])
        for density in path:
            np.testing.assert_allclose(density, exact.astype(float), rtol=1e-14, atol=0)
            exact = M @ exact
        assert np.array_equal(path[-1], propagate(chain, 0, steps))

    @settings(max_examples=examples(25))
    @given(chains())
    def test_the_average_over_a_period_tends_to_the_limit(self, chain):
        limit = stochastic_limit(chain, 0)
        path = propagate(chain, propagate(chain, 0, 2000), limit.period - 1, path=True)
        np.testing.assert_allclose(path.mean(axis=0), limit.probability, atol=1e-6)

    def test_no_mass_is_lost_to_rounding(self):
        """A third as a user types it: nine digits, the sum 1e-9 short."""
        third = 0.333333333
        chain = chain_of([(j, i, third) for j in range(3) for i in range(3)])
        leaky = chain_of([(j, (j + k) % 4, third) for j in range(4) for k in (1, 2, 3)])
        for made in (chain, leaky):
            assert propagate(made, 0, 5_000).sum() == pytest.approx(1.0, abs=1e-11)

    def test_zero_steps_and_a_density(self):
        chain = chain_of(OneBall(0.5, 0.5))
        assert propagate(chain, {"S1": 0.5, "S2": 0.5}, 0).tolist() == [0.5, 0.0, 0.5, 0.0]

    @pytest.mark.parametrize("steps", [-1, 2.5, "3", math.nan])
    def test_refused_steps(self, steps):
        with pytest.raises(InputError, match="steps must"):
            propagate(chain_of(OneBall(0.5, 0.5)), steps=steps)
