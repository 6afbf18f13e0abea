"""The committed roster and schedule of a season are what their script makes."""

import subprocess
import sys
from collections import Counter

from places import DATA


def test_script_makes_the_committed_bytes(tmp_path):
    script = DATA / "make_demo_season.py"
    subprocess.run([sys.executable, str(script), str(tmp_path)], check=True)
    for name in ("demo_league_roster.csv", "demo_schedule.csv"):
        assert (tmp_path / name).read_bytes() == (DATA / name).read_bytes()


def test_everybody_meets_everybody_once():
    lines = (DATA / "demo_schedule.csv").read_text(encoding="utf-8").splitlines()[1:]
    met = Counter(frozenset(line.split(",")[1:]) for line in lines)
    assert len(met) == 16 * 15 // 2
    assert set(met.values()) == {1}
