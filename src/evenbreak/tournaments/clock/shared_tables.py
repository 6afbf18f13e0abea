"""When several tournaments on the same tables end, and which match to call next.

Their matches form one queue: a free table takes the match with the longest remaining path in its
own tournament, whichever that is. The luck of different tournaments is independent.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np
from scipy.linalg import block_diag

from evenbreak.tournaments.clock.evenings import Evenings
from evenbreak.tournaments.clock.finish import Call, Finish, Room, tables_free
from evenbreak.tournaments.clock.table_schedule import Waiting


@dataclass(frozen=True, eq=False)
class SharedTables:
    """Tournaments on the same tables; `parts` are as if alone, with the same number of runs."""

    parts: tuple[Finish, ...]
    tables: int

    @cached_property
    def together(self) -> Finish:
        """All of it as one tournament; a match is named by its part, a space, and its name."""
        rooms = [part.room for part in self.parts]
        names = tuple(f"{k} {name}" for k, part in enumerate(self.parts) for name in part.names)
        cells = (
            np.concatenate([getattr(room.evenings, one.name) for room in rooms], axis=1)
            for one in fields(Evenings)[1:]
        )
        after, shared = (
            block_diag(*(getattr(room.waits, name) for room in rooms)).astype(bool)
            for name in ("after", "shared")
        )
        playing = tuple(
            match._replace(match=f"{k} {match.match}")
            for k, room in enumerate(rooms)
            for match in room.playing
        )
        now = max(room.now for room in rooms)
        free = tables_free(self.tables, now, len(playing))
        waits = Waiting(names, after, shared)
        room = Room(Evenings(names, *cells), waits, free, now, playing)
        first = self.parts[0]
        return Finish.planned(room, first.pace, first.standing)

    def calls(self, tables: int = 1) -> list[tuple[int, Call]]:
        """Return the matches that can be called next, each with its part, as in `Finish.calls`."""
        ready = [
            f"{k} {name}"
            for k, part in enumerate(self.parts)
            for name in part.standing.to_play
            if name not in part.room.on_tables
        ]
        found = []
        for call in self.together.calls(tables, ready):
            k, _, name = call.match.partition(" ")
            found.append((int(k), call._replace(match=name)))
        return found

    def after_calls(self, called: Sequence[tuple[int, str]]) -> list[Finish]:
        """Return each part if some matches are called now; its end is the end of all parts."""
        night = self.together.after_calls([f"{k} {name}" for k, name in called])
        ends = np.cumsum([len(part.names) for part in self.parts])[:-1]
        return [
            replace(part, finishes=night.finishes, starts=starts)
            for part, starts in zip(self.parts, np.split(night.starts, ends, axis=1), strict=True)
        ]
