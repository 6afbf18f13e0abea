"""A whole evening through the page: by the director and by players' phones, as by commands."""

import os
import random
import threading
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from evenbreak.files.store.changes import rows_from
from evenbreak.files.store.desk import phone_entries
from evenbreak.files.store.prizes import kept_prizes
from evenbreak.files.store.tournament import (
    add_events,
    new_tournament,
    read_events,
    read_tournament,
)
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Event
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.money.payouts import PrizeMoney
from evenbreak.web.night import mark_of
from web.conftest import Hall, begun
from web.phones import Phone, answering, is_working, style_of, two_phones

Decide = Callable[[Evening], object]


def scored_by_phones(hall: Hall, match: str, score: tuple[int, int]) -> list[Phone]:
    """Let both players of a match tap its games and enter the result; return their phones."""
    phones = two_phones(hall.site)
    for name, phone in zip(hall.state.pair(match), phones, strict=True):
        hall.director.send("/desk/release", player=name)
        assert phone.claims(name).status == 200
    for a, b in [(min(score[0], k), 0) for k in range(1, score[0])]:
        assert phones[0].taps(match, a, b).status == 200
    for phone in phones:
        assert phone.taps(match, *score).status == 200
    return phones


@pytest.mark.slow
def test_an_evening_ends_as_by_commands(hall: Hall, tmp_path: Path) -> None:
    luck = random.Random(3)
    done: list[Decide] = []
    assert hall.director.send("/desk/late", player="Late Larry", rating="610").status == 400
    entered = 0
    while hall.state.standing.to_play:
        name = luck.choice(list(hall.state.standing.to_play))
        needs = hall.state.needed(name, hall.state.pair(name))
        score = (needs[0], luck.randrange(needs[1]))
        score = score if luck.random() < 0.6 else (luck.randrange(needs[0]), needs[1])
        if entered in (5, 11):
            scored_by_phones(hall, name, score)
        else:
            shown = hall.director.send("/desk/result", match=name, a=score[0], b=score[1])
            assert shown.status == 200, shown.words
        done.append(lambda state, n=name, s=score: moves.result(state, n, s))
        entered += 1
        if entered == 14:
            wrong = "W1.1"
            games = hall.state.counted[wrong].score
            shown = hall.director.send(
                "/desk/correct", match=wrong, a=games[1], b=games[0], sure="yes"
            )
            assert shown.status == 200
            done.append(lambda state, g=games: moves.correct(state, "W1.1", g[::-1]))
    assert entered >= 30
    for _ in range(100):  # places come with the odds, which a busy machine is longer at
        shown = hall.guest.open("/")
        if "Result" in shown.words:
            break
        assert is_working(shown.text)
        time.sleep(0.1)
    assert "Result" in shown.words

    events = read_events(hall.site.path)
    plain = tmp_path / "commands.db"
    new_tournament(plain, events[:2])
    for decide in done:
        add_events(plain, lambda state, d=decide: [Event("2025-03-01T20:00:00", d(state))])
    assert read_tournament(plain).counted == hall.state.counted
    assert "phones: " in " ".join(one.by for one in events)


@pytest.mark.slow
def test_two_phones_that_differ_leave_it_to_the_director(hall: Hall) -> None:
    pair = hall.state.pair("W1.1")
    one, other = two_phones(hall.site)
    assert one.taps("W1.1", 3, 1).status == 403
    one.claims(pair[0])
    other.claims(pair[1])
    assert "counts once" in one.taps("W1.1", 3, 1).words
    assert "Two scores" in other.taps("W1.1", 1, 3).words
    assert "Two scores" in one.open("/me").words
    assert "W1.1" not in hall.state.counted
    assert [one.kind for one in phone_entries(hall.site.path)].count("proposed") == 2
    assert hall.director.open("/desk").words.count("won, says ") == 2
    assert hall.director.send("/desk/result", match="W1.1", a=3, b=1).status == 200
    assert hall.state.counted["W1.1"].winner == pair[0]


@pytest.mark.slow
def test_an_undone_result_is_not_confirmed_by_what_was_sent_before(hall: Hall) -> None:
    phone, _ = scored_by_phones(hall, "W1.1", (3, 1))
    assert "W1.1" in hall.state.counted
    hall.director.send("/desk/undo", entry=hall.state.numbers[-1])
    assert "sent it" not in hall.director.open("/desk").words
    assert "counts once" in phone.taps("W1.1", 3, 1).words
    assert "W1.1" not in hall.state.counted


