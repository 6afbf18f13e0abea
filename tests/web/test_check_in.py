"""Check-in before the draw: here, paid, who registers by phone; and the night to take home."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path

from evenbreak.files.store.tournament import read_tournament
from web.conftest import PLAYERS, Hall, begun
from web.phones import Phone, answering
from web.test_new_tournament import ASKED


def test_the_draw_is_of_those_who_are_here(tmp_path: Path) -> None:
    """The absent wait on the list, a phone registers, the pot is of those who paid."""
    with answering(tmp_path / "tonight.db") as site:
        director, guest = Phone(site, director=True), Phone(site)
        director.send("/new", **ASKED, fee=20, added=10)
        shown = director.open("/desk/check-in")
        assert "Draw 4 players" in shown.words
        assert "everyone plays" in shown.words
        assert guest.open("/desk/check-in").status == 403
        for name, fields in {
            "Ann": {"arrived": "yes", "paid": "yes"},
            "Bo": {"arrived": "yes"},
            "Di": {"paid": "yes"},
        }.items():
            asked = {"player": name, "back": "/desk/check-in"}
            shown = director.send("/desk/check-in", **asked, **fields)
            assert shown.url.endswith("/desk/check-in")
        assert "2 here, of 4" in shown.words
        assert "2 paid" in shown.words
        assert "50 in the pot" in shown.words
        assert "Draw 2 players 2 are not here · 1 hasn't paid" in shown.words
        rows = shown.words.partition("Player Here Paid")[2]
        order = [rows.index(f" {name} ") for name in ("Ann", "Bo", "Cy", "Di")]
        assert order == sorted(order)  # no tap moves a row

        assert "The director will let you in" in guest.send("/play", name="Eve", rating=530).words
        assert "is asking to play · says 530" in director.open("/desk/check-in").words
        other = Phone(site)
        other.send("/play", name="Fox")
        director.send("/desk/decline", name="Fox", back="/desk/check-in")
        assert "isn't on tonight's list" in other.open("/play").words
        assert "Eve has entered" in director.send("/desk/accept", name="Eve").words
        assert guest.open("/play").url.rstrip("/") == site.address
        director.send("/desk/check-in", player="Eve", arrived="yes")
        assert other.send("/play", name="ann").status == 400  # she is in already

        director.send("/desk/draw", here="yes")
        state = read_tournament(site.path)
        assert set(state.entrants) == {"Ann", "Bo", "Eve"}
        assert set(state.registered) == {"Cy", "Di"}
        shown = director.open("/desk/check-in")
        assert "Cy is asking to play" in shown.words
        assert "Draw" not in shown.words.partition("Player Here Paid")[2]
        people = director.open("/next").text
        assert all(name in people for name in ("Cy, 500", "Di, 480", "Eve, 530"))


def test_a_tournament_begins_with_nobody_and_players_register_themselves(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director, phones = Phone(site, director=True), [Phone(site) for _ in range(3)]
        asked = ASKED | {"entrants": "", "scale": "fargo", "tables": 2}
        shown = director.send("/new", **asked)
        assert shown.url.endswith("/desk/check-in")
        for path in ("/", "/players", "/desk", "/desk/more", "/screen"):
            assert director.open(path).status == 200
        assert "2 to 256 players" in director.send("/desk/draw").words
        for phone, name in zip(phones, ("Ann", "Bo", "Cy"), strict=True):
            phone.send("/play", name=name, rating=530)
        director.send("/desk/accept", name="Ann")
        assert "Without the rating" in director.open("/desk/check-in").words
        director.send("/desk/accept", name="Bo", unrated="yes")
        director.send("/desk/draw")
        state = read_tournament(site.path)
    assert state.drawn
    assert state.entrants["Ann"].rating == 530
    assert state.unrated == {"Bo"}
    assert state.registered == {"Cy": 530}


def test_the_director_changes_players_and_everybody_sees_them(hall: Hall) -> None:
    shown = hall.director.open("/players")
    assert len(re.findall(r"Code: \w{4,5}", shown.words)) == 16
    assert "Code" not in hall.guest.open("/players").words
    back = {"back": "/players"}
    hall.director.send("/desk/rename", player="Player 3", to="Cy Young", **back)
    hall.director.send("/desk/substitute", player="Player 4", to="Di Ray", rating=480, **back)
    shown = hall.director.send("/desk/swap", one="Player 1", other="Player 2", **back)
    assert shown.url.endswith("/players")
    assert {"Cy Young", "Di Ray"} <= set(hall.state.entrants)
    hall.director.send("/desk/drop", player="Player 9", sure="yes", **back)
    words = hall.guest.open("/players").words
    assert "Cy Young" in words
    assert "has left" in words


def test_the_night_to_take_home_needs_nobody_else(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        begun(director, PLAYERS[:4])
        hall = Hall(site, director, Phone(site))
        assert "isn't over yet" in hall.guest.open("/share").words
        hall.director.send("/prizes", fee=10, house=10, unit=5)
        while hall.state.standing.to_play:
            match = hall.state.standing.to_play[0]
            need = hall.state.needed(match, hall.state.pair(match))
            hall.director.send("/desk/result", match=match, a=need[0], b=1)
        for _ in range(200):
            shown = hall.guest.open("/share")
            if "Champion" in shown.words:
                break
        champion = hall.state.counted[list(hall.state.counted)[-1]].winner
        assert f"Champion · 25 {champion}" in shown.words
        page = hall.guest.open("/share.html")
        assert page.headers["content-security-policy"].startswith("default-src 'none'")
        assert not re.findall(r"(?:src|href|url)\s*[=(]\s*[\"']?(?!#)[^\"'# >]", page.text)
        assert "<script" not in page.text
        for name in hall.state.entrants:
            assert name in page.text
        assert page.text.count("<polyline") > 2
        rows = list(csv.DictReader(io.StringIO(hall.guest.open("/share.csv").text)))
        assert len(rows) == len(hall.state.counted)
