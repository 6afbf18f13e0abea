"""A whole evening of 16 players on the command line, from the draw to the final."""

import csv
import json
import shlex

import pytest

from evenbreak.files.store.tournament import read_tournament

NAMES = [f"Player {k:02d}" for k in range(1, 16)]


@pytest.fixture
def night(run, tmp_path):
    file = str(tmp_path / "tonight.db")

    def ask(name, *words):
        result = run("tournament", name, *map(str, words), "--file", file, "--json")
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    entrants = tmp_path / "entrants.csv"
    rows = [f"{name},{650 - 10 * k},fargo" for k, name in enumerate(NAMES)]
    entrants.write_text("\n".join(["player,rating,scale", *rows]))
    words = ["--race", "3", "--tables", "4", "--out", file, "--at", "19:00"]
    begun = run("tournament", "new", str(entrants), *words, "--json")
    assert begun.exit_code == 0, begun.stderr
    ask.file = file
    ask.run = run
    return ask


def play(night, answer, rounds):
    """Play what is called for, the first player winning, so many times; return the last answer."""
    for _ in range(rounds):
        for match in [one["match"] for one in answer["next"]]:
            answer = night("result", match, "3:1", "--at", "20:00")
    return answer


@pytest.mark.slow
def test_a_whole_evening(night):
    night("draw", "--at", "19:00")
    answer = night("late", "Zoe Late", "--rating", "480", "--at", "19:02")
    assert len(answer["odds"]) == 16
    assert sum(one["p_title"] for one in answer["odds"]) == pytest.approx(1.0)
    called = night("call", "--at", "19:05")
    assert sorted(one["table"] for one in called["next"] if one["table"]) == [1, 2, 3, 4]
    assert called["finish_p10"] < called["finish_p50"] < called["finish_p90"]
    answer = play(night, called, 3)
    wrong = night("correct", "W1.1", "1:3", "--at", "20:30", "--yes")
    number = read_tournament(night.file).number_of
    aside = {one["match"] for one in wrong["set_aside"]}
    assert aside >= {number("W2.1"), number("L1.1")}
    matches = {one["match"]: one for one in night("show")["matches"]}
    assert matches[number("W1.1")]["winner"] == "Zoe Late"
    assert matches[number("W2.1")]["winner"] is None
    assert not night("undo")["set_aside"]
    answer = night("correct", "W1.1", "1:3", "--at", "20:31", "--yes")
    while "places" not in answer:
        answer = play(night, answer, 1)
    places = [one["place"] for one in answer["places"]]
    assert places[:4] == ["1", "2", "3", "4"]
    assert len(places) == 16
    exported = night.run("tournament", "export", "--file", night.file, "--csv")
    rows = list(csv.DictReader(exported.stdout.splitlines()))
    assert len(rows) > 30
    assert {"player_a", "player_b", "score_a", "score_b", "race_a"} <= set(rows[0])


@pytest.mark.slow
def test_the_exported_matches_can_be_rated(night, tmp_path):
    play(night, night("draw"), 1)
    first = night("next")["next"][0]
    night("forfeit", first["player_a"])
    exported = night.run("tournament", "export", "--file", night.file, "--csv")
    matches = tmp_path / "matches.csv"
    matches.write_text(exported.stdout)
    rated = night.run("rate", str(matches), "--json")
    assert rated.exit_code == 0, rated.stderr


@pytest.mark.slow
def test_a_player_who_drops_out_forfeits(night):
    night("draw")
    night("drop", "player 02")
    matches = {one["match"]: one for one in night("show")["matches"]}
    assert matches[4]["winner"].endswith("(forfeit)")


@pytest.mark.slow_after(1)
@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (["result", "X1", "3:1"], 2, "X1"),
        (["result", "W1.2", "2:1"], 2, "2-1"),
        (["result", "W2.1", "3:1"], 2, "isn't ready"),
        (["correct", "W1.2", "3:1"], 2, "no result"),
        (["drop", "Nobody"], 2, "Nobody"),
        (["late", "player 01"], 2, "Player 01"),
        (["call", "--table", "2"], 2, "--table"),
        (["draw"], 2, "draw"),
    ],
)
def test_bad_entries_are_one_line(night, words, code, said):
    night("draw")
    result = night.run("tournament", *words, "--file", night.file)
    assert result.exit_code == code
    assert said in result.stderr.splitlines()[-1]


def test_the_file_must_be_a_tournament(night, tmp_path):
    result = night.run("tournament", "show", "--file", str(tmp_path / "entrants.csv"))
    assert result.exit_code == 3
    assert "entrants.csv" in result.stderr


@pytest.mark.slow
def test_the_commands_in_remedies_run_as_they_stand(night, tmp_path):
    night("draw")
    for wrong in (("correct", "W1.2", "3-1"), ("score", "W1.3", "3-1")):
        told = night.run("tournament", *wrong, "--file", night.file).stderr
        remedy = told.partition("evenbreak ")[2]
        assert night.run(*shlex.split(remedy)).exit_code == 0, told
    told = night.run("tournament", "show", "--file", str(tmp_path / "new.db")).stderr
    remedy = told.partition("evenbreak ")[2].replace("ENTRANTS.csv", str(tmp_path / "entrants.csv"))
    assert night.run(*shlex.split(remedy)).exit_code == 0, told
    both = night.run("tournament", "result", "W1.4", "3-1", "--winner", "Zed", "--file", night.file)
    assert "not both" in both.stderr


def test_moves_before_the_draw_are_refused(night):
    result = night.run("tournament", "result", "W1.1", "3:1", "--file", night.file)
    assert (result.exit_code, "draw hasn't been made" in result.stderr) == (2, True)


def test_the_file_may_be_named_without_its_option(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "entrants.csv").write_text("player,rating\nAnn,620\nBo,560\n")
    words = ["--scale", "fargo", "--race", "3", "--tables", "1", "--format", "single"]
    assert run("tournament", "new", "entrants.csv", "late.db", *words).exit_code == 0
    assert run("tournament", "draw", "--json", "late.db").exit_code == 0
    done = run("tournament", "result", "F", "3:1", "late.db")
    assert "wins the tournament" in done.stdout + done.stderr
    assert not (tmp_path / "tonight.db").exists()
