"""The director's desk: two taps a result, one card that stays, calls that make themselves."""

from __future__ import annotations

from pathlib import Path

import pytest

from evenbreak.files.store.tournament import add_events
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import BY_ITSELF, Changed, Event
from web.asked import forms_in
from web.conftest import PLAYERS, Hall, begun
from web.phones import Phone, answering


def on(hall: Hall, table: int) -> str:
    """Return the match on a table."""
    return next(n for n, one in hall.state.on_tables.items() if one.call.table == table)


def taps(hall: Hall, match: str, games: int, *, winner: int = 0) -> str:
    """Enter a result by two taps, and return what the desk says then."""
    name = hall.state.pair(match)[winner]
    shown = hall.director.send("/desk/result", match=match, winner=name, games=games)
    assert shown.status == 200, shown.words
    return shown.words


@pytest.fixture
def full(hall: Hall) -> Hall:
    """All four tables called by one tap, as the desk offers it."""
    asked = next(
        form.fields
        for form in forms_in(hall.director.open("/desk").text)
        if form.action == "/desk/call" and len(form.fields) > 6
    )
    assert hall.director.send_raw("/desk/call", fields_of(asked)).status == 200
    return hall


def fields_of(pairs: list[tuple[str, str]]) -> dict[str, object]:
    """Return the fields of a form, of which some come several times."""
    return {name: [v for n, v in pairs if n == name] for name, _ in pairs}


@pytest.mark.slow
def test_an_evening_of_nineteen_takes_seventy_five_taps(tmp_path: Path) -> None:
    """The draw, one tap that calls the tables, and two taps for each of 36 results."""
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        begun(director, [f"Player {k}" for k in range(19)])
        hall, tapped = Hall(site, director, Phone(site)), 1
        calls = [form for form in forms_in(director.open("/desk").text) if form.words]
        every = next(form for form in calls if "Call all 4 matches" in form.words)
        director.send_raw(every.action, fields_of(every.fields))
        tapped += 1
        while hall.state.standing.to_play:
            assert hall.state.on_tables, "a match is ready, and none is on a table"
            taps(hall, next(iter(hall.state.on_tables)), 1)
            tapped += 2
        results = len(hall.state.counted)
        assert results >= 36
        assert tapped == 2 + 2 * results <= 100
        assert "All matches have been played." in director.open("/desk").words


def test_a_result_stays_on_the_desk_until_it_is_read(full: Hall) -> None:
    match = on(full, 3)
    one, _ = full.state.pair(match)
    number = full.state.number_of(match)
    words = taps(full, match, 1)
    for _ in range(2):  # also when the page is opened again
        for part in (f"Match {number} is in", f"{one} beat", "Say it out loud Table", "Undo: "):
            assert part in words, words
        words = full.director.open("/desk").words
    shouted = full.state.on_tables[on(full, 3)].call.players
    assert f"Table 3: {shouted[0]} against {shouted[1]}." in words
    full.director.send("/desk/read", entry=full.state.numbers[-1])
    after = full.director.open("/desk").words
    assert "is in" not in after
    assert "Undo: " in after
    taps(full, on(full, 1), 0)
    assert "is in" in full.director.open("/desk").words


def test_the_undo_of_a_result_takes_back_the_call_that_came_with_it(full: Hall) -> None:
    before, match = full.state, on(full, 2)
    taps(full, match, 1)
    assert full.state.events[-1].by == BY_ITSELF
    assert on(full, 2) != match
    desk = full.director.open("/desk").text
    undo = next(form for form in forms_in(desk) if form.action == "/desk/undo")
    assert f"(match {before.number_of(match)})" in undo.words
    assert full.director.send_raw("/desk/undo", dict(undo.fields)).status == 200
    assert (full.state.on_tables, full.state.counted) == (before.on_tables, before.counted)
    redo = full.director.send("/desk/redo")
    assert redo.status == 200
    assert match in full.state.counted
    assert len(full.state.on_tables) == 4


def test_calls_are_made_by_hand_where_the_director_wants_it(full: Hall) -> None:
    assert (
        "You now call each match yourself." in full.director.send("/desk/calling", itself="").words
    )
    match = on(full, 4)
    words = taps(full, match, 2)
    assert 4 not in [one.call.table for one in full.state.on_tables.values()]
    assert words.count("Table 4 is free") == 1  # it is offered once
    assert "Call" in words
    full.director.send("/desk/calling", itself="yes")
    taps(full, on(full, 1), 2)
    assert 1 in [one.call.table for one in full.state.on_tables.values()]
    assert 4 not in [one.call.table for one in full.state.on_tables.values()]  # somebody keeps it


def test_two_taps_are_refused_for_a_match_that_others_play(full: Hall) -> None:
    match = on(full, 1)
    for fields in (
        {"winner": full.state.pair(on(full, 2))[0], "games": 1},
        {"winner": full.state.pair(match)[0], "games": 3},
        {"winner": "Nobody", "games": 0},
    ):
        assert full.director.send("/desk/result", match=match, **fields).status == 400
    assert not full.state.counted


