"""What phones did in a match: a log, and the sides of the match as a fold of it."""

import json
import sqlite3

from evenbreak.files.store.desk import CLAIMED, PROPOSED, Entry, enter, phone_entries
from evenbreak.files.store.tournament import new_tournament
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan

AT = "2025-03-01T20:00:00"
PAIR = ("Ann", "Bo")


def begun(path):
    entrants = tuple(Entrant(name, 500.0) for name in PAIR)
    new_tournament(path, [Event(AT, Opened(Plan("single", 3, scale="fargo"), entrants))])


def test_what_phones_did_is_never_overwritten(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    for player, won in (("Bo", 1), ("Ann", 1), ("Bo", 2)):
        entry = Entry(AT, "W1.1", PROPOSED, player, {"Ann": 3, "Bo": won}, "phone", "10.0.0.7")
        sides = enter(path, "W1.1", PAIR, lambda _, entry=entry: entry)
    assert [(one.player, one.score["Bo"]) for one in phone_entries(path)] == [
        ("Bo", 1),
        ("Ann", 1),
        ("Bo", 2),
    ]
    assert {who: one.score["Bo"] for who, one in sides.proposed.items()} == {"Ann": 1, "Bo": 2}


def test_a_phone_that_takes_the_other_side_gives_up_its_own_and_what_it_proposed(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    games = {"Ann": 3, "Bo": 1}
    for entry in (
        Entry(AT, "W1.1", CLAIMED, "Ann", phone="x", address="10.0.0.7"),
        Entry(AT, "W1.1", PROPOSED, "Ann", games, "x", "10.0.0.7"),
        Entry(AT, "W1.1", CLAIMED, "Bo", phone="x", address="10.0.0.7"),
        Entry(AT, "W1.1", PROPOSED, "Bo", games, "x", "10.0.0.7"),
    ):
        sides = enter(path, "W1.1", PAIR, lambda _, entry=entry: entry)
    assert (list(sides.claims), list(sides.proposed)) == (["Bo"], ["Bo"])


def test_a_phone_that_changes_its_address_does_not_become_two(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    games = {"Ann": 3, "Bo": 1}
    for entry in (
        Entry(AT, "W1.1", CLAIMED, "Ann", phone="x", address="10.0.0.7"),
        Entry(AT, "W1.1", CLAIMED, "Bo", phone="private tab", address="10.0.0.7"),
        Entry(AT, "W1.1", PROPOSED, "Ann", games, "x", "10.0.0.7"),
        Entry(AT, "W1.1", PROPOSED, "Bo", games, "private tab", "10.0.0.8"),
    ):
        sides = enter(path, "W1.1", PAIR, lambda _, entry=entry: entry)
    assert (sides.agree, sides.apart) == (True, False)


def test_a_proposal_that_an_earlier_version_kept_waits_for_the_director(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    with sqlite3.connect(path) as base:
        base.execute(
            "CREATE TABLE proposal (game TEXT NOT NULL, player TEXT NOT NULL, score TEXT NOT NULL,"
            " phone TEXT NOT NULL, at TEXT NOT NULL, PRIMARY KEY (game, player))"
        )
        row = "W1.1", "Ann", json.dumps({"Ann": 3, "Bo": 1}), "x", AT
        base.execute("INSERT INTO proposal VALUES (?, ?, ?, ?, ?)", row)
    base.close()
    entry = Entry(AT, "W1.1", PROPOSED, "Bo", {"Ann": 3, "Bo": 1}, "y", "10.0.0.8")
    sides = enter(path, "W1.1", PAIR, lambda _: entry)
    assert (sides.agree, sides.apart) == (True, False)
