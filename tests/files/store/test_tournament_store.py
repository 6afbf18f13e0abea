"""The file of an evening: nothing acknowledged is lost, and two programs can write to it."""

import os
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from evenbreak.errors import DataError, InputError
from evenbreak.files.store.tournament import (
    add_events,
    new_tournament,
    read_events,
    read_tournament,
)
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.fold import evening

AT = "2025-03-01T19:30:00"

WRITER = """
import sys
from evenbreak.files.store.tournament import add_events
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event
path, name = sys.argv[1:]
for k in range({many}):
    entrant = Entrant(f"{{name}} {{k}}", 500.0)
    add_events(path, lambda state: [Event("2025-03-01T19:30:00", moves.late(state, entrant))])
    print(entrant.name, flush=True)
"""


@pytest.fixture
def tonight(tmp_path: Path) -> Path:
    file = tmp_path / "tonight.db"
    entrants = tuple(Entrant(f"P{k}", 500.0) for k in range(4))
    new_tournament(file, [Event(AT, Opened(Plan("single", 5), entrants))])
    return file


def writer(file: Path, name: str, many: int) -> subprocess.Popen[str]:
    code = WRITER.format(many=many)
    command = [sys.executable, "-c", code, str(file), name]
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ})


def test_what_was_written_is_read(tonight: Path) -> None:
    rng = np.random.default_rng(1)
    before, after = add_events(tonight, lambda state: [Event(AT, moves.draw(state, rng))])
    assert not before.drawn
    assert read_tournament(tonight).order == after.order == ("P0", "P1", "P2", "P3")
    assert evening(read_events(tonight)).lines == after.lines


def test_a_refused_move_leaves_the_file_as_it_was(tonight: Path) -> None:
    with pytest.raises(InputError, match="draw"):
        add_events(tonight, lambda state: [Event(AT, moves.result(state, "F", (5, 0)))])
    assert len(read_events(tonight)) == 1


@pytest.mark.slow
def test_two_programs_lose_nothing(tonight: Path) -> None:
    many = 25
    both = [writer(tonight, name, many) for name in ("Ann", "Bo")]
    assert [process.communicate(timeout=60)[0].count("\n") for process in both] == [many, many]
    entrants = list(read_tournament(tonight).entrants)
    assert len(entrants) == len(set(entrants)) == 4 + 2 * many
    for name in ("Ann", "Bo"):
        assert [one for one in entrants if one.startswith(name)] == [
            f"{name} {k}" for k in range(many)
        ]


@pytest.mark.slow
@pytest.mark.parametrize("wait", [0.0, 0.05, 0.13])
def test_what_was_acknowledged_survives_a_kill(tonight: Path, wait: float) -> None:
    with writer(tonight, "Ann", 200) as process:
        assert process.stdout is not None
        first = process.stdout.readline()
        time.sleep(wait)
        process.kill()
        acknowledged = [first.strip(), *process.stdout.read().split("\n")]
    assert set(filter(None, acknowledged)) <= set(read_tournament(tonight).entrants)
    add_events(tonight, lambda state: [Event(AT, moves.late(state, Entrant("Bo", 500.0)))])
    assert list(read_tournament(tonight).entrants)[-1] == "Bo"


def test_a_file_that_is_there_is_not_overwritten(tonight: Path) -> None:
    opened = read_events(tonight)
    with pytest.raises(DataError, match=r"tonight\.db already exists\. Give the new"):
        new_tournament(tonight, opened)


def test_other_files_are_refused(tmp_path: Path) -> None:
    with pytest.raises(DataError, match=r"none\.db doesn't exist"):
        read_tournament(tmp_path / "none.db")
    text = tmp_path / "e.csv"
    text.write_text("player\nAnn\n", encoding="utf-8")
    base = tmp_path / "other.db"
    other = sqlite3.connect(base)
    other.execute("CREATE TABLE event (number INTEGER)")
    other.commit()
    other.close()
    for file in (text, base):
        with pytest.raises(DataError, match=f"{file.name} isn't a tournament file"):
            read_tournament(file)
