"""Public names load late, and mean the same whatever was imported before."""

import subprocess
import sys

import pytest

import evenbreak
from evenbreak import reports


@pytest.mark.parametrize("first", ["evenbreak.reports.draw", "evenbreak.reports"])
def test_a_function_wins_over_the_module_of_its_name(first: str) -> None:
    code = f"import {first}\nfrom evenbreak.reports import draw\nprint(callable(draw))"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout == "True\n"


def test_unknown_names_are_refused_by_name() -> None:
    with pytest.raises(AttributeError, match=r"'evenbreak\.reports' has no attribute 'nothing'"):
        reports.nothing  # noqa: B018


def test_dir_lists_the_public_names() -> None:
    assert "Race" in dir(evenbreak)
    assert dir(evenbreak) == sorted(evenbreak.__all__)
