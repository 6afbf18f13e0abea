"""A tournament begun through the page, begun again, and changed under way."""

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from evenbreak.files.store.prizes import kept_prizes
from evenbreak.files.store.tournament import add_events, new_tournament, read_tournament
from evenbreak.tournaments.evening.earlier import night_played
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.plan import FORMATS
from evenbreak.tournaments.money.payouts import PrizeMoney
from rows import each_of
from tournament_nights import timed_night
from web.conftest import PLAYERS, Hall, begun
from web.phones import Phone, answering
from web.test_same_questions import Fields

ASKED = {
    "entrants": "Ann,612\nBo,540\nCy,500\nDi,480",
    "format": "double",
    "races": "even",
    "race": 3,
    "tables": 2,
    "discipline": "9-ball",
    "seeding": "listed",
    "scale": "fargo",
}


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("kind", FORMATS)
def test_each_format_begins_and_is_drawn(tmp_path: Path, kind: str) -> None:
    if kind == "swiss":
        pytest.importorskip("caissify_pairings", reason="pairings of a Swiss need evenbreak[swiss]")
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        size = {"pod_size": 4} if kind == "pods" else {}
        begun(director, PLAYERS[:6], format=kind, losers_race="", chips="hoboken", **size)
        assert read_tournament(site.path).standing.to_play
        assert "Table" in director.open("/desk").words


