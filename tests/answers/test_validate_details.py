"""The statistics of a validated season: every figure where a person looks for it."""

from dataclasses import replace

import numpy as np

from evenbreak.answers.kit.parts import Table
from evenbreak.answers.validate_details import details
from evenbreak.answers.validate_judgement import scored_of
from evenbreak.ratings import Results, scale_of, validate
from evenbreak.ratings.levels import Levels

NPL, FARGO = scale_of("npl"), scale_of("fargo")


def parts_of(found, scale=NPL):
    parts = list(details(found, scale))
    return (
        [one for one in parts if isinstance(one, Table)],
        " ".join(one for one in parts if isinstance(one, str)),
    )


def test_every_kind_of_prediction_has_its_losses(chosen):
    scored = parts_of(chosen)[0][0]
    assert [row[:2] for row in scored.rows] == [
        ("game", "plug-in"),
        ("game", "integrated"),
        ("match", "plug-in"),
        ("match", "integrated"),
        ("game", "default"),
        ("match", "default"),
    ]
    best = scored_of(chosen, "match")
    assert scored.rows[3][2] == NPL.points(best.prior_sd)
    assert scored.columns[3].text(scored.rows[3][3]).startswith(f"{best.log_loss.value:.4f}")


def test_the_tests_stand_beside_what_was_expected(demo):
    tests = parts_of(demo)[0][2]
    rows = {row[0]: row[1:] for row in tests.rows}
    spread, first = demo.dispersion, demo.first_breaks
    assert rows["spread of scores"] == (
        spread.races,
        f"{spread.seen:.2f}",
        f"{spread.by_chance:.2f}",
        None,
        spread.p_value,
    )
    assert rows["won by the first breaker"][1] == str(first.won)
    assert "runs of racks" not in rows  # the demo league does not list its racks


def test_matches_and_spots_have_a_row_a_bin(demo):
    _, _, _, shapes, matches, spots, starts, experience = parts_of(demo)[0]
    assert [row.of for row in shapes.rows] == ["deciders", "sweeps", "games"]
    assert [row[0] for row in experience.rows] == ["1 to 20", "21 to 50", "51 to 200"]
    assert [row[1] for row in matches.rows] == [one.matches for one in demo.matches]
    assert [row[0] for row in spots.rows] == [1, 2, 3, 4, 5, "all"]
    assert list(starts.rows) == list(demo.starts.groups)


def test_a_chosen_prior_is_given_in_points_beside_the_default(chosen):
    text = parts_of(chosen, FARGO)[1]
    assert f"{FARGO.points(chosen.prior_sd):.3g} points" in text
    assert "default of 100 points" in text
    assert f"{chosen.choice.as_it_went:.4f}" in text


def test_two_matches_choose_no_prior():
    results = Results.from_names(
        ["A", "A"], ["B", "B"], [7, 7], [5, 0], date=["2024-09-03", "2024-09-04"]
    )
    assert "too few results to choose a prior" in parts_of(validate(results))[1]


def test_a_given_prior_has_no_cost(demo):
    assert "The prior was given" in parts_of(demo)[1]


def test_few_matches_have_no_slope(play_season):
    scored = parts_of(validate(play_season(6, matches=60), prior_sd=0.01))[0][0]
    assert [row[-1] for row in scored.rows] == [None] * 4


def test_newcomers_are_counted(demo):
    assert f"In {int(demo.forecasts.new.sum())} matches" in parts_of(demo)[1]


def test_how_even_handicaps_make_the_matches_is_what_the_season_shows(demo, play_season):
    even = tuple(row._replace(predicted=0.54) for row in demo.matches)
    text = parts_of(replace(demo, matches=even))[1]
    assert "One player gave games in 89% of the matches" in text
    assert "favourite 54% on average: nearly even" in text
    season = play_season(5, skills=1.0)
    few = np.arange(len(season)) < 20
    some = replace(season, race_b=np.where(few, season.race_b, season.race_a))
    handicapped = replace(some, race_a=np.where(few, 9, some.race_a))
    wins = np.where(few & (season.score_a > season.score_b), 9, season.score_a)
    text = parts_of(validate(replace(handicapped, score_a=wins), prior_sd=1.0))[1]
    assert "One player gave games in 2.2% of the matches" in text
    assert "nearly even" not in text


def test_two_factors_of_the_races_are_not_taken_for_one(demo):
    """What is taken before any result and what all results show are said apart, in one unit."""
    known = replace(demo, forecasts=replace(demo.forecasts, levels=Levels(race=1.88)))
    text = parts_of(known)[1]
    assert f"The {demo.starts.share.value:.2f} is what all results show" in text
    assert "The 1.88 that is taken before any result" in text
