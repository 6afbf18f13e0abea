"""The tutorial's evening in a real browser: every tap leads on and every picture is made."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

import pytest

from places import ROOT
from web.chromium import browser as browser

pytestmark = pytest.mark.thorough

sys.path.insert(0, str(ROOT / "docs" / "images"))


@pytest.fixture(scope="module", autouse=True)
def few_evenings() -> None:
    """The pictures are those that the page draws of all evenings."""


def test_the_evening_goes_through_and_makes_its_pictures(browser: Any, tmp_path: Path) -> None:
    from page_pictures import Clock, served, story

    clock = Clock()
    with served(tmp_path / "tonight.db", clock) as site:
        story(browser, site, clock, tmp_path)
    text = (ROOT / "docs" / "tutorial" / "evening-by-page.md").read_text("utf-8")
    shown = set(re.findall(r"images/page/(\w+)\.png", text))
    kept = {file.stem for file in (ROOT / "docs" / "images" / "page").glob("*.png")}
    assert {file.stem for file in tmp_path.glob("*.png")} == shown == kept
