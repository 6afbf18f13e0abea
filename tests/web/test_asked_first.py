"""The desk asks before it takes anything away, and undoes what the director has entered."""

import re
from typing import Any

import pytest

from evenbreak.files.store.tournament import add_events, read_events
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Event
from web.conftest import Hall
from web.phones import Phone, Shown

TAPS = 5
"""How often players tap between the director's undo and its page."""


def tap(hall: Hall, phone: Phone, match: str, a: int, b: int) -> Shown:
    """Tap the score of a match in play on a player's phone."""
    if "Who are you?" in phone.open("/me").words:
        phone.claims_by_code(hall.state.pair(match)[0])
    return phone.taps(match, a, b)


@pytest.fixture
def busy(hall: Hall) -> Hall:
    """W2.2 is on table 4 at 2:0, as its players' phones have it; L1.2 on table 1."""
    for name in ("W1.1", "W1.2", "W1.3", "W1.4"):
        hall.director.send("/desk/result", match=name, a=3, b=1)
    hall.director.send("/desk/call", match="L1.2", table=1)
    hall.director.send("/desk/call", match="W2.2", table=4)
    assert tap(hall, hall.guest, "W2.2", 2, 0).status == 200
    return hall


def answered(hall: Hall, path: str, shown: Shown, **more: Any) -> Shown:
    """Answer the question: stop the matches."""
    assert "Leave match 3 alone" in shown.words, shown.words
    form = shown.text.split('class="sure"')[1].split("</form>")[0]
    hidden = r'type="hidden" name="([^"]+)" value="([^"]*)"'
    fields = dict(re.findall(hidden, form)) | {"follow": "stop"}
    return hall.director.send_raw(path, {**fields, "sure": "yes", **more})


WRONG = {"match": "W1.3", "a": 1, "b": 3}


@pytest.mark.slow
def test_a_correction_names_what_it_takes_off_the_tables_and_gives_it_back(busy: Hall) -> None:
    before = busy.state
    pair = " ".join(before.pair("W2.2"))
    shown = busy.director.send("/desk/correct", **WRONG)
    assert f"Table 4 {pair} Match 10 2-0" in shown.words
    assert "2-0 stays in the history." in shown.words
    assert "Was Player 4 3-1 Now Player 13 3-1" in shown.words
    assert busy.state.on_tables == before.on_tables
    assert answered(busy, "/desk/correct", shown).status == 200
    assert {one.call.table for one in busy.state.on_tables.values()} == {1, 4}
    assert not busy.state.live
    right = {**WRONG, "a": 3, "b": 1}
    assert busy.director.send("/desk/correct", **right, follow="stop", sure="yes").status == 200
    assert (busy.state.on_tables, busy.state.live) == (before.on_tables, before.live)


@pytest.mark.slow
def test_the_answer_is_for_what_was_named(busy: Hall) -> None:
    asked = busy.director.send("/desk/correct", **WRONG)
    assert tap(busy, busy.guest, "W2.2", 2, 1).status == 200  # the same match, one game further
    busy.director.send("/desk/uncall", match="L1.2")
    again = answered(busy, "/desk/correct", asked)
    assert "Match 10 2-1" in again.words
    assert busy.state.counted["W1.3"].score == (3, 1)
    entries = len(read_events(busy.site.path))
    for _ in range(2):
        assert answered(busy, "/desk/correct", again).status == 200
    assert len(read_events(busy.site.path)) == entries + 2  # the match on table 4 starts anew


@pytest.mark.slow
@pytest.mark.parametrize(
    ("path", "fields"),
    [("drop", {"player": "Player 4"}), ("forfeit", {"player": "Player 4"})],
)
def test_whoever_leaves_a_match_in_play_is_asked_for_with_its_score(
    busy: Hall, path: str, fields: dict[str, str]
) -> None:
    (name,) = [n for n, one in busy.state.live.items() if "Player 4" in one.what.players]
    number = busy.state.number_of(name)
    shown = busy.director.send(f"/desk/{path}", **fields)
    assert re.search(rf"\(match {number}\) would (leave table 4|end) at 2-0\.", shown.words), (
        shown.words
    )


