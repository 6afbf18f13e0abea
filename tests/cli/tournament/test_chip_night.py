"""A chip night on the command line, from the draw to the prizes."""

import csv
import json

import pytest

from evenbreak.files.store.tournament import read_events

ENTRANTS = "player,rating\nAnn,720\nBo,705\nCy,660\nDi,655\nEd,\n"


@pytest.fixture
def night(run, tmp_path):
    file, entrants = str(tmp_path / "tonight.db"), tmp_path / "entrants.csv"
    entrants.write_text(ENTRANTS)

    def ask(name, *words, fails=0):
        result = run("tournament", name, *words, "--file", file, "--json")
        assert result.exit_code == fails, result.stderr
        return result.stderr if fails else json.loads(result.stdout)

    def new(*words):
        return run("tournament", "new", str(entrants), *words, "--out", file, "--text")

    ask.new, ask.file, ask.entrants, ask.folder = new, file, str(entrants), tmp_path
    return ask


@pytest.fixture
def begun(night):
    words = ("--format", "chips", "--chips", "pharaohs", "--tables", "2", "--starter-sd", "0")
    shown = night.new(*words, "--starter", "700", "--seeding", "listed", "--at", "18:50")
    assert shown.exit_code == 0, shown.stderr
    night("draw", "--at", "19:00")
    return night


def line(answer):
    rows = [row for row in answer["players"] if row["in_line"]]
    return [row["name"] for row in sorted(rows, key=lambda row: row["in_line"])]


def chips(answer):
    return {row["name"]: row["chips"] for row in answer["players"]}


@pytest.mark.slow
def test_a_whole_chip_night(begun, run):
    assert chips(begun("show")) == {"Ann": 2, "Bo": 2, "Cy": 3, "Di": 3, "Ed": 2}
    assert begun("odds")["exact"] is False
    after = begun("result", "1", "bo", "--at", "19:08")
    assert line(after) == ["Ann"]
    assert after["next"][0] | {"state": ""} == {
        "table": 1,
        "match": "R3",
        "player_a": "Bo",
        "player_b": "Ed",
        "state": "",
    }
    begun("correct", "1", "ann", "--at", "19:09", fails=2)  # R3 is in play
    fixed = begun("correct", "1", "ann", "--at", "19:09", "--yes")
    assert (line(fixed), chips(fixed)["Bo"], chips(fixed)["Ann"]) == (["Bo"], 1, 2)
    times = begun("time", "--at", "19:09")
    assert times["finish_p10"] < times["finish_p50"] < times["finish_p90"]
    assert begun("time", "--tables", "1", "--at", "19:09")["finish_p50"] > times["finish_p50"]
    late = begun("late", "Flo", "--rating", "560", "--at", "19:10")
    assert (line(late), chips(late)["Flo"]) == (["Bo", "Flo"], 4)
    gone = begun("drop", "Di", "--at", "19:11", "--yes")
    assert (gone["next"][1]["player_b"], line(gone)) == ("Bo", ["Flo"])
    assert line(begun("undo", "--at", "19:12", "--yes")) == ["Bo", "Flo"]
    begun("drop", "Di", "--at", "19:13", "--yes")
    begun("forfeit", "Bo", "--at", "19:14")
    answer, exact = begun("next", "--at", "19:15"), []
    while answer.get("next"):
        odds = begun("odds")
        exact.append((odds["exact"], sum(row["p_title"] > 0 for row in odds["players"])))
        one = answer["next"][0]
        answer = begun("result", one["match"], one["player_a"])
    assert {left for is_exact, left in exact if is_exact} >= {2, 3}
    assert [row["place"] for row in answer["players"]] == [1, 2, 3, 4, 5, 6]
    assert answer["players"][-1]["name"] == "Di"
    paid = {row["name"]: row for row in begun("prizes", "--fee", "20")["players"]}
    assert paid[answer["players"][0]["name"]]["prize_mean"] == pytest.approx(84.0)
    _comes_back(begun, run)


def _comes_back(begun, run):
    """Events make the same tournament again; matches can be rated."""
    events, again = begun.folder / "events.csv", str(begun.folder / "again.db")
    begun("export", "--events", "--out", str(events))
    assert run("tournament", "import", str(events), "--out", again).exit_code == 0
    assert read_events(again) == read_events(begun.file)
    out = begun.folder / "racks.csv"
    begun("export", "--out", str(out))
    rows = list(csv.DictReader(out.read_text().splitlines()))
    assert {row["race_a"] for row in rows if row["score_a"]} == {"1"}
    rated = run("rate", str(out), "--json")
    assert rated.exit_code == 0, rated.stderr
    assert {"Ann", "Flo"} <= {row["player"] for row in json.loads(rated.stdout)["players"]}


def test_a_wrong_winner_long_ago_sets_racks_aside(night):
    chart = night.folder / "one each.csv"
    chart.write_text("rating_from,chips\n,1\n")
    words = ("--format", "chips", "--chips", str(chart), "--tables", "2", "--seeding", "listed")
    night.new(*words)
    night("draw")
    for table, winner in ("1", "Ann"), ("2", "Cy"), ("2", "Ed"), ("2", "Ann"):
        answer = night("result", table, winner)
    assert [row["name"] for row in answer["players"]] == ["Ann", "Ed", "Cy", "Di", "Bo"]
    night("correct", "R1", "Bo", fails=2)
    wrong = night("correct", "R1", "Bo", "--yes")
    assert [one["match"] for one in wrong["set_aside"]] == ["R4"]
    assert {row["name"] for row in wrong["players"] if row["p_title"]} == {"Bo", "Ed"}
    assert not night("undo", "--yes")["set_aside"]


def test_what_a_chip_night_has_not_is_refused_in_one_line(begun):
    for words, said in (
        (("result", "1", "Cy"), "Cy isn't in rack 1"),
        (("result", "7", "Ann"), "'7'"),
        (("correct", "R1", "Ann"), "no result"),
        (("call",), "tournament next"),
        (("score", "R1", "0:0"), "no score"),
        (("stand", "R1"), "stand"),
        (("show", "--out", "x.html"), "--out"),
        (("print", "bracket"), "bracket"),
        (("change", "--race", "3"), "tables"),
        (("late", "ann"), "already entered"),
    ):
        assert said in begun(*words, fails=2)


def test_wrong_options_are_one_line(night, run):
    for words, said in (
        (("--format", "chips", "--tables", "2"), "--chips"),
        (
            ("--format", "chips", "--chips", "pharaohs", "--race", "5", "--tables", "2"),
            "Leave out --race",
        ),
        (("--format", "single", "--chips", "pharaohs", "--race", "5", "--tables", "2"), "--chips"),
    ):
        shown = night.new(*words)
        assert (shown.exit_code, said in shown.stderr) == (2, True)
    chips = ("--format", "chips", "--chips", "pharaohs")
    assert "chips odds" in run("tournament", "odds", night.entrants, *chips).stderr
