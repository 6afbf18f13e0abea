"""The demo: made-up files for trying the commands, and a half-played evening."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from datetime import datetime, timedelta
from importlib.resources import files
from pathlib import Path

from evenbreak.errors import DataError
from evenbreak.files.store.folder import write_files
from evenbreak.files.store.tournament import new_tournament, read_event_list
from evenbreak.tournaments.evening.fold import Evening

DEMO: Mapping[str, str] = {
    "demo_entrants.csv": "a tournament's players",
    "demo_league.csv": "a league's results over two seasons",
    "demo_roster.csv": "a club's players and their ratings",
    "demo_pairs.csv": "who plays who tonight",
    "demo_team.csv": "a captain's team",
    "demo_opponents.csv": "the team across the table",
    "drill_log.csv": "a player's attempts at a progressive drill",
    "practice_scores.csv": "practice scores before a change",
    "practice_scores_after.csv": "practice scores after that change",
    "practice_shots.csv": "practice on individual shots",
    "league.toml": "the league's file, which sets defaults for commands run in the folder",
}
"""The demo's files, and what each contains."""

EVENING = "demo_evening.csv"
"""The events of the half-played evening."""


def write_demo(folder: str | Path) -> list[str]:
    """Write the demo's files to a folder, and return the names of the new files.

    Raises DataError, and writes nothing, if a different file already has one of their names.
    """
    there = Path(folder)
    content = {name: _place(name).read_bytes() for name in DEMO}
    new = {name: text for name, text in content.items() if not (there / name).exists()}
    others = [name for name in DEMO if name not in new and not _holds(there / name, content[name])]
    if others:
        problem = "already exists and isn't part of the demo. Choose another folder."
        raise DataError([f"{there / name} {problem}" for name in others])
    if new:
        write_files(there, new)
    return list(new)


def write_demo_evening(path: str | Path, now: datetime) -> Evening:
    """Write a half-played tournament to a new file: results, tables in use, a score.

    `now` is a minute after its last event.
    """
    events = read_event_list(_place(EVENING))
    last, end = datetime.fromisoformat(events[-1].at), now - timedelta(minutes=1)

    def moved(at: str) -> str:
        return (end - (last - datetime.fromisoformat(at))).isoformat(timespec="seconds")

    return new_tournament(path, [replace(event, at=moved(event.at)) for event in events])


def _place(name: str) -> Path:
    """Return the path of a demo file: in the installed package, or next to it in a checkout."""
    installed = Path(str(files("evenbreak") / "demo_data" / name))
    checkout = Path(__file__).resolve().parents[3] / "data" / name
    return installed if installed.exists() else checkout


def _holds(path: Path, content: bytes) -> bool:
    return path.is_file() and path.read_bytes() == content
