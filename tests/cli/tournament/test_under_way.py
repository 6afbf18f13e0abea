"""`evenbreak tournament odds` and `time` about the tournament under way, and what settles it."""

import csv
import json

import pytest

from evenbreak.files.store.tournament import read_events
from places import ROOT

SAVED = ROOT / "tests" / "files" / "saved"
ENTRANTS = "player,rating,scale\nAnn,640,fargo\nBo,600,fargo\nCy,,fargo\nDi,520,fargo\n"


@pytest.fixture
def night(run, tmp_path):
    file = str(tmp_path / "tonight.db")

    def ask(name, *words):
        result = run("tournament", name, *map(str, words), "--file", file, "--json")
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    (tmp_path / "entrants.csv").write_text(ENTRANTS)
    ask.file, ask.run, ask.entrants = file, run, str(tmp_path / "entrants.csv")
    return ask


@pytest.fixture
def begun(night):
    words = ("--race", "3", "--tables", "2", "--starter-sd", "20", "--at", "18:50")
    result = night.run("tournament", "new", night.entrants, *words, "--out", night.file, "--text")
    assert "1 player without a rating (Cy): assumed to be 500 ± 20." in result.stdout
    night("draw", "--at", "19:00")
    return night


@pytest.mark.slow
def test_odds_and_time_follow_the_results(begun):
    before = {one["name"]: one["p_title"] for one in begun("odds")["players"]}
    assert sum(before.values()) == pytest.approx(1.0)
    scored = begun("score", "W1.1", "1:2", "--at", "19:20")
    assert scored["next"][0]["score_b"] in (2, None)
    paid = begun("odds", "--prizes", "100")
    for row in paid["at_stake"]:
        assert row["prize_at_stake"] == pytest.approx(100.0 * row["title_at_stake"])
    live = {one["name"]: one["p_title"] for one in paid["players"]}
    assert live["Ann"] < before["Ann"]
    after = begun("result", "W1.1", "3:2", "--at", "19:30")
    odds = begun("odds")
    for one in after["odds"]:
        listed = next(row for row in odds["players"] if row["name"] == one["name"])
        assert listed["p_title"] == pytest.approx(one["p_title"])
        assert listed["p_title_if_sure"] == pytest.approx(one["p_title_if_sure"])
    assert {row["match"] for row in odds["at_stake"]} == {2}
    times = begun("time", "--at", "19:30")
    assert times["finish_p50"] == pytest.approx(after["finish_p50"])
    moved = {row["change"]: row["minutes_later"] for row in times["what_if"]}
    assert moved["races_one_shorter"] < 0.0 < moved["one_table_fewer"]
    assert begun("time", "--tables", "1", "--at", "19:30")["finish_p50"] > times["finish_p50"]


def test_the_odds_of_ratings_taken_as_right(begun):
    averaged = {one["name"]: one for one in begun("odds")["players"]}
    sure = begun("odds", "--sure")
    assert not sure["ratings_averaged"]
    for one in sure["players"]:
        assert one["p_title"] == pytest.approx(averaged[one["name"]]["p_title_if_sure"])
    coins = begun("odds", "--sure", "--walkovers", "1")["players"]
    assert [one["p_title"] for one in coins] == pytest.approx([0.25] * 4)


@pytest.mark.slow
def test_next_says_what_each_match_decides(begun):
    begun("score", "W1.1", "1:2", "--at", "19:20")
    stakes = {row["match"]: row for row in begun("odds", "--prizes", "60,40")["at_stake"]}
    rows = begun("next", "--prizes", "60,40")["next"]
    assert len(rows) == len(stakes) == 2
    for row in rows:
        for key in ("title_at_stake", "prize_at_stake"):
            assert row[key] == pytest.approx(stakes[row["match"]][key])
    assert min(row["minutes_later"] for row in rows) == 0.0
    assert "title_at_stake" not in begun("undo")["next"][0]


