import math

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.files.results.results_file import read_results
from evenbreak.ratings import Results, best_prior
from evenbreak.ratings.clear_gains import FEWEST_STRETCHES, gains_over, is_clear
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.half_lives import HALF_LIVES, half_life_gains
from evenbreak.ratings.players_behind import PlayersBehind
from evenbreak.ratings.prior import (
    AS_GOOD,
    WIDTHS,
)
from evenbreak.ratings.stretches import Stretches, StretchLosses
from handicapped import by_chart
from places import SHARED

SEASON = SHARED / "data" / "snooker_2016_17_results.csv"


def season(spread, rng, players=30, days=40, a_day=12):
    skill = rng.normal(0, spread, players)
    matches = days * a_day
    a = rng.integers(0, players, matches)
    b = (a + rng.integers(1, players, matches)) % players
    won = rng.binomial(9, 1 / (1 + np.exp(skill[b] - skill[a])))
    date = np.datetime64("2026-01-01") + np.repeat(np.arange(days), a_day)
    names = tuple(f"p{k:02d}" for k in range(players))
    return Results(names, a, b, won, 9 - won, date=date)


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("spread", [0.2, 0.7, 2.0])
def test_the_width_is_near_the_one_that_skills_were_drawn_with(spread):
    choice = best_prior(season(spread, np.random.default_rng(1)))
    assert spread / 2 < choice.prior_sd < spread * 2
    assert choice.log_loss[choice.tried.index(choice.prior_sd)] == min(choice.log_loss)
    assert choice.learned
    assert choice.low <= choice.prior_sd <= choice.high < 4 * choice.low


@pytest.mark.parametrize("matches", [3, 6])
def test_a_few_matches_do_not_choose_a_prior(matches):
    results = season(0.2, np.random.default_rng(5), players=4, days=matches, a_day=1)
    choice = best_prior(results)
    assert not choice.learned
    assert choice.prior_sd == PRIOR_SD


def test_the_range_holds_the_widths_that_lose_little():
    choice = best_prior(season(0.7, np.random.default_rng(6), players=8, days=8, a_day=3))
    lost = (np.array(choice.log_loss) - min(choice.log_loss)) * choice.predicted
    good = [width for width, loss in zip(choice.tried, lost, strict=True) if loss <= AS_GOOD]
    assert (choice.low, choice.high) == (good[0], good[-1])


@pytest.mark.slow
def test_choosing_as_it_goes_costs_little_but_something():
    choice = best_prior(season(0.7, np.random.default_rng(1)))
    assert min(choice.log_loss) < choice.as_it_went < min(choice.log_loss) + 0.02


def test_a_width_that_was_not_tried_is_not_chosen():
    few = season(0.7, np.random.default_rng(2), players=4, days=3, a_day=1)
    assert best_prior(few, widths=[0.01, 0.1, 0.3]).prior_sd == 0.3


def test_who_wins_races_is_predicted_too():
    none = [0] * 6
    results = Results.from_names(
        ["A"] * 6,
        ["B"] * 6,
        none,
        none,
        race_a=[3] * 6,
        race_b=[2] * 6,
        winner=[1] * 6,
        unscored=[True] * 6,
        date=[f"2026-01-0{k}" for k in range(1, 7)],
    )
    choice = best_prior(results)
    assert choice.predicted == 5
    # Who always wins is best rated far ahead, but five matches are no reason to.
    assert choice.tried[int(np.argmin(choice.log_loss))] > PRIOR_SD
    assert (choice.prior_sd, choice.learned) == (PRIOR_SD, False)
    assert list(choice.tried) == sorted(WIDTHS)


def test_decay_enters_the_choice():
    results = season(0.7, np.random.default_rng(3), days=12)
    with_age, without = best_prior(results, half_life=5), best_prior(results)
    assert with_age.log_loss != without.log_loss


@pytest.mark.parametrize(
    ("dates", "words"),
    [
        (None, "2 of 2 matches have no date"),
        (["2026-01-01", "NaT"], "1 of 2 matches have no date"),
        (["2026-01-01"] * 2, "two days"),
    ],
)
def test_days_are_needed(dates, words):
    results = Results.from_names(["A", "A"], ["B", "B"], [7, 7], [5, 5], date=dates)
    with pytest.raises(InputError, match=words):
        best_prior(results)


