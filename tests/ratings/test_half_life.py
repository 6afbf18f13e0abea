"""Whether it helps to let old games count less: it does where strengths change, and else not."""

import numpy as np

from evenbreak.ratings import Results
from evenbreak.ratings.prior import HALF_LIVES, half_life_gains

PLAYERS, MATCHES = 12, 1500


def season(change: float, days: int = 720) -> Results:
    """Return a season of 9 games a match, between players whose skills wander every day."""
    rng = np.random.default_rng(1)
    skills = rng.normal(0, 0.6, PLAYERS) + rng.normal(0, change, (days, PLAYERS)).cumsum(0)
    day = np.sort(rng.integers(0, days, MATCHES))
    a = rng.integers(0, PLAYERS, MATCHES)
    b = (a + rng.integers(1, PLAYERS, MATCHES)) % PLAYERS
    won = rng.binomial(9, 1 / (1 + np.exp(skills[day, b] - skills[day, a])))
    names = tuple(f"p{k:02d}" for k in range(PLAYERS))
    return Results(names, a, b, won, 9 - won, date=np.datetime64("2024-01-01") + day)


def gains(results):
    found = half_life_gains(results, 0.6)
    return {one.half_life: one.gain for one in found}


def test_strengths_that_wander_are_found():
    found = gains(season(0.05))
    assert tuple(found) == HALF_LIVES[:3]
    assert found[90.0].low > 0


def test_strengths_that_stay_gain_nothing():
    found = gains(season(0.0))
    assert all(gain.low < 0 for gain in found.values())
    assert found[90.0].value < found[365.0].value


def test_a_few_days_say_nothing():
    assert gains(season(0.0, days=5)) == {}
