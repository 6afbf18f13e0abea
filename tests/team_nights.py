"""Team nights to test with."""

from evenbreak.teams.evening.events import Begun, Event, NightPlan, TeamSheet, What
from evenbreak.teams.evening.fold import TeamEvening, team_evening

AT = "2025-03-01T19:30:00"


def sheet(name: str, **players: float) -> TeamSheet:
    """Return a team whose players count for their rating in hundreds."""
    ratings = tuple(players.values())
    weights = tuple(rating // 100 for rating in ratings)
    return TeamSheet(name, tuple(players), ratings, (0.0,) * len(ratings), weights)


RACKS = sheet("Racks", Ann=640.0, Bo=560.0, Cleo=500.0, Dan=450.0)
CUES = sheet("Cues", Uli=600.0, Vic=580.0, Wim=490.0)


def plan(**how: object) -> NightPlan:
    """Return three sets, races to 4, unless something else is said."""
    return NightPlan((RACKS, CUES), **{"sets": 3, "race": 4, **how})  # type: ignore[arg-type]


def after(*what: What, **how: object) -> TeamEvening:
    """Return the state after some events."""
    state = team_evening(Event(AT, one) for one in (Begun(plan(**how)), *what))
    assert state is not None
    return state