@pytest.mark.slow
def test_what_was_sent_against_somebody_else_differs_from_nothing(hall: Hall) -> None:
    for match in ("W1.1", "W1.2"):
        hall.director.send("/desk/result", match=match, a=3, b=0)
    phones = two_phones(hall.site)
    phones[0].claims(hall.state.pair("W2.1")[0])
    phones[0].taps("W2.1", 3, 1)
    hall.director.send("/desk/correct", match="W1.2", a=1, b=3)
    phones[1].claims(hall.state.pair("W2.1")[1])
    shown = phones[1].taps("W2.1", 0, 3)
    assert shown.status == 200
    assert "Two scores" not in shown.words


@pytest.mark.slow
def test_both_phones_at_the_same_moment_agree(hall: Hall) -> None:
    matches, codes = [f"W1.{k}" for k in range(1, 6)], []
    for match in matches:
        phones = two_phones(hall.site)
        for name, phone in zip(hall.state.pair(match), phones, strict=True):
            phone.claims(name)
        together = threading.Barrier(2)

        def enter(phone: Phone, match: str, at: threading.Barrier) -> None:
            at.wait()
            codes.append(phone.taps(match, 3, 1).status)

        said = match, together
        threads = [threading.Thread(target=enter, args=(phone, *said)) for phone in phones]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert set(codes) <= {200, 409}  # 409: the match was over already
    assert set(hall.state.counted) == set(matches)


def test_the_director_sees_that_a_match_is_played_without_a_call(hall: Hall) -> None:
    phone = Phone(hall.site)
    phone.claims(hall.state.pair("W1.1")[0])
    assert phone.taps("W1.1", 2, 1).status == 200
    assert "Already playing, not called yet: 2-1" in hall.director.open("/desk").words


def test_phones_of_a_match_that_others_play_now_are_refused(hall: Hall) -> None:
    assert hall.guest.taps("W1.1", 1, 0, player_a="Ann", player_b="Bo").status == 409


@pytest.mark.slow
def test_many_phones_at_once_lose_nothing(hall: Hall) -> None:
    matches = [f"W1.{k}" for k in range(1, 9)]
    codes = []

    def enter(name: str) -> None:
        phone = Phone(hall.site, director=True)
        shown = phone.send("/desk/result", match=name, a=3, b=1)
        codes.append(shown.status)

    threads = [threading.Thread(target=enter, args=(name,)) for name in matches]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert codes == [200] * 8
    assert set(hall.state.counted) == set(matches)


@pytest.mark.parametrize("path", ["/", "/me", "/bracket", "/screen", "/fair"])
def test_a_page_is_small_and_needs_nothing_from_elsewhere(standing_hall: Hall, path: str) -> None:
    shown = standing_hall.guest.open(path)
    assert standing_hall.guest.travels(path) < 60_000
    assert "src=" not in shown.text
    assert "//" not in shown.text.replace("http://127.0.0.1", "").split("</script>")[-1]


def test_the_first_page_is_small_even_where_it_is_not_compressed(
    standing_hall: Hall, tmp_path: Path
) -> None:
    def size(phone: Phone, path: str) -> int:
        text = phone.open(path).text
        return len((text + phone.open(style_of(text)).text).encode())

    player = Phone(standing_hall.site, address="127.0.0.5")
    assert player.claims("Player 5").status == 200
    with answering(tmp_path / "before.db") as site:
        for phone in (standing_hall.guest, player, Phone(site)):
            for path in ("/", "/me"):
                assert phone.travels(path) < size(phone, path) / 2 < 30_000


@pytest.mark.slow
def test_several_matches_are_called_with_one_tap(hall: Hall) -> None:
    asked = {"match": ["W1.1", "W1.2", "W1.3"], "table": [1, 2, 3]}
    for _ in range(2):  # a double tap
        shown = hall.director.send("/desk/call", **asked)
        assert shown.status == 200
    assert {name: one.call.table for name, one in hall.state.on_tables.items()} == {
        f"W1.{n}": n for n in (1, 2, 3)
    }
    for taken in ([4, 4], [3, 4]):  # none is called then
        assert hall.director.send("/desk/call", match=["W1.4", "W1.5"], table=taken).status == 400
    assert len(hall.state.on_tables) == 3


@pytest.mark.slow
def test_a_match_that_was_played_on_a_wrong_result_may_stand(hall: Hall) -> None:
    enter = partial(hall.director.send, "/desk/result")
    correct = partial(hall.director.send, "/desk/correct")
    for name in ("W1.1", "W1.2"):
        enter(match=name, a=3, b=1)
    enter(match="W2.1", a=3, b=0)
    played = hall.state.counted["W2.1"]
    shown = correct(match="W1.1", a=1, b=3)
    assert "Change match 1?" in shown.words
    assert "no longer counts" in shown.words
    assert hall.state.counted["W2.1"] == played
    shown = correct(match="W1.1", a=1, b=3, sure="yes")
    assert "W2.1" not in hall.state.counted
    number = hall.state.number_of("W2.1")
    assert f"Match {number} doesn't count now" in shown.words
    assert hall.director.send("/desk/stand", match="W1.2").status == 400
    assert hall.guest.send("/desk/stand", match="W2.1").status == 403
    assert hall.director.send("/desk/stand", match="W2.1").status == 200
    assert hall.state.counted["W2.1"] == played
    assert hall.state.counted["W1.1"].score == (1, 3)


