"""Players without a rating: as good and as far apart as the field, until their games say more."""

import numpy as np
import pytest

from evenbreak.answers.tournament.odds import favorites
from evenbreak.ratings.scale import scale_of
from evenbreak.tournaments import CHIP_CHARTS, chances_given, over_ratings, single_elimination
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Plan
from evenbreak.tournaments.evening.fold import evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.plan import opened
from evenbreak.tournaments.evening.skills import Games, skills_before, skills_tonight
from evenbreak.tournaments.odds.races import Races

FARGO = scale_of("fargo")


def test_newcomers_from_the_field_lie_where_they_are_thought_to():
    rng, off = np.random.default_rng(3), []
    for _ in range(1500):
        spread = 100.0 * np.sqrt(4.0 / rng.chisquare(4))
        center = rng.normal(500.0, spread / np.sqrt(2.0))
        true = rng.normal(center, spread, 9)
        unrated = np.arange(9) == 4
        mean, covariance = skills_before(
            np.where(unrated, 500.0, true), np.where(unrated, 100.0, 0.0), unrated
        )
        off.append((true[4] - mean[4]) / np.sqrt(covariance[4, 4]))
    within = np.mean(np.abs(off) < 1.2816)
    assert abs(np.mean(off)) < 3.0 * np.std(off) / np.sqrt(len(off))
    assert 0.75 < within < 0.83  # of a normal distribution 0.80; the tails are those of Student's t


def test_without_a_field_the_starter_stands():
    everyone = np.ones(3, dtype=bool)
    mean, covariance = skills_before(np.full(3, 500.0), np.full(3, 100.0), everyone)
    assert mean.tolist() == [500.0] * 3
    np.testing.assert_allclose(covariance, 1e4 * np.eye(3))


def test_the_starter_learns_from_every_newcomer():
    rated = np.array([500.0, 480.0, 520.0, 500.0])
    errors, unrated = np.array([100.0, 0.0, 0.0, 100.0]), np.array([True, False, False, True])
    prior = skills_before(rated, errors, unrated)
    mean, _ = skills_tonight(*prior, [Games(0, 1, 5, 0)], FARGO)
    assert mean[0] > mean[3] > prior[0][3]


def test_games_of_one_match_say_less_where_form_varies():
    even = np.array([500.0, 500.0]), np.array([100.0, 0.0])
    one = [Games(0, 1, 6, 2)]
    plain, _ = skills_tonight(*even, one, FARGO)
    varying, wide = skills_tonight(*even, one, FARGO, form=0.5)
    assert 500.0 < varying[0] < plain[0]
    assert wide[0, 0] > skills_tonight(*even, one, FARGO)[1][0, 0]


def test_a_band_holds_the_average_and_is_none_of_a_sure_rating():
    bracket = single_elimination(4)
    ratings = np.array([520.0, 500.0, 500.0, 480.0])
    win = chances_given(bracket, ratings, Races(5), scale=FARGO)
    found = over_ratings(bracket, win, ratings, [0.0, 90.0, 0.0, 0.0])
    low, high = found.bands[1]
    assert low < found.averaged.title[1] < high
    assert np.ptp(found.bands[0]) < 0.1 < high - low


@pytest.mark.parametrize(
    ("form", "more"),
    [
        ("double", {}),
        ("swiss", {}),
        ("chips", {"chips": CHIP_CHARTS["hoboken"]}),
        ("double", {"qualifiers": 4, "placement": "redraw"}),
    ],
)
def test_nobody_is_the_favorite_for_a_few_games_in_any_format(form, more):
    plan = Plan(form, 3, scale="fargo", starter=500.0, starter_error=100.0, tables=2, **more)
    field = [Entrant(f"P{k}", 530.0 - 15.0 * k, 10.0) for k in range(6)]
    at = "2025-03-01T19:00:00"
    events = [Event(at, opened(plan, [*field, plan.newcomer("New"), plan.newcomer("Late")]))]
    draw = moves.draw_next(evening(events), np.random.default_rng(1))
    state = evening([*events, *(Event(at, what) for what in draw)])
    for _ in range(2):
        for name in [one for one in state.standing.to_play if "New" in state.pair(one)][:1]:
            score = (3, 0) if state.pair(name)[0] == "New" else (0, 3)
            won = moves.result(state, name, "New" if form == "chips" else score)
            state = state.then(Event(at, won))
    night = Outlook(state, at)
    assert night.bands.keys() == {"New", "Late"}
    for name, (low, high) in night.bands.items():
        assert low < night.odds.title[state.order.index(name)] < high
    best = favorites(night.odds, night.bands)[0]
    assert state.order[best] not in night.bands
    assert night.bands["New"][0] < 0.5 * night.odds.title[best]
