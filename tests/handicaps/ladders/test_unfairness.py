from collections import defaultdict

import numpy as np
import pytest

from evenbreak.games import Race, Rack
from evenbreak.handicaps import (
    AUTOCORRELATED,
    EQUAL_SKILL,
    Ladder,
    Opponents,
    better_off,
    chart,
    unfairness,
)
from evenbreak.matches import win_probability
from evenbreak.ratings import SCALES
from evenbreak.stats import Distribution

TEN = chart("npl_10")


def collected(pairs):
    """Return chances of winning with their weights, those within rounding taken together."""
    found = defaultdict(float)
    for win, weight in pairs:
        found[round(win, 8)] += weight
    return dict(sorted(found.items()))


def told(law):
    return collected(zip(law.values, law.probability, strict=True))


def win(difference, skill=0):
    race = TEN.race(difference)
    return win_probability(Race(*race, Rack(SCALES["npl"].win_probability(skill))))


def items(law):
    return list(zip(law.values, law.probability, strict=True))


def test_natural_unfairness_is_the_chart_at_the_players_error():
    ladder = Ladder(TEN)
    expected = collected((win(i), chance) for i, chance in items(ladder.law()))
    assert told(unfairness(ladder)) == pytest.approx(expected, abs=1e-12)


def test_two_wrong_ratings_are_a_double_sum():
    ladder = Ladder(TEN, opponents=EQUAL_SKILL)
    own, others = items(ladder.law()), items(ladder.opponent_law)
    wins = {x: win(x) for x in range(-120, 121)}
    expected = collected((wins[i - j], v * w) for i, v in own for j, w in others)
    assert told(unfairness(ladder)) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("given", ["skill", "rating"])
def test_opponents_spread_in_skill_or_rating_are_added_up_one_by_one(given):
    spread = Distribution((-15, 0, 8), (0.25, 0.5, 0.25))
    error = Distribution((-3, 2), (0.4, 0.6))
    ladder = Ladder(TEN, opponents=Opponents(spread, error, given), widest=25)
    pairs = []
    for i, chance in items(ladder.law()):
        for s, weight in items(spread):
            for e, off in items(error):
                skill, rating = (s, s + e) if given == "skill" else (s - e, s)
                pairs.append((win(i - rating, -skill), chance * weight * off))
    assert told(unfairness(ladder)) == pytest.approx(collected(pairs), abs=1e-12)


@pytest.mark.parametrize("opponents", [AUTOCORRELATED, EQUAL_SKILL])
def test_unfairness_is_the_same_for_both_sides(opponents):
    law = unfairness(Ladder(TEN, opponents=opponents))
    assert law.mean == pytest.approx(0.5, abs=1e-9)
    np.testing.assert_allclose(np.add(law.values, law.values[::-1]), 1.0, atol=1e-9)


def test_better_off_is_the_favorite():
    law = unfairness(Ladder(TEN, opponents=EQUAL_SKILL))
    favored = better_off(law)
    away = sum(chance * abs(w - 0.5) for w, chance in items(law))
    assert favored.mean - 0.5 == pytest.approx(away, abs=1e-9)
    share = sum(chance for w, chance in items(law) if max(w, 1 - w) > 0.6)
    assert 1 - favored.between(0, 0.6) == pytest.approx(share, abs=1e-12)
    assert favored.values[0] == 0.5


def test_form_takes_the_edge_off_a_wrong_race():
    calm, moody = (unfairness(Ladder(TEN, match_sd=sd)) for sd in (0.0, 20.0))
    assert better_off(moody).values[-1] < better_off(calm).values[-1]


def test_a_simulation_of_nights_agrees():
    ladder = Ladder(TEN, opponents=EQUAL_SKILL)
    rng = np.random.default_rng(4)
    law = np.array(ladder.law().probability)
    many = 40_000
    i, j = rng.choice(ladder.errors, p=law / law.sum(), size=(2, many))
    wins = np.array([win(x) for x in range(-120, 121)])[i - j + 120]
    favored = better_off(unfairness(ladder))
    simulated = np.maximum(wins, 1 - wins)
    assert abs(simulated.mean() - favored.mean) < 4.5 * favored.sd / np.sqrt(many)
