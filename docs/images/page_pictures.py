"""Make the pictures of the page: an evening on it, in a real browser, from the start to a result.

The first picture of all, the README's, shows the demo's evening on a phone and on the wall.

python docs/images/page_pictures.py

It needs the extra `browser` and Chromium. One computer makes the same bytes each time; another
may have other fonts, so that these pictures, unlike those beside them, are not made anew by CI.
"""

from __future__ import annotations

import base64
import io
import os
import re
import shutil
import socket
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from typing import Any

from PIL import Image
from playwright.sync_api import sync_playwright

from evenbreak.files.demo import write_demo_evening
from evenbreak.tournaments.evening.known import known_match
from evenbreak.web.server import server_of
from evenbreak.web.site import Site

HERE = Path(__file__).resolve().parent
ENTRANTS = HERE.parents[1] / "data" / "demo_entrants.csv"
PLAYERS = 7
CHROMIUM = os.environ.get("EVENBREAK_CHROMIUM") or shutil.which("chromium")
PHONE = {"width": 390, "height": 844}
WALL = {"width": 1280, "height": 720}
BIG_WALL = {"width": 1920, "height": 1080}
ROOM = "http://192.168.1.20:8000"
"""Where phones find the page, as the wall shows it: nothing while they are not let in."""
COLORS = 128
BOTH = """<!doctype html>
<style>
  body {{ align-items: center; display: flex; gap: 40px; margin: 0; padding: 24px; width: 1712px }}
  img {{ background: #fff; border: 14px solid #22262b; border-radius: 14px }}
  img + img {{ border-radius: 40px; width: 400px }}
  img:first-child {{ width: 1216px }}
</style>
<img src="data:image/png;base64,{}"><img src="data:image/png;base64,{}">
"""
"""The wall and a phone beside it, 1760 points wide."""


class Clock:
    """The time of the evening, which the story sets."""

    at = "18:50"

    def __call__(self) -> str:
        """Return it as the page wants it."""
        return f"2025-03-01T{self.at}:00"


@contextmanager
def served(path: Path, clock: Clock) -> Iterator[Site]:
    """Serve a file while the block runs."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    site = Site(path, address=f"http://127.0.0.1:{port}", clock=clock)
    server = server_of(site, port=port)
    thread = threading.Thread(target=server.run, daemon=True)
    thread.start()
    while not server.started:
        time.sleep(0.01)
    yield site
    server.should_exit = True
    thread.join(10)


def tab(browser: Any, site: Site, size: dict[str, int]) -> Any:
    """Return a page of a phone or of the wall, as a browser of its own shows it."""
    scale = 2 if size is PHONE else 1
    shown = {"viewport": size, "device_scale_factor": scale}
    return browser.new_context(base_url=site.address, **shown).new_page()


def shot(page: Any, *, first: str = "", last: str = "") -> bytes:
    """Return a picture of the page, from the top or an element `first` to the end of `last`.

    What stays at the bottom of a phone would cover the middle of a longer picture.
    """
    page.evaluate(
        """() => {
          document.activeElement.blur(); scrollTo(0, 0);
          document.querySelectorAll("nav.tabs").forEach(one => one.style.display = "none");
          document.querySelectorAll(".bottom").forEach(one => one.style.position = "static");
        }"""
    )
    ends = [page.locator(one).first.bounding_box() for one in (first, last) if one]
    width, height = page.viewport_size["width"], page.viewport_size["height"]
    top = ends[0]["y"] - 7 if first else 0.0
    bottom = ends[-1]["y"] + ends[-1]["height"] + 7 if last else top + height
    clip = {"x": 0, "y": top, "width": width, "height": bottom - top}
    return page.screenshot(full_page=True, clip=clip)


def kept(picture: bytes, file: Path) -> None:
    """Keep a picture with few colors, which makes it small."""
    drawn = Image.open(io.BytesIO(picture))
    small = drawn.convert("RGB").quantize(COLORS, dither=Image.Dither.NONE)
    small.save(file, optimize=True)


def settled(page: Any, path: str) -> None:
    """Open a page once the odds are those of the last entry; *Tonight* is marked until then."""
    for _ in range(600):
        page.goto("/", wait_until="domcontentloaded")
        if not page.locator("[data-older]").count():
            page.goto(path, wait_until="domcontentloaded")
            return
        time.sleep(0.1)
    raise RuntimeError(f"{path}: the odds do not come")


def press(page: Any, button: Any) -> None:
    """Press a button, and wait for the page that follows."""
    with page.expect_navigation(wait_until="domcontentloaded"):
        button.click()


def tap(page: Any, name: str) -> None:
    """Tap a button of a player's page, which stays and shows what follows."""
    page.wait_for_timeout(650)  # two taps within 0.6 s are one that came twice
    before = page.inner_text("main")
    page.get_by_role("button", name=name).click()
    page.wait_for_function("text => document.querySelector('main').innerText != text", arg=before)


def tap_result(page: Any, site: Site, within: str, match: int, winner: int, games: int) -> Any:
    """Tap a match's winner, and return the button of the loser's games."""
    name = known_match(site.night.state(), str(match), over=True)
    form = page.locator(f"{within} form.taps:has(label[for$='{name}-{winner}'])")
    form.locator("label.seat").nth(winner).click()
    return form.locator(f".after{winner} .pad button[value='{games}']")


