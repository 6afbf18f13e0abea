import pickle
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import comb, erf, sqrt

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import AccuracyError, InputError
from evenbreak.game import Game, graph_of
from evenbreak.handicaps import (
    AUTOCORRELATED,
    EQUAL_SKILL,
    NATURAL,
    Chart,
    Ladder,
    Opponents,
    chart,
    error_law,
    match_table,
    opponents_of,
    system_of,
)
from evenbreak.handicaps.ladders.form import deviation_grid, deviations
from evenbreak.handicaps.ladders.pairing import pairing_of
from evenbreak.ratings import SCALES, scale_of
from evenbreak.stats import Distribution

PUBLISHED = {  # chart: natural, model A (the text's), model B
    "npl_8": (4.963, 4.978, 4.583),
    "npl_10": (4.634, 4.654, 4.417),
    "npl_12": (4.269, 4.291, 4.144),
    "npl_20": (3.668, 3.697, 3.688),
}
MODELS = (NATURAL, AUTOCORRELATED, EQUAL_SKILL)
THREE = Distribution((-12, 0, 7), (0.25, 0.5, 0.25))


def exact_win(p, m, n):
    """Return W(p; m, n) for a fraction p: m or more of m + n - 1 games won."""
    games = m + n - 1
    return sum(comb(games, k) * p**k * (1 - p) ** (games - k) for k in range(m, games + 1))


def exact_law(wins):
    """Return the stationary law of a +-1 ladder by detailed balance, without rounding."""
    weights = [Fraction(1)]
    for up, down in pairwise(wins):
        weights.append(weights[-1] * up / (1 - down))
    return [weight / sum(weights) for weight in weights]


def chances(law):
    return np.array(law.probability, dtype=float)


def dense_law(ladder):
    """Return the law by an eigenvector of the whole matrix: the second route."""
    many = len(ladder.errors)
    M = np.zeros((many, many))
    for place in range(many):
        for step, chance in zip(ladder.steps, ladder.kernel[place], strict=True):
            after = place + step
            M[after if 0 <= after < many else place, place] += chance
    values, vectors = np.linalg.eig(M)
    law = np.abs(vectors[:, np.argmin(np.abs(values - 1.0))].real)
    return law / law.sum()


def rounded_normal(days, sd):
    """Return the law of a normal deviation rounded to whole points."""
    below = [0.5 * (1 + erf((day - 0.5) / (sd * sqrt(2)))) for day in days]
    above = [0.5 * (1 + erf((day + 0.5) / (sd * sqrt(2)))) for day in days]
    return np.array(above) - np.array(below)


def brute_moves(ladder, error, step):
    """Return P(step | error) by sums over whatever the opponent and the two deviations may be.

    For one match a night.
    """
    sd = np.hypot(ladder.day_sd, ladder.match_sd)
    far = int(9 * sd) + 1 if sd else 0
    days = np.arange(-far, far + 1)
    weights = rounded_normal(days, sd) if sd else np.ones(1)
    of_error = ladder.opponent_law
    spread = ladder.opponents.spread
    table = match_table(ladder.system, ladder.chart, widest=4 * ladder.widest)
    total = 0.0
    for a, chance_a in zip(spread.values, chances(spread), strict=True):
        for j, chance_j in zip(of_error.values, chances(of_error), strict=True):
            if chance_j < 1e-18:
                continue
            skill = a if ladder.opponents.given == "skill" else a - j
            x = error - (skill + j) + table.widest
            for f, chance_f in zip(days, weights, strict=True):
                p = ladder.system.scale.win_probability((f - skill - days).astype(float))
                m, n = table.needs[x].tolist()
                won = exact_win(p, m, n)
                by = table.moves[x, table.won[x], 0][0], table.moves[x, ~table.won[x], 0][0]
                here = won * (by[0] == step) + (1 - won) * (by[1] == step)
                total += chance_a * chance_j * chance_f * float(weights @ here)
    return total


@pytest.mark.parametrize("name", PUBLISHED)
def test_standard_deviations_are_the_published_ones(name):
    found = [Ladder(chart(name), opponents=model).law().sd for model in MODELS]
    assert found == pytest.approx(PUBLISHED[name], abs=5.1e-4)


