import math
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.ratings.scale import DEFAULT_SCALE, SCALES, USUAL, Scale, scale_of, unstated_scale
from rows import each_of

differences = st.floats(-20_000, 20_000)


@pytest.mark.parametrize(("name", "points"), [("npl", 30), ("fargo", 100)])
def test_so_many_points_double_the_odds(name, points):
    p = SCALES[name].win_probability(float(points))
    assert p / (1 - p) == pytest.approx(2, rel=1e-15)


def test_elo_has_ten_to_one_at_400_points():
    assert SCALES["elo"].win_probability(400.0) == pytest.approx(10 / 11, rel=1e-15)


def test_equal_players_have_exactly_even_chances():
    assert [scale.win_probability(0) for scale in SCALES.values()] == [0.5] * 3


@pytest.mark.parametrize("doublings", [-1000, -300, -60, -1, 0, 1, 7, 52, 300])
def test_whole_doublings_are_right_to_the_last_digits(doublings):
    exact = 1 / (1 + Fraction(2) ** -doublings)
    found = Scale("test", 25.0).win_probability(25.0 * doublings)
    assert found == pytest.approx(float(exact), rel=2.3e-16)


@given(differences)
def test_both_players_have_full_relative_accuracy(difference):
    scale = SCALES["fargo"]
    win, lose = scale.win_probability(difference), scale.win_probability(-difference)
    # Not 1 - win: where the loser's chance is 1e-30 the two must still be in proportion.
    assert math.log2(win) - math.log2(lose) == pytest.approx(difference / 100, rel=1e-12)
    assert win + lose == pytest.approx(1, rel=1e-15)


@given(differences)
def test_arrays_equal_scalars(difference):
    scale = SCALES["elo"]
    array = scale.win_probability(np.array([difference, -difference]))
    assert array[0] == pytest.approx(scale.win_probability(difference), rel=1e-14)
    assert array[1] == pytest.approx(scale.win_probability(-difference), rel=1e-14)


@given(st.floats(1e-300, 1 - 1e-12))
def test_difference_inverts_win_probability(p):
    scale = SCALES["npl"]
    difference = scale.difference(p)
    # A chance near 1 fixes the difference only as well as the float 1 - p does.
    assert scale.win_probability(difference) == pytest.approx(p, rel=1e-12)
    assert scale.difference(np.array([p]))[0] == pytest.approx(difference, rel=1e-12, abs=1e-300)


def test_differences_near_even_keep_their_digits():
    tiny = 2.0**-40
    exact = 2 * tiny / (1 / 2) / math.log(2)  # log-odds are 4 tiny to first order
    assert Scale("test", 1.0).difference(0.5 + tiny) == pytest.approx(exact, rel=1e-12)


def test_certainty_is_infinitely_far():
    scale = SCALES["npl"]
    assert (scale.difference(0), scale.difference(1)) == (-math.inf, math.inf)
    assert (scale.win_probability(-math.inf), scale.win_probability(math.inf)) == (0, 1)
    assert scale.difference(np.array([0.0, 1.0])).tolist() == [-math.inf, math.inf]
    assert scale.win_probability(np.array([-math.inf, math.inf])).tolist() == [0, 1]


@given(st.floats(-50, 50))
def test_points_and_log_odds_are_two_ways_to_say_one_thing(log_odds):
    scale = SCALES["fargo"]
    points = scale.points(log_odds)
    assert scale.log_odds(points) == pytest.approx(log_odds, rel=1e-14, abs=1e-300)
    assert scale.win_probability(points) == pytest.approx(1 / (1 + math.exp(-log_odds)), rel=1e-13)


def test_scale_of_knows_names_numbers_and_scales():
    assert scale_of(" FARGO ") is SCALES["fargo"]
    assert scale_of(SCALES["elo"]) is SCALES["elo"]
    assert scale_of(40).points_per_doubling == scale_of("40.0").points_per_doubling == 40


