"""What the file of a tournament holds besides its events."""

from evenbreak.files.tournament_desk import Proposal, proposals, propose
from evenbreak.files.tournament_store import new_tournament
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan

AT = "2025-03-01T20:00:00"


def test_proposals_come_in_their_order_even_in_one_second(tmp_path):
    path = tmp_path / "tonight.db"
    entrants = tuple(Entrant(name, 500.0) for name in ("Ann", "Bo"))
    new_tournament(path, [Event(AT, Opened(Plan("single", 3, scale="fargo"), entrants))])
    for player in ("Bo", "Ann", "Bo"):
        propose(path, Proposal("W1.1", player, {"Ann": 3, "Bo": 1}, "phone", AT))
    assert [one.player for one in proposals(path)] == ["Ann", "Bo"]
