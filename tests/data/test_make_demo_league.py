"""The committed demo league is what its script makes, and is a league that could have been."""

import csv
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

from places import DATA


@pytest.fixture(scope="module")
def rows() -> list[dict[str, str]]:
    with (DATA / "demo_league.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_script_makes_the_committed_bytes(tmp_path: Path) -> None:
    made = tmp_path / "again.csv"
    subprocess.run([sys.executable, str(DATA / "make_demo_league.py"), str(made)], check=True)
    assert made.read_bytes() == (DATA / "demo_league.csv").read_bytes()


def test_every_played_match_ends_when_one_player_reaches_the_race(
    rows: list[dict[str, str]],
) -> None:
    for row in rows:
        scores = int(row["score_a"]), int(row["score_b"])
        reached = scores[0] == int(row["race_a"]), scores[1] == int(row["race_b"])
        assert sum(reached) == (scores != (0, 0)), row


def test_nobody_plays_twice_on_a_night_and_everybody_plays(rows: list[dict[str, str]]) -> None:
    nights: dict[str, Counter[str]] = {}
    for row in rows:
        nights.setdefault(row["date"], Counter()).update((row["player_a"], row["player_b"]))
    assert len(nights) == 34
    assert all(len(names) == 24 and set(names.values()) == {1} for names in nights.values())


def test_some_matches_were_not_played(rows: list[dict[str, str]]) -> None:
    assert 3 <= sum(row["forfeit"] == "yes" for row in rows) <= 15
    assert sum((row["score_a"], row["score_b"]) == ("0", "0") for row in rows) == 2
