"""What begins a tournament writes a whole file or none, however it ends."""

import csv
import io
import json
import os
import random
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from evenbreak.cli.program import program
from evenbreak.files.store.tournament import read_events, read_tournament
from files.mutants import VALUES
from places import ROOT
from tournament_nights import SAVED

KILLS = int(os.environ.get("EVENBREAK_KILLS", "1"))
CUPS = ("double12", "single8", "rr5")
ENTRANTS = ROOT / "data" / "demo_entrants.csv"


def run(*words: object) -> Any:
    return CliRunner().invoke(program, ["tournament", *map(str, words)])


def leaves(data: Any) -> list[tuple[Any, Any]]:
    """Return each place of a value in some data: its container and its key."""
    keys = data.items() if isinstance(data, dict) else enumerate(data)
    found = []
    for key, value in keys:
        found += leaves(value) if isinstance(value, dict | list) else [(data, key)]
    return found


def test_a_number_that_cannot_be_true_is_refused_with_its_place(tmp_path: Path) -> None:
    data = json.loads((SAVED / "brackets_manager_single8.json").read_text())
    data["match"][0]["opponent1"]["score"] = 10**30
    cup, out = tmp_path / "cup.json", tmp_path / "tonight.db"
    cup.write_text(json.dumps(data))
    said = run("import", cup, "--race", 5, "--out", out)
    assert said.exit_code == 3
    assert "cup.json: match 1 has score 1000000" in said.stderr
    data["match"][0]["opponent1"]["score"] = 10_001
    cup.write_text(json.dumps(data))
    said = run("import", cup, "--race", 5, "--out", out)
    assert said.exit_code == 3
    assert "cup.json: W1.1: score 1 must be a whole number up to 10000; it is 1" in said.stderr
    assert [one.name for one in tmp_path.iterdir()] == ["cup.json"]


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("seed", range(6))
def test_an_import_writes_a_tournament_that_can_be_shown_or_nothing(
    seed: int, tmp_path: Path
) -> None:
    luck = random.Random(seed)
    data = json.loads((SAVED / f"brackets_manager_{luck.choice(CUPS)}.json").read_text())
    for _ in range(luck.choice((1, 1, 3))):
        where, key = luck.choice(leaves(data))
        where[key] = luck.choice(VALUES)
    cup, out = tmp_path / "cup.json", tmp_path / "tonight.db"
    cup.write_text(json.dumps(data))
    said = run("import", cup, "--race", 5, "--out", out)
    assert isinstance(said.exception, SystemExit | None), f"{seed}: {said.exception!r}"
    if said.exit_code:
        assert said.stderr.startswith("Error: ")
        assert [one.name for one in tmp_path.iterdir()] == ["cup.json"]
    else:
        assert run("show", "--file", out).exit_code == 0


def test_a_list_of_events_is_refused_with_line_and_field(tmp_path: Path) -> None:
    cup, out = SAVED / "brackets_manager_single8.json", tmp_path / "tonight.db"
    assert run("import", cup, "--race", 5, "--out", out).exit_code == 0
    rows = list(csv.reader(io.StringIO(run("export", "--events", "--file", out).stdout)))
    what = json.loads(rows[3][3])
    rows[3][3] = json.dumps({**what, "score": [10**30, 2]})
    events, second = tmp_path / "events.csv", tmp_path / "second.db"
    with events.open("w", newline="") as file:
        csv.writer(file).writerows(rows)
    said = run("import", events, "--out", second)
    assert (said.exit_code, second.exists()) == (3, False)
    assert (
        "events.csv:4: isn't a tournament's event: score 1 must be a whole number up to 10000; "
        "it is 1000000"
    ) in said.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", [("new", ENTRANTS, "--race", 5, "--tables", 3), ("import", "cup", "--race", 5)]
)
def test_a_kill_leaves_no_half_file(words: tuple[Any, ...], tmp_path: Path) -> None:
    cup = SAVED / "brackets_manager_single8.json"
    asked = [str(cup if word == "cup" else word) for word in words]
    out, luck = tmp_path / "tonight.db", random.Random(3)
    code = f"""
import sys
from evenbreak.files.store import evening_file
whole = evening_file._placed
def late(part, place):
    print("whole", flush=True)
    return whole(part, place)
evening_file._placed = late
from evenbreak.cli.program import program
program(["tournament", *{asked!r}, "--out", {str(out)!r}])
"""
    for _ in range(KILLS):
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        assert process.stdout is not None
        assert process.stdout.readline() == "whole\n"
        time.sleep(luck.uniform(0.0, 0.01))
        process.kill()
        process.communicate()
        if out.exists():
            assert read_events(out)
            out.unlink()
    assert run(*asked, "--out", out).exit_code == 0
    assert read_tournament(out).entrants


@pytest.mark.parametrize("name", ["tonight.sqlite", "tonight.db"])
def test_a_database_is_not_taken_for_a_list(tmp_path: Path, name: str) -> None:
    saved = tmp_path / name
    shutil.copyfile(SAVED / "v0_2_0" / "tournament.db", saved)
    said = run("import", saved, "--out", tmp_path / "new.db")
    assert said.exit_code == 2
    assert (
        f"{saved} is already a tournament's database. Continue it with --file {saved}"
        in said.stderr
    )
