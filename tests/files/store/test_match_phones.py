"""What phones did: a log, and whose phone is whose and what is proposed as a fold of it."""

import json
import sqlite3

from evenbreak.files.store.desk import (
    CLAIMED,
    PROPOSED,
    RELEASED,
    Act,
    Sides,
    by_phone,
    enter,
    phone_entries,
    phones_in,
)
from evenbreak.files.store.tournament import new_tournament, read_tournament
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan

AT = "2025-03-01T20:00:00"
PAIR = ("Ann", "Bo")
GAMES = {"Ann": 3, "Bo": 1}


def begun(path):
    entrants = tuple(Entrant(name, 500.0) for name in PAIR)
    new_tournament(path, [Event(AT, Opened(Plan("single", 3, scale="fargo"), entrants))])


def did(kind, player, phone="", address="", match="", score=None) -> tuple[Act, str]:
    return Act(kind, player, match, score or {}), by_phone(phone, address) if phone else ""


def entered(path, *acts) -> Sides:
    state = read_tournament(path)
    for act, by in acts:
        phones = enter(path, state, lambda _, act=act: act, at=AT, by=by)
    return phones.sides("W1.1", PAIR)


def test_what_phones_did_is_never_overwritten(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    sides = entered(
        path,
        *(
            did(PROPOSED, player, "phone", "10.0.0.7", "W1.1", {"Ann": 3, "Bo": won})
            for player, won in (("Bo", 1), ("Ann", 1), ("Bo", 2))
        ),
    )
    assert [(one.what.player, one.what.score["Bo"]) for one in phone_entries(path)] == [
        ("Bo", 1),
        ("Ann", 1),
        ("Bo", 2),
    ]
    assert sides.scores == {"Ann": (3, 1), "Bo": (3, 2)}


def test_a_phone_that_takes_the_other_player_gives_up_its_own_and_what_it_proposed(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    sides = entered(
        path,
        did(CLAIMED, "Ann", "x", "10.0.0.7"),
        did(PROPOSED, "Ann", "x", "10.0.0.7", "W1.1", GAMES),
        did(CLAIMED, "Bo", "x", "10.0.0.7"),
        did(PROPOSED, "Bo", "x", "10.0.0.7", "W1.1", GAMES),
    )
    assert (list(sides.claims), list(sides.proposed)) == (["Bo"], ["Bo"])


def test_what_a_phone_proposed_goes_with_it(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    claimed = did(CLAIMED, "Ann", "x", "10.0.0.7")
    proposed = did(PROPOSED, "Ann", "x", "10.0.0.7", "W1.1", GAMES)
    for gone in (
        did(RELEASED, "Ann"),
        did(CLAIMED, "Ann", "y", "10.0.0.9"),
    ):
        assert entered(path, claimed, proposed).proposed
        assert not entered(path, gone).proposed


def test_a_phone_that_changes_its_address_does_not_become_two(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    sides = entered(
        path,
        did(CLAIMED, "Ann", "x", "10.0.0.7"),
        did(CLAIMED, "Bo", "private tab", "10.0.0.7"),
        did(PROPOSED, "Ann", "x", "10.0.0.7", "W1.1", GAMES),
        did(PROPOSED, "Bo", "private tab", "10.0.0.8", "W1.1", GAMES),
    )
    assert (sides.agree, sides.apart) == (True, False)


def test_a_claim_for_a_match_of_an_earlier_version_is_the_player_s(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    entered(path, did(CLAIMED, "Ann", "x", "10.0.0.7", "W1.1"))
    assert phones_in(phone_entries(path), read_tournament(path)).of("x") == "Ann"


def test_a_proposal_that_an_earlier_version_kept_waits_for_the_director(tmp_path):
    path = tmp_path / "tonight.db"
    begun(path)
    with sqlite3.connect(path) as base:
        base.execute(
            "CREATE TABLE proposal (game TEXT NOT NULL, player TEXT NOT NULL, score TEXT NOT NULL,"
            " phone TEXT NOT NULL, at TEXT NOT NULL, PRIMARY KEY (game, player))"
        )
        row = "W1.1", "Ann", json.dumps(GAMES), "x", AT
        base.execute("INSERT INTO proposal VALUES (?, ?, ?, ?, ?)", row)
    base.close()
    sides = entered(path, did(PROPOSED, "Bo", "y", "10.0.0.8", "W1.1", GAMES))
    assert (sides.agree, sides.apart) == (True, False)
