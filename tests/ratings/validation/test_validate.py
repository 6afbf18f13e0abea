"""A validated season: its prior, and what holds of all figures together."""

import dataclasses

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.ratings import Results, best_prior, validate, walk_forward
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.validation.validate import handicap_fairness, race_lengths


def season(spread: float, *, matches: int = 900, seed: int = 1) -> Results:
    """Return races to 5 between players whose skills have this spread in log-odds."""
    rng = np.random.default_rng(seed)
    skill = rng.normal(0.0, spread, 30)
    a = rng.integers(0, 30, matches)
    b = (a + rng.integers(1, 30, matches)) % 30
    p = 1 / (1 + np.exp(skill[b] - skill[a]))
    won = (rng.random((matches, 9)) < p[:, None]).cumsum(1)
    lost = np.arange(1, 10) - won
    end = ((won == 5) | (lost == 5)).argmax(1)
    rows = np.arange(matches)
    date = np.datetime64("2024-09-03") + rows // 45
    return Results(tuple(f"p{k:02d}" for k in range(30)), a, b, won[rows, end], lost[rows, end],
        date=date)  # fmt: skip


@pytest.fixture(scope="module")
def found():
    return validate(season(0.6))


@pytest.mark.slow
def test_the_prior_is_about_the_spread_of_the_skills(found):
    assert 0.4 < found.prior_sd < 0.9
    assert found.choice == best_prior(season(0.6))
    assert found.prior_sd == found.choice.prior_sd
    assert {row.prior_sd for row in found.scored} == {found.prior_sd}


def test_a_notebook_shows_it_in_a_line(found):
    assert len(repr(found)) < 80
    assert f"{len(found.forecasts):,}" in repr(found)


@pytest.mark.slow
def test_undated_and_unscored_matches_count_as_they_do_for_the_best_prior():
    results = season(0.6, matches=300)
    dates = results.date.copy()
    dates[:20] = np.datetime64("NaT", "D")
    unscored = np.arange(300) >= 280
    none = np.where(unscored, 0, results.score_a), np.where(unscored, 0, results.score_b)
    five, winner = np.full(300, 5), np.where(results.score_a == 5, 1, 2)
    mixed = dataclasses.replace(
        results, date=dates, score_a=none[0], score_b=none[1], race_a=five, race_b=five,
        winner=winner, unscored=unscored,
    )  # fmt: skip
    assert validate(mixed).choice == best_prior(mixed.select(~np.isnat(dates)))


def test_three_matches_leave_the_default_prior():
    few = dataclasses.replace(
        season(0.6, matches=3), date=np.datetime64("2024-09-03") + np.arange(3)
    )
    found = validate(few)
    assert (found.prior_sd, found.choice.learned) == (PRIOR_SD, False)


def test_a_season_of_the_model_validates(found):
    assert found.skill.low > 0.0
    for row in found.scored:
        assert row.slope is not None
        assert row.slope.low < 1.0 < row.slope.high
        assert row.log_loss.low < row.log_loss.value < row.log_loss.high
    assert found.dispersion is not None
    assert found.dispersion.p_value > 0.01


def test_bins_hold_every_game_with_a_favorite(found):
    forecasts = found.forecasts
    assert (
        sum(row.games for row in found.games)
        == forecasts.games[np.abs(forecasts.p_game - 0.5) > 1e-9].sum()
    )


def test_matches_without_a_favorite_are_counted(found):
    forecasts = found.forecasts
    even = np.abs(forecasts.p_game - 0.5) <= 1e-9
    assert found.toss_ups["game"] == even.sum() > 0
    assert sum(row.matches for row in found.games) + even.sum() == len(forecasts)


def test_the_usual_prior_is_judged_beside_the_best(found):
    assert [(row.of, row.prior_sd) for row in found.usual] == [
        ("game", PRIOR_SD),
        ("match", PRIOR_SD),
    ]
    given = validate(season(0.6), prior_sd=PRIOR_SD)
    assert found.usual[0].log_loss.value == given.scored[1].log_loss.value


