"""What holds for all tests."""

import signal
from collections.abc import Mapping
from typing import NamedTuple

import pytest
from hypothesis import settings

# A slow machine is no failure, and a failure must come again on the next machine.
settings.register_profile("evenbreak", deadline=None, derandomize=True)
settings.load_profile("evenbreak")

# A shell's background jobs ignore Ctrl-C, and so would every program that a test starts.
signal.signal(signal.SIGINT, signal.default_int_handler)


class Reproduced(NamedTuple):
    """The files of the source text, and what was said while they were made."""

    files: Mapping[str, bytes]
    said: list[str]


@pytest.fixture(scope="session")
def reproduced() -> Reproduced:
    """The whole source text, computed and drawn once."""
    from evenbreak.source_text.reproduce import reproduction

    said: list[str] = []
    return Reproduced(reproduction(said.append), said)
