"""The page in a real browser: it follows what happens, the keyboard suffices, scripts need not."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from evenbreak.files.store.tournament import add_events, read_tournament
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Event
from web.chromium import opened
from web.conftest import PLAYERS, Hall, begun
from web.phones import Phone, running

pytestmark = pytest.mark.slow

AT = "2025-03-01T20:00:00"


@pytest.fixture(scope="module")
def event(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Hall]:
    """A tournament under way: a result, a match in play, one at hill-hill."""
    with running(tmp_path_factory.mktemp("browser") / "tonight.db") as site:
        director = Phone(site, director=True)
        begun(director, PLAYERS)
        add_events(site.path, lambda state: [Event(AT, moves.result(state, "W1.1", (3, 1)))])
        for table, name in enumerate(("W1.2", "W1.3"), 1):
            director.send("/desk/call", match=name, table=table)
        add_events(site.path, lambda state: [Event(AT, moves.score(state, "W1.3", (2, 2)))])
        yield Hall(site, director, Phone(site))


BROKEN = """() => [...document.querySelectorAll(".entries .did")].flatMap((cell) => {
    const walk = document.createTreeWalker(cell, NodeFilter.SHOW_TEXT), broken = [];
    while (walk.nextNode()) for (const word of walk.currentNode.data.matchAll(/[^\\s-]+/g)) {
        const range = document.createRange();
        range.setStart(walk.currentNode, word.index);
        range.setEnd(walk.currentNode, word.index + word[0].length);
        if (range.getClientRects().length > 1) broken.push(word[0]);
    }
    return broken;
})"""
"""The words of a list of entries that stand on two lines."""


@pytest.mark.parametrize("width", [320, 390, 1024])
def test_who_entered_what_breaks_no_word(browser: Any, event: Hall, width: int) -> None:
    page = opened(browser, event.site, width=width)
    page.goto(f"{event.site.address}/desk/history")
    assert page.locator(".entries .did").count() >= 5
    assert page.evaluate(BROKEN) == []


def test_a_bracket_of_groups_scrolls_in_its_own_frame(browser: Any, tmp_path: Path) -> None:
    with running(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        begun(
            director, [f"A Rather Long Name {k}" for k in range(9)], format="groups", losers_race=""
        )
        for name in read_tournament(site.path).standing.to_play[:3]:
            director.send("/desk/result", match=name, a=3, b=1)
        page = opened(browser, site)
        page.goto(f"{site.address}/bracket")
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        page.context.close()


def test_a_page_asks_at_most_twice_and_shows_changes_by_itself(browser: Any, hall: Hall) -> None:
    page = browser.new_page()
    asked: list[str] = []
    page.on("request", lambda request: asked.append(request.url))
    errors: list[str] = []
    page.on("console", lambda message: errors.append(message.text))
    page.goto(hall.site.address)
    page.wait_for_timeout(200)
    assert len([url for url in asked if not url.endswith("/events")]) == 2
    add_events(hall.site.path, lambda state: [Event(AT, moves.call(state, "W1.5", 3))])
    page.wait_for_selector("text=since", timeout=5000)
    assert errors == []
    page.close()


def test_the_keyboard_alone_enters_a_result(browser: Any, hall: Hall) -> None:
    hall.director.send("/desk/call", match="W1.1", table=1)
    page = opened(browser, hall.site)
    page.goto(f"{hall.site.address}/desk")
    outlined = "getComputedStyle(document.activeElement).outlineStyle"
    seen = []
    for name in ("winner", "games"):
        for _ in range(60):
            page.keyboard.press("Tab")
            if page.evaluate("document.activeElement.name") == name:
                break
            seen.append(page.evaluate(outlined))
        page.keyboard.press("Space" if name == "winner" else "Enter")
    page.wait_for_selector("text=is in")
    assert "none" not in seen  # where the keyboard is can be seen all the way
    assert hall.state.counted["W1.1"].score == (3, 0)
    page.context.close()


def test_a_form_shows_and_sends_what_its_format_has(browser: Any, tmp_path: Path) -> None:
    with running(tmp_path / "tonight.db") as site:
        page = opened(browser, site)
        page.goto(f"{site.address}/new")
        page.fill("[name=entrants]", "Ann,612\nBo,540\nCy 500\nDi 480")
        page.click("summary")
        page.fill("[name=losers_race]", "2")
        assert not page.is_visible("[name=chips]")
        page.select_option("[name=format]", "single")
        assert not page.is_visible("[name=losers_race]")
        page.check("[name=third_place]")
        page.select_option("[name=races]", "fargo_r6_hot")
        assert not page.is_visible("[name=race]")
        page.click('button:text-is("Go to check-in")')
        page.wait_for_url("**/desk/check-in")
        plan = read_tournament(site.path).plan
        assert (plan.form, plan.losers_race, plan.third_place) == ("single", None, True)
        assert plan.chart.name == "fargo_r6_hot"
        page.context.close()


def test_without_scripts_a_phone_scores_and_the_director_confirms(browser: Any, hall: Hall) -> None:
    players = browser.new_context(java_script_enabled=False).new_page()
    players.goto(f"{hall.site.address}/me")
    one, _ = hall.state.pair("W1.1")
    players.get_by_role("button", name=one, exact=True).click()
    players.click("text=We're already playing")
    for _ in range(3):
        players.get_by_role("button", name=f"Game for {one}, who").click()
    assert "counts once" in players.inner_text("main")
    page = opened(browser, hall.site, java_script_enabled=False)
    page.goto(f"{hall.site.address}/desk")
    page.click("text=Confirm")
    assert hall.state.counted["W1.1"].score == (3, 0)
    for one_page in (players, page):
        one_page.context.close()


def test_phones_go_on_after_a_restart(browser: Any, tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    with running(path) as site:
        begun(Phone(site, director=True), PLAYERS)
        page = opened(browser, site)
        address = site.address
    with running(path, port=int(address.rpartition(":")[2])):
        page.goto(f"{address}/desk")
        assert page.get_by_role("button", name="Sign out as director").count() == 1
    page.context.close()
