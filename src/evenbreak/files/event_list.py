"""The events of a tournament as a CSV file: all that happened, from which the state follows."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from pathlib import Path

from evenbreak.errors import DataError, InputError
from evenbreak.files.encoding import text_of
from evenbreak.files.evening_entries import happened
from evenbreak.tournaments.evening.events import NAMES, Event, as_dict, event_of
from evenbreak.tournaments.evening.fold import evening

TITLES = ("number", "at", "kind", "what", "by")
_BEGINNING = ",".join(TITLES[:4])  # of the lists of 0.2.0 too, which have no authors


def event_rows(events: Sequence[Event], first: int = 1) -> list[tuple[int, str, str, str, str]]:
    """Return the rows below `TITLES`; `what` holds the details as JSON."""
    return [
        (number, one.at, NAMES[type(one.what)], json.dumps(as_dict(one.what)), one.by)
        for number, one in enumerate(events, first)
    ]


def is_event_list(path: str | Path) -> bool:
    """Return whether a file begins like a list of events."""
    try:
        with Path(path).open("rb") as file:
            return file.read(64).removeprefix(b"\xef\xbb\xbf").startswith(_BEGINNING.encode())
    except OSError:
        return False


def read_event_list(path: str | Path) -> list[Event]:
    """Return the events in a CSV file.

    Raises
    ------
    DataError
        if a row is not an event, or the events are not those of a tournament.
    """
    body, encoding, _ = text_of(Path(path).read_bytes(), str(path))
    reader = csv.reader(body.decode(encoding).splitlines()[1:])
    events = []
    for line, row in enumerate(reader, 2):
        try:
            _, at, kind, what, by = row if len(row) == len(TITLES) else (*row, "")
            events.append(Event(at, happened(at, kind, what, event_of), by))
        except (InputError, ValueError) as error:
            raise DataError([f"{path}:{line}: is not an event of a tournament: {error}"]) from None
    try:
        state = evening(events)
        if state.drawn:
            _ = state.standing
    except InputError as error:
        raise DataError([f"{path}: {error}"]) from None
    return events
