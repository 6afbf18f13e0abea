"""The files of the source text, made once."""

import os
import subprocess
import sys
from collections.abc import Mapping
from typing import NamedTuple

import pytest

from places import ROOT


class Reproduced(NamedTuple):
    """The files of the source text, and what was said while they were made."""

    files: Mapping[str, bytes]
    said: list[str]


@pytest.fixture(scope="session")
def reports(request: pytest.FixtureRequest) -> Mapping[str, bytes]:
    """The committed files of the source text, held by the check of drift to those made anew."""
    place = ROOT / "reports"
    if not (place / "index.md").exists():  # in a copy of the program without them
        made: Reproduced = request.getfixturevalue("reproduced")
        return made.files
    return {path.name: path.read_bytes() for path in place.iterdir() if path.is_file()}


@pytest.fixture(scope="session")
def reproduced(tmp_path_factory: pytest.TempPathFactory) -> Reproduced:
    """The whole source text, by the command, in another country and with another hash seed."""
    place = tmp_path_factory.mktemp("reproduced")
    environment = {**os.environ, "PYTHONHASHSEED": "7", "LC_ALL": "C", "TZ": "Asia/Tokyo"}
    command = [sys.executable, "-m", "evenbreak", "reproduce", "--out", "text"]
    done = subprocess.run(
        command, check=True, cwd=place, env=environment, capture_output=True, encoding="utf-8"
    )
    files = {path.name: path.read_bytes() for path in (place / "text").iterdir()}
    return Reproduced(files, done.stderr.splitlines())
