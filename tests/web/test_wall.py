"""The wall in turn, and the page for everyone, of one and the same night."""

from pathlib import Path
from unittest.mock import patch

import pytest

from evenbreak.tournaments.evening.events import (
    Called,
    CheckedIn,
    Drawn,
    Entrant,
    Event,
    Opened,
    Plan,
    Result,
    Scored,
)
from evenbreak.tournaments.evening.fold import evening
from evenbreak.web.evening_view import EveningView
from evenbreak.web.night import Known
from evenbreak.web.site import Site
from evenbreak.web.wall_view import WallView, just_called, pictures_of, turn_at, wall_view
from web.phones import Phone, running

NAMES = ("Ann", "Bo", "Cy", "Di")
PLAN = Plan("single", 3, scale="fargo", tables=3, labels=("1", "TV"), name="Tuesday")
BEGUN = (Opened(PLAN, tuple(Entrant(n, 500.0) for n in NAMES)), Drawn(NAMES, (0, 3, 1, 2)))
CALLS = (Called("W1.1", 1, ("Ann", "Di")), Called("W1.2", 2, ("Bo", "Cy")))
SCORE = Scored("W1.2", ("Bo", "Cy"), (2, 1))
AT = "2025-03-01T20:00:00"


def wall(*happened: object, now: str = AT, **asked: object) -> WallView:
    events = [Event(AT, what) for what in happened]  # type: ignore[arg-type]
    return wall_view(evening(events), None, name="", now=now, **asked)  # type: ignore[arg-type]


def test_a_called_match_is_amber_until_it_is_scored_and_a_disputed_score_is_not_shown() -> None:
    shown = wall(*BEGUN, *CALLS, SCORE)
    assert [(one.name, one.state, one.score) for one in shown.tables] == [
        ("1", "called", None),
        ("TV", "playing", (2, 1)),
    ]
    later = wall(*BEGUN, *CALLS, SCORE, now="2025-03-01T20:06:00", disputed={"W1.2"})
    assert [(one.state, one.score) for one in later.tables] == [("playing", (0, 0)), ("two", None)]


def test_shared_places_are_rounded_as_on_the_page_that_is_sent_on() -> None:
    state = wall(*BEGUN).state
    rows = [{"place": "3-4", "name": name} for name in ("Bo", "Di")]
    known = Known(state, 0.0, data={"places": rows})
    money = {"prizes": [50.0, 30.0, 15.0, 10.0], "unit": 5.0}
    shown = wall_view(state, known, name="", now=AT, **money)  # type: ignore[arg-type]
    assert [tuple(one) for one in shown.places] == [("3-4", "Bo", 10.0), ("3-4", "Di", 10.0)]


def test_the_tables_come_at_once_when_a_match_is_called_and_the_champion_at_the_end() -> None:
    state = wall(*BEGUN, *CALLS).state
    assert just_called(state, "2025-03-01T20:00:20")
    assert not just_called(state, "2025-03-01T20:00:30")
    assert pictures_of(wall(BEGUN[0]), told=0) == ["check-in"]
    assert pictures_of(wall(*BEGUN), told=5) == ["tables", "bracket", "tables", "story"]
    results = (
        Result("W1.1", ("Ann", "Di"), (3, 0), "Ann"),
        Result("W1.2", ("Bo", "Cy"), (1, 3), "Cy"),
        Result("F", ("Ann", "Cy"), (3, 2), "Ann"),
    )
    over = wall(*BEGUN, *results)
    assert isinstance(over.view, EveningView)
    assert pictures_of(over, told=5)[0] == "end"
    assert turn_at("2025-03-01T00:00:44") == (2, 1)


@pytest.mark.slow
def test_each_picture_is_there_without_a_script(tmp_path: Path) -> None:
    from evenbreak.files.store.tournament import add_events, new_tournament

    path = tmp_path / "tonight.db"
    arrived = CheckedIn("Bo", arrived=True)
    new_tournament(path, [Event(AT, BEGUN[0]), Event(AT, arrived)])
    with running(path) as site:
        phone = Phone(site)
        before = phone.open("/screen")
        assert "Bo is here" in before.words
        assert 'http-equiv="refresh"' in before.text
        assert 'class="qr"' not in before.text  # no phone can open the page yet
        assert "Scan once" not in before.words
        assert "Let phones in" not in before.words
        director = Phone(site, director=True)
        for page in ("/screen", "/desk/check-in"):
            assert "Let phones in" in director.open(page).words
        with patch.object(Site, "for_phones", new=True):
            site.found_at(site.address)
            assert 'class="qr"' in phone.open("/screen").text  # the code to scan
            assert "register themselves" in director.open("/desk/check-in").words
        add_events(path, lambda _: [Event(AT, what) for what in (BEGUN[1], *CALLS, SCORE)])
        with patch.object(Site, "for_phones", new=True):
            tables = phone.open("/screen", only="tables").words
        site.found_at(site.address)
        lone = phone.open("/screen", only="tables").words
        assert "Tuesday" in tables
        assert "Scan once" in tables
        assert "Scan once" not in lone
        assert "127.0.0.1" not in lone
        assert "Table TV" in tables
        assert "winner of 1" in phone.open("/screen", only="bracket").words
        assert "The story of the night" in phone.open("/screen", only="story").words
        assert "Playing" in phone.open("/").words
        assert phone.open("/screen", only="nonsense").status == 200
