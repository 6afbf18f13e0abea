"""One scripted night with long names, and every screen of it: for tests, and to be looked at.

    python tests/web/night_shown.py /tmp/pictures

writes a picture of each screen, at its sizes, by day and by night. It needs the extra `browser`.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from evenbreak.files.store.tournament import add_events, new_tournament, read_tournament
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.fold import Evening

RATED = {
    "Tony Marsh": 648,
    "Nguyễn Văn An": 631,
    "Aleksandra Wiśniewska": 622,
    "Łukasz Żak": 620,
    "Jens Ødegård": 612,
    "Paul Smith": 604,
    "José Álvarez": 598,
    "Mike Sanders": 590,
    "Renée Dubois-Lachapelle": 583,
    "Bob “The Hammer” Kowalski": 577,
    "Priya Nair": 566,
    "Karl-Heinz Müller-Schmidt": 560,
    "Élodie Girard": 558,
    "Kev": 552,
    "Mike Santos": 545,
    "Siân O’Neill": 541,
    "Zoë Vandermeer": 530,
    "Ann Lee": 498,
    "Dave Przybylski-Thornton": None,
}
ANN = "Ann Lee"


class Screen(NamedTuple):
    """A screen: its name, its address, who looks at it, and the widths that it is made for."""

    name: str
    path: str
    who: str = "guest"
    widths: tuple[int, ...] = (390, 1280)


SCREENS = (
    Screen("tonight", "/"),
    Screen("tonight-director", "/", "director", (320, 390)),
    Screen("who", "/me"),
    Screen("mine", "/me", "player", (320, 390)),
    Screen("table", "/table/TV", "guest", (390, 1024)),
    Screen("bracket", "/bracket", "guest", (320, 390, 1280, 1920)),
    Screen("players", "/players"),
    Screen("players-director", "/players", "director"),
    Screen("prizes", "/prizes?fee=20"),
    Screen("fair", "/fair?a=Ann+Lee&b=Tony+Marsh&race=7"),
    Screen("league", "/league"),
    Screen("team", "/team"),
    Screen("pin", "/pin"),
    Screen("nowhere", "/nowhere"),
    Screen("wall", "/screen?only=tables", "guest", (1280, 1920)),
    Screen("wall-bracket", "/screen?only=bracket", "guest", (1280, 1920)),
    Screen("wall-story", "/screen?only=story", "guest", (1280, 1920)),
    Screen("desk", "/desk", "director", (320, 390, 1280)),
    Screen("desk-match", "/desk?match=20", "director"),
    Screen("desk-bracket", "/bracket?match=20", "director"),
    Screen("check-in", "/desk/check-in", "director"),
    Screen("history", "/desk/history", "director"),
    Screen("more", "/desk/more", "director"),
    Screen("codes", "/desk/codes", "director"),
    Screen("time", "/desk/time", "director"),
    Screen("new", "/new", "director"),
    Screen("next", "/next", "director"),
)


def half_played(path: Path, played: int = 17, day: str = "2026-11-24") -> Evening:
    """Write a night of 19 players on tables 1, 2, TV and 4, of which so many matches are played.

    Four are on the tables then: one at hill-hill, one just called.
    """
    luck = random.Random(5)
    entrants = tuple(
        Entrant(name, float(rating or 540), provisional=rating is None)
        for name, rating in RATED.items()
    )
    plan = Plan(
        "double",
        5,
        losers_race=4,
        scale="fargo",
        tables=4,
        labels=("1", "2", "TV", "4"),
        name="Tuesday 9-Ball",
        date=day,
    )
    new_tournament(path, [Event(f"{day}T18:00:00", Opened(plan, entrants))])
    minute = 18 * 60

    def do(decide: object) -> None:
        at = f"{day}T{minute // 60:02}:{minute % 60:02}:00"
        add_events(path, lambda state: [Event(at, decide(state))])  # type: ignore[operator]

    def fill() -> None:
        state = read_tournament(path)
        for table in state.free_tables:
            now = read_tournament(path)
            ready = [name for name in now.standing.to_play if name not in now.on_tables]
            if ready:
                do(lambda state, ready=ready, table=table: moves.call(state, ready[0], table))

    do(lambda state: moves.draw(state, np.random.default_rng(1)))
    for _ in range(played):
        fill()
        minute += 7
        state = read_tournament(path)
        match = min(state.on_tables, key=lambda name: state.on_tables[name].at)
        needs = state.needed(match, state.pair(match))
        score = (
            (needs[0], luck.randrange(needs[1]))
            if luck.random() < 0.6
            else (luck.randrange(needs[0]), needs[1])
        )
        do(lambda state, match=match, score=score: moves.result(state, match, score))
    fill()
    minute += 4
    on = list(read_tournament(path).on_tables)
    for match, (less_a, less_b) in zip(on, ((1, 1), (3, 2), (2, 3)), strict=False):
        state = read_tournament(path)
        a, b = state.needed(match, state.pair(match))
        score = max(a - less_a, 0), max(b - less_b, 0)
        do(lambda state, match=match, score=score: moves.score(state, match, score))
    return read_tournament(path)


def pictures(folder: Path) -> Iterator[Path]:
    """Write a picture of each screen, and yield their files."""
    import tempfile

    from playwright.sync_api import sync_playwright

    from web.chromium import CHROMIUM, claimed, opened
    from web.phones import running

    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as place, sync_playwright() as play:
        path = Path(place, "tonight.db")
        half_played(path)
        browser = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        with running(path) as site:
            site.clock = lambda: "2026-11-24T20:12:00"
            site.night.clock = site.clock
            for scheme in ("light", "dark"):
                phones = {
                    "director": opened(browser, site, color_scheme=scheme),
                    "guest": browser.new_context(color_scheme=scheme).new_page(),
                    "player": browser.new_context(color_scheme=scheme).new_page(),
                }
                claimed(phones["player"], site, ANN)
                for one in SCREENS:
                    page = phones[one.who]
                    for width in one.widths:
                        tall = 844 if width < 500 else width * 9 // 16
                        page.set_viewport_size({"width": width, "height": tall})
                        page.goto(site.address + one.path, wait_until="domcontentloaded")
                        page.wait_for_timeout(300)
                        file = folder / f"{one.name}-{width}-{scheme}.png"
                        page.screenshot(path=file)
                        yield file
        browser.close()


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    for written in pictures(Path(sys.argv[1])):
        sys.stdout.write(f"{written}\n")
