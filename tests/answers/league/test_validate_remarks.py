"""What is said of a validated season besides the verdict: each cause by its name, and only then."""

import dataclasses

import numpy as np
import pytest

from evenbreak.answers.league.validate import remarks
from evenbreak.files.results.results_file import read_results
from evenbreak.ratings import Results, scale_of, validate
from evenbreak.ratings.estimates import Estimate, wilson
from evenbreak.ratings.validation.advantages import ByExperience
from evenbreak.ratings.validation.validate import RaceLengths
from places import SHARED

NPL = scale_of("npl")
SEASON = SHARED / "data" / "snooker_2016_17_results.csv"


def said(found, word):
    """Return the one remark with this word in it, or None."""
    texts = [text for text in remarks(found, NPL) if word in text]
    assert len(texts) < 2
    return texts[0] if texts else None


def winners_first(season):
    turned = season.score_b > season.score_a
    a, b = (season.player_a, season.player_b), (season.score_a, season.score_b)
    return Results(
        season.players, np.where(turned, a[1], a[0]), np.where(turned, a[0], a[1]),
        np.maximum(*b), np.minimum(*b), date=season.date,
    )  # fmt: skip


def test_a_file_that_lists_winners_first_is_recognized(play_season):
    season = play_season(1, matches=300)
    found = validate(winners_first(season), prior_sd=0.5)
    text = said(found, "first column")
    assert "100%" in text
    assert "list winners first" in text
    assert "home" not in text
    plain = validate(season, prior_sd=0.5)
    assert found.scored[0].log_loss.value == pytest.approx(plain.scored[0].log_loss.value)
    assert said(plain, "first column") is None


@pytest.mark.slow
@pytest.mark.parametrize(("side", "home"), [(0.3, "home player"), (-0.3, "visitor")])
def test_an_advantage_of_the_first_column_may_be_that_of_home(play_season, side, home):
    assert home in said(validate(play_season(1, side=side), prior_sd=0.5), "first column")


@pytest.mark.parametrize(
    ("changed", "word"),
    [
        ({"dates_won": 12}, "winners first there"),
        ({"varies": 1e-4}, "from date to date"),
        ({"favored": 800, "with_favorite": 1200}, "stronger player first"),
    ],
)
def test_the_order_of_the_file_is_not_taken_for_an_advantage(sided, changed, word):
    column = sided.first_column._replace(**changed)
    text = said(dataclasses.replace(sided, first_column=column), "first column")
    assert word in text
    assert "home" not in text


@pytest.fixture(scope="module")
def sided(play_season):
    """A season in which the first column has an advantage."""
    return validate(play_season(1, side=0.3, matches=600), prior_sd=0.5)


def test_what_a_prior_does_to_newcomers_is_said_only_with_its_remedy(sided, chosen):
    new = ByExperience(0, 0, 100, 900, 0.5, 0.38, Estimate(-0.5, -0.7, -0.3), 1.0)
    text = said(dataclasses.replace(sided, experience=(new,)), "overrated before")
    assert "38% of their games (50% predicted)" in text
    assert "Leave {prior} out" in text
    assert chosen.choice is not None
    assert said(dataclasses.replace(chosen, experience=(new,)), "overrated before") is None


@pytest.mark.slow
@pytest.mark.skipif(not SEASON.exists(), reason="the season's results are not beside this checkout")
def test_a_real_season_whose_first_column_wins_more():
    found = validate(read_results(SEASON).results, prior_sd=0.36)
    short, long = found.lengths
    assert (short.longest, long.shortest) == (4, 5)
    assert abs(short.predicted - short.share) < 0.025
    assert all(one.gain.value < 0 for one in found.half_lives)
    assert "57%" in said(found, "first column")


@pytest.mark.parametrize(("share", "word"), [(0.68, "less"), (0.7, None)])
def test_races_of_a_length_that_favorites_win_less_are_named(sided, share, word):
    won = round(share * 4000)
    long = RaceLengths(6, 9, 4000, won, share, *wilson(share, 4000), 0.71)
    short = RaceLengths(3, 5, 4000, 2600, 0.65, *wilson(0.65, 4000), 0.65)
    text = said(dataclasses.replace(sided, lengths=(short, long)), "races")
    assert (text is not None) == (word is not None)
    if text:
        assert text == (
            "In the longer races (6 to 9 games), favorites win less often than predicted: 68% of "
            "4,000 (71% predicted)."
        )
