"""`evenbreak league tidy`: what it writes, what it lists, and what it asks."""

import json

import numpy as np
import pytest

from evenbreak.answers.league.tidy import results_frame
from evenbreak.cli.league import tidy as tidy_module
from evenbreak.files import read_results, to_csv

A = """Datum;Heim;Gast;Ergebnis
3.9.2024;Big Al Peterson;Bo Diaz;5:3
3.9.2024;Lisa Müller;Cy Ng;2:5
10.9.2024;Cy Ng;spielfrei;
10.9.2024;Cy Ng;Bo Diaz;x
"""
B = """date,player_a,player_b,score_a,score_b,race_a,race_b
2024-09-03,Bo Diaz,Big Al Peterson,3,5,5,5
2024-09-17,\"\"\"Big Al\"\" Peterson\",Lisa Mueller-Stone,5,1,5,5
2024-09-10,Cy Ng,Bo Diaz,4,5,6,5
"""
TOML = '[[results]]\nfile = "a.csv"\n[[results]]\nfile = "b.csv"\n'


@pytest.fixture
def office(tmp_path, monkeypatch):
    for name, text in (("a.csv", A), ("b.csv", B), ("league.toml", TOML)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_same_list_is_written_from_the_leagues_file_and_from_files_that_are_named(office, run):
    asked = json.loads(run("league", "tidy", "--json").stdout)
    first = (office / "tidy.csv").read_bytes()
    run("league", "tidy", "a.csv", "b.csv", "--out", "again.csv")
    assert (office / "again.csv").read_bytes() == first
    assert [one["kind"] for one in asked["changes"]] == ["left out", "left out", "double"]
    assert asked["changes"][1]["text"].startswith("score 'x' isn't a score")
    assert len(asked["name_doubts"]) == 2
    merged = read_results(office / "tidy.csv").results
    assert len(merged) == 4
    assert merged.race_a.tolist() == [5, 0, 6, 5]


def test_on_a_terminal_it_asks_and_prints_the_lines_that_answer(office, run, monkeypatch):
    monkeypatch.setattr(tidy_module, "can_ask", lambda: True)
    asked = json.loads(run("league", "tidy", "--json", stdin="y\nn\n").stdout)
    lines = [one["line"] for one in asked["answers"]]
    assert len(lines) == 2
    assert lines[0] == r'"\"Big Al\" Peterson" = "Big Al Peterson"'
    assert len(read_results(office / "tidy.csv").results.players) == 5
    (office / "league.toml").write_text("\n".join([TOML, "[aliases]", *lines]), encoding="utf-8")
    monkeypatch.setattr(tidy_module, "can_ask", lambda: False)
    before = (office / "tidy.csv").read_bytes()
    again = json.loads(run("league", "tidy", "--json").stdout)
    assert not again.get("name_doubts")
    assert (office / "tidy.csv").read_bytes() == before


def test_what_is_written_is_read_as_the_same_results(tmp_path):
    path = tmp_path / "r.csv"
    path.write_text(
        "date,event,player_a,player_b,score_a,score_b,race_a,race_b,winner,racks,forfeit,team_a,"
        "break_format,first_break,level_b\n"
        "2024-09-10,Cup,Ann,Bo,2,1,,,,aab,,Racks,alternate,a,5\n"
        "2024-09-03,,Bo,Cy,,,7,5,b,,,,,,\n"
        ",,Cy,Ann,,,,,,,yes,,winner,,\n"
        "2024-09-03,Cup,Ann,Cy,7,0,7,5,a,,w/o,,,b,\n",
        encoding="utf-8",
    )
    results = read_results(path).results
    path.write_bytes(to_csv(results_frame(results)))
    again = read_results(path).results
    order = np.argsort(results.date, kind="stable")
    assert results_frame(again).equals(results_frame(results))
    for name in ("score_a", "race_b", "winner", "racks", "forfeit", "unscored", "break_format"):
        assert getattr(again, name).tolist() == getattr(results, name)[order].tolist(), name


def test_nothing_is_written_over_the_files_that_the_league_names(office, run):
    before = (office / "a.csv").read_bytes()
    done = run("league", "tidy", "--out", "a.csv")
    assert done.exit_code == 2
    assert "would be overwritten" in done.stderr
    assert (office / "a.csv").read_bytes() == before


def test_a_leagues_file_of_another_name_is_the_one_that_is_read(office, run):
    (office / "spring.toml").write_text('[[results]]\nfile = "b.csv"\n')
    done = json.loads(run("league", "tidy", "--league", "spring.toml", "--json").stdout)
    assert [one["file"] for one in done["sources"]] == ["b.csv"]


def test_double_matches_of_two_files_are_one_line_and_each_in_the_details(office, run):
    (office / "c.csv").write_text(A.replace("x\n", "4:5\n"), encoding="utf-8")
    (office / "league.toml").write_text(TOML + '[[results]]\nfile = "c.csv"\n')
    every = json.loads(run("league", "tidy", "--json").stdout)["changes"]
    double = [one for one in every if one["kind"] == "double"]
    assert [one["file"] for one in double] == ["b.csv", "c.csv", "c.csv", "c.csv"]
    short, full = (run("league", "tidy", "--text", *more).stdout for more in ((), ("--verbose",)))
    assert "2 matches are in a.csv too" in " ".join(short.split())
    assert short.count("this match is also in") == 2
    assert full.count("this match is also in") == 2 + len(double)


def test_how_the_files_are_written_is_said_by_init_and_tidy_alone(tmp_path, run, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = ["Lee, Al", "Diaz, Bo", "Ng, Cy"]
    rows = [f'2024-09-0{k + 1},"{names[k % 3]}","{names[(k + 1) % 3]}",5,{k},R' for k in range(4)]
    head = "date,player_a,player_b,score_a,score_b,Referee"
    (tmp_path / "a.csv").write_text("\n".join([head, *rows]))
    notes = ("columns not used: 'Referee'", "with the last name first")
    for words, said in (
        (["league", "init", "--yes"], True),
        (["league", "tidy", "--out", "out.txt"], True),
        (["rate"], False),
        (["league", "table"], False),
        (["rate", "--json"], False),
        (["rate", "--verbose"], True),
        (["rate", "a.csv"], True),
    ):
        done = run(*words)
        assert done.exit_code == 0, done.stderr
        assert [note in done.stderr for note in notes] == [said, said], words
    (tmp_path / "a.csv").write_text("\n".join([head, *rows, rows[0]]))
    assert "Warning: a.csv:6: " in run("rate").stderr  # twice: it changes the answer