def call_all(page: Any) -> None:
    """Call every match that has a table."""
    settled(page, "/desk")
    while (call := page.get_by_role("button", name=re.compile("^Call( |$)"))).count():
        press(page, call.first)
        settled(page, "/desk")


def begun(desk: Any, clock: Clock, folder: Path) -> None:
    """Paste the list, tick off who is here and draw."""
    desk.goto("/new")
    rows = [line.split(",")[:2] for line in ENTRANTS.read_text("utf-8").splitlines()[1:]]
    lines = [f"{k}. {name} {rating}" for k, (name, rating) in enumerate(rows[:PLAYERS], 1)]
    for name, value in (("name", "Saturday 9-Ball"), ("race", "5"), ("tables", "2")):
        desk.fill(f"[name={name}]", value)
    desk.fill("[name=entrants]", "\n".join(lines))
    kept(shot(desk, first="h1", last="#tables-how"), folder / "begin.png")
    desk.get_by_text("More choices").click()
    desk.fill("[name=losers_race]", "4")
    desk.select_option("[name=seeding]", label="Seeded by rating")
    press(desk, desk.get_by_role("button", name="Go to check-in"))
    for k, (name, _) in enumerate(rows[:PLAYERS]):
        for what in ("is here", "has paid") if k % 3 else ("is here",):
            press(desk, desk.get_by_role("button", name=f"{name} {what}"))
        if k == PLAYERS - 3:
            kept(shot(desk, first="h1", last=".check-in"), folder / "check_in.png")
    clock.at = "19:00"
    press(desk, desk.get_by_role("button", name=f"Draw {PLAYERS} players"))


def story(browser: Any, site: Site, clock: Clock, folder: Path) -> None:
    """Go through the evening of the tutorial, and keep its pictures in a folder."""
    desk = tab(browser, site, PHONE)
    desk.goto("/pin")
    desk.get_by_label("PIN").fill(site.pin)
    press(desk, desk.get_by_role("button", name="Go"))
    begun(desk, clock, folder)
    settled(desk, "/desk")
    kept(shot(desk, first="h1", last=".desk-grid"), folder / "call.png")

    clock.at = "19:05"
    call_all(desk)
    player = tab(browser, site, PHONE)
    player.goto(f"/c/{site.player_code('Tomasz Wierzba')}")
    press(player, player.get_by_role("button", name="This is me"))
    tap(player, "I'm coming")
    clock.at = "19:40"
    enter = tap_result(desk, site, ".desk-grid", 1, 0, 4)
    kept(shot(desk, first="section.table", last="section.table"), folder / "result.png")
    press(desk, enter)
    settled(desk, "/desk")
    kept(shot(desk, first=".entered", last=".entered"), folder / "said.png")
    call_all(desk)
    guest = tab(browser, site, PHONE)
    settled(guest, "/")
    kept(shot(guest, first="h1", last="main"), folder / "tonight.png")

    for name in ("Tomasz Wierzba", "Tomasz Wierzba", "Priya Vandermeer"):
        tap(player, f"Game for {name}")
    kept(shot(player, first=".mine-top", last="main .odds"), folder / "match.png")

    clock.at = "20:15"
    desk.goto("/desk")
    press(desk, tap_result(desk, site, ".desk-grid", 2, 0, 2))
    call_all(desk)
    clock.at = "20:35"
    desk.goto("/desk?match=4#sheet")
    desk.get_by_text("Type the score").click()
    typed = desk.locator(".sheet form.typed:visible")
    for name, games in (("a", "3"), ("b", "0")):
        typed.locator(f"[name={name}]").fill(games)
    press(desk, typed.get_by_role("button", name="Still playing"))
    clock.at = "20:40"
    desk.goto("/bracket?match=1#sheet")
    press(desk, tap_result(desk, site, ".sheet", 1, 1, 4))
    kept(shot(desk, first="h1", last="main form"), folder / "correct.png")
    press(desk, desk.locator(".bottom button:visible").first)

    wall = tab(browser, site, WALL)
    site.found_at(ROOM)
    settled(wall, "/screen?only=tables")
    kept(shot(wall), folder / "screen.png")


def front_page(browser: Any, path: Path, clock: Clock, file: Path) -> None:
    """Show the demo's evening on the wall, and one of its matches on a phone beside it."""
    clock.at = "18:00"
    state = write_demo_evening(path, datetime.fromisoformat(clock()))
    with served(path, clock) as site:
        wall = tab(browser, site, BIG_WALL)
        phone = tab(browser, site, PHONE)
        site.found_at(ROOM)
        settled(wall, "/screen?only=tables")
        first = min(state.on_tables, key=lambda match: state.on_tables[match].call.table)
        phone.goto(f"/c/{site.player_code(state.pair(first)[0])}")
        press(phone, phone.get_by_role("button", name="This is me"))
        pictures = (shot(wall), shot(phone, first=".mine-top", last="main .odds"))
    both = browser.new_page()
    both.set_content(BOTH.format(*(base64.b64encode(one).decode() for one in pictures)))
    kept(both.locator("body").screenshot(), file)


def main() -> None:
    """Write `front_page.png`, and the pictures of the tutorial into `page/`."""
    clock = Clock()
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as play:
        browser = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        with served(Path(folder, "tonight.db"), clock) as site:
            story(browser, site, clock, HERE / "page")
        front_page(browser, Path(folder, "Tuesday 9-Ball.db"), clock, HERE / "front_page.png")
        browser.close()


if __name__ == "__main__":
    main()