def test_a_dispute_is_one_card_with_two_answers(full: Hall) -> None:
    match = on(full, 1)
    pair = full.state.pair(match)
    phones = [Phone(full.site, address=f"127.0.0.{k}") for k in (2, 3)]
    for name, phone, score in zip(pair, phones, ((3, 1), (0, 3)), strict=True):
        phone.claims(name)
        phone.taps(match, *score)
    shown = full.director.open("/desk")
    says = [form for form in forms_in(shown.text) if "won, says" in form.words]
    assert [dict(form.fields)["winner"] for form in says] == list(pair)
    assert [form.choices["games"] for form in says] == [["1"], ["0"]]
    full.director.send_raw("/desk/result", dict(says[1].fields) | {"games": "0"})
    assert full.state.counted[match].winner == pair[1]
    assert "won, says" not in full.director.open("/desk").words


def test_a_match_past_its_waiting_time_is_to_be_forfeited(full: Hall) -> None:
    match = on(full, 2)
    gone, other = full.state.pair(match)
    full.site.clock = lambda: "2031-03-01T20:00:00"
    full.director.send("/desk/wait", match=match, absent=gone, until="20:15", reason="traffic")
    assert "waiting until 20:15, traffic" in full.director.open("/desk").words
    full.site.clock = lambda: "2031-03-01T20:16:00"
    desk = full.director.open("/desk")
    assert "Waited until 20:15" in desk.words
    loud = next(form for form in forms_in(desk.text) if f"{gone} forfeits" in form.words)
    asked = full.director.send_raw(loud.action, dict(loud.fields))
    assert "Please confirm" in asked.words
    full.director.send(loud.action, match=match, player=gone, sure="yes")
    assert full.state.counted[match].winner == other


@pytest.mark.slow
@pytest.mark.parametrize("follow", ["stop", "keep"])
def test_a_correction_asks_what_happens_to_what_is_played_on_it(full: Hall, follow: str) -> None:
    full.site.clock = lambda: "2031-03-01T20:00:00"
    add_events(
        full.site.path, lambda _: [Event(full.site.clock(), Changed(labels=("1", "2", "TV", "4")))]
    )
    while not {"W2.1", "L1.1"} & {*full.state.on_tables}:
        taps(full, next(iter(full.state.on_tables)), 1)
    follower = next(one for one in ("W2.1", "L1.1") if one in full.state.on_tables)
    match = full.state.bracket.match(follower).slots[0].match  # type: ignore[union-attr]
    add_events(
        full.site.path,
        lambda s: [Event(full.site.clock(), moves.score(s, follower, (1, 0)))],
        by="phone: x",
    )
    was = full.state.counted[match]
    sat = next(one for one in (was.winner, was.loser) if one in full.state.pair(follower))
    wrong = {"match": match, "winner": was.loser, "games": 0}
    asked = full.director.send("/desk/correct", **wrong)
    number = full.state.number_of(match)
    for part in (f"Change match {number}?", f"Was {was.winner}", f"Now {was.loser}", "1-0"):
        assert part in asked.words
    assert f"Leave match {number} alone" in asked.words
    form = next(form for form in forms_in(asked.text) if form.action == "/desk/correct")
    full.director.send_raw("/desk/correct", dict(form.fields) | {"follow": follow})
    now = full.state.counted[match]
    assert now.games[was.loser] > now.games[was.winner]
    assert (sat in full.state.pair(follower)) is (follow == "keep")
    assert (follower in full.state.live) is (follow == "keep")
    assert follower in full.state.on_tables


def test_the_history_undoes_what_nothing_follows_from_and_folds_scores(full: Hall) -> None:
    first, second, third = (on(full, table) for table in (1, 2, 3))
    taps(full, first, 1)
    taps(full, second, 1)
    for by, score in (("phone: x", (1, 0)), ("phone: x", (1, 1)), ("program: tv", (2, 1))):
        add_events(
            full.site.path,
            lambda s, score=score: [Event(full.site.clock(), moves.score(s, third, score))],
            by=by,
        )
    shown = full.director.open("/desk/history")
    name = f"match {full.state.number_of(third)}"
    count = len(full.state.log)
    assert f"Score 1-0, 1-1 in {name} #{count - 1}" in shown.words
    assert f"Score 2-1 in {name} #{count} · program: tv" in shown.words
    entries = [dict(f.fields)["entry"] for f in forms_in(shown.text) if f.action == "/desk/undo"]
    entry = next(
        n
        for n, one in zip(full.state.numbers, full.state.events, strict=True)
        if getattr(one.what, "match", "") == second and type(one.what).__name__ == "Result"
    )
    assert str(entry) in entries
    assert full.director.send("/desk/undo", entry=entry, back="/desk/history").status == 200
    assert second not in full.state.counted
    assert first in full.state.counted


