"""A team night in a real browser: axe has no objection, a captain's choice is not taken away."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from web.phones import Phone, running
from web.test_team_night import Night, night_of

pytestmark = pytest.mark.thorough

axe_api = pytest.importorskip(
    "axe_playwright_python.sync_playwright",
    reason="no axe-playwright-python; pip install -e '.[browser]'",
)


def page_of(browser: Any, phone: Phone, *, width: int = 390, **asked: Any) -> Any:
    """Return a page of a browser that goes on with the session of a phone."""
    context = browser.new_context(viewport={"width": width, "height": 844}, **asked)
    cookies = [
        {"name": one.name, "value": one.value, "url": phone.site.address} for one in phone.jar
    ]
    context.add_cookies(cookies)
    return context.new_page()


def test_axe_objects_to_nothing_and_nothing_scrolls_sideways(browser: Any, tmp_path: Path) -> None:
    with night_of(tmp_path / "tonight.db", running, cap="15") as night:
        night.put(0, "Ann")
        night.put(1, "Wim")
        night.say(0, 1, (4, 2))
        for phone, path in (
            (night.captains[0], "/team"),
            (night.captains[1], "/team"),
            (night.director, "/team"),
            (night.director, "/team/new"),
            (night.director, "/team/history"),
            (night.guest, "/screen"),
        ):
            page = page_of(browser, phone, width=320)
            page.goto(night.site.address + path)
            wide = page.evaluate("document.documentElement.scrollWidth")
            assert wide <= 320, path
            for summary in page.locator("summary").all():
                summary.click()
            found = axe_api.Axe().run(page).response["violations"]
            assert [f"{path} {one['id']}: {one['nodes'][0]['html'][:100]}" for one in found] == []


def test_a_captains_page_follows_but_leaves_a_choice_alone(browser: Any, tmp_path: Path) -> None:
    with night_of(tmp_path / "tonight.db", running, order="blind") as night:
        page = page_of(browser, night.captains[1])
        page.goto(f"{night.site.address}/team")
        page.get_by_label("Vic").check()
        page.evaluate("document.activeElement.blur()")
        night.put(0, "Ann")  # changes the page, but must not take the choice away
        page.wait_for_timeout(1500)
        assert page.get_by_label("Vic").is_checked()
        page.get_by_role("button", name="Put up").press("Enter")
        page.wait_for_selector("text=Vic plays set 1")
        assert night.state.sets[0].picks == (("Ann",), ("Vic",))
        night.direct("result", number=1, a=4, b=3)
        page.wait_for_selector("text=4-3")


def test_without_scripts_a_captain_puts_up_and_enters_a_result(
    browser: Any, tmp_path: Path
) -> None:
    with night_of(tmp_path / "tonight.db", running) as night:
        page = page_of(browser, night.captains[0], java_script_enabled=False)
        page.goto(f"{night.site.address}/team")
        assert page.locator("meta[http-equiv=refresh]").count() == 0  # a choice would be lost
        page.get_by_role("button", name="Put up").click()
        first = night.state.sets[0].picks[0]
        assert first
        night.put(1, "Wim")
        _enter(page, night)
        night.say(1, 1, (4, 2))
        page.get_by_role("link", name="Reload").click()
        assert page.locator("text=4-2").count() == 1


def _enter(page: Any, night: Night) -> None:
    page.goto(f"{night.site.address}/team")
    page.fill("input[name=a]", "4")
    page.fill("input[name=b]", "2")
    page.get_by_role("button", name="Enter result").click()
