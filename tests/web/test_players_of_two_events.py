"""Players of two events of a night: one phone, one code, one page, whichever event they play in."""

import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from evenbreak.files.store.desk import phone_entries
from evenbreak.files.store.tournament import read_tournament
from evenbreak.web.codes import LETTERS
from evenbreak.web.site import Site
from web.conftest import Hall, copied, hall_of
from web.phones import Phone, answering, free_port
from web.test_kills import started


@pytest.fixture(scope="module")
def second_chance(drawn: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file of a night whose losers play a second chance, its first match on table 3."""
    path = copied(drawn, tmp_path_factory.mktemp("two") / "tonight.db")
    with hall_of(path) as hall:
        starts(hall)
    return path


@pytest.fixture
def two(second_chance: Path, tmp_path: Path) -> Iterator[Hall]:
    with hall_of(copied(second_chance, tmp_path / "tonight.db")) as hall:
        yield hall


def starts(hall: Hall) -> None:
    """Let four lose twice, and start the second chance."""
    for match in [f"W1.{k}" for k in range(1, 9)] + [f"L1.{k}" for k in range(1, 5)]:
        assert hall.director.send("/desk/result", match=match, a=2 + (match[0] == "W"), b=0)
    for match in hall.state.on_tables:
        hall.director.send("/desk/uncall", match=match)
    assert hall.director.send("/desk/second-chance", race=2).status == 200
    assert hall.director.send("/desk/draw", event=2).status == 200
    first = next(iter(second(hall).standing.to_play))
    assert hall.director.send("/desk/call", match=first, table=3, event=2).status == 200


def second(hall: Hall):
    return read_tournament(hall.site.path, 2)


def taps(phone: Phone, match: str, pair: tuple[str, str], a: int, b: int):
    seen = {"player_a": pair[0], "player_b": pair[1], "seen": "0:0", "event": 2}
    return phone.send("/me/score", match=match, a=a, b=b, **seen)


@pytest.mark.slow
def test_a_phone_follows_its_player_into_the_event_that_they_play(two: Hall) -> None:
    (match,) = second(two).on_tables
    pair = second(two).pair(match)
    phones = [Phone(two.site, address=f"127.0.0.{k}") for k in (2, 3)]
    for phone, name in zip(phones, pair, strict=True):
        assert "You're up: table 3" in phone.claims_by_code(name).words
        assert phone.open("/table/3").url.endswith("/me")
    assert pair[0] in Phone(two.site).open("/table/3").words
    for phone in phones:
        said = taps(phone, match, pair, 2, 1)
        assert said.status == 200, said.words
    assert second(two).counted[match].score == (2, 1)
    assert len(two.state.counted) == 12  # in the first event nothing has happened
    assert [one.what.event for one in phone_entries(two.site.path) if one.what.match] == [2, 2, 2]


def test_a_proposal_of_one_event_is_none_in_the_other(two: Hall) -> None:
    (match,) = second(two).on_tables
    pair = second(two).pair(match)
    phone = Phone(two.site, address="127.0.0.2")
    phone.claims_by_code(pair[0])
    taps(phone, match, pair, 2, 0)
    first, other = (night.phones() for night in two.site.nights)
    assert not first.sides(match, pair).proposed
    assert list(other.sides(match, pair).proposed) == [pair[0]]
    assert first.claims.keys() == other.claims.keys() == {pair[0]}


def test_nobody_has_two_codes_and_everybody_has_one(two: Hall) -> None:
    codes = two.site.player_codes()
    everybody = {*two.state.entrants, *second(two).entrants}
    assert codes.keys() == everybody
    assert len(set(codes.values())) == len(codes)


@pytest.mark.slow
def test_the_tablet_of_a_table_serves_every_event_and_says_what_is_wrong(two: Hall) -> None:
    (match,) = second(two).on_tables
    pair = second(two).pair(match)
    tablet = Phone(two.site, director=True)
    assert tablet.send("/table/3/tablet", give="yes").status == 200
    seen = {"player_a": pair[0], "player_b": pair[1], "seen": "0:0", "event": 2}
    shown = tablet.send("/table/3/score", match=match, a=2, b=0, **seen)
    assert "That's wrong" in shown.words
    assert second(two).counted[match].score == (2, 0)
    assert "tablet for table 3" in two.director.open("/desk?event=2").words
    (following,) = (name for name, on in two.state.on_tables.items() if on.call.table == 3)
    form = re.search(r'action="/table/3/wrong">.*?</form>', shown.text, re.DOTALL)
    assert form
    asked = dict(re.findall(r'name="(\w+)" value="([^"]*)"', form[0]))
    assert "The director knows" in tablet.send_raw("/table/3/wrong", asked).words
    assert tablet.send("/table/3/score", match=following, a=1, b=0).status == 200
    assert two.state.live[following].what.score == (1, 0)
    two.director.send("/table/3/tablet", give="no")
    assert tablet.send("/table/3/score", match=following, a=2, b=0).status == 403
    assert tablet.send("/table/3/wrong", match=match, event=2).status == 403


def test_nobody_answers_under_a_player_s_name_from_another_phone(hall: Hall) -> None:
    pair, luck = hall.state.pair("W1.1"), random.Random(1)
    owner, thief = (Phone(hall.site, address=f"127.0.0.{k}") for k in (2, 3))
    owner.claims(pair[0])
    owner.taps("W1.1", 3, 1)
    before = phone_entries(hall.site.path)
    (token,) = {owner.token()}
    forged = {"csrf": token, "once": "1", "begun": hall.site.night.begun_at}
    score = {"match": "W1.1", "player_a": pair[0], "player_b": pair[1], "seen": "0:0"}
    attacks = [
        thief.taps("W1.1", 1, 3),
        thief.send("/me/withdraw", match="W1.1"),
        thief.send("/me/claim", name=pair[0]),
        thief.send("/me/code", code="".join(luck.choices(LETTERS, k=5))),
        thief.send_raw("/me/score", {**forged, **score, "a": 1, "b": 3}),
        thief.send("/me/score", **score, a=1, b=3, event=2),
        thief.send("/me/score", **score, a=1, b=3, player=pair[0], name=pair[0]),
        thief.send("/table/1/score", **score, a=1, b=3),
        thief.send("/table/1/wrong", match="W1.1"),
        thief.send("/desk/release", player=pair[0]),
        thief.send("/table/1/tablet", give="yes"),
    ]
    assert {one.status for one in attacks} <= {403, 404, 409}, [one.status for one in attacks]
    assert phone_entries(hall.site.path) == before


@pytest.mark.slow
def test_phones_go_on_after_a_kill_on_another_address_by_their_codes(hall: Hall) -> None:
    """The lid is closed, the laptop starts again elsewhere: what came in before stays."""
    pair, path = hall.state.pair("W1.1"), hall.site.path
    port = free_port()
    server = started(path, port)
    site = Site(path, address=f"http://127.0.0.1:{port}")
    one = Phone(site, address="127.0.0.2")
    one.claims_by_code(pair[0])
    form = {**one.hidden(), "match": "W1.1", "player_a": pair[0], "player_b": pair[1]}
    form |= {"seen": "0:0", "a": 3, "b": 1}
    assert "counts once" in one.send_raw("/me/score", form).words
    server.kill()
    server.wait()
    with answering(path) as again:  # another port; phones know it by the wall's code
        known = phone_entries(path)
        one.site = again
        assert one.send_raw("/me/score", form).status == 200  # the form that was kept
        assert phone_entries(path) == known
        new, other = (Phone(again, address=f"127.0.0.{k}") for k in (4, 3))
        assert "Waiting for" not in new.claims_by_code(pair[0]).words  # a phone without the cookie
        assert one.open("/me").words.startswith("Who are you?")
        new.taps("W1.1", 3, 1)
        other.claims_by_code(pair[1])
        assert "You both agree" in other.taps("W1.1", 3, 1).words
    assert read_tournament(path).counted["W1.1"].score == (3, 1)