@pytest.mark.parametrize("name", PUBLISHED)
def test_natural_law_is_the_exact_one(name):
    wins = [exact_win(Fraction(1, 2), *chart(name).race(i)) for i in range(-60, 61)]
    expected = exact_law(wins)
    ladder = Ladder(chart(name))
    np.testing.assert_allclose(chances(ladder.law()), [float(x) for x in expected], rtol=1e-12)
    np.testing.assert_allclose(ladder.wins, [float(win) for win in wins], rtol=1e-12)
    assert ladder.law().values == tuple(range(-60, 61))
    assert ladder.changes == ()


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("name", PUBLISHED)
def test_law_is_the_eigenvector_of_the_matrix(model, name):
    ladder = Ladder(chart(name), opponents=model)
    np.testing.assert_allclose(chances(ladder.law()), dense_law(ladder), atol=1e-12)


@pytest.mark.parametrize("name", PUBLISHED)
def test_autocorrelated_law_is_that_of_opponents_who_err_by_it(name):
    ladder = Ladder(chart(name), opponents=AUTOCORRELATED, widest=40)
    errors = range(-40, 41)
    games = SCALES["npl"].win_probability(np.arange(-40.0, 41.0))
    law = chances(ladder.opponent_law)
    wins = [float(law @ exact_win(games, *chart(name).race(i))) for i in errors]
    np.testing.assert_allclose(ladder.wins, wins, rtol=1e-12)
    player = [float(x) for x in exact_law([Fraction(win) for win in wins])]
    np.testing.assert_allclose(law, player, rtol=1e-9)


def test_model_b_law_of_a_short_chart_is_the_one_of_exact_rounds():
    # All games are even, so that every chance is a fraction.
    short = Chart("short", [(0, 0, 2, 2), (1, 2, 3, 2), (3, None, 2, 1)])
    races = {x: exact_win(Fraction(1, 2), *short.race(x)) for x in range(-8, 9)}
    errors = range(-4, 5)
    law = exact_law([races[i] for i in errors])
    for _ in range(120):
        wins = [sum(v * races[i - j] for j, v in zip(errors, law, strict=True)) for i in errors]
        law = [Fraction(round(x * 10**30), 10**30) for x in exact_law(wins)]
    found = Ladder(short, opponents=EQUAL_SKILL, widest=4)
    np.testing.assert_allclose(chances(found.law()), [float(x) for x in law], rtol=1e-11)


@pytest.mark.parametrize("sd", [0.0, 1.5])
@pytest.mark.parametrize(
    "opponents",
    [
        EQUAL_SKILL,
        Opponents(THREE, given="skill"),
        Opponents(THREE, given="rating"),
        Opponents(THREE, Distribution((-3, 0, 1), (0.25, 0.5, 0.25)), "skill"),
        Opponents(THREE, Distribution((-3, 0, 1), (0.25, 0.5, 0.25)), "rating"),
    ],
)
def test_kernel_is_the_sum_over_all_that_may_be(opponents, sd):
    ladder = Ladder("step 2 2", chart("npl_8"), opponents=opponents, match_sd=sd, widest=16)
    for error in (-16, 0, 9):
        for place, step in enumerate(ladder.steps.tolist()):
            expected = brute_moves(ladder, error, step)
            assert ladder.kernel[error + 16, place] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("model", MODELS)
def test_day_and_match_deviations_are_one_where_a_night_has_one_match(model):
    day = Ladder(chart("npl_10"), opponents=model, day_sd=6.0)
    match = Ladder(chart("npl_10"), opponents=model, match_sd=6.0, matches_a_night=3)
    np.testing.assert_allclose(chances(day.law()), chances(match.law()), rtol=1e-12)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("name", PUBLISHED)
def test_fluctuation_widens_the_law(model, name):
    sds = [Ladder(chart(name), opponents=model, match_sd=sd).law().sd for sd in (0, 2, 4, 8)]
    assert all(before < after for before, after in pairwise(sds))
    assert sds[-1] < 1.1 * sds[0]


