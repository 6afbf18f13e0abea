"""A change of the file of an evening is on the disk as a whole, or leaves no trace."""

import sqlite3
from pathlib import Path

import pytest

from evenbreak.files.store.evening_file import begin, changing, opened


@pytest.fixture
def file(tmp_path: Path) -> Path:
    place = tmp_path / "tonight.db"
    begin(place, lambda base: base.execute("CREATE TABLE event (number INTEGER PRIMARY KEY)"))
    return place


def numbers(file: Path) -> list[int]:
    with opened(file) as base:
        return [number for (number,) in base.execute("SELECT number FROM event")]


def test_a_change_is_kept(file: Path) -> None:
    with changing(file) as base:
        base.execute("INSERT INTO event VALUES (1)")
        assert numbers(file) == []
    assert numbers(file) == [1]


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt, sqlite3.OperationalError])
def test_of_a_change_that_fails_halfway_nothing_is_kept(
    file: Path, error: type[BaseException]
) -> None:
    def half() -> None:
        with changing(file) as base:
            base.execute("INSERT INTO event VALUES (1)")
            raise error

    with pytest.raises((error, ValueError)):
        half()
    assert numbers(file) == []
    with changing(file) as base:
        base.execute("INSERT INTO event VALUES (2)")
    assert numbers(file) == [2]


def test_what_was_acknowledged_has_been_forced_to_the_disk(file: Path) -> None:
    full = 2
    with changing(file) as base:
        assert base.execute("PRAGMA synchronous").fetchone() == (full,)
        assert base.execute("PRAGMA journal_mode").fetchone() == ("wal",)
