"""A calendar file against what RFC 5545 asks, read back by its own rules."""

from dataclasses import replace
from datetime import date, time

from evenbreak.files.calendar import calendar_bytes
from evenbreak.league import Fixture

LONG = "Zoë's Very, Very Long; Name of a Team – " * 4
MATCHES = [
    Fixture(1, LONG.strip(), "Back\\slash", date(2026, 9, 1), "Corner, Main St", 3),
    Fixture(1, "Acers", "Bankers", date(2026, 9, 1), turn=2),
    Fixture(2, "Bankers", "Acers"),
]


def events(content: bytes) -> list[dict[str, str]]:
    """Return the events: lines unfolded, values as they are meant."""
    text = content.decode().replace("\r\n ", "")
    assert "\n" not in text.replace("\r\n", "")
    found: list[dict[str, str]] = []
    for line in text.split("\r\n"):
        name, _, value = line.partition(":")
        if line == "BEGIN:VEVENT":
            found.append({})
        elif found:
            out, signs = "", iter(value)
            for sign in signs:
                out += next(signs) if sign == "\\" else sign
            found[-1].setdefault(name, out)
    return found


def test_names_places_and_times_come_back() -> None:
    how = {"name": "Tuesday", "venue": "Elm", "start": time(19), "minutes": 90}
    content = calendar_bytes(MATCHES, **how)
    assert all(len(line) <= 75 for line in content.split(b"\r\n"))
    first, second = events(content)  # the third has no date
    assert first["SUMMARY"] == f"{MATCHES[0].home} v Back\\slash"
    assert (first["LOCATION"], second["LOCATION"]) == ("Corner, Main St", "Elm")
    assert (first["DTSTART"], first["DTEND"]) == ("20260901T190000", "20260901T203000")
    assert (second["DTSTART"], second["DESCRIPTION"]) == ("20260901T203000", "Round 1")
    assert first["DESCRIPTION"] == "Round 1, table 3"
    assert first["UID"] != second["UID"]
    assert content == calendar_bytes(
        MATCHES, name="Tuesday", venue="Elm", start=time(19), minutes=90
    )


def test_an_event_stays_the_same_when_it_is_moved() -> None:
    moved = [replace(one, date=date(2026, 10, 6), round=5, table=1) for one in MATCHES]
    before, after = (events(calendar_bytes(of, name="Tuesday")) for of in (MATCHES, moved))
    assert [one["UID"] for one in after[:2]] == [one["UID"] for one in before]
    assert before[0]["DTSTART;VALUE=DATE"] == "20260901"
    assert before[0]["DTEND;VALUE=DATE"] == "20260902"


def test_no_dates_is_an_empty_calendar() -> None:
    assert events(calendar_bytes(MATCHES[2:], name="Tuesday")) == []
