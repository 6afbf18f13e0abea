"""Evenings of a tournament: played out in part, or read from a saved file."""

from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from evenbreak.files.foreign.tournament import read_saved_tournament
from evenbreak.tournaments.clock.event_pace import event_pace
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Called, Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.settling import break_ties, tied_groups
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


def timed_night(events: list[Event], begins: str, slow: float = 1.0, seed: int = 1) -> list[Event]:
    """Return the events of an evening played out from some on, its matches called as tables free.

    They take so many times as long as those of the usual pace, on average.
    """
    rng = np.random.default_rng(seed)
    found, now = list(events), datetime.fromisoformat(begins)
    busy: dict[int, tuple[datetime, str, tuple[int, int]]] = {}
    if not evening(found).drawn:
        found.append(Event(begins, moves.draw(evening(found), rng)))
    while True:
        state = evening(found)
        pace = event_pace(state.plan.discipline)
        playing = {player for _, name, _ in busy.values() for player in state.pair(name)}
        free = [table for table in range(1, state.plan.tables + 1) if table not in busy]
        for name in state.standing.to_play:
            pair = state.pair(name)
            if free and not playing & {*pair}:
                table, lost = free.pop(0), int(rng.integers(state.plan.race))
                found.append(Event(now.isoformat(), Called(name, table, pair)))
                luck = rng.lognormal(-(pace.match_sd**2) / 2, pace.match_sd)
                minutes = slow * luck * float(pace.mean_minutes(state.plan.race + lost))
                score = (state.plan.race, lost)
                score = score if rng.random() < 0.5 else score[::-1]
                busy[table] = now + timedelta(seconds=round(60 * minutes)), name, score
                playing |= {*pair}
        if not busy and tied_groups(state):
            found.append(Event(now.isoformat(), break_ties(state, rng).ranked))
            continue
        if not busy:
            return found
        table = min(busy, key=lambda one: busy[one][0])
        now, name, score = busy.pop(table)
        found.append(Event(now.isoformat(), moves.result(evening(found), name, score)))
