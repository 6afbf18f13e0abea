"""`evenbreak sandbag power`: how soon a sandbagger is flagged."""

import csv
import json

import pytest

FEW = ("sandbag", "power", "--replicas", "20", "--matches", "8")


@pytest.fixture
def power(run):
    def ask(*words):
        result = run(*FEW, *words)
        assert result.exit_code == 0, result.stderr
        return result.stdout

    return ask


def test_honest_players_stand_beside_the_kind_asked_for(power):
    answer = json.loads(power("--share", "0.9", "--json"))
    assert [kind["share"] for kind in answer["kinds"]] == [0.0, 0.9]
    assert [len(kind["flagged"]) for kind in answer["kinds"]] == [8, 8]
    assert (answer["chart"], answer["replicas"], answer["alpha"]) == ("npl_10", 20, 0.01)
    rows = list(csv.DictReader(power("--share", "0.9").splitlines()))
    assert [row["matches"] for row in rows] == ["2", "4", "6", "8"] * 2


def test_points_are_of_the_scale_of_the_system(power):
    kinds = json.loads(power("--system", "elo 16", "--json"))["kinds"]
    assert [kind["points"] for kind in kinds if kind["points"]] == [241, 120, 241, 482, 241]


def test_without_matches_in_earnest_there_is_no_share_won_of_them(power):
    kinds = json.loads(power("--share", "1", "--json"))["kinds"]
    assert [kind["p_win"] is None for kind in kinds] == [False, True]
    assert list(csv.DictReader(power("--share", "1").splitlines()))[-1]["p_win"] == ""
    assert "nan" not in power("--share", "1", "--text")


def test_a_share_of_nothing_is_honest_alone(power):
    assert len(json.loads(power("--share", "0", "--json"))["kinds"]) == 1


@pytest.mark.parametrize(
    ("words", "named"), [(("--points", "30"), "--share"), (("--share", "1.5"), "'1.5'")]
)
def test_what_is_wrong_is_refused_by_name(run, words, named):
    result = run("sandbag", "power", *words)
    assert (result.exit_code, result.stdout) == (2, "")
    assert named in result.stderr