@pytest.mark.slow
def test_a_match_stands_and_results_count_again(begun):
    for match, score in (("W1.1", "3:0"), ("W1.2", "3:0"), ("W2.1", "3:1")):
        begun("result", match, score)
    asked = begun.run("tournament", "correct", "W1.1", "0:3", "--file", begun.file)
    assert asked.exit_code == 2
    assert (
        "Ann beat Bo 3-1 (match 3) would no longer count. If that's what you want, add --yes"
        in asked.stderr
    )
    wrong = begun("correct", "W1.1", "0:3", "--yes")
    assert [one["match"] for one in wrong["set_aside"]] == [3]
    shown = begun.run("tournament", "stand", "W2.1", "--file", begun.file, "--text").stdout
    assert "Restored" in shown
    assert not begun("next")["set_aside"]
    undone = begun.run("tournament", "undo", "--file", begun.file, "--text", "--yes")
    assert "Reopened: match 3" in undone.stdout


def test_ties_of_a_round_robin(night):
    words = ("--format", "round-robin", "--race", "3", "--tables", "2", "--starter-sd", "0")
    night.run("tournament", "new", night.entrants, *words, "--out", night.file)
    answer = night("draw")
    beats = {("Ann", "Bo"), ("Bo", "Cy"), ("Cy", "Ann")}
    while answer.get("next"):
        one = answer["next"][0]
        first = (one["player_a"], one["player_b"]) in beats or one["player_b"] == "Di"
        answer = night("result", one["match"], "3:0" if first else "0:3")
    settled = night("tiebreak", "--seed", "1")
    assert sorted(one["place"] for one in settled["places"]) == ["1", "2", "3", "4"]


def test_export_writes_a_file_and_a_chart_says_the_races(night, tmp_path):
    words = ("--chart", "npl_10", "--format", "single", "--tables", "2", "--starter-sd", "0")
    result = night.run("tournament", "new", night.entrants, *words, "--out", night.file)
    assert result.exit_code == 0
    first = night("draw")["next"][0]
    assert (first["race_a"], first["race_b"]) == (7, 2)
    night("result", first["match"], "7:1")
    night("score", night("next")["next"][0]["match"], "1:0")
    night("undo")
    events, again = tmp_path / "events.csv", str(tmp_path / "again.db")
    night("export", "--events", "--out", str(events))
    night.run("tournament", "import", str(events), "--out", again)
    assert read_events(again) == read_events(night.file)
    out = tmp_path / "matches.csv"
    night("export", "--out", str(out))
    (row,) = csv.DictReader(out.read_text().splitlines())
    assert (row["race_a"], row["score_b"], row["winner"]) == ("7", "1", "Ann")


def test_bad_entries_are_one_line(begun):
    for words, said in (
        (["odds", "--race", "5"], "--race"),
        (["odds", begun.entrants, "--race", "5"], "--file"),
        (["time", "--discipline", "9-ball"], "--discipline"),
        (["score", "W1.1", "3:0"], "result 1 3-0"),
        (["stand", "W1.1"], "match 1"),
        (["tiebreak"], "tie"),
        (["change"], "--tables"),
        (["odds", "--fairest"], "--fairest"),
        (["forfeit", "Cy", "W1.1"], "match 1"),
    ):
        result = begun.run("tournament", *words, "--file", begun.file)
        assert result.exit_code == 2, words
        assert said in result.stderr.splitlines()[-1]


def test_without_entrants_or_a_tournament(run, tmp_path):
    result = run("tournament", "odds", "--file", str(tmp_path / "none.db"))
    assert result.exit_code == 2
    assert "none.db" in result.stderr


def test_a_tournament_of_another_program_goes_on(night, tmp_path):
    saved = SAVED / "brackets_manager_single8.json"
    listed = tmp_path / "ratings.csv"
    listed.write_text("player,rating,scale\nPlayer 2,640,fargo\nPlayer 6,520,fargo\n")
    words = (str(saved), "--ratings", str(listed), "--race", "5", "--tables", "2")
    result = night.run("tournament", "import", *words, "--out", night.file, "--text")
    assert "Imported 8 players and 5 results." in result.stdout
    assert "6 players without a rating" in result.stdout
    (one,) = night("next")["next"]
    assert {one["player_a"], one["player_b"]} == {"Player 2", "Player 6"}
    assert night("result", one["match"], "5:0")["next"]
    wrong = night.run("tournament", "import", str(listed), "--out", str(tmp_path / "b.db"))
    assert (wrong.exit_code, "ratings.csv" in wrong.stderr) == (3, True)