@pytest.mark.parametrize("page", ["/desk", "/bracket"])
def test_the_sheet_of_a_match_has_its_acts_for_the_director_alone(full: Hall, page: str) -> None:
    number = str(full.state.number_of(on(full, 1)))
    words = full.director.open(page, match=number).words
    for act in ("Take it off the table", "Let it wait", "Forfeit", "Another table", "Ended early"):
        assert act in words, act
    assert "Winner goes to match" in words
    assert "Take it off the table" not in full.guest.open(page, match=number).words
    for odd in ("0", "999", "x", "²"):
        assert "Take it off" not in full.director.open(page, match=odd).words


def test_a_reserved_table_is_given_out_from_the_sheet_of_a_match(hall: Hall) -> None:
    hall.director.send("/desk/change", tables="1-3, TV", reserved="TV")
    match = hall.state.standing.to_play[0]
    words = hall.director.open("/desk", match=str(hall.state.number_of(match))).words
    assert "Call to table 1" in words
    assert "Table TV" in words
    hall.director.send("/desk/call", match=match, table="TV")
    assert hall.state.on_tables[match].call.table == 4


def test_matches_called_by_one_tap_are_told_as_one(full: Hall) -> None:
    assert "4 matches called" in full.director.open("/desk").words


def test_more_has_everything_once(full: Hall) -> None:
    shown = full.director.open("/desk/more")
    for words in ("History and undo", "Someone came late", "Tables: 4", "Save a copy"):
        assert shown.words.count(words) == 1, words
    full.director.send("/desk/change", tables="1-2, TV, 5", reserved="TV", streamed="TV")
    assert full.state.plan.labels == ("1", "2", "TV", "5")
    assert full.state.plan.reserved == (3,)
    assert "Tables: 1-2, TV, 5" in full.director.open("/desk/more").words
    full.director.send("/desk/change", slower="1.3")
    assert full.state.plan.slower == 1.3
    assert PLAYERS[0] in full.director.open("/desk/more").text


def test_a_table_is_closed_from_its_match_and_only_that_match_leaves(hall: Hall) -> None:
    assert hall.director.send("/desk/change", tables="1-2, TV, 4").status == 200
    for table in range(1, 5):
        match = hall.state.standing.to_play[table - 1]
        assert hall.director.send("/desk/call", match=match, table=table).status == 200
    before = hall.state
    gone = on(hall, 3)
    sheet = hall.director.open(f"/desk?match={before.number_of(gone)}").text
    close = next(form for form in forms_in(sheet) if "Close table TV" in form.words)
    # More sends the tables that were kept for calls by hand too, as they were.
    fields = dict(close.fields) | {"reserved": "TV", "streamed": "TV, 4"}
    assert hall.director.send_raw("/desk/change", fields | {"sure": "yes"}).status == 200
    names = hall.state.plan.table_name
    assert {names(one.call.table): n for n, one in hall.state.on_tables.items()} == {
        before.plan.table_name(one.call.table): n
        for n, one in before.on_tables.items()
        if n != gone
    }
    assert hall.state.plan.streamed == (3,)
    assert not hall.state.plan.reserved


def test_the_card_of_an_act_has_that_act_alone(full: Hall) -> None:
    taps(full, on(full, 1), 1)
    words = taps(full, on(full, 2), 1)
    card = words[words.index("is in") : words.index("OK")]
    called = full.state.on_tables[on(full, 2)].call.players
    assert card.count("Table 2: ") == 1
    assert f"Table 2: {called[0]} against {called[1]}." in card
    assert "Table 1: " not in card
    assert "Winner goes to match" in card


def test_an_undo_can_be_redone_from_the_desk(full: Hall) -> None:
    match = on(full, 2)
    taps(full, match, 1)
    undo = next(f for f in forms_in(full.director.open("/desk").text) if f.action == "/desk/undo")
    full.director.send_raw("/desk/undo", dict(undo.fields))
    redo = next(f for f in forms_in(full.director.open("/desk").text) if f.action == "/desk/redo")
    assert redo.words.strip().startswith("Redo: ")
    assert full.director.send_raw("/desk/redo", dict(redo.fields)).status == 200
    assert match in full.state.counted
    assert "Redo: " not in full.director.open("/desk").words


def test_a_match_that_waits_says_for_whom_and_ends_its_wait_by_one_tap(full: Hall) -> None:
    match = on(full, 2)
    name, number = full.state.pair(match)[0], full.state.number_of(match)
    full.director.send("/desk/wait", match=match, absent=name, until="23:59")
    sheet = full.director.open(f"/desk?match={number}")
    assert f"Waiting for {name} until 23:59" in sheet.words
    here = next(form for form in forms_in(sheet.text) if form.words.strip() == "They're here")
    assert full.director.send_raw("/desk/wait", dict(here.fields)).status == 200
    assert not full.state.waiting_for
    words = full.director.send("/desk/forfeit", player=name, match=match, sure="yes").words
    assert f"{name} is going home" in words
