"""Step by step: known cases by hand, the rest against exact enumeration with fractions."""

from collections import defaultdict
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.chains import (
    chain_from_arrays,
    chain_of,
    conditioned,
    first_passage,
    steps_to_absorption,
)
from evenbreak.errors import AccuracyError, ChainError, InputError
from evenbreak.games import Ahead, OneBall, Race, Rack, alternate_breaks, winner_breaks
from tiers import examples


@st.composite
def chains(draw, most=6):
    """Random chains with probabilities that are exact in binary: k/16."""
    n = draw(st.integers(1, most))
    columns = []
    for _ in range(n):
        cuts = sorted(draw(st.lists(st.integers(0, 16), min_size=n - 1, max_size=n - 1)))
        columns.append(np.diff([0, *cuts, 16]) / 16)
    j, i = np.nonzero(columns)
    return chain_from_arrays(list(range(n)), j, i, np.array(columns)[j, i], start=0)


def exactly(chain, start, steps, ends=()):
    """Densities after 0, 1, ... steps as fractions, `ends` made absorbing."""
    M = chain.matrix.toarray()
    n = len(chain)
    columns = [
        {j: Fraction(1)} if j in ends else {i: Fraction(M[i, j]) for i in range(n) if M[i, j]}
        for j in range(n)
    ]
    density = [Fraction(int(j == start)) for j in range(n)]
    yield density
    for _ in range(steps):
        onward = [Fraction(0)] * n
        for j, mass in enumerate(density):
            for i, chance in columns[j].items():
                onward[i] += mass * chance
        density = onward
        yield density


class TestSteps:
    def test_race_in_one_rack(self):
        racks = steps_to_absorption(chain_of(Race(1, 1, Rack(0.5))))
        assert (racks.mean, racks.variance, racks.p_never) == (1.0, 0.0, 0.0)
        assert racks.certain
        assert racks.distribution() == (pytest.approx([0, 1]), 0.0)

    def test_a_fixed_number_of_steps_has_no_variance(self):
        chain = chain_of([(i, i + 1, 1.0) for i in range(50)], start=0)
        assert steps_to_absorption(chain).variance == 0.0

    def test_race_length_is_the_negative_binomial(self):
        """An even race 3:3 lasts 3, 4, 5 racks with chances 1/4, 3/8, 3/8."""
        racks = steps_to_absorption(chain_of(Race(3, 3, Rack(0.5))))
        chances, tail = racks.distribution()
        assert tail == 0.0
        assert chances.tolist() == [0.0, 0.0, 0.0, 0.25, 0.375, 0.375]
        assert racks.mean == 4.125
        assert racks.variance == pytest.approx(0.609375, rel=1e-15)
        assert [racks.quantile(q) for q in (0, 0.25, 0.26, 0.625, 0.63, 1)] == [0, 3, 4, 4, 5, 5]

    def test_coin_tosses(self):
        """Geometric: mean 1/p and variance q/p^2, also for very rare events."""
        for p in (0.5, 0.125, 1e-3, 1e-9):
            toss = steps_to_absorption(chain_of([("go", "go", 1 - p), ("go", "end", p)]), "go")
            assert toss.mean == pytest.approx(1 / p, rel=1e-14)
            assert toss.variance == pytest.approx((1 - p) / p**2, rel=1e-14)

    def test_gamblers_ruin(self):
        """An even n-ahead match n:n lasts n^2 racks, variance 2 n^2 (n^2 - 1) / 3."""
        n = 40
        racks = steps_to_absorption(chain_of(Ahead(n, n, Rack(0.5))))
        assert racks.mean == pytest.approx(n**2, rel=1e-13)
        assert racks.variance == pytest.approx(2 * n**2 * (n**2 - 1) / 3, rel=1e-12)

    def test_nobody_ever_makes_it(self):
        duel = chain_of(OneBall(0, 0))
        never = steps_to_absorption(duel)
        assert (never.p_reached, never.p_never) == (0.0, 1.0)
        assert (never.mean, never.variance, never.mean_if_reached) == (None, None, None)
        assert never.quantile(0.5) is None
        assert never.distribution()[0].tolist() == [0.0]
        assert steps_to_absorption(duel, into="closed").mean == 0.0

    def test_alternate_breaks_that_go_on_for_ever(self):
        game = Ahead(2, 2, Rack(1, 1), breaks=alternate_breaks)
        racks = steps_to_absorption(chain_of(game))
        assert (racks.p_never, racks.mean) == (1.0, None)

    def test_it_may_never_end(self):
        """From s: absorbed in a (3/4, after 1 step) or in the cycle x-y (1/4)."""
        chain = chain_of([("s", "a", 0.75), ("s", "x", 0.25), ("x", "y", 1.0), ("y", "x", 1.0)])
        steps = steps_to_absorption(chain, "s")
        assert (steps.p_reached, steps.p_never) == (0.75, 0.25)
        assert steps.mean is None
        assert (steps.mean_if_reached, steps.variance_if_reached) == (1.0, 0.0)
        assert steps.quantile(0.75) == 1
        assert steps.quantile(0.76) is None
        assert steps_to_absorption(chain, "s", into="closed").mean == 1.0

    def test_never_to_end_however_unlikely_is_not_certain(self):
        chain = chain_of([("s", "a", 1.0), ("s", "x", 1e-20), ("x", "y", 1.0), ("y", "x", 1.0)])
        steps = steps_to_absorption(chain, "s")
        assert steps.p_never == 1e-20
        assert steps.mean is None

    def test_an_unreachable_trap_does_not_matter(self):
        chain = chain_of([("s", "a", 1.0), ("z", "a", 0.5), ("z", "x", 0.5), ("x", "x", 1.0)])
        assert first_passage(chain, "s", "a").mean == 1.0

    def test_start_as_a_density(self):
        chain = chain_of([(2, 1, 1.0), (1, 0, 1.0)])
        steps = steps_to_absorption(chain, {0: 0.25, 1: 0.25, 2: 0.5})
        assert steps.mean == 1.25
        assert steps.variance == 0.6875
        assert steps.distribution()[0].tolist() == [0.25, 0.25, 0.5]

    def test_distribution_says_what_it_leaves_out(self):
        racks = steps_to_absorption(chain_of(Ahead(3, 3, Rack(0.5))))
        chances, tail = racks.distribution(max_steps=20)
        assert len(chances) == 21
        assert 0.01 < tail < 0.1
        assert chances.sum() + tail == pytest.approx(1.0, abs=1e-14)

    def test_a_quantile_too_far_off_is_refused(self, monkeypatch):
        monkeypatch.setattr("evenbreak.chains.passage_times.MOST_STEPS", 1000)
        chain = chain_of([("go", "go", 1 - 1e-9), ("go", "end", 1e-9)])
        with pytest.raises(AccuracyError, match=r"0\.5 quantile is more than 1000 steps"):
            steps_to_absorption(chain, "go").quantile(0.5)

    def test_refusals(self):
        chain = chain_of(OneBall(0.5, 0.5))
        with pytest.raises(
            InputError, match="into must be 'absorbing' or 'closed'; you gave 'win'"
        ):
            steps_to_absorption(chain, into="win")
        with pytest.raises(ChainError, match="state 'X'"):
            first_passage(chain, None, "X")
        with pytest.raises(ChainError, match="no target"):
            first_passage(chain, None, [])
        with pytest.raises(InputError, match=r"gave 1\.5"):
            steps_to_absorption(chain).quantile(1.5)


