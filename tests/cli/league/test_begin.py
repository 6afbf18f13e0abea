"""A season that begins where the last one ended, from the command line."""

import csv
import json

import numpy as np
import pytest
from scipy.special import expit

from places import DATA


@pytest.fixture(scope="module")
def seasons(tmp_path_factory):
    """The demo league cut in two by date, its games drawn anew without form of the day.

    Where there is form, more matches establish it sooner, and then errors allow for it.
    """
    folder = tmp_path_factory.mktemp("seasons")
    with (DATA / "demo_league.csv").open(encoding="utf-8") as lines:
        header, *rows = csv.reader(lines)
    _draw_scores(header, rows)
    date = header.index("date")
    rows.sort(key=lambda row: row[date])
    cut = [row[date] for row in rows].index(rows[200][date])
    paths = []
    for name, part in (("last.csv", rows[:cut]), ("this.csv", rows[cut:])):
        paths.append(folder / name)
        with paths[-1].open("w", encoding="utf-8", newline="") as out:
            csv.writer(out).writerows([header, *part])
    return paths


def _draw_scores(header, rows):
    columns = ["player_a", "player_b", "race_a", "race_b", "score_a", "score_b"]
    at = [header.index(name) for name in columns]
    drawn = np.random.default_rng(1)
    strength = {name: drawn.normal(0.0, 0.5) for row in rows for name in (row[at[0]], row[at[1]])}
    for row in rows:
        first, second, *numbers = (row[k] for k in at)
        if not all(numbers) or numbers[2:] == ["0", "0"]:
            continue
        needs, won = [int(race) for race in numbers[:2]], [0, 0]
        while won[0] < needs[0] and won[1] < needs[1]:
            won[int(drawn.random() > expit(strength[first] - strength[second]))] += 1
        row[at[4]], row[at[5]] = map(str, won)


def rated(run, *words):
    result = run("rate", *map(str, words), "--json", "--prior", "30")
    assert result.exit_code == 0, result.stderr
    return {row["player"]: row for row in json.loads(result.stdout)["players"]}


def test_a_season_begins_where_the_last_one_ended(run, seasons, tmp_path):
    last, this = seasons
    saved = tmp_path / "ratings.csv"
    rated(run, last, "--save", saved)
    begun, joint, alone = (
        rated(run, *words) for words in ((this, "--begin", saved), (last, this), (this,))
    )
    assert begun.keys() == joint.keys()
    off = max(abs(begun[name]["rating"] - joint[name]["rating"]) for name in joint)
    assert off < 1.5 < max(abs(alone[name]["rating"] - joint[name]["rating"]) for name in joint)
    for name in joint:
        assert begun[name]["quasi_error"] == pytest.approx(joint[name]["quasi_error"], rel=0.05)


def test_those_who_did_not_play_stay_in_the_file(run, seasons, tmp_path):
    last, _ = seasons
    old, new = tmp_path / "old.csv", tmp_path / "new.csv"
    old.write_text("player,rating,standard_error,scale\nNobody Here,95,12,npl\n", encoding="utf-8")
    with (last).open(encoding="utf-8") as lines:
        name = next(iter(csv.DictReader(lines)))["player_a"]
    with old.open("a", encoding="utf-8") as out:
        out.write(f"{name},90,10,npl\n")
    rated(run, last, "--begin", old, "--save", new)
    with new.open(encoding="utf-8") as lines:
        rows = {row["player"]: row for row in csv.DictReader(lines)}
    assert float(rows["Nobody Here"]["standard_error"]) == pytest.approx(12.0)
    assert len(rows) == 25


def test_results_that_the_ratings_know_are_refused(run, seasons, tmp_path):
    saved = tmp_path / "ratings.csv"
    rated(run, seasons[0], "--save", saved)
    again = run("rate", str(seasons[0]), "--begin", str(saved))
    assert again.exit_code == 2
    assert "count twice" in again.stderr


def test_matches_in_two_files_are_named(run, seasons, tmp_path):
    both = tmp_path / "both.csv"
    both.write_text(seasons[0].read_text() + seasons[1].read_text().split("\n", 1)[1])
    result = run("rate", str(seasons[0]), str(both), "--prior", "30", "--text")
    assert "also in an earlier file" in result.stderr


@pytest.mark.slow_after(3)
@pytest.mark.parametrize(
    ("content", "what"),
    [
        ("player,rating\nNobody,90\n", "none of its players"),
        ("player,rating\nInes Valbrecht,ninety\n", "begin.csv:2"),
        ("player,rating,as_of\nInes Valbrecht,90,soon\n", "begin.csv:2"),
        ("player,rating,prior\nInes Valbrecht,90,-3\n", "begin.csv:2"),
        ("player,rating,scale\nInes Valbrecht,600,fargo\n", "--scale fargo"),
        ("player,level\nInes Valbrecht,6\n", "skill levels"),
        ("player,rating\nInes Valbrecht,\n", "none of its players has a rating"),
    ],
)
def test_what_cannot_be_begun_from_is_refused(run, seasons, tmp_path, content, what):
    bad = tmp_path / "begin.csv"
    bad.write_text(content, encoding="utf-8")
    result = run("rate", str(seasons[1]), "--begin", str(bad))
    assert result.exit_code in (2, 3)
    assert what in result.stderr
    assert result.stdout == ""
