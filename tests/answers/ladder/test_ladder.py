"""What a ladder says in words, in numbers and in files."""

import pytest

from evenbreak.answers.ladder.ladder import LadderFindings, LadderQuestion, ladder_answer, of_100
from evenbreak.handicaps import Ladder


def asked(ladder, start=-30, within=5, *, newcomer=False, opponents="natural"):
    return ladder_answer(LadderFindings(ladder, LadderQuestion(start, within, newcomer, opponents)))


@pytest.fixture(scope="module")
def npl():
    return asked(Ladder("npl"))


def test_the_first_sentence_has_the_numbers_of_the_json(npl):
    found = npl.to_dict()
    assert f"within {found['off_by_quantiles']['0.9']} points" in npl.sentences[0]
    assert of_100(found["off_by_more"]["5"]) in npl.sentences[0]
    assert f"{100 * found['unfairness']['favorite_mean']:.1f}%" in npl.sentences[1]
    assert f"{found['settling']['mean']:.1f} matches" in npl.sentences[2]


def test_statistics_are_details(npl):
    assert not any("spectral" in text or "variation" in text for text in npl.sentences)
    assert f"{100 * npl.to_dict()['gap']:.2f}%" in npl.to_dict()["details"][0]


def test_files_have_a_row_for_each_error(npl):
    frame = npl.to_frame()
    assert list(frame) == ["error", "probability", "cumulative", "p_win"]
    assert frame["cumulative"].iloc[-1] == pytest.approx(1.0)
    assert npl.to_dict()["distribution"][60] == frame.iloc[60].to_dict()


def test_form_and_drift_are_in_the_heading():
    answer = asked(Ladder("npl", day_sd=5.0, match_sd=2.0, drift=-0.1), 25, newcomer=True)
    for number in (
        "5 points",
        "2 points",
        "10% chance that the player's skill falls by one point: 0.1 points",
    ):
        assert number in answer.heading
    assert "too high on average" in answer.sentences[0]
    assert "25 points too high" in answer.sentences[2]


def test_an_error_within_the_band_is_settled_from_the_start():
    assert asked(Ladder("npl"), 3).sentences[2].startswith("A rating off by 3 points")


def test_what_inflates_is_said():
    answer = asked(Ladder("step 2 1"))
    assert answer.to_dict()["inflation"] == pytest.approx(1.0)
    assert len(answer.sentences) == len(asked(Ladder("step 2")).sentences) + 1


def test_how_often_in_words():
    assert [of_100(p) for p in (0.0, 0.5, 0.1, 0.01, 0.999)] == [
        *("none", "50%", "10%", "1 in 100", "nearly all")
    ]
