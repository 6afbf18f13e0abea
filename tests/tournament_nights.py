"""Evenings of a tournament: played out in part, or read from a saved file."""

from pathlib import Path

import numpy as np

from evenbreak.files.foreign.tournament import read_saved_tournament
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.fold import Evening, evening
from places import ROOT

SAVED = ROOT / "tests" / "files" / "saved"
AT = "2025-03-01T19:30:00"


def imported(path: Path, race: int = 5) -> Evening:
    plan = Plan("imported", race, scale="fargo", starter=500.0, tables=0, discipline="")
    return evening(read_saved_tournament(path, plan, {"Player 1": Entrant("Player 1", 600.0)}, AT))


def night(players: int, form: str, results: int, **plan: object) -> Evening:
    """Return an evening of which so many matches have been played."""
    entrants = tuple(Entrant(f"P{k}", 500.0) for k in range(1, players + 1))
    events = [Event(AT, Opened(Plan(form, 5, scale="fargo", **plan), entrants))]  # type: ignore[arg-type]
    rng = np.random.default_rng(3)
    events.append(Event(AT, moves.draw(evening(events), rng)))
    for _ in range(results):
        state = evening(events)
        if not state.standing.to_play:
            break
        name = state.standing.to_play[0]
        score = (5, int(rng.integers(5)))
        what = moves.result(state, name, score if rng.random() < 0.5 else score[::-1])
        events.append(Event(AT, what))
    return evening(events)
