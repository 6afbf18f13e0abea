"""The chance of a result, honest or feigned, against plain sums."""

import numpy as np
import pytest

from evenbreak.league.sandbag_evidence import Likelihood, units
from evenbreak.ratings.scale import SCALES
from slow_results import LAW, NPL, chance, ends

ERRS = Likelihood(NPL, LAW)


def test_points_of_other_scales_are_rounded_halves_upwards():
    assert units(72.0, NPL) == 72
    assert units(610.0, SCALES["fargo"]) == 183
    assert units(2.5, NPL) == 3


def test_scores_and_feigned_defeats_against_a_plain_sum():
    honest, feigned = ERRS.of((3, 5), (4, 5), won=False, first=-9, last=9)
    assert honest.shape == feigned.shape == (19,)
    for place in (0, 9, 18):
        assert honest[place] == pytest.approx(chance((3, 5), place - 9))
    total = sum(
        ways * ERRS.of(games, (4, 5), won=won, first=7, last=7)[1][0]
        for games, ways, won in ends(4, 5)
    )
    assert total == pytest.approx(1.0)


def test_a_match_of_which_only_the_winner_is_known():
    won, _ = ERRS.of(None, (4, 5), won=True, first=3, last=3)
    lost, feigned = ERRS.of(None, (4, 5), won=False, first=3, last=3)
    scores = sum(ways * chance(games, 3) for games, ways, ok in ends(4, 5) if ok)
    assert won[0] == pytest.approx(scores)
    assert won[0] + lost[0] == pytest.approx(1.0)
    assert feigned[0] == pytest.approx(1.0)
    assert ERRS.of(None, None, won=True, first=0, last=0)[0] == pytest.approx(1.0)


def test_scores_too_unlikely_for_a_float_weigh_nothing():
    _, feigned = ERRS.of((119, 120), (120, 120), won=False, first=-400, last=900)
    assert np.isfinite(feigned).all()
    assert feigned[-1] == 0.0 < feigned[400]


def test_the_form_of_the_day_is_averaged_over():
    form = 5.0
    known = Likelihood(NPL, LAW, form)
    rng = np.random.default_rng(4)
    # His own form and the opponent's, each rounded to whole points.
    mine, theirs = (np.rint(rng.normal(0.0, form, 20_000)).astype(int) for _ in range(2))
    each = np.array([chance((5, 2), 7 + apart) for apart in range(-60, 61)])[mine - theirs + 60]
    expected = known.of((5, 2), (5, 5), won=True, first=7, last=7)[0][0]
    assert abs(each.mean() - expected) < 4.5 * each.std() / 20_000**0.5
    assert expected != pytest.approx(chance((5, 2), 7), rel=1e-4)
    assert known.error.tolist() == ERRS.error.tolist()
