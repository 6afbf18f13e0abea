import math

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import chart
from evenbreak.league import reestimate

HOT = chart("fargo_r6_hot")
EQUAL = np.zeros(16)


def test_the_same_seed_gives_the_same_answer_and_another_another():
    one, two, three = (reestimate(EQUAL, HOT, weeks=8, leagues=2, seed=seed) for seed in (3, 3, 4))
    np.testing.assert_array_equal(one.sd_by_week, two.sd_by_week)
    assert one.row == two.row
    assert (one.sd_by_week != three.sd_by_week).any()


@pytest.mark.slow
def test_the_error_of_equal_players_is_the_one_of_the_information_in_their_games():
    # n games against equals tell log-odds to 2 / sqrt(n), and the prior weighs 4 / ln(2)^2 more.
    found = reestimate(np.zeros(40), HOT, weeks=30, leagues=6, seed=2)
    games = found.row.games * np.arange(1, 31) + 4 / math.log(2) ** 2
    # Shrinking toward the prior leaves of the error the share that is not the prior's.
    share = 1 - 4 / math.log(2) ** 2 / games
    points = 100 / math.log(2) * np.sqrt(4 / games * share)
    expected = points[15:].mean()
    assert found.row.sd == pytest.approx(expected, rel=0.12)
    assert found.sd_error < 0.06 * found.row.sd
    assert found.row.sd_doublings == found.row.sd / 100
    assert found.sd_by_week.shape == (6, 30)


@pytest.mark.slow
def test_a_short_memory_makes_ratings_worse():
    long, short = (
        reestimate(EQUAL, HOT, weeks=40, leagues=3, seed=7, half_life=half_life)
        for half_life in (None, 4)
    )
    assert short.row.sd > long.row.sd + 4 * math.hypot(long.sd_error, short.sd_error)
    assert short.row.favorite > long.row.favorite
    assert short.row.system == "refit, half-life 4"


def test_newcomers_settle_or_are_counted_as_unsettled():
    found = reestimate(EQUAL, HOT, weeks=6, newcomer_weeks=40, leagues=3, seed=9)
    assert 1.0 <= found.row.settling_mean <= found.row.settling_p90 <= 40
    assert found.unsettled < 0.2
    soon = reestimate(EQUAL, HOT, weeks=6, newcomer_weeks=1, leagues=3, seed=9)
    assert (soon.row.settling_mean, soon.unsettled) == (1.0, 1.0)


def test_with_an_odd_number_one_rests():
    found = reestimate(np.zeros(5), HOT, weeks=6, leagues=2, seed=1)
    assert (found.sd_by_week > 0.0).all()


@pytest.mark.parametrize(
    ("skill", "by", "options", "message"),
    [
        ([1.0], HOT, {}, "skill must be a list of two"),
        ([1.0, math.nan], HOT, {}, "skill must be a list of two"),
        (
            EQUAL,
            "nobody",
            {},
            (
                "chart must be a chart by rating difference: fargo_r6_hot, npl_8, npl_10, "
                "npl_12, npl_20, or a Chart of your own; you gave 'nobody'"
            ),
        ),
        (EQUAL, HOT, {"weeks": 1}, "weeks must"),
        (EQUAL, HOT, {"leagues": 1}, "leagues must"),
        (
            EQUAL,
            HOT,
            {"half_life": 0.0},
            r"half_life must be a number of weeks above 0, or None; you gave 0\.0",
        ),
    ],
)
def test_nonsense_is_refused(skill, by, options, message):
    with pytest.raises(InputError, match=message):
        reestimate(skill, by, **options)
