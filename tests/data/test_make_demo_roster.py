"""The committed roster and pairs are what their script makes."""

import subprocess
import sys

from places import DATA


def test_script_makes_the_committed_bytes(tmp_path):
    script = DATA / "make_demo_roster.py"
    subprocess.run([sys.executable, str(script), str(tmp_path)], check=True)
    for name in ("demo_roster.csv", "demo_pairs.csv"):
        assert (tmp_path / name).read_bytes() == (DATA / name).read_bytes()
