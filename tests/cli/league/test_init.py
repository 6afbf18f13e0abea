"""`evenbreak league init`: the league's file is written, asked for, and never written over."""

import shutil

import pytest

from evenbreak.cli.league import init
from evenbreak.cli.program import program
from evenbreak.files.league.league_file import read_league
from places import DATA


@pytest.fixture
def folder(tmp_path, monkeypatch):
    for name in ("demo_league.csv", "demo_roster.csv", "demo_aliases.csv"):
        shutil.copy(DATA / name, tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_in_a_script_the_proposals_are_taken(run, folder):
    result = run("league", "init", "--tables", "6")
    assert (result.exit_code, result.stderr) == (0, "")
    league = read_league(folder)
    assert (league.scale.name, league.chart, league.tables) == ("npl", "npl_10", 6)
    for line in ("evenbreak matchups", "evenbreak league table", "evenbreak rate"):
        assert line in result.stdout


@pytest.mark.slow
def test_what_it_says_to_run_runs_in_the_folder_and_pointed_at_it(run, folder, monkeypatch):
    run("league", "init")
    here = [run("matchups", "--json"), run("league", "table", "--json"), run("rate", "--json")]
    assert [one.exit_code for one in here] == [0, 0, 0]
    monkeypatch.chdir(folder.parent)
    there = run("rate", "--league", folder.name, "--json")
    assert there.exit_code == 0
    assert there.stdout.count("\n") == here[2].stdout.count("\n")


def test_a_file_that_is_there_is_not_written_over(run, folder):
    (folder / "league.toml").write_text("tables = 3\n")
    for words in ([], ["--yes"]):
        result = run("league", "init", *words)
        assert result.exit_code == 2
        assert "league.toml already exists. Edit it, or remove it first" in result.stderr
    assert read_league(folder).tables == 3


def test_what_cannot_be_is_refused_and_nothing_is_written(run, folder):
    result = run("league", "init", "--chart", "npl_99")
    assert result.exit_code == 3
    assert "no chart or file with this name" in result.stderr
    assert not (folder / "league.toml").exists()
    assert run("league", "init", "nowhere").exit_code == 2


def test_on_a_terminal_it_asks_and_asks_again(folder, monkeypatch):
    from click.testing import CliRunner

    monkeypatch.setattr(init, "can_ask", lambda: True)
    answers = ["Thursday", "10 ball", "10-ball", "fargo", "9", "none", "4", ""]
    result = CliRunner().invoke(program, ["league", "init"], input="\n".join(answers))
    assert result.exit_code == 0
    league = read_league(folder)
    assert (league.name, league.discipline, league.scale.name) == ("Thursday", "10-ball", "fargo")
    assert (league.race_to, league.chart, league.tables) == (9, None, 4)
    assert "demo_league.csv: 408 matches among 24 players" in result.stderr
    (folder / "league.toml").write_text("tables = 3\n")
    kept = CliRunner().invoke(program, ["league", "init"], input="n\n")
    assert kept.exit_code != 0
    assert read_league(folder).tables == 3
