"""From the files that an office exports to every answer, each in one command after `league init`.

What is answered is compared with numbers that are counted here from the same files.
"""

import csv
import re
from collections import defaultdict
from itertools import combinations
from pathlib import Path

import pytest

from offices import TEAMS, apa_office, apa_race, fairest, fargo_office

pytestmark = pytest.mark.slow


@pytest.fixture
def rows(run):
    """Run a command and return its rows."""

    def ask(*words):
        result = run(*words, "--csv")
        assert result.exit_code == 0, result.stderr
        return list(csv.DictReader(result.stdout.splitlines()))

    return ask


@pytest.fixture
def text(run):
    def ask(*words):
        result = run(*words, "--text")
        assert result.exit_code == 0, result.stderr
        return " ".join(result.stdout.split())

    return ask


@pytest.fixture
def apa(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    sets = apa_office(tmp_path)
    proposed = run("league", "init", "--yes")
    assert proposed.exit_code == 0, proposed.stderr
    return sets, proposed.stdout


@pytest.fixture
def fargo(run, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    played = fargo_office(tmp_path)
    proposed = run("league", "init", "--yes")
    assert proposed.exit_code == 0, proposed.stderr
    return played, proposed.stdout


def commands(proposed):
    """Return the words of each command that is proposed."""
    lines = re.findall(r"  evenbreak (.+)", proposed)
    return [re.findall(r'"[^"]+"|\S+', line) for line in lines]


@pytest.mark.parametrize("office", [apa_office, fargo_office])
def test_all_that_init_proposes_runs(run, tmp_path, monkeypatch, office):
    monkeypatch.chdir(tmp_path)
    office(tmp_path)
    proposed = commands(run("league", "init", "--yes").stdout)
    names = {words[0] for words in proposed}
    assert names >= {"matchups", "league", "publish", "validate", "sandbag", "simulate"}
    for words in proposed:
        words = [word.strip('"') for word in words]
        words += ["--replicas", "4", "--weeks", "6"] if words[0] == "simulate" else []
        result = run(*words)
        assert result.exit_code == 0, f"{words}: {result.stderr}"


def _rows_of(path):
    return list(csv.DictReader(Path(path).read_text(encoding="utf-8").splitlines()))


def turned(name):
    family, _, given = name.partition(", ")
    return f"{given} {family}"


def test_an_apa_office_gets_table_races_line_up_and_verdicts(apa, rows, text, tmp_path):
    sets, _ = apa
    points, won = defaultdict(int), defaultdict(int)
    tonight = {row["Player"]: int(row["SL"]) for row in _rows_of("roster.csv")}
    gave = [0, 0]
    for team, _, level, wins, other_team, _, other_level, other_wins in sets:
        m, n = apa_race(level, other_level)
        first = wins == m
        for own, scored, needs, is_won, opposed in (
            (team, wins, m, first, other_wins), (other_team, other_wins, n, not first, wins),
        ):  # fmt: skip
            won[own] += is_won
            points[own] += 2 + (opposed == 0) if is_won else int(scored == needs - 1)
        if m != n:
            gave[0] += 1
            gave[1] += first == (m > n)
    table = rows("league", "table")
    assert {row["team"]: int(row["points"]) for row in table} == points
    assert {row["team"]: int(row["sets_won"]) for row in table} == won
    races = rows("matchups")
    assert len(races) == 2 * 6 * 6  # week 9, which is still to be played: two matches of teams
    for row in races:
        pair = [tonight[_listed(row[side], tonight)] for side in ("player_a", "player_b")]
        assert (int(row["chart_race_a"]), int(row["chart_race_b"])) == apa_race(*pair)
    level_of = {turned(name): level for name, level in tonight.items()}
    ours = [turned(r["Player"]) for r in _rows_of("roster.csv") if r["Team"] == TEAMS[0]]
    for cap, absent in (("23", ours[0]), ("20", "")):
        away = ("--absent", absent) if absent else ()
        offered = {row["name"] for row in rows("lineup", *TEAMS[:2], "--cap", cap, *away)}
        legal = [
            five
            for five in combinations([name for name in ours if name != absent], 5)
            if sum(map(level_of.get, five)) <= int(cap)
            and sum(level_of[one] >= 6 for one in five) <= 2
        ]
        assert offered == {name for five in legal for name in five}
    verdict = text("validate")
    assert f"won {gave[1]} of {gave[0]} matches" in verdict
    assert "Between average players of two levels" in text("chart", "audit")
    watched = {row["player"]: row for row in rows("sandbag", "watch")}
    matches = defaultdict(int)
    for one in sets:
        matches[turned(one[1])] += 1
        matches[turned(one[5])] += 1
    assert {name: int(row["matches"]) for name, row in watched.items()} == matches
    text("publish")
    assert (tmp_path / "site" / "index.html").stat().st_size < 60_000
    published = _rows_of("site/data/teams.csv")
    assert {row["name"]: float(row["points"]) for row in published} == points
    compared = text("simulate", "--compare", "level review, fargo-like, none", "--replicas", "4")
    assert all(name in compared for name in ("level-review", "fargo-like", "none"))


@pytest.mark.usefixtures("apa")
def test_a_sheet_typed_from_paper_gives_the_same_table(run, rows, tmp_path, monkeypatch):
    wanted = rows("league", "table")
    lines = ["Date,Match,Team,Player,SL,GTW,Innings,Defensive Shots,Wins"]
    for row in csv.reader(Path("scores fall.csv").read_text().splitlines()[1:]):
        races = apa_race(int(row[4]), int(row[8]))
        for k, race in ((2, races[0]), (6, races[1])):
            number = row[:2] if k == 2 else ["", ""]  # written once, above both
            cells = [
                *number,
                row[k],
                f'"{row[k + 1]}"',
                row[k + 2],
                str(race),
                *row[10:],
                row[k + 3],
            ]
            lines.append(",".join(cells))
    place = tmp_path / "paper"
    place.mkdir()
    (place / "sheets.csv").write_text("\n".join(lines))
    (place / "roster.csv").write_text(Path("roster.csv").read_text())
    monkeypatch.chdir(place)
    assert run("league", "init", "--yes").exit_code == 0
    assert rows("league", "table") == wanted


def _listed(name, listed):
    return next(one for one in listed if turned(one) == name)


def test_a_fargo_office_gets_table_races_and_verdicts(fargo, rows, text, tmp_path):
    played, _ = fargo
    tidied = text("league", "tidy")
    assert "Left out: 8 duplicate matches" in tidied
    assert "1 forfeit" in tidied
    assert len(_rows_of("tidy.csv")) == len(played) + 1
    games = defaultdict(lambda: [0, 0])
    for one, a, other, b in played:
        for name, own, opposed in ((one, a, b), (other, b, a)):
            games[name][0] += own
            games[name][1] += opposed
    table = rows("league", "table")
    assert {r["player"]: [int(r["games_won"]), int(r["games_lost"])] for r in table} == games
    rating = {
        f"{row['firstName']} {row['lastName']}": int(row["effectiveRating"])
        for row in _rows_of("players.csv")
    }
    new = {
        f"{row['firstName']} {row['lastName']}"
        for row in _rows_of("players.csv")
        if row["rating"] == "0"
    }
    for row in rows("matchups"):
        pair = row["player_a"], row["player_b"]
        difference = abs(rating[pair[0]] - rating[pair[1]])
        if new.isdisjoint(pair) and difference > 0:  # otherwise the chance allows for the error
            assert float(row["difference"]) == rating[pair[0]] - rating[pair[1]]
            assert float(row["p_game_a_plug_in"]) == pytest.approx(
                1 / (1 + 2 ** (-float(row["difference"]) / 100)), abs=1e-6
            )
            race = int(row["race_a"]), int(row["race_b"])
            assert max(race) == 7
            by_hand = fairest(rating[pair[0]], rating[pair[1]], 7)
            assert abs(min(race) - min(by_hand)) <= 1
    assert "of their" not in tidied
    assert "handicaps" in text("validate")
    assert len(rows("sandbag", "watch")) == 16
    text("publish")
    assert (tmp_path / "site" / "index.html").is_file()
    compared = text("simulate", "--compare", "fargo-like, npl, none", "--replicas", "4")
    assert "fargo-like" in compared.partition("A system is fairer")[0]


def test_a_fargo_captain_gets_a_line_up_from_the_list_of_teams(run, tmp_path, monkeypatch, rows):
    monkeypatch.chdir(tmp_path)
    fargo_office(tmp_path, teams=True)
    proposed = run("league", "init", "--yes").stdout
    (line_up,) = [words for words in commands(proposed) if words[0] == "lineup"]
    ours, theirs = (word.strip('"') for word in line_up[1:3])
    assert {ours, theirs} <= {*TEAMS}
    assert len(rows("lineup", ours, theirs)) == 4
