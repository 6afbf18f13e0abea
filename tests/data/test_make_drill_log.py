"""The committed drill log is what its script makes, and is a log that could have been."""

import csv
import subprocess
import sys
from pathlib import Path

import pytest

from evenbreak.files.practice import read_drill_log
from places import DATA


def test_script_makes_the_committed_bytes(tmp_path: Path) -> None:
    made = tmp_path / "again.csv"
    subprocess.run([sys.executable, str(DATA / "make_drill_log.py"), str(made)], check=True)
    assert made.read_bytes() == (DATA / "drill_log.csv").read_bytes()


def test_every_evening_begins_at_level_1_and_keeps_to_the_rule() -> None:
    with (DATA / "drill_log.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    level = {}
    for row in rows:
        assert int(row["level"]) == level.get(row["date"], 1)
        step = 1 if row["success"] == "yes" else -1
        level[row["date"]] = min(max(int(row["level"]) + step, 1), 9)
    assert len(level) == 12


def test_it_is_read_without_a_warning_and_has_all_nine_levels() -> None:
    file = read_drill_log(DATA / "drill_log.csv")
    assert (file.warnings, file.log.sessions, file.log.levels) == ((), 12, 9)
    assert (file.log.attempts > 0).all()


def test_the_weak_level_is_seen() -> None:
    log = read_drill_log(DATA / "drill_log.csv").log
    fraction = log.successes / log.attempts
    assert fraction[4] < fraction[5]
    assert fraction[4] == pytest.approx(0.3, abs=0.1)