def test_a_deviation_that_lasts_for_the_night_widens_it_more():
    sds = [
        Ladder(chart("npl_10"), opponents=EQUAL_SKILL, day_sd=8.0, matches_a_night=matches).law().sd
        for matches in (1, 2, 3)
    ]
    assert sds[0] < sds[1] < sds[2]


def test_the_law_of_a_night_is_that_of_the_chain_of_error_match_and_deviation():
    ladder = Ladder(chart("npl_8"), day_sd=1.5, matches_a_night=2, widest=40)
    days = np.arange(-13, 14)
    weights = rounded_normal(days, 1.5)
    games = SCALES["npl"].win_probability((days[:, None] - days).astype(float))  # own, other's
    races = [chart("npl_8").race(i) for i in range(-40, 41)]
    wins = np.array([exact_win(games, m, n) @ weights for m, n in races])  # error, own
    night, first = np.zeros((2, 81, 81))
    place = np.arange(81)
    for day, weight in enumerate(weights):
        M = np.zeros((81, 81))
        M[np.minimum(place + 1, 80), place] += wins[:, day]
        M[np.maximum(place - 1, 0), place] += 1.0 - wins[:, day]
        first += weight * M
        night += weight * M @ M
    begun = np.zeros(81)
    begun[39:42] = 0.25, 0.5, 0.25  # as often odd as even, and far from the ends
    law = np.linalg.matrix_power(night, 4096) @ begun
    np.testing.assert_allclose(chances(ladder.law()), (law + first @ law) / 2, atol=1e-11)


@pytest.mark.parametrize("system", ["npl", "step 2", "step 3 2", "margin 1", "elo 8"])
def test_every_rule_has_the_law_of_its_matrix(system):
    ladder = Ladder(system, opponents=EQUAL_SKILL, widest=72)
    law = chances(ladder.law())
    assert law.sum() == pytest.approx(1.0)
    M = np.zeros((145, 145))
    for before in range(145):
        for step, chance in zip(ladder.steps.tolist(), ladder.kernel[before].tolist(), strict=True):
            after = before + step
            M[after if 0 <= after < 145 else before, before] += chance
    np.testing.assert_allclose(M @ law, law, atol=1e-13)


def test_steps_of_two_make_each_parity_equally_likely():
    law = Ladder("step 2", chart("npl_10")).law()
    even = sum(
        chance for error, chance in zip(law.values, law.probability, strict=True) if error % 2 == 0
    )
    assert even == pytest.approx(0.5)


def test_a_skill_that_rises_leaves_its_rating_behind():
    means = [
        Ladder(chart("npl_10"), opponents=EQUAL_SKILL, drift=drift).law().mean
        for drift in (-0.1, 0.0, 0.05, 0.1)
    ]
    assert means[0] == pytest.approx(-means[3], rel=1e-9)
    assert means[1] == pytest.approx(0.0, abs=1e-12)
    assert means[3] < means[2] < 0.0


def test_a_rising_skill_is_met_by_steady_opponents():
    ladder = Ladder(chart("npl_10"), opponents=EQUAL_SKILL, drift=0.1)
    steady = Ladder(chart("npl_10"), opponents=EQUAL_SKILL)
    assert chances(ladder.opponent_law) == pytest.approx(chances(steady.law()), abs=1e-13)
    # In the long run the matches bring what the skill gains.
    assert (2 * ladder.wins - 1) @ chances(ladder.law()) == pytest.approx(0.1, rel=1e-9)


def test_where_all_ratings_rise_errors_are_those_beyond_the_mean():
    law = Ladder("step 2 1", chart("npl_10"), opponents=EQUAL_SKILL).law()
    assert law.mean == pytest.approx(0.0, abs=0.02)
    assert Ladder("step 2 1", chart("npl_10")).law().mean > 10.0


@pytest.mark.parametrize("model", [AUTOCORRELATED, EQUAL_SKILL])
def test_each_round_brings_the_change_down(model):
    changes = Ladder(chart("npl_10"), opponents=model).changes
    assert changes[-1] <= 1e-13
    for before, after in pairwise(changes[:5]):
        assert after < (0.02 if model is AUTOCORRELATED else 0.25) * before


