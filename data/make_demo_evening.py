"""Make demo_evening.csv: an evening that is half played, with tables in use and a score.

Run with the tournament's players, demo_entrants.csv, beside it; seed 1.
"""

import sys
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from evenbreak.answers.faces.to_csv import to_csv
from evenbreak.answers.tournament.printed import tournament_events_answer
from evenbreak.files.lists.entrants import read_entrants
from evenbreak.ratings.scale import scale_of
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Plan, Scored, What
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.plan import opened

HERE = Path(__file__).parent
START = datetime(2025, 3, 1, 18)
RESULTS = 13  # matches that are over
DRAW, RACK = 15, 6  # the draw is made after so many minutes, and a rack takes so many
PLAN = Plan(
    "double",
    5,
    losers_race=4,
    seeding="rating",
    scale="fargo",
    starter=500.0,
    starter_error=100.0,
    tables=4,
    name="Tuesday 9-Ball",
)


def time(minute: int) -> str:
    return (START + timedelta(minutes=minute)).isoformat(timespec="seconds")


def story_of_the_evening() -> list[tuple[int, What]]:
    """Return what happens, each with the minutes since the start."""
    rng = np.random.default_rng(1)
    story: list[tuple[int, What]] = [(0, opened(PLAN, entrants()))]
    story.append((DRAW, moves.draw(after(story), rng)))
    on: dict[str, tuple[int, list[int]]] = {}
    while len((state := after(story)).counted) < RESULTS:
        minute = story[-1][0]
        ready = [match for match in state.standing.to_play if match not in on]
        if ready and state.free_tables:
            story.append((minute, moves.call(state, ready[0], None)))
            on[ready[0]] = minute, racks_of(state, ready[0], rng)
            continue
        match = min(state.on_tables, key=lambda name: on[name][0] + RACK * len(on[name][1]))
        called, racks = on[match]
        minute = max(minute, called + RACK * len(racks)) + 1
        story.append((minute, moves.result(state, match, score_of(racks))))
    for match in state.on_tables:
        called, racks = on[match]
        score = score_of(racks[: (minute - called) // RACK])
        story.append((minute, moves.score(state, match, score)))
    return story


def entrants() -> list[Entrant]:
    roster = read_entrants(HERE / "demo_entrants.csv").roster
    new = np.isnan(roster.rating)
    ratings = np.where(new, PLAN.starter, roster.rating).tolist()
    errors = np.where(new, PLAN.starter_error, roster.standard_error).tolist()
    return [Entrant(*one) for one in zip(roster.players, ratings, errors, strict=True)]


def after(story: list[tuple[int, What]]) -> Evening:
    """Return the state; the date does not matter to it."""
    return evening([Event(time(minute), what) for minute, what in story])


def racks_of(state: Evening, match: str, rng: np.random.Generator) -> list[int]:
    """Return which of the two players wins each rack of a match, 0 or 1."""
    pair = state.pair(match)
    one, other = (state.entrants[name].rating for name in pair)
    p = scale_of(PLAN.scale).win_probability(one - other)
    needed, racks = state.needed(match, pair), [int(rng.random() >= p)]
    while racks.count(racks[-1]) < needed[racks[-1]]:
        racks.append(int(rng.random() >= p))
    return racks


def by(what: What) -> str:
    """Return who enters it: the players their score, on a phone, and the director all else."""
    return f"phone: {what.players[0]}" if isinstance(what, Scored) else "director's page"


def score_of(racks: list[int]) -> tuple[int, int]:
    return racks.count(0), racks.count(1)


if __name__ == "__main__":
    events = [Event(time(minute), what, by(what)) for minute, what in story_of_the_evening()]
    text = "".join(to_csv(tournament_events_answer(events, "demo")))
    out = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "demo_evening.csv"
    out.write_text(text, encoding="utf-8")
