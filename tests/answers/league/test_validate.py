"""Whether ratings can be trusted, as an answer."""

import pytest

from evenbreak.answers.faces.to_text import to_text
from evenbreak.answers.league.validate import validate_answer, verdict
from evenbreak.files.results.results_file import ResultsFile, read_results
from evenbreak.ratings import scale_of
from places import DATA

NPL = scale_of("npl")


@pytest.fixture(scope="module")
def demo_answer(demo):
    return validate_answer(read_results(DATA / "demo_league.csv"), demo, NPL, seed=1)


def test_the_verdict_comes_first(demo_answer, demo):
    assert demo_answer.sentences[0] == verdict(demo, NPL)
    assert demo_answer.to_dict()["verdict"] == verdict(demo, NPL)


def test_the_answer_fits_a_screen_and_statistics_are_details(demo_answer):
    shown = to_text(demo_answer)
    assert shown.count("\n") <= 40
    for word in ("log-loss", "Brier", "slope", "plug-in", "spread of scores"):
        assert word not in shown
        assert word in to_text(demo_answer, verbose=True)


def test_the_table_shows_each_bin_of_games(demo_answer, demo):
    rows = list(demo_answer.parts[1].rows)
    assert [row[1] for row in rows] == [one.games for one in demo.games]


def test_handicaps_are_judged_by_who_gave_games(demo_answer, demo):
    (text,) = [one for one in demo_answer.sentences if one.startswith("The handicaps")]
    every = demo.spots[-1]
    assert f"{every.won} of {every.matches}" in text
    assert "under" in text


def test_json_holds_everything(demo_answer, demo):
    data = demo_answer.to_dict()
    assert (data["matches_read"], data["dates"], data["forfeits"], data["empty"]) == (
        395,
        34,
        11,
        2,
    )
    assert data["prior_points"] == pytest.approx(NPL.points(demo.prior_sd))
    assert data["scored"][0]["log_loss"]["value"] == demo.scored[0].log_loss.value
    assert data["skill"] == demo.skill._asdict()
    assert [one["spot"] for one in data["spots"]] == [1, 2, 3, 4, 5, None]
    assert (data["streaks"], data["seed"]) == (None, 1)


def test_the_prior_is_named_only_where_the_default_is_wrong(chosen, alike):
    file = ResultsFile(chosen.forecasts.results, "r.csv", (), (), "")
    assert not any("prior" in text for text in validate_answer(file, chosen, NPL).sentences)
    sentences = validate_answer(file, alike, NPL).sentences
    assert "prior" in sentences[0]
    assert not any("prior" in text for text in sentences[1:])