def test_without_symmetry_a_tilt_grows():
    found = Ladder(chart("npl_10"), opponents=AUTOCORRELATED)
    # Opponents who are better than rated by .01 points on average.
    law = 0.99 * chances(found.law()) + 0.01 * np.roll(chances(found.law()), -1)
    means = []
    for _ in range(3):
        means.append(law @ found.errors)
        given = Distribution(tuple(found.errors.tolist()), tuple(law / law.sum()))
        law = chances(
            Ladder(chart("npl_10"), opponents=Opponents(error=given, given="rating")).law()
        )
    for before, after in pairwise(means):
        assert 1.05 < after / before < 1.4


def test_narrow_ladders_fall_short_and_wide_ones_agree():
    natural = {w: Ladder(chart("npl_8"), widest=w).law().sd for w in (15, 30, 60)}
    assert natural[15] == pytest.approx(4.949, abs=5e-4)
    assert natural[30] == pytest.approx(natural[60], abs=1e-8)


@pytest.mark.parametrize("model", MODELS)
@given(
    day_sd=st.floats(0, 12),
    match_sd=st.floats(0, 12),
    matches=st.integers(1, 3),
    name=st.sampled_from(sorted(PUBLISHED)),
)
@settings(max_examples=6, deadline=None)
def test_laws_are_symmetric(model, day_sd, match_sd, matches, name):
    ladder = Ladder(
        chart(name),
        opponents=model,
        day_sd=day_sd,
        match_sd=match_sd,
        matches_a_night=matches,
        widest=40,
    )
    law = chances(ladder.law())
    np.testing.assert_allclose(law, law[::-1], atol=1e-12)
    np.testing.assert_allclose(ladder.kernel.sum(axis=1), 1.0, rtol=1e-12)


def test_fourier_transforms_give_what_sums_give(monkeypatch):
    from evenbreak.handicaps.ladders import form as fluctuation
    from evenbreak.handicaps.ladders import pairing

    around = Opponents(THREE, given="rating")
    settings_of = [
        {"opponents": EQUAL_SKILL, "day_sd": 4.5, "matches_a_night": 2},
        {"opponents": EQUAL_SKILL, "match_sd": 5.0},
        {"opponents": around, "match_sd": 5.0},
    ]
    summed, transformed = [], []
    for few, found in ((1 << 40, summed), (0, transformed)):
        monkeypatch.setattr(fluctuation, "_FEW", few)
        monkeypatch.setattr(pairing, "_FEW", few)
        found += [chances(Ladder(chart("npl_8"), widest=14, **each).law()) for each in settings_of]
    for one, other in zip(summed, transformed, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-12)


@pytest.mark.parametrize("system", ["npl", "step 3"])
def test_it_is_a_game_whose_two_routes_agree(system):
    ladder = Ladder(system, chart("npl_8"), widest=9)
    assert isinstance(ladder, Game)
    assert ladder.start == 0
    assert ladder.winner(3) is None
    limit = stochastic_limit(chain_of(ladder))
    law = dict(zip(range(-9, 10), ladder.law().probability, strict=True))
    unit = 3 if system == "step 3" else 1
    reached = {error: law[error] * unit for error in law if error % unit == 0}
    assert dict(limit.to_dict()) == pytest.approx(reached, rel=1e-12)
    assert sorted(graph_of(ladder)) == sorted(reached)


def test_drift_makes_a_game_too():
    ladder = Ladder(chart("npl_8"), drift=0.25, widest=20)
    limit = stochastic_limit(chain_of(ladder))
    for error, chance in zip(range(-20, 21), ladder.law().probability, strict=True):
        assert limit.get(error, 0.0) == pytest.approx(chance, rel=1e-9, abs=1e-15)


