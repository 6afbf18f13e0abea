"""The demo's evening is the one that its script makes."""

import subprocess
import sys
from pathlib import Path

import pytest

from places import DATA


@pytest.mark.slow
def test_the_script_makes_the_file(tmp_path: Path) -> None:
    made = tmp_path / "made.csv"
    subprocess.run([sys.executable, str(DATA / "make_demo_evening.py"), str(made)], check=True)
    assert made.read_bytes() == (DATA / "demo_evening.csv").read_bytes()
