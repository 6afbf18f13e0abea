"""The statistics of a validated season: every figure where a person looks for it."""

from evenbreak.answers.kit.parts import Table
from evenbreak.answers.league.validate_findings import details
from evenbreak.answers.league.validate_handicaps import scored_of
from evenbreak.ratings import Results, scale_of, validate

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
    tests = parts_of(demo)[0][1]
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


def test_starts_have_a_row_a_size(demo):
    _, _, spots, starts, experience = parts_of(demo)[0]
    assert [row[0] for row in experience.rows] == ["1 to 20", "21 to 50", "51 to 200"]
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