def test_equal_ladders_are_equal_and_copies_too():
    ladder = Ladder("npl", chart("npl_8"), opponents=EQUAL_SKILL, widest=20)
    assert ladder == Ladder(chart("npl_8"), opponents=EQUAL_SKILL, widest=20)
    assert ladder != Ladder(chart("npl_8"), widest=20)
    assert ladder.system is system_of("npl")
    assert Ladder("npl").chart == chart("npl_10")
    copy = pickle.loads(pickle.dumps(ladder))  # noqa: S301
    assert copy == ladder
    assert copy.law() == ladder.law()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"widest": 0}, "widest is 0; give a whole number, 1 or more"),
        ({"widest": 2.5}, "widest is 2.5; give a whole number"),
        ({"day_sd": -1}, "day_sd is -1; give a number from 0 to 120"),
        ({"match_sd": "x"}, "match_sd is 'x'; give a number"),
        ({"day_sd": float("nan")}, "day_sd is nan"),
        ({"matches_a_night": 0}, "matches_a_night is 0; give a whole number, 1 or more"),
        ({"drift": 2}, "drift is 2; give a number from -1 to 1"),
        ({"opponents": "natural"}, "opponents is 'natural'; give Opponents, such as NATURAL"),
        ({"opponents": Opponents(Distribution((0, 900), (0.5, 0.5)))}, "goes to 900 points"),
        ({"chart": "npl_8"}, "chart is 'npl_8'; give a Chart, such as chart"),
        ({"system": "chess"}, "system is 'chess'; give"),
    ],
)
def test_what_makes_no_ladder_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        Ladder(**{"system": "npl"} | change)


def test_two_charts_are_one_too_many():
    with pytest.raises(InputError, match="a Chart was given as the system already"):
        Ladder(chart("npl_8"), chart("npl_10"))


def test_a_skill_that_outruns_its_rating_has_no_width():
    with pytest.raises(AccuracyError, match="give widest yourself"):
        Ladder(chart("npl_10"), drift=1.0)


def test_a_law_that_does_not_settle_is_not_given(monkeypatch):
    monkeypatch.setattr(error_law, "_ROUNDS", 3)
    with pytest.raises(AccuracyError, match="after 3 rounds"):
        Ladder(chart("npl_8"), opponents=AUTOCORRELATED).law()


@pytest.mark.parametrize(("system", "day_sd"), [("step 2", 110.0), ("step 3", 100.0)])
def test_the_line_is_wide_enough_for_forms_that_vary_much(system, day_sd):
    ladder = Ladder(system, day_sd=day_sd)
    wider = Ladder(system, day_sd=day_sd, widest=2 * ladder.widest)
    assert ladder.law().sd == pytest.approx(wider.law().sd, rel=1e-6)


def test_a_night_of_one_match_may_be_reckoned_by_any_grid_of_forms():
    # A form that lasts for the night is held at few points; one for a match has every point.
    ladder = Ladder("npl", chart("npl_20"), day_sd=70.0)
    days, weights = deviation_grid(deviations(70.0), 30.0)
    pairing = pairing_of(
        ladder.system, ladder.chart, ladder.widest, ladder.opponents, np.ones(1), days
    )
    wins = pairing.moves(np.outer(ladder.errors == 0, weights))[-1] @ weights
    np.testing.assert_allclose(wins, ladder.wins, atol=1e-11)


def test_a_law_that_lies_on_the_ends_is_refused():
    with pytest.raises(AccuracyError, match="not keep up"):
        Ladder("step 1 0", widest=60).law()
    far = opponents_of([500, 550, 600], 80)
    with pytest.raises(AccuracyError, match="opponents nearer the player's skill, or a widest"):
        Ladder("npl", opponents=far, widest=60).law()
    with pytest.raises(AccuracyError, match="too far from the player's skill"):
        Ladder("npl", opponents=far)


def test_a_spread_of_opponents_gets_the_width_that_it_needs():
    far = opponents_of([52, 80, 118], 140)
    ladder = Ladder("npl", opponents=far)
    assert ladder.widest == 240
    wider = Ladder("npl", opponents=far, widest=300).law()
    assert ladder.law().mean == pytest.approx(wider.mean, abs=1e-6)


def test_a_chart_that_is_even_everywhere_brings_nothing_back():
    with pytest.raises(AccuracyError, match="the same race at every difference"):
        Ladder("npl", Chart("even", [(0, None, 5, 5)]))


def test_a_scale_of_less_than_a_point_is_refused():
    tiny = replace(system_of("npl"), scale=scale_of(0.01))
    with pytest.raises(InputError, match=r"is 0\.01 on"):
        Ladder(tiny)
