"""The league on the page: results in, ratings and files out, why a race is fair."""

import asyncio
import csv
import io
import threading
import time
import zipfile
from collections.abc import Iterator
from datetime import datetime
from pathlib import Path

import pytest

from evenbreak.files.results.results_file import read_results
from evenbreak.files.store.tournament import read_tournament
from evenbreak.ratings import usual
from evenbreak.ratings.scale import SCALES
from evenbreak.ratings.usual import usual_ratings
from evenbreak.web.league import League
from places import DATA
from web.conftest import Hall
from web.phones import Phone, Shown, answering, is_working

RUDE = "=1+1<script>alert(1)</script>"
SMALL = f"""player_a,player_b,score_a,score_b
Ann,Bo,7,5
"{RUDE}",Ann,7,2
علي,Bo,3,7
Bo,"{RUDE}",7,6
"""


def rated(phone: Phone, content: str, **fields: object) -> Shown:
    """Give results and wait for the ratings."""
    shown = phone.send("/league", results=content, scale="fargo", race=7, **fields)
    assert shown.status == 200, shown.words
    return worked_out(phone)


def worked_out(phone: Phone) -> Shown:
    """Wait for the ratings."""
    for _ in range(200):
        shown = phone.open("/league")
        if not is_working(shown.text):
            return shown
        time.sleep(0.02)
    raise AssertionError(shown.words)


@pytest.fixture(scope="module")
def director(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Phone]:
    with answering(tmp_path_factory.mktemp("league") / "tonight.db") as site:
        phone = Phone(site, director=True)
        rated(phone, (DATA / "demo_league.csv").read_text(encoding="utf-8"))
        yield phone


@pytest.mark.slow
def test_the_ratings_are_those_of_the_command(director: Phone) -> None:
    ratings, _ = usual_ratings(
        read_results(DATA / "demo_league.csv").results, scale=SCALES["fargo"]
    )
    shown = Phone(director.site).open("/league/ratings.csv")
    rows = list(csv.DictReader(io.StringIO(shown.text)))
    assert len(rows) == len(ratings.players)
    by_name = dict(zip(ratings.players, ratings.rating, strict=True))
    assert all(abs(float(row["rating"]) - by_name[row["player"]]) < 1e-5 for row in rows)
    assert rows[0]["player"] in Phone(director.site).open("/league").words


@pytest.mark.slow
def test_a_player_sees_matches_and_why_a_race_is_fair(director: Phone) -> None:
    guest = Phone(director.site)
    first, second, *_ = read_results(DATA / "demo_league.csv").results.players
    for _ in range(100):
        shown = guest.open("/league/player", name=first, other=second)
        if not is_working(shown.text):
            break
        time.sleep(0.05)
    assert shown.text.count("<tr>") > 10
    assert second in shown.words
    assert guest.open("/league/player", name="Nobody").status == 400
    german = Phone(director.site, language="de").open("/league/player", name="Zoë")
    assert "Nicht in der Liga: 'Zoë' (gemeint: 'Zoë Kestleman'?)" in german.words


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sheet.pdf", "sheet.html", "sheet.xlsx", "matchups.csv"])
def test_files_to_take_along(director: Phone, name: str) -> None:
    with director.opener.open(f"{director.site.address}/league/{name}") as got:
        content = got.read()
    begins = {"pdf": b"%PDF", "html": b"<!doctype html>", "xlsx": b"PK", "csv": b"player_a"}
    assert content.startswith(begins[name.rpartition(".")[2]])


def test_results_of_more_than_a_megabyte_can_be_pasted(director: Phone) -> None:
    again = SMALL + "\n" * (1 << 20)
    shown = director.send_files("/league", {}, results=again, scale="no such scale", race=7)
    assert "no such scale" in shown.words  # it was read: only the scale is refused


def test_only_the_director_gives_results(director: Phone) -> None:
    assert Phone(director.site).send("/league", results=SMALL, scale="fargo").status == 403


def test_wrong_results_are_refused_by_line_and_the_old_ones_kept(director: Phone) -> None:
    before = director.open("/league/ratings.csv").text
    shown = director.send(
        "/league", results="player_a,player_b,score_a,score_b\nAnn,Bo,x,5\n", scale="fargo"
    )
    assert shown.status == 400
    assert "Line 2: score_a 'x'" in shown.words
    assert director.send("/league", results=" ", scale="fargo").status == 400
    assert director.send("/league", results=SMALL, scale="best").status == 400
    assert director.open("/league/ratings.csv").text == before


