"""The committed practice scores are what their script makes."""

import subprocess
import sys

from places import DATA


def test_script_makes_the_committed_bytes(tmp_path):
    script = DATA / "make_practice.py"
    subprocess.run([sys.executable, str(script), str(tmp_path)], check=True)
    for name in ("practice_scores.csv", "practice_scores_after.csv", "practice_shots.csv"):
        assert (tmp_path / name).read_bytes() == (DATA / name).read_bytes()