class TestFirstPassage:
    def test_ladder(self):
        """From the middle of a fair walk on 0..4 that bounces at 0: 16 - 4 steps to 4."""
        walk = [(0, 1, 1.0), *((i, i + d, 0.5) for i in (1, 2, 3) for d in (1, -1)), (4, 3, 1.0)]
        passage = first_passage(chain_of(walk), 2, 4)
        assert passage.certain
        assert passage.mean == pytest.approx(12.0, rel=1e-15)

    def test_start_in_the_target(self):
        passage = first_passage(chain_of(OneBall(0.5, 0.5)), "S1", ["S1", "L"])
        assert (passage.mean, passage.variance, passage.quantile(1)) == (0.0, 0.0, 0)

    def test_tuple_states_are_states(self):
        chain = chain_of(Race(2, 2, Rack(0.5)))
        hill_hill = first_passage(chain, None, (1, 1))
        assert hill_hill.p_reached == 0.5
        assert hill_hill.mean is None
        assert hill_hill.mean_if_reached == 2.0

    def test_stiff(self):
        """Gambler's ruin: W = (1 - r) / (1 - r^n) with r = q/p = 1e3 from 1 below n = 60."""
        r, n = 1e3, 60
        arcs = [
            (i, i + s, c) for i in range(1, n) for s, c in ((1, 1 / (1 + r)), (-1, r / (1 + r)))
        ]
        won = first_passage(chain_of(arcs), 1, n)
        exact = (r - 1) / (r**n - 1)
        assert won.p_reached == pytest.approx(exact, rel=1e-12, abs=0)
        assert won.mean_if_reached == pytest.approx((n - 1) * (r + 1) / (r - 1), rel=1e-2)

    @settings(max_examples=examples(40))
    @given(chains(), st.integers(0, 5), st.integers(0, 5))
    def test_against_fractions(self, chain, start, target):
        start, target = start % len(chain), target % len(chain)
        passage = first_passage(chain, start, target)
        assert passage.p_reached + passage.p_never == pytest.approx(1.0, abs=1e-14)
        chances, tail = passage.distribution(max_steps=30)
        cumulative = [d[target] for d in exactly(chain, start, len(chances) - 1, {target})]
        np.testing.assert_allclose(
            np.cumsum(chances), np.array(cumulative, dtype=float), rtol=1e-13, atol=0
        )
        assert chances.sum() + tail + passage.p_never == pytest.approx(1.0, abs=1e-13)

    @settings(max_examples=examples(40))
    @given(chains(), st.integers(0, 5), st.integers(0, 5))
    def test_moments_are_those_of_the_distribution(self, chain, start, target):
        passage = first_passage(chain, start % len(chain), target % len(chain))
        if passage.p_reached == 0.0:
            assert passage.mean_if_reached is None
            return
        chances, tail = passage.distribution(tail=1e-15, max_steps=2_000)
        if tail > 1e-15:
            return
        t = np.arange(len(chances))
        mean = t @ chances / passage.p_reached
        assert passage.mean_if_reached == pytest.approx(mean, rel=1e-9, abs=1e-12)
        variance = (t - mean) ** 2 @ chances / passage.p_reached
        assert passage.variance_if_reached == pytest.approx(variance, rel=1e-7, abs=1e-9)
        assert (passage.mean is None) == (not passage.certain)


