"""Newcomers who are weaker than the prior expects, and newcomers who are not."""

import numpy as np
import pytest

from evenbreak.ratings import walk_forward
from evenbreak.ratings.validation.advantages import by_experience
from simulated_levels import league


def newest(below, seed):
    rng = np.random.default_rng(seed)
    results, _, _ = league(rng, below=below, players=150, days=40, a_day=40)
    return by_experience(walk_forward(results, prior_sd=0.5))


def test_weak_newcomers_win_less_than_predicted():
    groups = newest(1.0, 1)
    assert groups[0].fewest == 0
    assert groups[0].most == 0
    assert groups[0].stronger.high < 0.0
    assert groups[0].seen < groups[0].predicted
    assert groups[-1].stronger.low < 0.0 < groups[-1].stronger.high


@pytest.mark.slow
def test_a_league_without_the_effect_shows_none():
    far = [group for seed in range(6) for group in newest(0.0, seed)]
    out = [one for one in far if not one.stronger.low <= 0.0 <= one.stronger.high]
    assert len(out) <= 0.15 * len(far) + 1


def test_groups_hold_all_matches_of_unequal_experience():
    results, _, _ = league(np.random.default_rng(3), days=40)
    walk = walk_forward(results)
    unequal = (walk.known_a != walk.known_b) & (walk.date_of > 0)
    groups = by_experience(walk)
    assert sum(group.matches for group in groups) >= unequal.sum() - 4 * 30
    assert all(0.5 < group.spread < 2.0 for group in groups)
    assert groups[0].games == pytest.approx(groups[0].matches * 9, rel=0.3)
