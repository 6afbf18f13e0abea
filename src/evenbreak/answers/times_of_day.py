"""Times of day, such as 08:05, and the sentence that says when an evening ends."""

from __future__ import annotations

from datetime import datetime

_DAY = 24 * 60


def time_of_day(minutes: float) -> str:
    """Return minutes after midnight as a time of day.

    >>> time_of_day(8 * 60 + 5), time_of_day(26 * 60 + 27.2)
    ('08:05', '02:27')
    """
    moment = round(minutes) % _DAY
    return f"{moment // 60:02d}:{moment % 60:02d}"


def minute_of_day(moment: datetime) -> int:
    """Return a time of day in minutes after midnight.

    >>> minute_of_day(datetime(2025, 3, 1, 19, 30))
    1170
    """
    return 60 * moment.hour + moment.minute


def ends_words(early: float, middle: float, late: float) -> str:
    """Return when something ends, all times in minutes after the midnight before it began.

    >>> ends_words(23 * 60, 24 * 60 + 15, 26 * 60)
    'It ends at about 00:15 the next day; 8 times out of 10 between 23:00 and 02:00.'
    """
    days = round(middle) // _DAY
    day = {0: "", 1: " the next day"}.get(days, f" {days} days later")
    return (
        f"It ends at about {time_of_day(middle)}{day}; 8 times out of 10 between "
        f"{time_of_day(early)} and {time_of_day(late)}."
    )
