"""The desk in a real browser: it follows what happens, and leaves alone what is tapped or typed."""

from __future__ import annotations

from typing import Any

import pytest

from evenbreak.files.store.tournament import add_events
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Event
from web.chromium import opened
from web.conftest import Hall
from web.phones import Phone

pytestmark = pytest.mark.thorough

AT = "2025-03-01T20:00:00"


def score(hall: Hall, match: str, games: tuple[int, int]) -> None:
    """Enter a live score, as a phone does."""
    what = moves.score(hall.state, match, games)
    add_events(hall.site.path, lambda _: [Event(AT, what)], by="phone: x")


@pytest.fixture
def playing(hall: Hall) -> Hall:
    for table, name in enumerate(("W1.1", "W1.2", "W1.3"), 1):
        hall.director.send("/desk/call", match=name, table=table)
    return hall


@pytest.fixture
def desk(browser: Any, playing: Hall) -> Any:
    page = opened(browser, playing.site)
    page.goto(f"{playing.site.address}/desk")
    yield page
    page.context.close()


def card(page: Any, match: str) -> Any:
    return page.locator(f'section.table[data-key="{match}"]')


def pad(page: Any, match: str) -> Any:
    return card(page, match).locator(".pad .btn:visible")


def shows(page: Any, match: str, games: int) -> None:
    """Wait until the first player of a match on the desk has so many games."""
    page.wait_for_function(
        "([match, games]) => document.querySelector(`section.table[data-key='${match}'] .won`)"
        "?.innerText === games",
        arg=[match, str(games)],
        timeout=8000,
    )


def test_two_taps_enter_a_result_and_its_card_stays(desk: Any, playing: Hall) -> None:
    score(playing, "W1.1", (2, 1))
    shows(desk, "W1.1", 2)
    assert pad(desk, "W1.1").count() == 0
    card(desk, "W1.1").locator(".seat").first.click()
    assert pad(desk, "W1.1").all_inner_texts() == ["0", "1", "2"]
    loud = card(desk, "W1.1").locator(".pad .btn.loud:visible")
    assert loud.inner_text() == "1"  # as the phones have it
    loud.click()
    desk.wait_for_selector(".entered")
    said = desk.inner_text(".entered > .what")
    assert "beat Player 16 3-1" in said
    score(playing, "W1.2", (2, 0))
    shows(desk, "W1.2", 2)
    desk.wait_for_timeout(2500)
    assert desk.inner_text(".entered > .what") == said
    desk.reload()
    assert desk.inner_text(".entered > .what") == said
    desk.get_by_role("button", name="OK").click()
    desk.wait_for_selector(".entered", state="detached")


def test_a_tapped_winner_stays_while_the_page_changes_around_it(desk: Any, playing: Hall) -> None:
    card(desk, "W1.3").locator(".seat").nth(1).click()
    for games in ((1, 0), (1, 1), (2, 1)):
        score(playing, "W1.1", games)
        shows(desk, "W1.1", games[0])
    phone = Phone(playing.site)
    phone.claims(playing.state.pair("W1.2")[0])
    assert phone.taps("W1.2", 3, 1).status == 200
    desk.wait_for_selector("section.is-call:has-text('sent it')", timeout=5000)
    pad(desk, "W1.3").nth(2).click()
    desk.wait_for_selector(".entered")
    result = playing.state.counted["W1.3"]
    assert (result.winner, min(result.score)) == (playing.state.pair("W1.3")[1], 2)


def test_enter_on_a_tapped_winner_enters_nothing(desk: Any, playing: Hall) -> None:
    card(desk, "W1.1").locator("input[name=winner]").first.focus()
    desk.keyboard.press("Space")
    desk.keyboard.press("Enter")
    desk.wait_for_timeout(500)
    assert not playing.state.counted
    pad(desk, "W1.1").first.focus()
    desk.keyboard.press("Enter")
    desk.wait_for_selector(".entered")
    assert "W1.1" in playing.state.counted


def test_a_correction_takes_three_taps_from_the_bracket(desk: Any, playing: Hall) -> None:
    playing.director.send("/desk/result", match="W1.1", a=3, b=1)
    desk.goto(f"{playing.site.address}/bracket")
    desk.locator('a[href*="match=1"]:visible').first.click()
    desk.locator(".sheet .seat").nth(1).click()
    desk.locator(".sheet .pad .btn:visible").nth(2).click()
    desk.wait_for_load_state()
    assert playing.state.counted["W1.1"].score == (2, 3)