def test_a_slope_of_a_few_matches_is_withheld():
    results = season(0.6, matches=12)
    found = validate(
        dataclasses.replace(results, date=np.datetime64("2024-09-03") + np.arange(12) // 3),
        prior_sd=0.1,
    )
    assert all(row.slope is None for row in found.scored)


@pytest.mark.parametrize("prior_sd", [None, 0.6])
def test_progress_is_reported(prior_sd):
    """Of the walks and the search, each through all dates; the part done never goes back."""
    steps = []
    found = validate(
        season(0.6, matches=90), prior_sd=prior_sd, progress=lambda *step: steps.append(step)
    )
    dates = int(found.forecasts.date_of[-1]) + 1
    parts = 3 if prior_sd is None else 2
    assert steps == sorted(steps)
    assert steps[-1] == (parts * dates, parts * dates, 1.0)
    assert [part for _, _, part in steps] == sorted(part for _, _, part in steps)
    assert len(steps) >= 4


@pytest.mark.slow
def test_the_same_seed_gives_the_same_figures(found):
    again = validate(season(0.6))
    assert again.scored == found.scored
    assert again.dispersion == found.dispersion


def test_a_given_prior_is_used_throughout():
    found = validate(season(0.6, matches=200), prior_sd=0.8, seed=3)
    assert {row.prior_sd for row in found.scored} == {0.8}
    assert (found.choice, found.usual) == (None, ())
    assert found.drawn == "matches"


def test_one_date_is_refused():
    with pytest.raises(InputError, match="1 date"):
        validate(season(0.6, matches=45))


def test_a_chance_that_rounds_to_certainty_may_still_fail():
    """With hardly a prior a player who has always won cannot lose, and then does."""
    results = Results.from_names(
        ["Ann"] * 4, ["Bo"] * 4, [9, 9, 9, 0], [0, 0, 0, 9],
        date=[f"2024-09-0{day}" for day in range(1, 5)],
    )  # fmt: skip
    found = validate(results, prior_sd=100.0)
    assert all(np.isfinite(row.log_loss).all() for row in found.scored)


# How often the player with the longer race wins, by spot.


def test_spots_are_counted_from_the_side_that_gives():
    results = Results.from_names(
        ["Ann"] * 5, ["Bo"] * 5, [7, 6, 4, 4, 7], [4, 5, 7, 7, 6],
        race_a=[7, 7, 5, 6, 7], race_b=[5, 5, 7, 7, 7],
        date=[f"2024-09-0{day}" for day in range(1, 6)],
    )  # fmt: skip
    told = walk_forward(results)
    one, two, every = handicap_fairness(told)
    assert (one.spot, one.matches, one.won) == (1, 1, 1)
    assert (two.spot, two.matches, two.won) == (2, 3, 2)
    assert (every.spot, every.matches, every.won, every.share) == (None, 4, 3, 0.75)
    chances = told.p_match_integrated
    expected = (chances[0] + chances[1] + 1 - chances[2]) / 3
    assert two.expected == pytest.approx(expected)


def test_even_races_have_no_spot():
    results = Results.from_names(
        ["Ann"] * 2, ["Bo"] * 2, [7, 6], [4, 7], date=["2024-09-03", "2024-09-04"]
    )
    assert handicap_fairness(walk_forward(results)) == []


# Favorites in short races and in long ones.


def forecasts(races, *, longer=0):
    """Return forecasts of races that Ann, who has won before, wins but for the third."""
    many = len(races)
    race_b = np.array([5, *races])
    won = np.ones(many + 1, dtype=bool)
    won[3:4] = False
    race_a = race_b + longer
    results = Results.from_names(
        ["Ann"] * (many + 1), ["Bo"] * (many + 1), np.where(won, race_a, 0),
        np.where(won, 0, race_b), race_a=race_a, race_b=race_b,
        date=np.datetime64("2024-09-03") + np.arange(many + 1),
    )  # fmt: skip
    return walk_forward(results)


def test_the_halves_are_as_equal_as_lengths_allow():
    short, long = race_lengths(forecasts([3, 3, 4, 7, 7, 9]))
    assert (short.shortest, short.longest, short.matches, short.won) == (3, 4, 3, 2)
    assert (long.shortest, long.longest, long.matches, long.won) == (7, 9, 3, 3)
    assert short.share == pytest.approx(2 / 3)
    assert short.low < short.share < short.high
    assert 0.5 < short.predicted < long.predicted < 1


def test_one_length_and_handicaps_say_nothing():
    assert race_lengths(forecasts([5, 5, 5])) == []
    assert race_lengths(forecasts([3, 5, 7], longer=1)) == []


@pytest.mark.parametrize(("starts", "judged"), [(1, True), (2, False)])
def test_even_races_are_judged_where_few_others_have_a_start(starts, judged):
    races = [3, 3, 4, 7, 7, 9]
    started = np.arange(7) > 6 - starts
    found = race_lengths(forecasts(races, longer=started.astype(int)))
    assert bool(found) == judged
    assert sum(one.matches for one in found) == (6 - starts) * judged


def test_one_day_is_refused_whether_a_prior_is_given_or_not():
    day = season(0.6, matches=40)
    for prior_sd in (None, 0.7):
        with pytest.raises(InputError, match=r"on 1 date\. Give at least two"):
            validate(day, prior_sd=prior_sd)