@pytest.mark.slow
def test_what_is_in_play_is_named_before_it_is_taken_away(begun):
    for match in ("W1.1", "W1.2"):
        begun("result", match, "3:0")
    begun("call", "W2.1", "--table", "2")
    begun("score", "W2.1", "2:1")
    wrong = ("tournament", "correct", "W1.1", "0:3", "--file", begun.file)
    for words, said in (
        (wrong, "Ann against Bo (match 3) would leave table 2 at 2-1. "),
        (("tournament", "drop", "ann", "--file", begun.file), "would end at 2-1. "),
    ):
        asked = begun.run(*words)
        assert asked.exit_code == 2
        assert f"{said}If that's what you want, add --yes" in asked.stderr
    entered = len(read_events(begun.file))
    assert begun.run(*wrong, "--yes").exit_code == 0
    begun("correct", "W1.1", "3:0")
    on = {one["match"]: one["table"] for one in begun("next")["next"]}
    assert on[3] == 2
    said = begun.run("tournament", "uncall", "W2.1", "--file", begun.file, "--text")
    assert "Taken off table 2: match 3; 2-1 is kept." in said.stdout
    assert begun.run("tournament", "uncall", "--file", begun.file).exit_code == 2
    said = begun.run("tournament", "undo", "--file", begun.file, "--text")
    assert "Undone: match 3 taken off its table." in said.stdout
    assert len(read_events(begun.file)) == entered + 4


def test_a_name_is_corrected_before_the_draw(night):
    words = ("--race", "3", "--tables", "2", "--seeding", "listed", "--out", night.file)
    assert night.run("tournament", "new", night.entrants, *words).exit_code == 0
    said = night.run("tournament", "edit", "ann", "--name", "Anne", "--file", night.file, "--text")
    assert "Anne has been entered with a rating of 640." in said.stdout
    night("edit", "Cy", "--rating", "580")
    assert night.run("tournament", "edit", "Cy", "--file", night.file).exit_code == 2
    night("draw")
    matches = night("show")["matches"]
    assert {"Anne", "Di"} == {matches[0]["player_a"], matches[0]["player_b"]}


def test_a_hint_names_the_file_that_the_command_was_given(tmp_path, run):
    players, file = tmp_path / "players.csv", str(tmp_path / "saturday.db")
    players.write_text("player\nAnn\nBo\nCy\n")
    new = run("tournament", "new", str(players), "--race", "5", "--out", file, "--text")
    assert f"evenbreak tournament draw --file {file}" in " ".join(new.stdout.split())
    for words in (("--file", file), (f"--file={file}",), (file,)):
        again = run("tournament", "draw", *words)
    assert f"evenbreak tournament undo --file {file}" in again.stderr


def test_another_event_is_played_on_the_same_tables(begun, tmp_path):
    more = tmp_path / "more.csv"
    more.write_text("player,rating\nEd,90\nFlo,80\nGus,70\nHal,60\n")
    new = ("tournament", "new", str(more), "--format", "single", "--race", "3", "--beside")
    said = begun.run(*new, "--out", begun.file, "--text")
    assert "This is event 2 of the night: use --event 2 with the other commands." in said.stdout
    first = begun("call", "1")["next"][0]
    begun("draw", "--event", "2")
    other = begun("call", "1", "--event", "2")["next"][0]
    assert first["table"] != other["table"]
    taken = begun.run(
        "tournament", "call", "2", "--table", str(other["table"]), "--file", begun.file
    )
    assert (taken.exit_code, "is taken by" in taken.stderr) == (2, True)
