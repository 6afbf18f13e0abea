"""Fixtures as a calendar file, `.ics`: as RFC 5545 requires, with the same bytes every time.

See docs/explanation/decisions/0025-calendar-files.md for why no library writes it.
"""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterator, Sequence
from datetime import datetime, time, timedelta

from evenbreak.league.tables.fixtures import Fixture

_LONGEST = 75  # octets of a line


def calendar_bytes(
    fixtures: Sequence[Fixture],
    *,
    name: str,
    venue: str = "",
    start: time | None = None,
    minutes: int = 180,
) -> bytes:
    """Return the dated fixtures as a calendar; without `start`, they are all-day events.

    An event keeps its UID when its date, time or table changes, so calendars that already have the
    event move it. Times are local to the venue; `venue` is for fixtures that name no venue.
    """
    dated = [one for one in fixtures if one.date is not None]
    stamp = min((one.date for one in dated if one.date), default=None)
    lines = [
        "BEGIN:VCALENDAR",
        "VERSION:2.0",
        "PRODID:-//evenbreak//fixtures//EN",
        "CALSCALE:GREGORIAN",
        f"X-WR-CALNAME:{_escaped(name)}",
    ]
    meetings: Counter[tuple[str, str]] = Counter()
    for one in dated:
        meetings[one.home, one.away] += 1
        key = "\0".join([name, one.home, one.away, str(meetings[one.home, one.away])])
        lines += [
            "BEGIN:VEVENT",
            f"UID:{hashlib.sha256(key.encode()).hexdigest()[:20]}@evenbreak",
            f"DTSTAMP:{stamp:%Y%m%d}T000000Z",
            *_times(one, start, minutes),
            f"SUMMARY:{_escaped(f'{one.home} v {one.away}')}",
        ]
        if where := one.venue or venue:
            lines.append(f"LOCATION:{_escaped(where)}")
        table = f", table {one.table}" if one.table else ""
        lines += [f"DESCRIPTION:{_escaped(f'Round {one.round}{table}')}", "END:VEVENT"]
    lines.append("END:VCALENDAR")
    return "".join(f"{part}\r\n" for line in lines for part in _folded(line)).encode()


def _times(one: Fixture, start: time | None, minutes: int) -> Iterator[str]:
    if one.date is None:
        return
    if start is None:
        yield f"DTSTART;VALUE=DATE:{one.date:%Y%m%d}"
        yield f"DTEND;VALUE=DATE:{one.date + timedelta(days=1):%Y%m%d}"
        return
    begins = datetime.combine(one.date, start) + timedelta(minutes=(one.turn - 1) * minutes)
    yield f"DTSTART:{begins:%Y%m%dT%H%M%S}"
    yield f"DTEND:{begins + timedelta(minutes=minutes):%Y%m%dT%H%M%S}"


def _escaped(text: str) -> str:
    r"""Return a string as a value of type TEXT (RFC 5545, 3.3.11).

    >>> _escaped("Corner, Main St; back\\room")
    'Corner\\, Main St\\; back\\\\room'
    """
    for sign in "\\;,":
        text = text.replace(sign, f"\\{sign}")
    return text.replace("\r\n", "\\n").replace("\n", "\\n")


def _folded(line: str) -> Iterator[str]:
    """Yield a line in parts of at most 75 octets, without splitting a character (3.1)."""
    part, size = "", 0
    for letter in line:
        wide = len(letter.encode())
        if size + wide > _LONGEST:
            yield part
            part, size = " ", 1
        part, size = part + letter, size + wide
    yield part
