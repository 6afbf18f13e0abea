"""What a match brings at each error, against sums over all opponents and forms."""

import numpy as np
import pytest

from evenbreak.handicaps import (
    AUTOCORRELATED,
    EQUAL_SKILL,
    NATURAL,
    Ladder,
    Opponents,
    chart,
    match_table,
)
from evenbreak.handicaps.ladders.form import deviation_grid, deviations
from evenbreak.handicaps.ladders.pairing import pairing_of
from evenbreak.stats import Distribution
from slow_ladders import chances, exact_win, rounded_normal

MODELS = (NATURAL, AUTOCORRELATED, EQUAL_SKILL)
THREE = Distribution((-12, 0, 7), (0.25, 0.5, 0.25))


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


@pytest.mark.slow_after(1)
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
def test_chances_are_the_sum_over_all_opponents_and_forms(opponents, sd):
    ladder = Ladder("step 2 2", chart("npl_8"), opponents=opponents, match_sd=sd, widest=16)
    for error in (-16, 0, 9):
        for place, step in enumerate(ladder.steps.tolist()):
            expected = brute_moves(ladder, error, step)
            assert ladder.kernel[error + 16, place] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("model", MODELS)
def test_with_one_match_a_night_form_of_the_day_and_of_the_match_are_the_same(model):
    day = Ladder(chart("npl_10"), opponents=model, day_sd=6.0)
    match = Ladder(chart("npl_10"), opponents=model, match_sd=6.0, matches_a_night=3)
    np.testing.assert_allclose(chances(day.law()), chances(match.law()), rtol=1e-12)


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


def test_a_grid_of_forms_gives_what_every_point_gives():
    # A form that lasts for the night is held at few points; one for a match has every point.
    ladder = Ladder("npl", chart("npl_20"), day_sd=70.0)
    days, weights = deviation_grid(deviations(70.0), 30.0)
    pairing = pairing_of(
        ladder.system, ladder.chart, ladder.widest, ladder.opponents, np.ones(1), days
    )
    wins = pairing.moves(np.outer(ladder.errors == 0, weights))[-1] @ weights
    np.testing.assert_allclose(wins, ladder.wins, atol=1e-11)
