"""One match of the forward pass: its parts summed apart, beside their joint states."""

import numpy as np
import pytest

from evenbreak.tournaments import consolation, double_elimination
from evenbreak.tournaments.odds import passes, plan, planning
from evenbreak.tournaments.odds.plan import MatchStep

BRACKETS = {
    "double of 8": double_elimination(8, drops="straight"),
    "double of 13": double_elimination(13, drops="straight"),
    "double of 12": double_elimination(12),
    "double of 16": double_elimination(16),
    "consolation of 8": consolation(8),
}


@pytest.mark.parametrize("name", BRACKETS)
def test_parts_summed_apart_have_the_chances_of_their_joint_states(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(plan, "_FEW", 0)
    rng, apart = np.random.default_rng(1), 0
    for step in planning._built(BRACKETS[name], (), np.inf).steps:
        assert isinstance(step, MatchStep)
        parts = [10.0 ** rng.uniform(-140, 0, size) for size in step.sizes]
        p = rng.choice([0.0, 0.1, 0.5, 0.8, 1.0], len(step.first))
        meet, after = passes.played(step, parts, p)
        mass = passes.joined(parts)
        np.testing.assert_allclose(meet, passes.pairs(step, mass), rtol=1e-14)
        np.testing.assert_allclose(after, passes.passed_on(step, mass, p), rtol=1e-14)
        apart += step.apart is not None
    assert apart
