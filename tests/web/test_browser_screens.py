"""Every screen of one night, at every size: axe, widths, what is touched, the first visit."""

from __future__ import annotations

import urllib.error
import urllib.request
from collections.abc import Iterator
from typing import Any, NamedTuple

import pytest

from evenbreak.web.site import Site
from web.chromium import claimed, opened
from web.night_shown import ANN, SCREENS, Screen, half_played
from web.phones import running

pytestmark = pytest.mark.slow

axe_api = pytest.importorskip(
    "axe_playwright_python.sync_playwright",
    reason="no axe-playwright-python; pip install -e '.[browser]'",
)

SMALL = """() => [...document.querySelectorAll("button, a[href], select, summary, label.seat, " +
    "label.check, input:not([type=hidden], [type=radio], [type=checkbox])")]
    .filter((one) => one.checkVisibility({ visibilityProperty: true, opacityProperty: true }))
    .filter((one) => !one.matches(".unseen, .skip, p a, li a, td a, th a, .note a, .unseen *"))
    .map((one) => ({ box: one.getBoundingClientRect(), text: one.innerText || one.name }))
    .filter(({ box }) => box.width > 0 && (box.width < 43.5 || box.height < 43.5))
    .map(({ box, text }) => [text.slice(0, 40), box.width, box.height].join(" "))"""
"""What is touched and smaller than 44 px; a link within a sentence is as large as its line."""


class Room(NamedTuple):
    site: Site
    pages: dict[tuple[str, str], Any]
    browser: Any

    def page(self, who: str, scheme: str = "light") -> Any:
        """Return the phone of a director, a player or a guest."""
        if (who, scheme) not in self.pages:
            if who == "director":
                self.pages[who, scheme] = opened(self.browser, self.site, color_scheme=scheme)
            else:
                page = self.browser.new_context(color_scheme=scheme).new_page()
                if who == "player":
                    claimed(page, self.site, ANN)
                self.pages[who, scheme] = page
        return self.pages[who, scheme]

    def shows(self, one: Screen, width: int, scheme: str = "light") -> Any:
        page = self.page(one.who, scheme)
        page.set_viewport_size({"width": width, "height": 844 if width < 700 else width * 9 // 16})
        page.goto(self.site.address + one.path, wait_until="domcontentloaded")
        return page


@pytest.fixture(scope="module")
def room(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Room]:
    path = tmp_path_factory.mktemp("screens") / "tonight.db"
    half_played(path)
    with running(path) as site:
        site.clock = site.night.clock = lambda: "2026-11-24T20:12:00"
        yield Room(site, {}, browser)


@pytest.mark.parametrize(
    ("width", "scheme"),
    [
        (390, "light"),
        pytest.param(1280, "dark", marks=pytest.mark.thorough),
        pytest.param(390, "dark", marks=pytest.mark.thorough),
        pytest.param(768, "light", marks=pytest.mark.thorough),
        pytest.param(1280, "light", marks=pytest.mark.thorough),
        pytest.param(1920, "light", marks=pytest.mark.thorough),
    ],
)
def test_axe_objects_to_nothing(room: Room, width: int, scheme: str) -> None:
    objections = []
    for one in SCREENS:
        page = room.shows(one, width, scheme)
        found = axe_api.Axe().run(page).response["violations"]
        objections += [
            f"{one.name}: {each['id']}: {node['html'][:150]}"
            for each in found
            for node in each["nodes"]
        ]
    assert objections == []


def test_nothing_scrolls_sideways(room: Room) -> None:
    wide = []
    for one in SCREENS:
        for width in (320, *one.widths):
            page = room.shows(one, width)
            if (found := page.evaluate("document.documentElement.scrollWidth")) > width:
                wide.append((one.name, width, found))
    assert wide == []


def test_whatever_is_touched_is_44_px_or_more(room: Room) -> None:
    small = {
        one.name: room.shows(one, 390).evaluate(SMALL) for one in SCREENS if "wall" not in one.name
    }
    assert {name: found for name, found in small.items() if found} == {}


def test_the_first_visit_is_two_requests_and_60_kb(room: Room) -> None:
    """The page and its style; the stream is what tells of changes, and brings nothing."""
    for one in SCREENS:
        page, asked = room.page(one.who), []

        def note(answer: Any, asked: list[Any] = asked) -> None:
            asked.append(answer)

        page.on("response", note)
        room.shows(one, 390).wait_for_timeout(100)
        page.remove_listener("response", note)
        got = [each for each in asked if not each.url.endswith("/events") and each.status != 303]
        assert len(got) <= 2, (one.name, [each.url for each in got])

    def size(who: str, path: str) -> int:
        mine = "; ".join(
            f"{each['name']}={each['value']}" for each in room.page(who).context.cookies()
        )
        head = {"Accept-Encoding": "gzip", "Cookie": mine}
        asked = urllib.request.Request(room.site.address + path, headers=head)  # noqa: S310
        try:
            with urllib.request.urlopen(asked) as answer:  # noqa: S310
                return len(answer.read())
        except urllib.error.HTTPError as error:
            with error:
                return len(error.read())

    style = size("director", "/evenbreak.css")
    sizes = {one.name: style + size(one.who, one.path) for one in SCREENS}
    assert {name: at for name, at in sizes.items() if at > 60_000} == {}
    assert max(sizes.values()) > 15_000
