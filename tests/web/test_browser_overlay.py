"""What other screens read, in a real browser: a tap is on the overlay within a second, and a page
elsewhere shows the bracket."""

from __future__ import annotations

import re
import threading
import time
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest

from web.chromium import browser as browser
from web.conftest import PLAYERS, begun
from web.phones import Phone, running

pytestmark = pytest.mark.slow
PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "tonight-on-a-page.html"
SHOWN = (
    "() => [...document.querySelectorAll('.games, .odds')].map((one) => one.textContent).join(' ')"
)


def shown(page: Any, what: str, words: str, *, within: float) -> float:
    """Wait until a page shows something, and return the seconds that it took."""
    begin = time.monotonic()
    while words not in page.evaluate(what):
        assert time.monotonic() - begin < within, page.evaluate(what)
        page.wait_for_timeout(20)
    return time.monotonic() - begin


def test_a_tap_is_on_the_overlay_with_its_odds_within_a_second(
    browser: Any, tmp_path: Path
) -> None:
    with running(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        begun(director, PLAYERS)
        director.send("/desk/call", match="W1.1", table=4)
        page = browser.new_page(viewport={"width": 1920, "height": 1080})
        page.goto(f"{site.address}/overlay/4")
        clear = "() => getComputedStyle(document.documentElement).backgroundColor"
        assert page.evaluate(clear) == "rgba(0, 0, 0, 0)"
        odds = "() => document.querySelector('.odds').textContent.trim()"
        before = page.evaluate(odds)
        page.wait_for_timeout(500)  # the page follows, and its first odds are being worked out
        assert director.send("/desk/score", match="W1.1", a=0, b=2).status == 200
        assert shown(page, SHOWN, "0 2 ", within=5.0) < 1.0
        assert page.evaluate(odds) != before
        page.close()


def test_a_page_elsewhere_shows_tonights_bracket(browser: Any, tmp_path: Path) -> None:
    """By the ten lines of JavaScript in the documentation."""
    text = PAGE.read_text(encoding="utf-8")
    script = re.findall(r"<script>\n(.*?)</script>", text, re.DOTALL)[0]
    assert len(script.splitlines()) == 10

    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, *_: object) -> None:
            pass

    elsewhere = ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=str(tmp_path)))
    threading.Thread(target=elsewhere.serve_forever, daemon=True).start()
    origin = f"http://127.0.0.1:{elsewhere.server_port}"
    with running(tmp_path / "tonight.db", origins=frozenset({origin})) as site:
        address = re.findall(r'"(http.*?)/api', script)[0]
        (tmp_path / "page.html").write_text(text.replace(address, site.address), encoding="utf-8")
        director = Phone(site, director=True)
        begun(director, PLAYERS)
        page = browser.new_page()
        page.goto(f"{origin}/page.html")
        bracket = "() => document.querySelector('pre').textContent"
        shown(page, bracket, "1: Player 1  – Player 16 ", within=5.0)
        assert director.send("/desk/score", match="W1.1", a=2, b=1).status == 200
        shown(page, bracket, "1: Player 1 2 – Player 16 1", within=5.0)
        page.close()
    elsewhere.shutdown()
    elsewhere.server_close()