@pytest.mark.slow
def test_undo_names_the_directors_entry_and_taps_do_not_get_in_the_way(busy: Hall) -> None:
    desk = busy.director.open("/desk").words
    assert "Undo: match 10 called to table 4" in desk
    entry = busy.state.numbers[-2]
    for k in range(TAPS):
        assert tap(busy, busy.guest, "W2.2", 2, 1 - k % 2).status == 200
        shown = busy.director.send("/desk/undo", entry=entry)
        assert shown.status == 200
        assert "Undone: match 10 called to table 4." in shown.words
        busy.director.send("/desk/call", match="W2.2", table=4)
        entry = len(read_events(busy.site.path))
    assert busy.state.live["W2.2"].what.score == (2, 1)
    assert busy.director.send("/desk/undo", entry=entry - 2).status == 400
    history = busy.director.open("/desk/history").text
    assert history.count("<s>Match 10 called to table 4</s> (undone)") == TAPS
    assert history.count("undone: match 10 called to table 4") == TAPS
    busy.director.send("/language", language="de")
    history = busy.director.open("/desk/history").text
    assert len(re.findall(r"Eingabe \d+ zurückgenommen: [^<:]*10[^<:]*Tisch 4", history)) == TAPS


@pytest.mark.slow
def test_what_was_entered_at_a_terminal_says_so(busy: Hall) -> None:
    called = moves.call(busy.state, "W1.5", None)
    add_events(busy.site.path, lambda _: [Event(busy.site.clock(), called)])
    number = busy.state.number_of("W1.5")
    rows = busy.director.open("/desk/history").text.split("<li ")
    assert "a terminal" in next(row for row in rows if f"Match {number} called" in row)
    assert sum("a terminal" in row for row in rows) == 1  # the page began the tournament


@pytest.mark.slow
def test_a_match_is_called_back_on_the_desk(busy: Hall) -> None:
    assert "Take it off the table" in busy.director.open("/desk", match="10").words
    shown = busy.director.send("/desk/uncall", match="W2.2")
    assert "Taken off table 4: match 10; 2-0 is kept." in shown.words
    assert busy.state.live["W2.2"].what.score == (2, 0)
    assert busy.guest.send("/desk/uncall", match="L1.2").status == 403


def test_a_correction_before_the_draw_keeps_the_seeds(hall: Hall) -> None:
    hall.director.send("/desk/undo", entry=2, sure="yes")
    shown = hall.director.send("/desk/edit", player="Player 1", name="Player One")
    assert shown.status == 200
    shown = hall.director.send("/desk/edit", player="Player 2", name="", rating="655")
    assert list(hall.state.entrants)[:3] == ["Player One", "Player 2", "Player 3"]
    assert hall.state.entrants["Player 2"].rating == 655.0


@pytest.mark.slow
def test_a_phone_follows_its_player_when_others_play_the_match_now(busy: Hall) -> None:
    gone = busy.state.counted["W1.3"].winner
    before = busy.state.pair("W2.2")
    phones = {name: Phone(busy.site) for name in before}
    for name, phone in phones.items():
        phone.claims_by_code(name)
        assert "Tap for a game" in phone.open("/me").words
    stale = {"player_a": before[0], "player_b": before[1], "seen": "2:0"}
    busy.director.send("/desk/correct", **WRONG, sure="yes")
    assert gone not in busy.state.pair("W2.2")
    for phone in phones.values():
        assert phone.taps("W2.2", 2, 1, **stale).status == 409
    assert "losers 1" in phones[gone].open("/me").words.casefold()
    busy.director.send("/desk/correct", **{**WRONG, "a": 3, "b": 1})
    assert "Tap for a game" in phones[gone].open("/me").words


@pytest.mark.slow
def test_another_event_has_a_desk_of_its_own_on_the_same_tables(hall: Hall) -> None:
    four = "Zoe,612\nYan,540\nXia,500\nWim,480"
    new = {"entrants": four, "race": 3, "format": "single", "races": "even", "scale": "fargo"}
    more = {"tables": 2, "discipline": "9-ball", "seeding": "listed", "beside": "yes"}
    shown = hall.director.send("/new", **new, **more)
    assert shown.url.endswith("/desk?event=2"), shown.words
    assert hall.director.send("/desk/draw", event=2).url.endswith("/desk?event=2")
    hall.director.send("/desk/call", match="1", table=1)
    assert hall.director.send("/desk/call", match="1", table=1, event=2).status == 400
    assert hall.director.send("/desk/call", match="1", table=2, event=2).status == 200
    assert 'name="event" value="2"' in hall.director.open("/desk?event=2").text
    assert list(hall.state.elsewhere) == [2]
    assert hall.director.open("/desk?event=3").status == 404
    for path in ("/", "/bracket", "/players", "/desk/check-in", "/desk/more"):
        shown = hall.director.open(f"{path}?event=2")
        assert "Zoe" in shown.text, path
        assert f'href="{path}">Event 1' in shown.text
        links = re.findall(r'href="(/(?:desk|bracket|players|prizes|share|me)\b[^"]*)"', shown.text)
        lost = [one for one in links if "event=2" not in one and one != path]
        assert set(lost) <= {"/players", "/desk/phones"}, (path, lost)  # the footer's; the room's
        assert 'class="row" aria-label="Events"' in shown.text