@each_of("wrong", ["ffargo", "", 0, -30, "nan", math.inf, None, 1e-3, "1e7", 1e300])
def test_scale_of_refuses_the_rest(wrong):
    with pytest.raises(InputError, match="must be npl, fargo, elo, or the points"):
        scale_of(wrong)


@pytest.mark.parametrize("wrong", ["x", None, math.nan, [1.0, math.nan], "12"])
def test_win_probability_refuses_what_is_no_number(wrong):
    with pytest.raises(InputError, match="difference"):
        SCALES["npl"].win_probability(wrong)


@pytest.mark.parametrize("wrong", [-0.1, 1.1, math.nan, [0.5, 2.0]])
def test_difference_refuses_what_is_no_probability(wrong):
    with pytest.raises(InputError, match="p "):
        SCALES["npl"].difference(wrong)


@pytest.mark.parametrize("points", [0.0, -1.0, math.inf, math.nan])
def test_a_scale_needs_points(points):
    with pytest.raises(InputError, match="points_per_doubling"):
        Scale("test", points)


def test_a_scale_needs_a_finite_center():
    with pytest.raises(InputError, match="center"):
        Scale("test", 30.0, math.inf)


def test_scalar_questions_do_not_import_numpy():
    program = (
        "import sys; from evenbreak.ratings.scale import scale_of; "
        "scale_of('npl').win_probability(12.0); scale_of('npl').difference(.7); "
        "sys.exit('numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


# Ratings that do not say their scale: what they can only be, or a question with both readings.


NOBODY = float("nan")


@pytest.mark.parametrize("name", USUAL)
def test_ratings_that_can_only_be_on_one_scale_are_on_that(name: str) -> None:
    rng, (low, high) = np.random.default_rng(12), USUAL[name]
    for _ in range(100):
        ratings = [*rng.uniform(low + 1, high - 1, rng.integers(1, 30)), NOBODY]
        assert unstated_scale(ratings, ["Ann"] * 31, "").name == name


@pytest.mark.parametrize(
    "ratings", [[190, 140], [612, 92], [580, 5800], [980, 960], [3100, 3050], [-80, 20]]
)
def test_ratings_outside_every_scale_are_refused_with_each_reading(ratings: list[float]) -> None:
    with pytest.raises(InputError, match=r"say which$") as refused:
        unstated_scale([NOBODY, *ratings], ["Cy", "Ann", "Bo"], "say which", "tonight.txt")
    said = str(refused.value)
    gap = abs(ratings[0] - ratings[1])
    for name, title in (("npl", "NPL"), ("fargo", "Fargo"), ("elo", "Elo")):
        assert f"by {title} ratings" in said
        assert f"{SCALES[name].win_probability(gap):.0%}" in said
    better, worse = ("Ann", "Bo") if ratings[0] > ratings[1] else ("Bo", "Ann")
    assert f"tonight.txt: the ratings from {min(ratings)} to {max(ratings)}" in said
    assert f"{better} wins a game against {worse}" in said


@pytest.mark.parametrize("ratings", [[6, 3], [5, 5], [2, NOBODY, 7, 4], [1, 9]])
def test_ratings_that_look_like_skill_levels_are_refused(ratings: list[float]) -> None:
    low, high = np.nanmin(ratings), np.nanmax(ratings)
    said = f"{low:g} to {high:g} look like skill levels, not ratings. take a chart"
    with pytest.raises(InputError, match=said):
        unstated_scale(ratings, ["Ann"] * 4, "say which", levels="take a chart")


@pytest.mark.parametrize("ratings", [[6], [6.5, 3], [0, 9], [3, 10], [NOBODY, 6]])
def test_one_rating_or_one_that_is_no_level_is_a_rating(ratings: list[float]) -> None:
    assert unstated_scale(ratings, ["Ann"] * 4, "").name == "npl"


def test_a_list_without_a_rating_is_on_the_default_scale() -> None:
    assert unstated_scale([NOBODY], ["Ann"], "").name == DEFAULT_SCALE
