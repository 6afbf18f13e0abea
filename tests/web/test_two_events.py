"""A night of two divisions and a second chance, directed through the page: one desk, one wall."""

from __future__ import annotations

import asyncio
import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from evenbreak.files.store.prizes import kept_prizes
from evenbreak.files.store.tournament import read_night
from evenbreak.tournaments.evening.events import BY_ITSELF, Called
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.site import Site
from web.asked import Browser, Room, forms_in
from web.test_who_may import NEW

TABLES = 4


@pytest.fixture
def director(tmp_path: Path) -> Iterator[Browser]:
    room = Room(Site(tmp_path / "tonight.db", hosts=frozenset({"localhost"}), clock=Clock()))
    yield Browser(room, director=True)
    room.close()


class Clock:
    """A minute later each time a result is entered."""

    minutes = 0

    def __call__(self) -> str:
        return f"2025-03-01T{19 + self.minutes // 60}:{self.minutes % 60:02}:00"


def states(site: Site) -> dict[int, Evening]:
    return {night.event: night.state() for night in site.nights}


def seated(site: Site) -> dict[int, tuple[int, str]]:
    """Return the match on each table; nobody and no table is in two."""
    on = [
        (call.call.table, (n, name), call.call.players)
        for n, state in states(site).items()
        if state.drawn
        for name, call in state.on_tables.items()
    ]
    players = [player for *_, pair in on for player in pair]
    assert len({table for table, *_ in on}) == len(on) <= TABLES
    assert len({*players}) == len(players)
    return {table: match for table, match, _ in on}


def opened(director: Browser, name: str, players: int, **more: object) -> None:
    listed = "\n".join(f"{name[-1]}{k} Player, {600 - 7 * k}" for k in range(players))
    asked = {**NEW, "entrants": listed, "name": name, "losers_race": "", "tables": TABLES, **more}
    got = director.send("/new", **asked)
    assert got.status == 303, got.words


def draw_and_call(director: Browser, event: int) -> None:
    """Draw an event, and call what the desk offers: the one tap that no result can make."""
    assert director.send("/desk/draw", event=event).status == 303
    text = director.open("/desk").text
    for form in forms_in(text):
        if form.action == "/desk/call":
            director.ask("POST", "/desk/call", form.fields)
            break


@pytest.mark.slow
def test_a_night_of_two_divisions_and_a_second_chance(director: Browser) -> None:
    site, luck = director.room.site, random.Random(3)
    opened(director, "Division A", 8, format="double")
    opened(director, "Division B", 11, format="single", beside="yes")
    draw_and_call(director, 1)
    draw_and_call(director, 2)
    assert len(seated(site)) == TABLES
    chance = waited = 0
    while True:
        on = seated(site)
        now = states(site)
        if not on:
            break
        text = director.open("/desk").text
        for table, (n, name) in on.items():
            key = name if n == 1 else f"{n}-{name}"
            card = text[text.index(f'data-key="{key}"') :].partition("</section>")[0]
            assert f"</span>{table}</span>" in card, (table, key)
            assert now[n].plan.name in card
        wall = director.open("/screen", only="tables").text
        for n, name in on.values():
            for player in now[n].pair(name):
                assert wall.count(f"<bdi>{player}</bdi>") >= 1, player
        if not chance and "Start a B bracket" in text:
            got = director.send("/desk/second-chance", race=2, name="B bracket")
            assert got.status == 303
            assert "Start a B bracket" not in director.open("/desk").words
            chance = max(states(site))
            draw_and_call(director, chance)
            continue
        table, (n, name) = luck.choice(sorted(on.items()))
        site.clock.minutes += 3  # type: ignore[attr-defined]
        winner, event = luck.choice(now[n].pair(name)), {"event": n} if n > 1 else {}
        games = luck.randrange(min(now[n].needed(name, now[n].pair(name))))
        got = director.send("/desk/result", match=name, winner=winner, games=games, **event)
        assert got.status == 303, got.words
        ready = sum(len([*one.standing.to_play]) for one in states(site).values() if one.drawn)
        busy = {p for n, m in seated(site).values() for p in states(site)[n].pair(m)}
        free = [
            match
            for one in states(site).values()
            if one.drawn
            for match in one.standing.to_play
            if match not in one.on_tables and not busy & {*one.pair(match)}
        ]
        assert not free or len(seated(site)) == TABLES, "a match waits though a table is free"
        waited = max(waited, ready)
    assert chance == 3
    assert waited > TABLES
    for one in states(site).values():
        assert not one.standing.to_play
    entries = [one for each in read_night(site.path).values() for one in each]
    calls = [one for one in entries if isinstance(one.what, Called)]
    assert sum(one.by.startswith(BY_ITSELF) for one in calls) > len(calls) * 0.7


