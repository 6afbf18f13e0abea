"""Form of the day: scores averaged over it are those of the integral, and zero form is no form."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import expit, logit

from evenbreak.errors import InputError
from evenbreak.games import Ahead, Race, Rack, alternate_breaks
from evenbreak.matches import final_scores, hill_hill_probability, match_length, match_odds
from evenbreak.matches.form import center_of_form, on_days


def expected(value, sd):
    """Return E value(N(0, sd²)) by adaptive quadrature."""
    density = lambda e: math.exp(-(e**2) / (2.0 * sd**2)) / (sd * math.sqrt(2.0 * math.pi))  # noqa: E731
    return quad(lambda e: value(e) * density(e), -12 * sd, 12 * sd, epsabs=1e-12, limit=500)[0]


MATCHES = [
    Race(7, 5, Rack(0.6)),
    Race(3, 3, Rack(0.7, 0.4), breaks=alternate_breaks),
    Race(3, 2, Rack(0.9), win_by=2),
    Race(2, 2, Race(2, 3, Rack(0.45))),
    Ahead(3, 2, Rack(0.55)),
]


@pytest.mark.parametrize("match", MATCHES, ids=["race", "breaks", "win by 2", "sets", "ahead"])
def test_without_form_everything_stays_as_it_is(match):
    assert match_odds(match, form=0.0) == match_odds(match)
    assert final_scores(match, form=0.0).probability == final_scores(match).probability
    plain, formed = match_length(match), match_length(match, form=0.0)
    assert (plain.probability == formed.probability).all()


@pytest.mark.parametrize(("p", "form"), [(0.6, 0.35), (0.93, 1.2), (0.5, 3.0)])
def test_scores_are_those_of_the_integral_over_form(p, form):
    race = Race(5, 3, Rack(p))
    center = float(center_of_form(logit(p), 0.0, form))
    assert expected(lambda e: expit(center + e), form) == pytest.approx(p, abs=1e-10)
    scores = final_scores(race, form=form).probability
    for score in ((5, 0), (5, 2), (1, 3)):
        exact = expected(
            lambda e: final_scores(Race(5, 3, Rack(float(expit(center + e))))).probability[score],  # noqa: B023
            form,
        )
        assert scores[score] == pytest.approx(exact, abs=1e-9)


@pytest.mark.parametrize("match", MATCHES, ids=["race", "breaks", "win by 2", "sets", "ahead"])
def test_scores_lengths_and_odds_are_of_one_law(match):
    odds = match_odds(match, form=0.4)
    scores, length = final_scores(match, form=0.4), match_length(match, form=0.4)
    ahead = sum(p for (a, b), p in scores.probability.items() if match.decided(a, b) == 1)
    assert odds.p_win_1 == pytest.approx(ahead, abs=1e-9)
    assert odds.p_win_1 + odds.p_win_2 == pytest.approx(1.0, abs=1e-9)
    assert (odds.mean_games, odds.sd_games) == pytest.approx((length.mean, length.sd), abs=1e-9)
    if odds.p_hill_hill is not None:
        last = match.m + match.n - 1
        decider = sum(p for (a, b), p in scores.probability.items() if a + b == last)
        assert odds.p_hill_hill == pytest.approx(decider, abs=1e-9)
    assert sum(scores.probability.values()) == pytest.approx(1.0, abs=1e-9)


def test_a_single_game_has_the_same_chance_and_races_more_sweeps_and_fewer_deciders():
    assert match_odds(Race(1, 1, Rack(0.6)), form=0.8).p_win_1 == pytest.approx(0.6, abs=1e-12)
    plain, formed = (match_odds(Race(7, 7, Rack(0.6)), form=form) for form in (0.0, 0.4))
    assert formed.p_hill_hill < plain.p_hill_hill
    assert formed.p_hill_hill < hill_hill_probability(Race(7, 7, Rack(0.6)))
    assert formed.p_shutout_1 + formed.p_shutout_2 > plain.p_shutout_1 + plain.p_shutout_2
    assert formed.mean_games < plain.mean_games
    assert 0.5 < formed.p_win_1 < plain.p_win_1


def test_games_played_show_the_form():
    race = Race(5, 5, Rack(0.5))
    scores = final_scores(race, form=0.6).probability
    behind = {score: p for score, p in scores.items() if score[1] == 5}
    # Player 1 wins from 2:0 as often as they do of the matches that come to 2:0.
    odds = match_odds(Race(5, 5, Rack(0.5), score=(2, 0)), form=0.6)
    at = match_odds(Race(2, 5, Rack(0.5)), form=0.6)
    assert odds.p_shutout_1 == pytest.approx(scores[5, 0] / at.p_shutout_1, abs=1e-9)
    assert sum(behind.values()) == pytest.approx(0.5, abs=1e-12)
    assert odds.p_win_1 > match_odds(Race(5, 5, Rack(0.5), score=(2, 0))).p_win_1


def test_arrays_and_sure_games():
    many = final_scores(Race(2, 2, Rack([0.5, 0.6, 1.0])), form=0.5)
    for k, p in enumerate((0.5, 0.6, 1.0)):
        one = final_scores(Race(2, 2, Rack(p)), form=0.5).probability
        for score, chance in many.probability.items():
            assert chance[k] == pytest.approx(one.get(score, 0.0), abs=1e-14)
    assert many.probability[2, 0][2] == pytest.approx(1.0, abs=1e-14)
    length = match_length(Race(2, 2, Rack([0.5, 0.6])), form=0.5)
    assert length.mean[1] == pytest.approx(match_length(Race(2, 2, Rack(0.6)), form=0.5).mean)


def test_the_center_of_chances_of_all_sizes():
    mean = np.array([-900.0, -40.0, -3.0, 0.0, 3.0, 40.0])
    center = center_of_form(mean, 0.0, 1.0)
    assert center[[0, 3]].tolist() == [-900.0, 0.0]
    assert center[1] == pytest.approx(-40.5)  # E exp(e) = exp(1/2)
    assert center[2] == -center[4]
    assert center[4] > 3.0


def test_what_is_refused():
    with pytest.raises(InputError, match="who broke"):
        on_days(Race(3, 3, Rack(0.6, 0.5), breaks=alternate_breaks, score=(1, 0)), 0.3)
    with pytest.raises(InputError, match="via"):
        match_odds(Race(3, 3, Rack(0.6)), via="eigen", form=0.3)
    with pytest.raises(InputError, match="form"):
        match_odds(Race(3, 3, Rack(0.6)), form=-0.1)
