import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.games import Ahead, Race, Rack, winner_breaks
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.matches import match_odds
from evenbreak.ratings.scale import SCALES

EVEN = Rack(0.5)


@pytest.mark.parametrize(("m", "n"), [(7, 5), (1, 1), (9, 4)])
def test_a_race_has_the_chances_and_lengths_of_other_commands(m, n):
    odds = Gap(15, 25).odds(Race(m, n, EVEN))
    assert odds.p_win_1 == pytest.approx(Gap(15, 25).win(m, n), abs=1e-12)
    length = Gap(15, 25).length(m, n)
    assert (odds.mean_games, odds.sd_games) == pytest.approx((length.mean, length.sd))
    assert (odds.games_p50, odds.games_p90) == (length.quantile(0.5), length.quantile(0.9))


MATCHES = [
    Race(3, 1, Race(3, 3, EVEN)),
    Ahead(5, 3, EVEN),
    Race(5, 4, EVEN, win_by=2),
    Race(5, 4, EVEN, score=(2, 1)),
]


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("match", MATCHES)
def test_any_match_is_averaged_over_the_possible_differences(match):
    scale = SCALES["npl"]
    odds = Gap(15, 25, scale=scale).odds(match)
    rng = np.random.default_rng(1)
    chances, means = [], []
    for difference in rng.normal(15, 25, 400).tolist():
        one = Gap(difference, scale=scale).odds(match)
        chances.append(one.p_win_1)
        means.append(one.mean_games)
    for found, drawn in ((odds.p_win_1, chances), (odds.mean_games, means)):
        assert found == pytest.approx(np.mean(drawn), abs=4 * np.std(drawn) / 20)
    assert odds.p_win_1 + odds.p_win_2 + odds.p_never_ends == pytest.approx(1.0)
    assert odds.games_p50 <= odds.games_p90


@pytest.mark.parametrize("match", MATCHES)
def test_ratings_that_are_sure_give_the_odds_of_the_match(match):
    sure = Gap(0.0).odds(match)
    assert sure == match_odds(match)
    nearly = Gap(0.0, 1e-6).odds(match)
    assert nearly.p_win_1 == pytest.approx(sure.p_win_1, abs=1e-6)


@pytest.mark.parametrize(
    ("match", "difference", "error", "named"),
    [
        (Race(5, 4, EVEN), "much", 10.0, "difference"),
        (
            Race(5, 4, EVEN),
            10.0,
            -1.0,
            r"error must be 0 to 300 points \(10 doublings of the odds\); it is -1",
        ),
        (Race(5, 4, EVEN), 10.0, [1.0, 2.0], "a single number"),
        ("5:4", 10.0, 10.0, "match"),
        (Race(5, 4, Rack(0.6, 0.5), breaks=winner_breaks), 10.0, 10.0, "break"),
    ],
)
def test_what_cannot_be_averaged_is_refused(match, difference, error, named):
    with pytest.raises(InputError, match=named):
        Gap(difference, error).odds(match)
