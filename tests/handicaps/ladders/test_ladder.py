"""The ladder: its long run against the published, the exact and the obvious one."""

import pickle
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

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
    opponents_of,
    system_of,
)
from evenbreak.ratings import scale_of
from evenbreak.stats import Distribution
from rows import each_of
from slow_ladders import chances, exact_law, exact_win

PUBLISHED = {  # chart: natural, model A (the text's), model B
    "npl_8": (4.963, 4.978, 4.583),
    "npl_10": (4.634, 4.654, 4.417),
    "npl_12": (4.269, 4.291, 4.144),
    "npl_20": (3.668, 3.697, 3.688),
}
MODELS = (NATURAL, AUTOCORRELATED, EQUAL_SKILL)
THREE = Distribution((-12, 0, 7), (0.25, 0.5, 0.25))


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


@pytest.mark.parametrize("name", PUBLISHED)
def test_standard_deviations_are_the_published_ones(name):
    found = [Ladder(chart(name), opponents=model).law().sd for model in MODELS]
    assert found == pytest.approx(PUBLISHED[name], abs=5.1e-4)


@pytest.mark.parametrize("name", PUBLISHED)
def test_the_natural_distribution_is_the_exact_one(name):
    wins = [exact_win(Fraction(1, 2), *chart(name).race(i)) for i in range(-60, 61)]
    expected = exact_law(wins)
    ladder = Ladder(chart(name))
    np.testing.assert_allclose(chances(ladder.law()), [float(x) for x in expected], rtol=1e-12)
    np.testing.assert_allclose(ladder.wins, [float(win) for win in wins], rtol=1e-12)
    assert ladder.law().values == tuple(range(-60, 61))
    assert ladder.changes == ()


@each_of("model", MODELS)
@each_of("name", PUBLISHED)
def test_the_long_run_is_the_eigenvector_of_the_matrix(model, name):
    ladder = Ladder(chart(name), opponents=model)
    np.testing.assert_allclose(chances(ladder.law()), dense_law(ladder), atol=1e-12)


@each_of("model", MODELS)
@each_of("name", PUBLISHED)
def test_varying_form_widens_the_errors(model, name):
    sds = [Ladder(chart(name), opponents=model, match_sd=sd).law().sd for sd in (0, 2, 4, 8)]
    assert all(before < after for before, after in pairwise(sds))
    assert sds[-1] < 1.1 * sds[0]


def test_form_that_lasts_for_the_night_widens_the_errors_more():
    sds = [
        Ladder(chart("npl_10"), opponents=EQUAL_SKILL, day_sd=8.0, matches_a_night=matches).law().sd
        for matches in (1, 2, 3)
    ]
    assert sds[0] < sds[1] < sds[2]


@pytest.mark.parametrize("system", ["npl", "step 2", "step 3 2", "margin 1", "elo 8"])
def test_every_rule_has_the_long_run_of_its_matrix(system):
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


def test_a_rising_skill_leaves_its_rating_behind():
    means = [
        Ladder(chart("npl_10"), opponents=EQUAL_SKILL, drift=drift).law().mean
        for drift in (-0.1, 0.0, 0.05, 0.1)
    ]
    assert means[0] == pytest.approx(-means[3], rel=1e-9)
    assert means[1] == pytest.approx(0.0, abs=1e-12)
    assert means[3] < means[2] < 0.0


def test_narrow_ladders_fall_short_and_wide_ones_agree():
    natural = {w: Ladder(chart("npl_8"), widest=w).law().sd for w in (15, 30, 60)}
    assert natural[15] == pytest.approx(4.949, abs=5e-4)
    assert natural[30] == pytest.approx(natural[60], abs=1e-8)


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


@each_of(
    "change, message",
    [
        ({"widest": 0}, "widest must be a whole number, 1 or more; you gave 0"),
        ({"widest": 2.5}, r"widest must be a whole number, 1 or more; you gave 2\.5"),
        ({"day_sd": -1}, "day_sd must be a number from 0 to 120; you gave -1"),
        ({"match_sd": "x"}, "match_sd must be a number from 0 to 120; you gave 'x'"),
        ({"day_sd": float("nan")}, "day_sd must be a number from 0 to 120; you gave nan"),
        ({"matches_a_night": 0}, "matches_a_night must be a whole number, 1 or more; you gave 0"),
        ({"drift": 2}, "drift must be a number from -1 to 1; you gave 2"),
        (
            {"opponents": "natural"},
            "opponents must be Opponents, such as NATURAL; you gave 'natural'",
        ),
        ({"opponents": Opponents(Distribution((0, 900), (0.5, 0.5)))}, "goes up to 900 points"),
        (
            {"chart": "nobody"},
            (
                "chart must be a chart by rating difference: fargo_r6_hot, npl_8, npl_10, "
                "npl_12, npl_20, or a Chart of your own; you gave 'nobody'"
            ),
        ),
        (
            {"system": "chess"},
            (
                r"system must be npl, step UP \[DOWN\], margin \[MOST\], elo \[K\], fixed "
                r"\[GAMES\], none \[GAMES\], fargo-like, level-review, apa-like, tap-like, "
                r"level-steps \[STEPS\], averages, win-percent or napa-like; you gave 'chess'"
            ),
        ),
    ],
)
def test_what_makes_no_ladder_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        Ladder(**{"system": "npl"} | change)


def test_two_charts_are_one_too_many():
    with pytest.raises(InputError, match="a Chart was already given as the system"):
        Ladder(chart("npl_8"), chart("npl_10"))


def test_a_skill_that_outruns_its_rating_has_no_width():
    with pytest.raises(AccuracyError, match="less day_sd, match_sd or drift"):
        Ladder(chart("npl_10"), drift=1.0)


@pytest.mark.parametrize(("system", "day_sd"), [("step 2", 110.0), ("step 3", 100.0)])
def test_a_ladder_is_wide_enough_for_form_that_varies_much(system, day_sd):
    ladder = Ladder(system, day_sd=day_sd)
    wider = Ladder(system, day_sd=day_sd, widest=2 * ladder.widest)
    assert ladder.law().sd == pytest.approx(wider.law().sd, rel=1e-6)


def test_errors_that_lie_on_the_ends_are_refused():
    with pytest.raises(AccuracyError, match="don't keep up"):
        Ladder("step 1 0", widest=60).law()
    far = opponents_of([500, 550, 600], 80)
    with pytest.raises(AccuracyError, match="opponents closer to the player's skill, or a widest"):
        Ladder("npl", opponents=far, widest=60).law()
    with pytest.raises(AccuracyError, match="Give a skill closer to theirs"):
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
    with pytest.raises(InputError, match=r"it is 0\.01"):
        Ladder(tiny)
