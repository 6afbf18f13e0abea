"""A player's evening in a real browser: one scan, a page that changes by itself, taps that last."""

from __future__ import annotations

from typing import Any

import pytest

from evenbreak.tournaments.evening.fold import Evening
from web.chromium import claimed
from web.conftest import PLAYERS, Hall, begun
from web.phones import Phone, running

pytestmark = pytest.mark.thorough


def phone(browser: Any, hall: Hall, name: str, **asked: Any) -> Any:
    """Return a phone that has scanned a player's code, and what it asks for."""
    page = browser.new_context(viewport={"width": 390, "height": 844}, **asked).new_page()
    claimed(page, hall.site, name)
    return page


def score(state: Evening, match: str) -> tuple[int, int]:
    return state.live[match].what.score if match in state.live else (0, 0)


def all_sent(page: Any) -> None:
    """Wait until nothing is kept for later."""
    for _ in range(50):
        if page.evaluate("() => localStorage.getItem('evenbreak taps')") == "[]":
            return
        page.wait_for_timeout(100)
    raise AssertionError(page.inner_text("main"))


def test_one_scan_lasts_from_the_first_call_to_the_next_match(browser: Any, hall: Hall) -> None:
    one, other = hall.state.pair("W1.1")
    page = phone(browser, hall, one)
    opened: list[str] = []
    page.on("request", lambda asked: asked.is_navigation_request() and opened.append(asked.url))
    assert other in page.inner_text("main")
    hall.director.send("/desk/call", match="W1.1", table=4)
    page.wait_for_selector(".up .up-table", timeout=5000)
    assert page.inner_text(".up-table") == "4"
    assert page.title().startswith("▶")
    page.get_by_role("button", name="I'm coming").click()
    rival = Phone(hall.site, address="127.0.0.9")
    rival.claims(other)
    for _ in range(3):
        page.locator(".half.is-mine").click()
        page.wait_for_timeout(650)
    page.wait_for_selector(".sent")
    assert rival.taps("W1.1", 3, 0).status == 200
    page.wait_for_selector('[data-step="waits"]', timeout=5000)
    assert "Quarterfinals" in page.inner_text("main")
    assert opened == []  # it was the same page all along
    page.context.close()


def test_a_hidden_phone_shows_what_is_so_when_it_returns(browser: Any, hall: Hall) -> None:
    one, _ = hall.state.pair("W1.1")
    page = phone(browser, hall, one)
    page.context.set_offline(True)
    hall.director.send("/desk/call", match="W1.1", table=4)
    page.wait_for_timeout(500)
    page.context.set_offline(False)
    page.evaluate("document.dispatchEvent(new Event('visibilitychange'))")
    page.wait_for_selector(".up-table", timeout=2000)
    page.context.close()


def test_taps_without_a_connection_are_shown_kept_and_sent_once(browser: Any, hall: Hall) -> None:
    one, _ = hall.state.pair("W1.1")
    page = phone(browser, hall, one)
    page.goto(f"{hall.site.address}/me?play=1")
    page.wait_for_timeout(500)
    page.context.set_offline(True)
    for half, wanted in (
        (".half.is-mine", "1"),
        (".half:not(.is-mine)", "1"),
        (".half.is-mine", "2"),
    ):
        page.locator(half).click()
        assert page.locator(half).locator(".half-score").inner_text() == wanted
        page.wait_for_timeout(650)
    page.wait_for_selector("#lost:not([hidden])", timeout=9000)
    assert "Taps are kept" in page.inner_text("#lost")
    assert score(hall.state, "W1.1") == (0, 0)
    before = len(hall.state.events)
    page.context.set_offline(False)
    page.wait_for_selector("#lost", state="hidden", timeout=9000)
    all_sent(page)
    assert sorted(score(hall.state, "W1.1")) == [1, 2]
    assert len(hall.state.events) == before + 3
    page.context.close()


def test_taps_outlast_a_restart_of_the_page_s_computer(browser: Any, tmp_path: Any) -> None:
    path = tmp_path / "tonight.db"
    with running(path) as site:
        director = Phone(site, director=True)
        begun(director, PLAYERS)
        hall = Hall(site, director, director)
        one, _ = hall.state.pair("W1.1")
        page = phone(browser, hall, one)
        page.goto(f"{site.address}/me?play=1")
        port = int(site.address.rpartition(":")[2])
    page.locator(".half.is-mine").click()
    page.wait_for_selector("#lost:not([hidden])", timeout=9000)
    with running(path, port=port):
        page.wait_for_selector("#lost", state="hidden", timeout=9000)
        all_sent(page)
        assert max(score(hall.state, "W1.1")) == 1
        page.wait_for_selector('[data-step="playing"]')
    page.context.close()