@pytest.mark.slow
def test_rude_names_do_no_harm_and_a_restart_goes_on(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    with answering(path) as site:
        shown = rated(Phone(site, director=True), SMALL)
        assert "<script>alert" not in shown.text
    assert (tmp_path / "tonight.league.csv").read_text(encoding="utf-8").split() == SMALL.split()
    with answering(path) as site:
        guest = Phone(site)
        for _ in range(200):
            if "علي" in guest.open("/league").words:
                break
            time.sleep(0.02)
        assert "'=1+1" in guest.open("/league/ratings.csv").text
        assert "<script>alert" not in guest.open("/league/sheet.html").text
        with guest.opener.open(f"{site.address}/league/sheet.xlsx") as got:
            packed = zipfile.ZipFile(io.BytesIO(got.read()))
        cells = b"".join(packed.read(name) for name in packed.namelist())
        assert b"<f>" not in cells
        assert b"<script>alert" not in cells


@pytest.mark.slow
def test_the_leagues_ratings_serve_tonight(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        rated(director, (DATA / "demo_league.csv").read_text(encoding="utf-8"))
        one, other, *_ = site.league.sheet.ratings.players
        fair = director.open("/fair", a=one.upper(), b=other, race="7").words
        assert one in fair
        assert director.open("/fair", a=one, b="Nobody", race="7").status == 400
        asked = {"race": 3, "tables": 1, "discipline": "9-ball", "seeding": "listed"}
        shown = director.send(
            "/new",
            entrants=f"{one}\n{other}\nNew Ned",
            format="single",
            races="even",
            scale="npl",
            league="yes",
            **asked,
        )
        assert shown.status == 200, shown.words
        found = read_tournament(site.path)
        assert found.scale.text == "fargo"
        assert found.entrants[one].rating == site.league.known(one)[1]
        assert found.entrants["New Ned"].rating == SCALES["fargo"].center


def test_a_match_known_by_its_winner_and_a_handicapped_one_are_shown_as_they_ended(
    tmp_path: Path,
) -> None:
    season = "date,player_a,player_b,race_a,race_b,score_a,score_b,winner\n"
    season += "2026-01-05,Ann,Bo,5,3,4,3,b\n2026-01-12,Bo,Ann,7,7,,,a\n"
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        rated(director, season)
        rows = director.open("/league/player", name="Bo").text.split("<tr>")[2:]
        assert "2026-01-12" in rows[0]
        assert "0:0" not in rows[0]
        assert "won" in rows[0]
        assert "3-4" in rows[1]
        assert "won" in rows[1]


def test_whatever_goes_wrong_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ArithmeticError("the ratings did not settle")

    monkeypatch.setattr(usual, "usual_ratings", fail)
    with answering(tmp_path / "tonight.db") as site:
        shown = rated(Phone(site, director=True), SMALL)
        assert "The ratings did not settle" in shown.words


def test_whoever_asks_for_many_pairs_holds_nobody_up(tmp_path: Path) -> None:
    league, begun, go_on = League(tmp_path / "tonight.db", sheet=object()), [], threading.Event()

    def work(_: object, pair: tuple[int, int]) -> tuple[int, int]:
        begun.append(pair)
        go_on.wait(10)
        return pair

    async def ask() -> list[object]:
        for k in range(60):
            assert await league.why((0, k), work, 0.0) is None
        go_on.set()
        return [await league.why((0, k), work, 5.0) for k in range(4)]

    assert asyncio.run(ask()) == [(0, k) for k in range(4)]
    assert len(begun) == 4


@pytest.mark.slow
def test_an_evening_is_added_to_the_league_once(hall: Hall) -> None:
    director, league = hall.director, hall.site.league
    assert director.send("/league/tonight").status == 409  # nothing has been played
    for k in range(1, 9):
        director.send("/desk/result", match=f"W1.{k}", a=3, b=k % 3)
    assert hall.guest.send("/league/tonight").status == 403
    shown = hall.guest.open("/results.csv")
    assert len(shown.text.splitlines()) == 9
    assert director.send("/league/tonight").status == 200
    worked_out(director)
    assert (len(league.sheet.file.results), len(league.sheet.ratings.players)) == (8, 16)
    director.send("/desk/correct", match="W1.1", a=2, b=3)
    director.send("/league/tonight")  # again: in place of what was added before
    worked_out(director)
    assert len(league.sheet.file.results) == 8
    assert len(league.paths) == 1
    rated(director, "player_a,player_b,score_a,score_b\nPlayer 1,New Ned,7,2\n")
    assert len(league.sheet.file.results) == 1  # a new file takes the place of all
    assert [path.suffix for path in league.beside.parent.glob("*.league-*")] == [".replaced"]
    director.send("/league/tonight")
    worked_out(director)
    assert len(league.sheet.file.results) == 9
    assert "New Ned" in hall.guest.open("/league").words


def test_results_that_are_replaced_stay_in_a_file(tmp_path: Path) -> None:
    league = League(tmp_path / "tonight.db")
    header = "player_a,player_b,score_a,score_b\n"
    rows = [f"{header}Ann,Bo,5,{k}\n".encode() for k in range(3)]
    for before, content in zip(["", *rows], rows, strict=False):
        league.keep(content, "fargo", 7)
        league.add_evening(content, datetime(2025, 3, 1, 19))  # the same evening, again and again
        kept = tmp_path / "tonight.league.csv.replaced"
        assert (kept.read_bytes() if before else b"") == (before or b"")
    assert len(league.paths) == 2


@pytest.mark.slow
def test_a_visitor_has_no_place_whatever_the_rating(tmp_path: Path) -> None:
    rounds = "Ann,Bo,7,6\nBo,Cy,7,5\nCy,Di,7,6\nAnn,Di,7,4\n" * 6
    with answering(tmp_path / "tonight.db") as site:
        phone = Phone(site, director=True)
        shown = rated(phone, f"player_a,player_b,score_a,score_b\n{rounds}Eve,Ann,7,0\n")
        words = shown.words
        assert words.index("1 Ann") < words.index("4 Di") < words.index("Provisional: fewer than")
        assert words.index("Provisional: fewer than") < words.index("Eve ~")
        assert "No. 1 in the league" in phone.open("/league/player?name=Ann").words
        assert "Provisional: 7 games" in phone.open("/league/player?name=Eve").words
