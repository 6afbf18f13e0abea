"""The watch blames the honest as seldom as it says, and sees those who sandbag."""

import numpy as np
import pytest
from scipy.stats import binom

from evenbreak.errors import InputError
from evenbreak.handicaps import Ladder
from evenbreak.league.sandbag_power import watch_power

LADDER = Ladder("npl")
MOST = {alpha: binom.ppf(1.0 - 1e-5, 400, alpha) / 400 for alpha in (0.05, 0.2)}


@pytest.mark.parametrize(
    ("honest", "alpha", "start", "marked"),
    [
        ("any", 0.2, None, None),
        ("any", 0.2, -30, None),
        ("any", 0.2, 25, 0.5),
        ("established", 0.05, None, None),
        ("established", 0.2, None, 0.5),
    ],
)
def test_honest_players_are_flagged_as_seldom_as_stated(honest, alpha, start, marked):
    found = watch_power(
        LADDER,
        share=0.0,
        matches=50,
        alpha=alpha,
        honest=honest,
        start=start,
        marked=marked,
        replicas=400,
        seed=3,
    )
    assert found.flagged[-1] <= MOST[alpha]
    if start is None:
        assert found.p_win == pytest.approx(0.5, abs=0.02)


@pytest.mark.parametrize("system", ["elo", "margin"])
def test_other_systems_and_scales_have_the_same_bound(system):
    asked = {"matches": 30, "replicas": 200, "alpha": 0.2, "honest": "established"}
    ladder = Ladder(system)
    assert watch_power(ladder, share=0.0, **asked).flagged[-1] <= 0.35
    assert watch_power(ladder, share=0.9, marked=0.5, **asked).flagged[-1] > 0.5


def test_established_is_no_bound_for_the_misrated():
    found = watch_power(LADDER, share=0.0, matches=40, honest="established", start=-30, replicas=60)
    assert found.flagged[-1] > 0.5


def test_dumping_more_and_deeper_is_flagged_sooner():
    asked = {"matches": 40, "replicas": 100, "marked": 0.5, "seed": 2}
    lightly, heavily = (
        watch_power(LADDER, share=share, points=60, **asked).flagged for share in (0.2, 0.9)
    )
    assert lightly[-1] + 0.2 < heavily[-1]
    assert (np.diff(heavily) >= 0).all()


def test_the_error_that_dumping_brings_is_that_of_the_cycle():
    # Half of the matches dumped outright: all others must be won to stand still, so it falls.
    found = watch_power(LADDER, share=0.5, matches=40, replicas=100)
    assert found.rating_error[-1] < -12.0
    assert found.p_win > 0.6


def test_the_same_seed_the_same_answer_and_its_error():
    first, again = (watch_power(LADDER, share=0.5, matches=20, replicas=40) for _ in range(2))
    assert (first.flagged == again.flagged).all()
    part = first.flagged[-1]
    assert first.se[-1] == pytest.approx((part * (1 - part) / 40) ** 0.5)


@pytest.mark.parametrize(
    "asked",
    [
        {"share": 2.0},
        {"matches": 0},
        {"alpha": 0.0},
        {"replicas": 1},
        {"points": -1},
        {"marked": 3},
        {"honest": "no"},
        {"start": 900},
    ],
)
def test_what_cannot_be_is_refused(asked):
    with pytest.raises(InputError):
        watch_power(LADDER, **{"share": 0.5, "replicas": 10, "matches": 5, **asked})
