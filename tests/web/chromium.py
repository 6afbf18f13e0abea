"""A real browser for the page's tests, or the reason why there is none."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from typing import Any

import pytest

from evenbreak.web.site import Site

CHROMIUM = os.environ.get("EVENBREAK_CHROMIUM") or shutil.which("chromium")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    sync_api = pytest.importorskip(
        "playwright.sync_api", reason="no playwright; pip install -e '.[browser]'"
    )
    if CHROMIUM is None:
        pytest.skip(
            "no Chromium; install it by the system's package manager (apt install chromium), or "
            "name it in EVENBREAK_CHROMIUM"
        )
    with sync_api.sync_playwright() as play:
        started = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield started
        started.close()


def claimed(page: Any, site: Site, name: str) -> None:
    """Let a page scan a player's code, and say that its phone is theirs."""
    page.goto(f"{site.address}/c/{site.player_code(name)}")
    page.click("main form .btn.loud")
    page.wait_for_url(f"{site.address}/me")


def opened(browser: Any, site: Site, *, width: int = 390, **asked: Any) -> Any:
    """Return a page of a browser in which the director's PIN has been entered."""
    context = browser.new_context(viewport={"width": width, "height": 844}, **asked)
    page = context.new_page()
    page.goto(f"{site.address}/pin")
    page.fill("input[name=pin]", site.pin)
    page.keyboard.press("Enter")
    page.wait_for_url(lambda url: not url.endswith("/pin"))
    return page
