"""One list of ratings that states form of the day: a match has one chance, whoever is asked."""

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.special import logit

from evenbreak.cli.program import program
from evenbreak.games import Race, Rack
from evenbreak.matches.form import chance_in_form, on_days
from evenbreak.matches.win import win_probability

FORM, RACE = 0.6, 7
LIST = "player,rating,match_form,scale\nAnn,600,{form},fargo\nBo,520,{form},fargo\n"


def asked(*words):
    """Return what a command says in JSON."""
    got = CliRunner().invoke(program, [*map(str, words), "--json"])
    assert got.exit_code == 0, got.output
    return json.loads(got.stdout)


def of_odds(file):
    return asked("odds", "Ann", "Bo", "--from", file, "--race", f"{RACE}:{RACE}")["p_win_a"]


def of_live(file):
    return asked("live", "Ann", "Bo", "--from", file, "--race", f"{RACE}:{RACE}")["now"]["p_win_a"]


def of_fair(file):
    races = asked("fair", "Ann", "Bo", "--from", file, "--games", "13..13", "--top", 99)["races"]
    (chance,) = (one["p_win_a"] for one in races if one["race_a"] == one["race_b"] == RACE)
    return chance


def of_matchups(file):
    chart = file.with_name("chart.csv")
    chart.write_text(
        f"difference_from,difference_to,stronger_needs,weaker_needs\n0,,{RACE},{RACE}\n"
    )
    (pair,) = asked("matchups", file, "--chart", chart)["pairs"]
    return pair["chart_p_win_a"]


def of_lineup(file):
    ours, theirs = one_each(file)
    said = asked("lineup", ours, theirs, "--race", RACE, "--sets", 1)
    return said["p_win"]


def of_round(file):
    ours, theirs = one_each(file)
    said = asked("round", ours, theirs, "--race", RACE)
    (row,) = (row for row in said["starts"] if row["start_1"] == 0)
    return row["p_win_1"]


def one_each(file):
    head, *rows = file.read_text().splitlines()
    files = [file.with_name(f"team {k}.csv") for k in range(2)]
    for path, row in zip(files, rows, strict=True):
        path.write_text(f"{head}\n{row}\n")
    return files


def of_tournament(file):
    return _ann(asked("tournament", "odds", file, "--format", "single", "--race", RACE))


def of_tournament_under_way(file):
    night = file.with_name(f"night {len(file.read_text())}.db")
    asked("tournament", "new", file, "--format", "single", "--race", RACE, "--out", night)
    asked("tournament", "draw", "--file", night)
    return _ann(asked("tournament", "odds", "--file", night))


def _ann(said):
    (chance,) = (row["p_title"] for row in said["players"] if row["name"] == "Ann")
    return chance


WAYS = [
    of_odds, of_live, of_fair, of_matchups, of_lineup, of_round,
    of_tournament, of_tournament_under_way,
]  # fmt: skip


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "list.csv"
    path.write_text(LIST.format(form=FORM))
    return path


@pytest.mark.parametrize("way", WAYS)
def test_a_match_has_one_chance_in_every_command(way, file):
    p = 1.0 / (1.0 + 2.0**-0.8)
    days, weights = on_days(Race(RACE, RACE, Rack(p)), FORM)
    known = float(win_probability(days) @ weights)
    assert way(file) == pytest.approx(known, abs=2e-6)
    file.write_text(LIST.format(form=""))
    plain = float(win_probability(Race(RACE, RACE, Rack(p))))
    assert plain > known + 0.01
    assert way(file) == pytest.approx(plain, abs=2e-6)


@pytest.mark.parametrize("score", [(0, 0), (4, 1), (6, 6)])
@pytest.mark.parametrize("needs", [(7, 7), (3, 9)])
def test_a_chance_by_the_curve_is_that_of_all_days(needs, score):
    score = tuple(min(has, need - 1) for has, need in zip(score, needs, strict=True))
    p = np.array([0.02, 0.3, 0.5, 0.77, 0.999])
    for form in (0.05, 0.5, 2.0):
        days, weights = on_days(Race(*needs, Rack(p), score=score), form)
        known = (win_probability(days) * weights).sum(-1)
        assert chance_in_form(needs, form, score)(logit(p)) == pytest.approx(known, abs=2e-6)


@pytest.mark.slow
@pytest.mark.parametrize("way", [of_lineup, of_tournament, of_tournament_under_way])
def test_errors_of_ratings_are_averaged_over_beside_it(way, file):
    head, *rows = LIST.format(form=FORM).splitlines()
    file.write_text("\n".join([f"{head},standard_error", *(f"{row},50" for row in rows)]))
    # A tournament draws the errors, and form around each of them.
    assert way(file) == pytest.approx(of_odds(file), abs=0.01)
