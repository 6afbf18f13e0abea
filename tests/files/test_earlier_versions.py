"""Every file that an earlier version wrote opens, and holds what it held then."""

import json
import shutil
from pathlib import Path

import pytest

from earlier_files import held
from tournament_nights import SAVED

VERSIONS = sorted(SAVED.glob("v*"))


@pytest.fixture(params=VERSIONS, ids=lambda folder: folder.name)
def earlier(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """Return a copy of the files of an earlier version."""
    return Path(shutil.copytree(request.param, tmp_path / "earlier"))


def test_the_files_of_earlier_versions_hold_what_they_held(earlier: Path) -> None:
    assert held(earlier) == json.loads((earlier / "states.json").read_text(encoding="utf-8"))