def test_forfeits_need_no_day():
    results = Results.from_names(
        ["A"] * 3,
        ["B"] * 3,
        [7, 7, 0],
        [5, 5, 0],
        date=["2026-01-01", "2026-01-02", "NaT"],
        forfeit=[False, False, True],
    )
    assert best_prior(results).predicted == 12


@pytest.mark.thorough
@pytest.mark.skipif(not SEASON.exists(), reason="the season's results are not beside this checkout")
def test_a_real_season():
    choice = best_prior(read_results(SEASON).results)
    assert choice.prior_sd == pytest.approx(math.log(2) / 2)
    newcomers, field, joined, half_life = choice.evidence
    assert [one.of for one in choice.evidence] == ["newcomers", "field", "joined", "half_life"]
    for found in (newcomers, field):
        assert found.used
        assert found.value > 2 * found.standard_error
    assert not joined.used
    assert (half_life.used, choice.half_life) == (False, None)
    loss = dict(zip(choice.tried, choice.log_loss, strict=True))
    assert min(loss.values()) == pytest.approx(0.67293, abs=2e-5)
    assert max(loss.values()) < math.log(2)


@pytest.mark.slow
def test_old_games_count_in_full_where_only_the_first_prior_was_too_wide():
    """Races say nearly all here; with the prior that suits results alone, fading them helps."""
    choice = best_prior(by_chart(0, levels=False, off=0.0, form=0.0, matches=500))
    assert choice.levels.race > 0.5
    assert choice.half_life is None


# Whether it helps to let old games count less: it does where strengths change, and else not.


PLAYERS, MATCHES = 12, 1500


def wandering_season(change: float, days: int = 720) -> Results:
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
    found = gains(wandering_season(0.05))
    assert tuple(found) == HALF_LIVES[:3]
    assert found[90.0].low > 0


def test_strengths_that_stay_gain_nothing():
    found = gains(wandering_season(0.0))
    assert all(gain.low < 0 for gain in found.values())
    assert found[90.0].value < found[365.0].value


def test_a_few_days_say_nothing():
    assert gains(wandering_season(0.0, days=5)) == {}


# When one way of rating clearly predicts better than another.


MANY = 25


def losses(saved):
    """Return the losses of two ways, the second of which saves so much in each stretch."""
    both = np.column_stack([np.full(len(saved), 50.0), 50.0 - saved])
    nobody = PlayersBehind(np.zeros(0, int), np.zeros(0, int))
    return StretchLosses(both, np.full(len(saved), 70.0), np.zeros((0, 2)), nobody)


def test_a_gain_is_what_is_saved_a_game():
    (gain,) = gains_over(losses(np.full(MANY, 0.7)))
    assert round(gain.value, 9) == 0.01
    assert gain.low == gain.high


def test_a_steady_gain_is_clear_however_small_and_luck_is_not():
    rng = np.random.default_rng(1)
    assert is_clear(losses(np.full(MANY, 0.01)))
    assert not is_clear(losses(rng.normal(0.0, 0.5, MANY)))


def test_much_gained_early_in_the_season_is_clear():
    saved = np.zeros(MANY)
    saved[:4] = 2.0
    assert is_clear(losses(saved))
    assert not is_clear(losses(saved / 4))


def test_a_few_stretches_show_nothing():
    assert not is_clear(losses(np.full(FEWEST_STRETCHES - 1, 5.0)))


@pytest.mark.slow
def test_no_way_is_tried_twice(monkeypatch):
    tried = []
    losses = Stretches.losses

    def counted(self, ways, **options):
        tried.extend((way["prior_sd"], way["half_life"], way["levels"]) for way in ways)
        return losses(self, ways, **options)

    monkeypatch.setattr(Stretches, "losses", counted)
    best_prior(season(0.7, np.random.default_rng(1)))
    assert len(tried) == len(set(tried)) > len(WIDTHS)
