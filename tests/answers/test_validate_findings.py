"""The statistics in words: each holds the figures that it is about."""

import pytest

from evenbreak.answers.validate_findings import findings, spread_words
from evenbreak.answers.validate_judgement import scored_of
from evenbreak.ratings import Results, scale_of, validate

NPL, FARGO = scale_of("npl"), scale_of("fargo")


def test_the_figures_of_a_handicap_league(demo):
    text = " ".join(findings(demo, NPL))
    game = scored_of(demo, "game")
    for figure in (
        f"{game.log_loss.value:.4f}",
        f"slope {game.slope.value:.2f}",
        f"{demo.dispersion.seen:.2f}",
        f"{demo.dispersion.by_chance:.2f}",
        f"{demo.first_breaks.won} of {demo.first_breaks.matches}",
    ):
        assert figure in text
    assert "of no use" in text  # chances of matches under handicaps


def test_a_chosen_prior_is_given_in_points_of_the_scale(chosen):
    text = " ".join(findings(chosen, FARGO))
    assert f"{chosen.prior_sd * FARGO.points_per_log_odds:.3g} points on the fargo scale" in text
    assert f"{scored_of(chosen, 'game').as_it_went:.4f}" in text
    assert "default of 100 points" in text


def test_a_default_prior_that_is_too_wide_is_too_extreme(alike):
    assert "too extreme" in " ".join(findings(alike, NPL))


def test_a_prior_at_the_edge_is_not_recommended():
    results = Results.from_names(
        ["A", "A"], ["B", "B"], [7, 7], [5, 0], date=["2024-09-03", "2024-09-04"]
    )
    text = " ".join(findings(validate(results), NPL))
    assert "no telling which prior" in text
    assert "--prior" not in text


def test_few_matches_have_no_slope(play_season):
    text = " ".join(findings(validate(play_season(6, matches=60), prior_sd=0.01), NPL))
    assert "(slope" not in text


def test_scores_that_vary_more_are_explained_and_others_are_not(demo, chosen):
    more = 100 * (demo.dispersion.seen / demo.dispersion.by_chance - 1)
    assert f"{more:.0f} %" in spread_words(demo)
    assert "winner breaks" in spread_words(demo)
    assert spread_words(chosen) == ""


@pytest.mark.parametrize(("side", "advantage"), [(0.3, True), (0.0, False)])
def test_an_advantage_of_the_first_column(play_season, side, advantage):
    text = " ".join(findings(validate(play_season(1, side=side), prior_sd=0.5), NPL))
    assert ("first column is an advantage" in text) == advantage
