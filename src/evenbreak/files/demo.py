"""The demo: made-up files to try the commands on, and an evening that is half played."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime, timedelta
from importlib.resources import files
from pathlib import Path

import numpy as np

from evenbreak.errors import DataError
from evenbreak.files.entrants import read_entrants
from evenbreak.files.folder import write_files
from evenbreak.files.tournament_store import new_tournament
from evenbreak.ratings.scale import scale_of
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Plan, What
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.opening import opened

DEMO: Mapping[str, str] = {
    "demo_entrants.csv": "the players of a tournament",
    "demo_league.csv": "a league's results over two seasons",
    "demo_roster.csv": "the players of a club and their ratings",
    "demo_pairs.csv": "who plays whom tonight",
    "demo_team.csv": "a captain's team",
    "demo_opponents.csv": "the team across the table",
    "drill_log.csv": "a player's attempts at a progressive drill",
    "practice_scores.csv": "practice scores before a change",
    "practice_scores_after.csv": "practice scores after it",
}
"""The files of the demo: what each holds."""

_RESULTS = 13
"""How many matches of the evening are over."""

_DRAW, _RACK = 15, 6
"""The draw is made after so many minutes, and a rack takes so many."""

_PLAN = Plan(
    "double",
    5,
    losers_race=4,
    seeding="rating",
    scale="fargo",
    starter=500.0,
    starter_error=100.0,
    tables=4,
)


def write_demo(folder: str | Path) -> list[str]:
    """Write the files of the demo into a folder, and return the names of those it did not have.

    Raises
    ------
    DataError
        if the folder has another file with one of their names; nothing is written then.
    OSError
        if they cannot be written.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     len(write_demo(folder)), write_demo(folder)
    (9, [])
    """
    there = Path(folder)
    content = {name: _place(name).read_bytes() for name in DEMO}
    new = {name: text for name, text in content.items() if not (there / name).exists()}
    others = [name for name in DEMO if name not in new and not _holds(there / name, content[name])]
    if others:
        problem = "is there already and is not the demo's; name another folder"
        raise DataError([f"{there / name} {problem}" for name in others])
    if new:
        write_files(there, new)
    return list(new)


def write_demo_evening(path: str | Path, now: datetime) -> Evening:
    """Write a tournament that is half played to a new file: results, tables in use, a score.

    Parameters
    ----------
    path
        the file, which must not exist yet.
    now
        when the last of it has just happened.
    """
    story = _story()
    start = now - timedelta(minutes=story[-1][0] + 1)
    return new_tournament(path, [Event(_time(start, minute), what) for minute, what in story])


def _place(name: str) -> Path:
    """Return where a file of the demo is: in the installed package, or beside it in a checkout."""
    installed = Path(str(files("evenbreak") / "demo_data" / name))
    checkout = Path(__file__).resolve().parents[3] / "data" / name
    return installed if installed.exists() else checkout


def _holds(path: Path, content: bytes) -> bool:
    return path.is_file() and path.read_bytes() == content


def _time(start: datetime, minute: int) -> str:
    return (start + timedelta(minutes=minute)).isoformat(timespec="seconds")


def _story() -> list[tuple[int, What]]:
    """Return what happens, each with the minutes since the start."""
    rng = np.random.default_rng(1)
    story: list[tuple[int, What]] = [(0, opened(_PLAN, _entrants()))]
    story.append((_DRAW, moves.draw(_after(story), rng)))
    on: dict[str, tuple[int, list[int]]] = {}
    while len((state := _after(story)).counted) < _RESULTS:
        minute = story[-1][0]
        ready = [match for match in state.standing.to_play if match not in on]
        if ready and moves.free_tables(state):
            story.append((minute, moves.call(state, ready[0], None)))
            on[ready[0]] = minute, _racks(state, ready[0], rng)
            continue
        match = min(state.on_tables, key=lambda name: on[name][0] + _RACK * len(on[name][1]))
        called, racks = on[match]
        minute = max(minute, called + _RACK * len(racks)) + 1
        story.append((minute, moves.result(state, match, _score(racks))))
    for match in state.on_tables:
        called, racks = on[match]
        score = _score(racks[: (minute - called) // _RACK])
        story.append((minute, moves.score(state, match, score)))
    return story


def _entrants() -> list[Entrant]:
    roster = read_entrants(_place("demo_entrants.csv")).roster
    new = np.isnan(roster.rating)
    ratings = np.where(new, _PLAN.starter, roster.rating).tolist()
    errors = np.where(new, _PLAN.starter_error, roster.standard_error).tolist()
    return [Entrant(*one) for one in zip(roster.players, ratings, errors, strict=True)]


def _after(story: list[tuple[int, What]]) -> Evening:
    """Return the state; the date does not matter to it."""
    return evening([Event(_time(datetime.min, minute), what) for minute, what in story])


def _racks(state: Evening, match: str, rng: np.random.Generator) -> list[int]:
    """Return which of the two players wins each rack of a match, 0 or 1."""
    pair = state.pair(match)
    one, other = (state.entrants[name].rating for name in pair)
    p = scale_of(_PLAN.scale).win_probability(one - other)
    needed, racks = state.needed(match, pair), [int(rng.random() >= p)]
    while racks.count(racks[-1]) < needed[racks[-1]]:
        racks.append(int(rng.random() >= p))
    return racks


def _score(racks: list[int]) -> tuple[int, int]:
    return racks.count(0), racks.count(1)