@pytest.mark.slow
def test_the_desk_says_when_the_whole_night_ends(director: Browser) -> None:
    site = director.room.site
    opened(director, "Division A", 4, format="single")
    opened(director, "Division B", 4, format="single", beside="yes")
    draw_and_call(director, 1)
    draw_and_call(director, 2)
    for _ in range(200):
        shown = director.open("/desk").words
        if "ends about" in shown:
            break
        director.room.loop.run_until_complete(asyncio.sleep(0.1))
    (ends,) = re.findall(r"ends about (\d+:\d\d)", shown)
    director.open("/screen", only="tables")
    assert f"ends about {ends}" in director.open("/screen", only="tables").words
    assert "Table 1, Division A" in shown
    assert len(seated(site)) == TABLES


@pytest.mark.slow
def test_who_goes_home_does_so_from_all_events_if_the_director_says_so(director: Browser) -> None:
    site = director.room.site
    opened(director, "A", 8, format="double")
    opened(director, "A", 6, format="single", beside="yes")
    draw_and_call(director, 1)
    draw_and_call(director, 2)
    asked = director.send("/desk/drop", player="A1 Player")
    assert "Yes, in all events" in asked.words
    assert all(not one.dropped for one in states(site).values())
    director.send("/desk/drop", player="A1 Player", sure="yes")
    assert [one.dropped for one in states(site).values()] == [("A1 Player",), ()]
    director.send("/desk/drop", player="A2 Player", sure="yes", everywhere="yes")
    assert ["A2 Player" in one.dropped for one in states(site).values()] == [True, True]
    entry = states(site)[1].numbers[-1]
    director.send("/desk/undo", entry=entry, sure="yes")
    assert ["A2 Player" in one.dropped for one in states(site).values()] == [False, False]


def test_each_event_has_its_prizes_and_its_lists(director: Browser) -> None:
    site = director.room.site
    opened(director, "A", 8, format="double", fee="10")
    opened(director, "B", 6, format="single", beside="yes", fee="20")
    assert [kept_prizes(site.path, n).fee for n in (1, 2)] == [10.0, 20.0]  # type: ignore[union-attr]
    director.send("/prizes", fee="5", payout="100", event=2)
    assert [kept_prizes(site.path, n).fee for n in (1, 2)] == [10.0, 5.0]  # type: ignore[union-attr]
    assert "B5 Player" in director.open("/desk/more?event=2").text
    assert "B5 Player" not in director.open("/desk/more").text
    draw_and_call(director, 2)
    assert "Draw" in director.open("/desk/history?event=2").words
    assert director.open("/desk/time?event=2").status == 200
    assert director.open("/desk/time").status == 409


def test_a_form_that_added_nothing_adds_nothing_after_a_restart(director: Browser) -> None:
    site = director.room.site
    opened(director, "A", 4, format="single")
    draw_and_call(director, 1)
    state = site.night.state()
    name = next(iter(state.on_tables))
    fields = {"match": name, "winner": state.pair(name)[0], "games": 1}
    again = {**director.hidden(), **fields}
    director.send("/desk/result", **fields)
    assert director.ask("POST", "/desk/result", again).status == 303  # the same result: nothing new
    director.send("/desk/undo", entry=site.night.state().numbers[-1], sure="yes")
    entered = site.night.state().log
    restarted = Room(Site(site.path, hosts=frozenset({"localhost"}), clock=Clock()))
    same = Browser(restarted)
    same.cookies, same.kept = director.cookies, director.kept
    assert same.ask("POST", "/desk/result", again).status == 303
    assert restarted.site.night.state().log == entered
    restarted.close()
