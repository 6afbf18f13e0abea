"""Overlays: a table's match with its chance, the bracket around it, for whoever is in the room."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from evenbreak.answers.tournament.bracket_view import bracket_panels
from evenbreak.files.store.tournament import add_events, new_tournament, read_tournament
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan, What
from evenbreak.tournaments.evening.fold import evening
from evenbreak.web.pages.overlay import readable
from evenbreak.web.site import Site
from web.asked import Browser, Room

AT = "2025-03-01T19:30:00"
NAMES = ("Siân O’Neill", "Renée Dubois-Lachapelle", "Cy", "Di")
RATINGS = (600.0, 640.0, 560.0, 550.0)


class Night:
    """A tournament of four, as its overlays show it at a certain time."""

    def __init__(self, path: Path, **plan: object) -> None:
        self.path, self.now = path, AT
        asked = {"handicapped": True, "scale": "fargo", "tables": 2, "labels": ("1", "TV"), **plan}
        entrants = tuple(map(Entrant, NAMES, RATINGS))
        self.enter(Opened(Plan("single", 5, streamed=(2,), **asked), entrants))  # type: ignore[arg-type]
        self.enter(Drawn(NAMES, (0, 1, 2, 3)))
        self.room = Room(Site(path, hosts=frozenset({"localhost"}), clock=lambda: self.now))
        self.browser = Browser(self.room)

    def enter(self, what: What) -> None:
        if self.path.exists():
            add_events(self.path, lambda _: [Event(self.now, what)])
        else:
            new_tournament(self.path, [Event(self.now, what)])

    def moves(self, name: str, *asked: object) -> None:
        add_events(self.path, lambda state: [Event(self.now, getattr(moves, name)(state, *asked))])

    def words(self, path: str = "/overlay/TV") -> str:
        got = self.browser.open(path)
        assert got.status == 200, got.text
        return got.words.removeprefix("Overlay ")


@pytest.fixture
def night(tmp_path: Path) -> Iterator[Night]:
    night = Night(tmp_path / "tonight.db", name="Tuesday")
    with closing(night.room):
        yield night


@pytest.mark.slow
def test_the_plate_follows_the_match_on_a_table(night: Night) -> None:
    a, b = NAMES[:2]
    state = read_tournament(night.path)
    m, n = state.needed("W1.1", (a, b))
    assert m < n
    night.moves("call", "W1.1", 2)
    assert f"{a} Called race {m}:{n} {b}" in night.words()
    night.moves("score", "W1.1", (2, 1))
    assert f"{a} 2 Semifinals race {m}:{n} 1 {b}" in night.words()
    assert night.words("/overlay/2") == night.words()
    night.moves("score", "W1.1", (m - 1, n - 1))
    hill = night.words()
    assert f"{a} {m - 1} Hill-hill race {m}:{n} {n - 1} {b}" in hill
    # The chance of one rack is that of the ratings, whatever has been worked out by now.
    p = round(100.0 / (1.0 + 2.0 ** ((RATINGS[1] - RATINGS[0]) / 100.0)))
    assert abs(int(hill.split()[-2].rstrip("%")) - p) <= 4
    night.moves("result", "W1.1", (m, n - 1))
    assert f"{a} wins" in night.words()
    night.now = "2025-03-01T19:30:21"
    assert "wins" not in night.words()


def test_no_score_is_shown_while_players_disagree(night: Night) -> None:
    night.moves("call", "W1.1", 2)
    for name, score in zip(NAMES, ((5, 0), (0, 5)), strict=False):
        phone = Browser(night.room, address=f"10.0.0.{len(name)}")
        phone.send("/c/" + night.room.site.player_code(name))
        phone.claims(name)
        pair = dict(zip(("player_a", "player_b"), NAMES, strict=False))
        needs = read_tournament(night.path).needed("W1.1", (NAMES[0], NAMES[1]))
        a, b = (need if won else 0 for need, won in zip(needs, score, strict=True))
        assert phone.taps("W1.1", a, b, **pair).status == 303
    assert "Checking" in night.words()
    assert "%" not in night.words()


def test_colors_and_language_are_those_of_the_address(night: Night) -> None:
    night.moves("call", "W1.1", 2)
    got = night.browser.open("/overlay/TV?accent=7A1F5C&language=de")
    assert '<link rel="stylesheet" href="/overlay.css?accent=7a1f5c">' in got.text
    assert "Aufgerufen" in got.words
    assert (
        "--accent: #7a1f5c; --accent-on: #ffffff"
        in night.browser.open("/overlay.css?accent=7a1f5c").text
    )
    for wrong in ("red", "7a1f5", "7a1f5c;}", "%0a7a1f5"):
        for path in ("/overlay/TV", "/overlay/bracket", "/overlay.css"):
            assert night.browser.open(f"{path}?back={wrong}").status == 400


def test_a_table_that_is_not_there_is_named_in_one_line(night: Night) -> None:
    got = night.browser.open("/overlay/9")
    assert (got.status, got.text) == (404, "There's no table 9; the tables are 1, TV\n")


def test_before_a_tournament_there_is_a_line_and_at_its_end_the_champion(tmp_path: Path) -> None:
    with closing(Room(Site(tmp_path / "none.db", hosts=frozenset({"localhost"})))) as room:
        assert Browser(room).open("/overlay/1").text == "No tournament is running yet.\n"
    night = Night(tmp_path / "tonight.db", handicapped=False, name="Tuesday")
    with closing(night.room):
        assert "Next here" in night.words("/overlay/1")
        for match in ("W1.1", "W1.2", "F"):
            night.moves("result", match, (5, 3))
        night.now = "2025-03-01T19:40:00"
        assert "Champion" in " ".join(night.words() for _ in range(9))  # when that is worked out
        assert NAMES[0] in night.words("/overlay/bracket")


@pytest.mark.parametrize("players", [8, 32, 128])
def test_the_bracket_is_cut_to_what_can_be_read(players: int) -> None:
    names = tuple(f"Player {k}" for k in range(players))
    plan = Plan("double", 5, scale="fargo", tables=4)
    opened = Opened(plan, tuple(Entrant(name, 600.0) for name in names))
    state = evening([Event(AT, what) for what in (opened, Drawn(names, tuple(range(players))))])
    panels = bracket_panels(state)
    for match in list(state.standing.to_play)[:: players // 4]:
        cut = readable(panels, match)
        boxes = {box.match: box for panel in cut for box in panel.boxes}
        assert match in boxes
        assert boxes[match].to in boxes
        assert (len(cut) == len(panels)) == (players == 8)
