"""For a double click: tonight's file in the documents folder, one page at a time, a browser."""

from __future__ import annotations

import os
import re
import sys
import time
import webbrowser
from contextlib import suppress
from datetime import date, timedelta
from pathlib import Path
from types import TracebackType
from typing import IO

import platformdirs

from evenbreak.errors import DataError
from evenbreak.files.store.evening_file import holds
from evenbreak.files.store.formats import TOURNAMENT
from evenbreak.files.store.team_night import read_team_events, team_night_of
from evenbreak.files.store.tournament import night_of, read_night
from evenbreak.tournaments.evening.later_draws import can_draw

_LONGEST = timedelta(days=3)
"""How long a tournament or a team night may last."""
_DAY = re.compile(r"\d{4}-\d\d-\d\d")
_FAR = 1 << 20  # a byte beyond the address: on Windows what is locked cannot be read
_STARTING = 10.0  # seconds in which the other program says where its page is


def documents() -> Path:
    """Return the folder for the user's events, creating it if needed."""
    folder = platformdirs.user_documents_path() / "evenbreak"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def tonights_file(folder: Path, today: date) -> Path:
    """Return today's file, or that of an earlier day if something in it isn't over yet."""
    of_today = folder / f"{today}.db"
    if not of_today.exists():
        earliest = f"{today - _LONGEST}"
        found = [one for one in folder.glob("*.db") if _DAY.fullmatch(one.stem)]
        for path in sorted(found, reverse=True):
            if earliest <= path.stem < f"{today}":
                return path if goes_on(path) else of_today
    return of_today


def goes_on(path: Path) -> bool:
    """Return whether a file's night is still going on; False if it can't be read."""
    with suppress(DataError):  # it is left for whoever can mend it
        teams = team_night_of(path, read_team_events(path))
        if teams is not None and not teams.over:
            return True
        night = night_of(path, read_night(path)) if holds(path, TOURNAMENT) else {}
        return any(
            not state.drawn or state.standing.to_play or can_draw(state) for state in night.values()
        )
    return False


class Alone:
    """Lets only one program at a time serve tonight's page; a second one learns where it is.

    The system releases the lock when the program ends, however it ends. `running` and `of` are the
    address of the other program's page and its night's file, '' if there is none.
    """

    def __init__(self, path: Path | None = None) -> None:
        self.path = path or platformdirs.user_cache_path("evenbreak", False) / "page"
        self.running, self.of = "", ""
        self.file: IO[str] | None = None

    def __enter__(self) -> Alone:
        """Take the lock, or find out where the other program's page is."""
        with suppress(OSError):  # where no file can be kept, nobody learns of another
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self.file = self.path.open("a+", encoding="utf-8")
            if _lock(self.file):
                self.file.truncate(0)
            else:
                self.running, _, self.of = self._kept().partition("\n")
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        """Release the lock."""
        if self.file is not None:
            self.file.close()

    def keep(self, address: str, path: Path) -> None:
        """Store the page's address and its file, for a second start."""
        if self.file is not None and not self.running:
            self.file.write(f"{address}\n{path.resolve()}")
            self.file.flush()

    def _kept(self) -> str:
        until = time.monotonic() + _STARTING
        while not (found := self.path.read_text("utf-8")) and time.monotonic() < until:
            time.sleep(0.2)
        return found


def _lock(file: IO[str]) -> bool:
    """Return whether this program could lock a file; False if another program has it."""
    try:
        if sys.platform == "win32":
            import msvcrt

            os.lseek(file.fileno(), _FAR, os.SEEK_SET)
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            from fcntl import LOCK_EX, LOCK_NB, flock

            flock(file, LOCK_EX | LOCK_NB)
    except (BlockingIOError, PermissionError):
        return False
    return True


def show(address: str) -> None:
    """Open the browser on a page, if there is a display."""
    on_screen = {"DISPLAY", "WAYLAND_DISPLAY", "BROWSER"} & os.environ.keys()
    if sys.platform != "linux" or on_screen:
        webbrowser.open(address)