@pytest.mark.slow
def test_a_match_moves_to_another_table_and_keeps_its_start(hall: Hall) -> None:
    hall.site.clock = lambda: "2025-03-01T20:00:00"
    hall.director.send("/desk/call", match="W1.1", table=1)
    hall.site.clock = lambda: "2025-03-01T20:20:00"
    assert hall.director.send("/desk/call", match="W1.1", table=3).status == 200
    moved = hall.state.on_tables["W1.1"]
    assert (moved.call.table, moved.at) == (3, "2025-03-01T20:00:00")
    hall.director.send("/desk/call", match="W1.2", table=1)
    assert hall.director.send("/desk/call", match="W1.1", table=1).status == 400  # taken
    assert list(hall.state.on_tables) == ["W1.1", "W1.2"]


def test_pages_follow_the_file_whoever_writes_it(hall: Hall) -> None:
    at = "2025-03-01T20:00:00"
    add_events(hall.site.path, lambda state: [Event(at, moves.result(state, "W1.1", (3, 2)))])
    assert "3" in hall.guest.open("/bracket").words
    assert "W1.1" not in hall.guest.open("/desk").words
    assert len(hall.state.events) == 3


def test_prizes_that_the_director_keeps_are_seen_by_everybody(hall: Hall) -> None:
    asked = {"fee": 20, "added": 80, "payout": "50/30/20"}
    assert hall.guest.send("/prizes", **asked).status == 403
    tried = hall.director.open("/prizes", fee="20", added="80", payout="50/30/20")
    assert "Save these prizes" in tried.words
    assert "Save these prizes" not in hall.guest.open("/prizes", fee="20").words
    assert "The prizes are saved" in hall.director.send("/prizes", **asked).words
    assert "Prizes 200 · 120 · 80" in hall.guest.open("/").words
    assert "Prizes 200 · 120 · 80" in hall.guest.open("/screen", only="tables").words
    assert "400.00 is paid to 3 places" in hall.guest.open("/prizes").words
    assert hall.director.send("/prizes", fee=5, payout="hoboken").status == 400
    assert "216.00 is paid" in hall.guest.open("/prizes", fee="13,50", payout="100").words
    for wrong in ("1e5", "nan", "-1", "12.345", "99999999"):
        assert hall.guest.open("/prizes", fee=wrong).status == 400
    assert "Enter your own shares" in hall.guest.open("/prizes", fee="5", payout="hoboken").words
    assert kept_prizes(hall.site.path) == PrizeMoney(20.0, 80.0, payout="50/30/20")
    state = hall.state.events
    new_tournament(hall.site.path, state[:1], in_place_of=len(state))
    assert kept_prizes(hall.site.path) is None


@pytest.mark.slow
def test_players_see_when_they_play_next_and_what_they_may_win(hall: Hall) -> None:
    hall.director.send("/desk/call", match="W1.1", table=1)
    hall.guest.open("/")
    for _ in range(100):
        words = hall.guest.open("/players").words
        if "next: against" in words:
            break
        time.sleep(0.05)
    assert words.count("Table 1 ") == 2
    assert words.count(", next: against") == 6
    assert words.count("next match about") == 8
    shown = hall.guest.open("/prizes", fee="20", payout="40/30/20/10").words
    assert "128.00 for the winner" in shown
    assert hall.guest.open("/prizes", fee="-1").status == 400
    shown = hall.guest.open("/prizes", fee="20", payout="50/30/20").words
    assert "160.00 for the winner" in shown
    for wrong in ("all mine", "60/50", "0/0", "50/-10", "nan"):
        assert hall.guest.open("/prizes", fee="9", payout=wrong).status == 400


@pytest.mark.slow
def test_pages_follow_a_file_of_any_name(tmp_path: Path) -> None:
    path = tmp_path / "pool #3 50%?.db"
    assert rows_from(path, 0, 9) == []
    with answering(path) as site:
        begun(Phone(site, director=True), ["Ann", "Bo"])
    assert rows_from(path, 0, 9)
    assert [one.name for one in tmp_path.iterdir() if not one.name.startswith(path.name)] == []


def test_what_was_just_written_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    path.write_bytes(b"x")
    assert mark_of(path) != mark_of(path)  # it may change again within a tick of the clock
    os.utime(path, (1e9, 1e9))
    assert mark_of(path) == mark_of(path)