@pytest.mark.slow
def test_what_a_form_says_is_what_is_planned(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        for given, wanted in (
            ({"final": "single"}, {"final": "single"}),
            ({"qualifiers": 2}, {"qualifiers": 2}),
            ({"format": "single", "third_place": "yes"}, {"third_place": True}),
            ({"format": "groups", "groups": 1, "qualifiers": 3}, {"groups": 1, "qualifiers": 3}),
            ({"format": "groups", "groups": 2, "knockout_size": 3}, {"knockout_size": 3}),
            ({"format": "round-robin", "races": "fair"}, {"handicapped": True, "race": 3}),
            ({"losers_race": 2, "final_race": 4}, {"losers_race": 2, "final_race": 4}),
        ):
            assert director.send("/new", **ASKED | given | again(director)).status == 200
            plan = read_tournament(site.path).plan
            assert {name: getattr(plan, name) for name in wanted} == wanted
        shown = director.send("/new", **ASKED | {"races": "npl_8"} | again(director))
        assert (
            "about 30 points double the odds, but on the scale used here 100 points do"
            in shown.words
        )
        assert read_tournament(site.path).plan.chart.name == "npl_8"
        assert director.send("/desk/draw").status == 200


def test_a_second_tap_on_begin_leads_to_the_same_tournament(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        for _ in range(2):
            shown = director.send("/new", **ASKED)
            assert (shown.status, shown.url.endswith("/desk/check-in")) == (200, True)
        assert len(read_tournament(site.path).events) == 1


def test_what_is_said_fits_into_a_cookie_in_every_script(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director, sizes = Phone(site, director=True), []
        keep = director.jar.set_cookie
        monkeypatch.setattr(director.jar, "set_cookie", lambda one: sizes.append(one) or keep(one))
        names = "\n".join(letter * 150 for letter in "жшщю")
        assert director.send("/new", **ASKED | {"entrants": names}).status == 200
        assert max((len(one.value) for one in sizes), default=0) < 3800


def test_doubtful_lines_are_asked_about_and_taken_as_answered(tmp_path: Path) -> None:
    pasted = "Players:\n1. Ann Lee 612\n2. Bo 500, paid\n3. Ann Lee\n4. Cy 480  Di 470\n5. Ed 312 x"
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        shown = director.send("/new", **ASKED | {"entrants": pasted, "tables": "1, TV"})
        assert shown.status == 200
        assert not site.path.exists()
        fields = Fields(shown.text).usual
        assert fields["name-2"] == "Ann Lee"
        assert fields["line-4"] == ""  # the second Ann Lee is left out
        answers = {**fields, "line-6": "other", "other-6": "Ed Fox 470", "rating-2": "620"}
        wrong = director.send("/new", **answers | {"other-6": "what 1,234 is"})
        assert "Line 6: write a name" in wrong.words
        assert "Ed 312 x" in wrong.words
        assert director.send("/new", **answers).url.endswith("/desk/check-in")
        state = read_tournament(site.path)
    rated = {name: one.rating for name, one in state.entrants.items()}
    assert rated == {"Ann Lee": 620, "Bo": 500, "Cy": 480, "Di": 470, "Ed Fox": 470}
    assert state.plan.labels == ("1", "TV")


def test_next_week_has_the_same_people_and_options(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        plan = {"name": "Tuesday", "tables": "5-6, TV", "losers_race": 2, "slower": "1.3"}
        money = {"fee": 20, "house": 10, "unit": 5, "payout": "70/30"}
        assert director.send("/new", **ASKED | plan | money).status == 200
        before = read_tournament(site.path)
        site.clock = lambda: "2031-03-08T19:30:00"
        fields = Fields(director.open("/next").text).usual
        fields["in_place_of"] = again(director)["in_place_of"]
        assert director.send("/new", **fields).status == 200
        after = read_tournament(site.path)
        assert after.plan == replace(before.plan, date="2031-03-08")
        assert after.entrants == before.entrants
        kept = kept_prizes(site.path)
        assert kept == PrizeMoney(20.0, 0.0, 0.1, "70/30", 5.0)


def test_a_tournament_is_deleted_once_that_is_meant_and_a_copy_stays(hall: Hall) -> None:
    folder = hall.site.path.parent
    assert "A copy of its file is kept" in hall.director.send("/desk/delete").words
    assert hall.guest.send("/desk/delete", sure="yes").status == 403
    before = hall.state
    shown = hall.director.send("/desk/delete", sure="yes")
    assert "Deleted. A copy was saved as" in shown.words
    (copy,) = folder.glob("*.backup.db")
    assert read_tournament(copy).events == before.events
    assert "No tournament" in hall.guest.open("/players").words
    assert hall.guest.open("/").status == 200
    assert hall.director.send("/new", **ASKED).status == 200
    assert list(hall.state.entrants) == ["Ann", "Bo", "Cy", "Di"]


def test_players_come_in_a_file(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        ann = {"file": b"player,rating\nAnn,612\nBo,540\n"}
        assert director.send_files("/new", ann, **ASKED | {"entrants": ""}).status == 200
        assert list(read_tournament(site.path).entrants) == ["Ann", "Bo"]


def again(director: Phone) -> dict[str, str]:
    """Return the field that lets a new tournament take the place of the one that there is."""
    name = director.open("/new").text.partition('name="in_place_of" value="')[2].split('"')[0]
    return {"in_place_of": name} if name else {}


@pytest.mark.slow
def test_a_new_tournament_learns_from_those_in_its_folder(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        assert director.send("/new", **ASKED).status == 200
        before = read_tournament(site.path)
        played = timed_night(list(before.events), before.events[0].at, slow=1.3)
        add_events(site.path, lambda state: played[len(state.events) :])
        night = night_played(read_tournament(site.path))
        assert Fields(director.open("/new").text).usual["pace"] == "yes"
        for _ in range(2):  # the same tap again
            assert director.send("/new", **ASKED, **again(director), pace="yes").status == 200
        assert read_tournament(site.path).plan.earlier == (night,)
        assert director.send("/desk/draw").status == 200
        assert "Your last night of 9-ball at this venue ran" in director.open("/desk/time").words
        assert director.send("/new", **ASKED, **again(director)).status == 200
        assert read_tournament(site.path).plan.earlier == ()
    with answering(tmp_path / "next.db") as site:
        assert (
            "at this venue ran"
            in Phone(site, director=True).send("/new", **ASKED, pace="yes").words
        )
        assert read_tournament(site.path).plan.earlier == (night,)


@pytest.fixture(scope="module")
def nothing_begun(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Phone]:
    with answering(tmp_path_factory.mktemp("nothing") / "tonight.db") as site:
        yield Phone(site, director=True)


@each_of(
    "given, why",
    [
        ({"format": "single", "losers_race": 2}, "no losers' side"),
        ({"format": "swiss", "final_race": 2}, "no final"),
        ({"format": "single", "rounds": 2}, "Only a Swiss"),
        ({"qualifiers": 3}, "another power of 2"),
        ({"qualifiers": 2, "final": "single"}, "one final"),
        ({"format": "single", "knockout_size": 3}, "no groups"),
        ({"format": "groups", "groups": 3}, "for 4 players, but each group needs 2"),
        ({"format": "pods"}, "too few"),
        ({"races": "npl_8", "losers_race": 2}, "sets all races"),
        ({"races": "nobody's"}, "must be one of"),
        ({"race": ""}, "The race is blank"),
        ({"tables": "nan"}, "write how many tables"),
        ({"entrants": "Ann,612"}, "2 to 256"),
        ({"entrants": "player,rating\nAnn,612\nann,600"}, "Line 3"),
        ({"entrants": "player,rating\nAnn,612\nBo,high"}, "Line 3"),
        ({"house": "100"}, "99%"),
        ({"tables": "1-3, 2"}, "tables are called 2"),
        ({"fee": "20", "payout": "80/30"}, "100 at most"),
        ({"entrants": "Ann,612\nBYE 2"}, "not a player"),
        ({"entrants": " \n ", "scale": ""}, "No one has entered yet"),
    ],
)
def test_a_form_that_is_refused_comes_back_as_it_was(
    nothing_begun: Phone, given: dict[str, object], why: str
) -> None:
    asked = ASKED | {"tables": 7} | given
    shown = nothing_begun.send("/new", **asked)
    assert shown.status == 400
    assert why in shown.words
    assert str(asked["entrants"]).strip() in shown.text
    assert f'name="tables" value="{asked["tables"]}"' in shown.text
    assert f'<option value="{asked["format"]}" selected>' in shown.text
    assert not nothing_begun.site.path.exists()


def test_doubtful_ratings_are_said(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        shown = director.send("/new", **ASKED | {"scale": "npl"})
        assert "is it the right scale?" in shown.words
        new = ASKED | {"entrants": "Ann,612\nBo"} | again(director)
        assert "1 player without a rating (Bo)" in director.send("/new", **new).words


@pytest.mark.slow
def test_another_tournament_takes_the_place_of_the_first(hall: Hall, tmp_path: Path) -> None:
    code = hall.site.player_code("Player 1")
    hall.director.send("/desk/result", match="W1.1", a=3, b=1)
    hall.guest.open("/")
    shown = hall.director.send("/new", **ASKED)
    assert shown.status == 400
    assert "already" in shown.words
    assert len(hall.state.entrants) == 16
    seen = again(hall.director)
    hall.director.send("/desk/result", match="W1.2", a=3, b=1)
    assert hall.director.send("/new", **ASKED | seen).status == 400  # somebody has played on
    hall.site.clock = lambda: "2031-03-01T19:30:00"
    assert hall.director.send("/new", **ASKED | again(hall.director)).status == 200
    assert list(hall.state.entrants) == ["Ann", "Bo", "Cy", "Di"]
    copies = [read_tournament(copy) for copy in tmp_path.glob("*.backup.db")]
    assert set(max((one.counted for one in copies), key=len)) == {"W1.1", "W1.2"}
    hall.director.send("/desk/draw")
    words = hall.guest.open("/").words
    assert "Player 1" not in words
    assert "Ann" in words
    assert hall.guest.open(f"/c/{code}").status == 404
    assert "Ann" in hall.guest.open(f"/c/{hall.site.player_code('Ann')}").words


@pytest.mark.slow
def test_the_desk_changes_tables_and_races(hall: Hall) -> None:
    hall.director.send("/desk/call", match="W1.1", table=1)
    shown = hall.director.send("/desk/change", tables=3, race=2)
    assert "3 tables: 1, 2, 3. Races to 2" in shown.words
    assert hall.state.plan.tables == 3
    assert hall.state.needed("W1.1", hall.state.pair("W1.1")) == (3, 3)
    assert hall.state.needed("W1.2", hall.state.pair("W1.2")) == (2, 2)
    assert hall.director.send("/desk/change").status == 400
    assert hall.guest.send("/desk/change", tables=9).status == 403


@pytest.mark.slow
def test_the_desk_says_what_would_end_it_sooner(hall: Hall) -> None:
    shown = hall.director.open("/desk/time")
    assert shown.status == 200
    assert "with one more table" in shown.words.lower()
    assert hall.guest.open("/desk/time").status == 403


@pytest.mark.slow
def test_odds_are_those_of_the_moment_after_an_undo(hall: Hall) -> None:
    hall.director.send("/desk/result", match="W1.1", a=3, b=1)
    hall.director.send("/desk/undo", entry=hall.state.numbers[-1], sure="yes")
    for _ in range(200):
        words = hall.guest.open("/prizes", fee="20", payout="40/30/20/10").words
        if "Expected" in words or "expect" in words:
            break
        hall.guest.open("/")
    assert "expect" in words.lower()


def test_a_late_player_is_read_like_one_of_the_list(hall: Hall) -> None:
    before = len(hall.state.events)
    refused = {
        "rating": ["nan", "inf", "-inf", "1e9"],
        "name": ["Player  1", "PLAYER1", "Pla\u200byer 1", "Zo\x07e", "BYE 2"],
    }
    for field, values in refused.items():
        for value in values:
            shown = hall.director.send("/desk/late", **{"player": "Zoe", field: value})
            assert shown.status == 400, (value, shown.words)
    assert len(hall.state.events) == before
    hall.director.send("/desk/undo", entry=before, sure="yes")
    shown = hall.director.send("/desk/late", player="Bo\u202e  Diaz", rating=9000)
    assert "Bo Diaz" in hall.state.entrants
    assert "from the median" in shown.words


@pytest.mark.slow
def test_odds_that_fail_leave_the_director_a_desk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise ValueError("no odds")

    monkeypatch.setattr("evenbreak.web.night.night_answer", fail)
    path = tmp_path / "tonight.db"
    plan = Plan("single", 3, scale="fargo", tables=2)
    what = Opened(plan, tuple(Entrant(n, 500.0) for n in ("Ann", *PLAYERS[:3])))
    new_tournament(path, [Event("2025-03-01T19:30:00", what)])
    with answering(path) as site:
        director, guest = Phone(site, director=True), Phone(site)
        assert director.send("/desk/draw").status == 200
        for page in ("/", "/screen", "/players", "/bracket", "/prizes?fee=10"):
            assert guest.open(page).status == 200
        for _ in range(100):
            if "can't be calculated" in (shown := director.open("/desk")).words:
                break
            time.sleep(0.02)
        assert "can't be calculated" in shown.words
        assert director.send("/desk/call", match="W1.1", table=1).status == 200


@pytest.mark.slow
def test_an_entry_is_corrected_before_the_draw(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        director.send("/new", **ASKED)
        assert director.send("/desk/edit", player="Bo", name="Bo Lee").status == 200
        shown = director.send("/desk/edit", player="Cy", rating="5000")
        assert "1 of 4 ratings (Cy: 5000) is more than 600 points" in shown.words
        found = read_tournament(site.path).entrants
        assert {name: one.rating for name, one in found.items()} == {
            "Ann": 612,
            "Di": 480,
            "Bo Lee": 540,
            "Cy": 5000,
        }
        for wrong in (
            {"player": "Nobody"},
            {"name": "Bo\x07"},
            {"player": "Cy", "name": "ann"},
            {"rating": "nan"},
        ):
            assert director.send("/desk/edit", **{"player": "Cy"} | wrong).status == 400
        director.send("/desk/draw")
        assert director.send("/desk/edit", player="Ann", rating="600").status == 400


def test_a_refusal_leads_back_to_where_it_came_from(hall: Hall) -> None:
    site = hall.site
    for came, back in (
        ("/desk", "/desk"),
        ("/fair?a=Ann", "/fair?a=Ann"),
        ("/desk/drop", "/desk"),  # the page that asks whether it is meant
        ("//elsewhere.example/x", "/desk"),
    ):
        shown = hall.director.send_raw(
            "/desk/drop",
            {**hall.director.hidden(), "player": "Nobody"},
            Referer=site.address + came,
        )
        assert shown.status == 400
        assert f'class="button" href="{back}"' in shown.text
    shown = hall.guest.send_raw(
        "/desk/drop", hall.guest.hidden(), Referer="http://elsewhere.example/x"
    )
    assert 'class="button" href="/"' in shown.text


@pytest.mark.slow
def test_somebody_who_goes_home_is_asked_for_twice(hall: Hall) -> None:
    hall.director.send("/desk/call", match="W1.1", table=1)
    shown = hall.director.send("/desk/drop", player="Player 1")
    assert "Please confirm" in shown.words
    assert "Player 1 would forfeit to Player 16 in match 1." in shown.words
    assert not hall.state.dropped
    shown = hall.director.send("/desk/drop", player="Player 1", sure="yes")
    assert "Player 1 has withdrawn." in shown.words
    assert "Player 1" in hall.state.dropped
    assert hall.director.send("/desk/drop", player="").status == 400


@pytest.mark.slow
def test_provisional_ratings_are_marked_and_listed_last(tmp_path: Path) -> None:
    entered = "player,rating,games\nAnn,500,300\nBo,640,12\nCy,480,400\nDi,,0\n"
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        asked = ASKED | {"entrants": entered, "format": "single"}
        assert director.send("/new", **asked).status == 200
        entrants = read_tournament(site.path).entrants
        assert [name for name, one in entrants.items() if one.provisional] == ["Bo", "Di"]
        phone = Phone(site)
        shown = phone.open("/players").words
        assert shown.index("Cy rating 480") < shown.index("Bo provisional rating 640")
        assert director.send("/desk/draw").status == 200
        wall = phone.open("/screen", only="tables").words
        for _ in range(200):
            if "Odds to win" in wall and "Bo few games" in wall:
                break
            time.sleep(0.05)
            wall = phone.open("/screen", only="tables").words
        assert "Di unrated" in wall
        assert "Ann few games" not in wall
