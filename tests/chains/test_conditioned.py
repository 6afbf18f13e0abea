"""A chain given its outcome, against the enumeration of all paths with fractions."""

from collections import defaultdict
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from evenbreak.chains import chain_of, conditioned, first_passage, steps_to_absorption
from evenbreak.errors import ChainError
from evenbreak.games import Ahead, OneBall, Race, Rack

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
    with pytest.raises(ChainError, match="cannot be reached from 'S1'"):
        conditioned(chain_of({"S1": {"a": 1.0}, "z": {"z": 1.0}}, start="S1"), "z")
    assert np.isfinite(conditioned(duel, duel.states[-1]).matrix.data).all()
