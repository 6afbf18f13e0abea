"""The team night in a file: added once, by whom, beside a tournament, and never half."""

import sqlite3
import threading

import pytest

from evenbreak.errors import DataError, InputError
from evenbreak.files.store.evening_file import holds
from evenbreak.files.store.formats import TEAM_NIGHT, TOURNAMENT
from evenbreak.files.store.team_night import add_team_events, read_team_events
from evenbreak.files.store.tournament import new_tournament, read_tournament
from evenbreak.teams.evening.events import Begun, PutUp
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from team_nights import AT, plan

OPENED = Opened(Plan("single", 3, scale="fargo"), tuple(Entrant(n, 500.0) for n in "abcd"))


def add(path, what, **how):
    asked = {"at": AT, "by": "me", **how}
    return add_team_events(path, lambda _, __: [what] if what else [], **asked)


def test_a_night_and_a_tournament_share_a_file_whichever_is_first(tmp_path):
    for name, first_night in (("a.db", True), ("b.db", False)):
        path = tmp_path / name
        if first_night:
            add(path, Begun(plan()))
            assert holds(path, TEAM_NIGHT)
            assert not holds(path, TOURNAMENT)
            with pytest.raises(DataError, match="holds a team night, not a tournament"):
                read_tournament(path)
        new_tournament(path, [Event(AT, OPENED)])
        state, added = add(path, Begun(plan(race=6)))
        assert (state.plan.race, added) == (6, True)
        assert len(read_tournament(path).entrants) == 4
        with pytest.raises(DataError, match=r"\.db already exists\."):
            new_tournament(path, [Event(AT, OPENED)])


def test_a_form_adds_once(tmp_path):
    path = tmp_path / "night.db"
    add(path, Begun(plan()), form="a")
    assert add(path, Begun(plan(race=9)), form="a")[1] is False
    assert add(path, PutUp(0, 1, ("Ann",)), form="b")[1] is True
    assert add(path, None, form="c")[1] is False
    assert [(one.at, one.by) for one in read_team_events(path)] == [(AT, "me")] * 2


def test_what_is_refused_leaves_nothing(tmp_path):
    path = tmp_path / "night.db"

    def refuse(_, __):
        raise InputError("no")

    with pytest.raises(InputError):
        add_team_events(path, refuse, at=AT, by="me")
    assert read_team_events(path) == []
    add(path, Begun(plan()))
    with pytest.raises(DataError):
        add(path, PutUp(0, 9, ("Ann",)))
    assert len(read_team_events(path)) == 1


def test_many_at_once_lose_nothing(tmp_path):
    path = tmp_path / "night.db"
    threads = [threading.Thread(target=add, args=(path, Begun(plan(race=k)))) for k in range(1, 7)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert {one.what.plan.race for one in read_team_events(path)} == set(range(1, 7))


def test_another_file_is_refused(tmp_path):
    path = tmp_path / "other.db"
    sqlite3.connect(path).execute("CREATE TABLE x (y)").connection.close()
    for use in (read_team_events, lambda place: add(place, Begun(plan()))):
        with pytest.raises(DataError, match="isn't a tournament file"):
            use(path)