def test_break_formats_change_the_length_of_a_race():
    lengths = [
        steps_to_absorption(chain_of(Race(5, 5, Rack(0.75, 0.75), breaks=breaks))).mean
        for breaks in (winner_breaks, alternate_breaks)
    ]
    assert lengths[0] < lengths[1]


# A chain given its outcome, against the enumeration of all paths with fractions.


RACE = chain_of(Race(3, 4, Rack(0.625)))


def paths_to(chain, ends, state, chance=Fraction(1), path=()):
    """Yield each path from a state to the ends, and its chance, for a chain without cycles."""
    path = (*path, state)
    if state in ends:
        yield path, chance
        return
    column = chain.matrix[:, [chain.index(state)]].tocoo()
    for i, p in zip(column.row.tolist(), column.data.tolist(), strict=True):
        if chain.states[i] != state:
            yield from paths_to(chain, ends, chain.states[i], chance * Fraction(p), path)


def test_every_path_of_a_race_that_is_lost() -> None:
    ends = [s for s, end in zip(RACE.states, RACE.structure.recurrent, strict=True) if end]
    lost = {s for s in ends if s[1] == 4}
    found = conditioned(RACE, lost)
    flow, along = defaultdict(Fraction), defaultdict(Fraction)
    for path, chance in paths_to(RACE, lost, RACE.start):
        for step in pairwise(path):
            along[step] += chance
            flow[step[0]] += chance
    assert set(found.states) == {state for step in along for state in step}
    assert found.start == RACE.start
    for (j, i), chance in along.items():
        exact = float(chance / flow[j])
        assert found.matrix[found.index(i), found.index(j)] == pytest.approx(exact, rel=1e-15)
    assert found.matrix.nnz == len(along) + len(lost)


def test_steps_given_the_outcome_are_those_of_first_passage() -> None:
    chain = chain_of(Ahead(4, 6, Rack(0.45)))
    ends = [s for s, end in zip(chain.states, chain.structure.recurrent, strict=True) if end]
    for end in ends:
        given = first_passage(chain, None, end)
        steps = steps_to_absorption(conditioned(chain, end))
        assert steps.mean == pytest.approx(given.mean_if_reached, rel=1e-14)
        assert steps.variance == pytest.approx(given.variance_if_reached, rel=1e-12)


def test_self_loops_keep_their_chance() -> None:
    chain = chain_of({"s": {"s": 0.5, "a": 0.375, "b": 0.125}}, start="s")
    assert conditioned(chain, "b").matrix.toarray().tolist() == [[0.5, 0.0], [0.5, 1.0]]


def test_an_outcome_however_unlikely() -> None:
    """Gambler's ruin upwards against 1000 to 1: given the outcome, almost surely straight."""
    r, n = 1000.0, 30
    arcs = [(i, i + s, c / (1 + r)) for i in range(1, n) for s, c in ((1, 1.0), (-1, r))]
    found = conditioned(chain_of(arcs, start=1), n)
    h = [sum(Fraction(1000) ** k for k in range(i)) for i in range(n + 1)]
    for i in range(2, n):
        exact = float(h[i + 1] / h[i] / 1001)
        assert found.matrix[found.index(i + 1), found.index(i)] == pytest.approx(exact, rel=1e-13)


def test_a_target_that_the_chain_would_leave() -> None:
    walk = chain_of([(0, 1, 1.0), (1, 0, 0.5), (1, 2, 0.5), (2, 1, 1.0)], start=0)
    found = conditioned(walk, 2)
    assert found.matrix[found.index(2), found.index(2)] == 1.0
    assert found.matrix[found.index(0), found.index(1)] == 0.5


def test_refusals() -> None:
    duel = chain_of(OneBall(0.5, 0.5))
    with pytest.raises(ChainError, match="'X'"):
        conditioned(duel, "X")
    with pytest.raises(ChainError, match="no target"):
        conditioned(duel, [])
    with pytest.raises(ChainError, match="can't be reached from 'S1'"):
        conditioned(chain_of({"S1": {"a": 1.0}, "z": {"z": 1.0}}, start="S1"), "z")
    assert np.isfinite(conditioned(duel, duel.states[-1]).matrix.data).all()
