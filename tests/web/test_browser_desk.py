"""The desk in a real browser: it follows what happens, and leaves alone what is filled in."""

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
PROPOSED = "section.proposed"


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


def field(page: Any, match: str) -> Any:
    return page.locator(f'form.result:has([value="{match}"]):has([value="new"]) [name=a]').first


def test_a_stray_digit_does_not_freeze_the_desk(desk: Any, playing: Hall) -> None:
    field(desk, "W1.2").press_sequentially("7")
    phone = Phone(playing.site)
    phone.claims(playing.state.pair("W1.1")[0])
    assert phone.taps("W1.1", 3, 1).status == 200
    desk.wait_for_selector(PROPOSED, timeout=5000)
    assert field(desk, "W1.2").input_value() == "7"
    assert desk.evaluate("document.activeElement.name") == "a"
    desk.keyboard.type("8")
    assert field(desk, "W1.2").input_value() == "78"


def test_a_field_keeps_the_focus_while_the_page_changes_around_it(desk: Any, playing: Hall) -> None:
    field(desk, "W1.3").click()
    desk.keyboard.type("2")
    for games in ((1, 0), (1, 1), (2, 1)):
        score(playing, "W1.1", games)
        desk.wait_for_function(
            "(games) => document.querySelector('[data-key=\"W1.1\"] [name=a]').value == games",
            arg=str(games[0]),
        )
    add_events(playing.site.path, lambda s: [Event(AT, moves.result(s, "W1.2", (3, 0)))])
    desk.wait_for_selector('[data-key="W1.2"]', state="detached", timeout=5000)
    desk.keyboard.type("1")
    assert field(desk, "W1.3").input_value() == "21"


def test_what_was_typed_goes_along_with_a_match_that_moves(desk: Any, playing: Hall) -> None:
    field(desk, "W1.1").fill("2")
    add_events(playing.site.path, lambda s: [Event(AT, moves.call_back(s, "W1.1"))])
    desk.wait_for_function(
        "() => !document.body.innerText.includes('Table 1: W1.1, race') &&"
        " document.querySelector('[data-key=\"W1.1\"] [name=a]')?.value === '2'",
        timeout=8000,
    )


def test_the_answer_to_an_entry_stays_until_the_next(desk: Any, playing: Hall) -> None:
    field(desk, "W1.1").fill("3")
    desk.locator('form.result:has([value="W1.1"]):has([value="new"]) [name=b]').first.fill("1")
    desk.keyboard.press("Enter")
    desk.wait_for_selector(".said")
    said = desk.inner_text(".said")
    assert "3:1 in W1.1" in said
    score(playing, "W1.2", (2, 0))
    desk.wait_for_function(
        "() => document.querySelector('[data-key=\"W1.2\"] [name=a]').value === '2'", timeout=8000
    )
    desk.wait_for_timeout(2500)
    assert desk.inner_text(".said") == said
    desk.locator("[data-key='W1.2']").get_by_role("button", name="Take it off the table").click()
    desk.wait_for_function("(old) => document.querySelector('.said').innerText !== old", arg=said)
    assert "W1.2 is off table 2." in desk.inner_text(".said")
