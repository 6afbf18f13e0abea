"""The prior that is chosen, in leagues simulated with a known one: open tournaments for years.

Players come very differently often, most of them for a few games, and there are new ones at most
events.
"""

import math

import numpy as np
import pytest
from scipy.special import expit

from evenbreak.ratings import Results
from evenbreak.ratings.integrated import Scores
from evenbreak.ratings.prior import AS_GOOD
from evenbreak.ratings.stretches import stretch_losses

SPREAD = 40.0 / 30.0 * math.log(2.0)
"""Of the players' skills: 40 points of the NPL."""

WIDTHS = SPREAD * 2.0 ** (np.arange(-6, 7) / 4.0)
LEAGUES = 25


def tournaments(rng, events=40, field=16, race=5):
    """Return knockouts in pools of players that grow."""
    skill, often = rng.normal(0.0, SPREAD, 40), rng.gamma(0.5, 1.0, 40) + 0.01
    rows = []
    for event in range(events):
        new = rng.poisson(1.5)
        skill = np.append(skill, rng.normal(0.0, SPREAD, new))
        often = np.append(often, rng.gamma(0.5, 1.0, new) + 0.01)
        left = rng.choice(len(skill), field, replace=False, p=often / often.sum())
        while len(left) > 1:
            a, b = left[::2], left[1::2]
            racks = rng.random((len(a), 2 * race - 1)) < expit(skill[a] - skill[b])[:, None]
            won = racks.cumsum(1)
            lost = np.arange(1, 2 * race) - won
            end = ((won == race) | (lost == race)).argmax(1)
            score = won[np.arange(len(a)), end], lost[np.arange(len(a)), end]
            rows += [(7 * event, *row) for row in zip(a, b, *score, strict=True)]
            left = np.where(score[0] == race, a, b)
    day, a, b, won, lost = np.array(rows).T
    names = tuple(f"p{k:03d}" for k in range(len(skill)))
    return Results(names, a, b, won, lost, date=np.datetime64("2020-01-01") + day)


def chosen(leagues):
    """Return how far off each width is, as a logarithm, and how often its range holds the truth."""
    ways = [{"prior_sd": width} for width in WIDTHS.tolist()]
    losses = np.array([stretch_losses(league, ways).losses.sum(0) for league in leagues])
    good = losses <= losses.min(1, keepdims=True) + AS_GOOD
    return np.log(WIDTHS[losses.argmin(1)] / SPREAD), good[:, WIDTHS == SPREAD].mean()


@pytest.mark.thorough
def test_the_width_is_that_of_the_players_and_not_narrower(monkeypatch):
    rng = np.random.default_rng(1)
    leagues = [tournaments(rng) for _ in range(LEAGUES)]
    off, covered = chosen(leagues)
    assert abs(off.mean()) < 0.03 + 2.6 * off.std() / math.sqrt(LEAGUES)
    # What a range of 95% covers: 20 or more of 25 with a chance of 99.9%.
    assert covered >= 20 / LEAGUES
    averaged = Scores.log_chances

    def plug_in(scores, mean, variance, advantage):
        return averaged(scores, mean, 0.0 * variance, advantage)

    monkeypatch.setattr(Scores, "log_chances", plug_in)
    off, covered = chosen(leagues)
    assert off.mean() < -0.15
    assert covered < 0.5
