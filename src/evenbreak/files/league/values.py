"""The value types that both `league.toml` and command options use."""

from __future__ import annotations

import re
import unicodedata
from datetime import date, time
from typing import TYPE_CHECKING, Any, Literal, get_args

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, Named, Number, Text, Whole
from evenbreak.ratings.scale import scale_of

if TYPE_CHECKING:
    from evenbreak.handicaps.systems.system import System
    from evenbreak.league.tables.rules import TableRules
else:  # systems take a quarter of a second to load, which most questions do without
    System = Any

SCALE = Named(
    scale_of,
    "npl|fargo|elo|POINTS",
    offers="scales",
    spelled=lambda scale: str(scale.text),
    number=True,
)
"""A rating scale."""


def _system(text: str) -> System:
    from evenbreak.handicaps.systems.catalog import system_of

    system: System = system_of(text)
    return system


SYSTEM = Named(_system, "NAME", offers="systems", spelled=lambda system: str(system.name))
"""A handicap system."""


def _system_name(text: str) -> str:
    _system(text)
    return text.strip()


SYSTEM_NAME = Named(_system_name)
"""The name of a handicap system."""

MINUTES = Number(0.001, 1440.0, " isn't a number of minutes. Give one such as 8 or 7.5")
TURNOVER = Number(0.0, 1440.0, " isn't a number of minutes. Give one such as 5, or 0")


def strong_in(text: str) -> tuple[int, float]:
    """Return how many players at each level a string allows.

    >>> strong_in("2:6"), strong_in("1 of 5.5+")
    ((2, 6.0), (1, 5.5))
    """
    match = re.fullmatch(
        r"\s*(\d{1,3})\s*(?::|x|of)\s*(\d{1,4}(?:\.\d+)?)\s*\+?\s*", text, re.ASCII
    )
    if match is None:
        raise InputError(
            "{value!r}: write the most players allowed at or above a level, such as 2:6.",
            value=text,
        )
    return int(match[1]), float(match[2])


STRONG = Named(strong_in, "K:LEVEL", spelled=lambda limit: f"{limit[0]}:{limit[1]:g}")
CAP = Number(0.001, 1e6, " isn't a number above 0, such as 23", metavar="TOTAL")
MOST_SETS = 25
SETS = Whole(1, MOST_SETS, metavar="K")


def points_in(text: str) -> TableRules:
    """Return a string's points for a match as rules for the standings.

    >>> points_in("3,1,0").win, points_in("1,0,0,1").a_set, points_in("apa_8ball").split
    (3.0, 1.0, 'apa_8ball')
    """
    from evenbreak.league.tables.rules import SPLITS, TableRules

    word = text.strip().lower().replace(" ", "_").replace("-", "_")
    if word in SPLITS:
        return TableRules(split=word)
    if word in ("sets", "games"):
        return TableRules(0.0, 0.0, 0.0, 1.0)
    try:
        numbers = [Number(0.0, 100.0).read(part) for part in text.split(",")]
        win, draw, loss, a_set, shutout = (*numbers, *[0.0] * (5 - len(numbers)))
        if len(numbers) < 3:
            raise InputError("too few")
    except (InputError, ValueError):
        message = (
            f"{text!r} isn't a rule for points. Give the points for a win, a draw and a loss, "
            "such as 2,1,0 (and for each game or set won, such as 1,0,0,1), or sets, or "
            f"{' or '.join(SPLITS)}."
        )
        raise InputError(message) from None
    return TableRules(win, draw, loss, a_set, shutout=shutout)


def points_spelled(rules: TableRules) -> str:
    """Return the points for a match in typed form."""
    if rules.split:
        return rules.split
    numbers = [rules.win, rules.draw, rules.loss, rules.a_set, rules.shutout]
    if numbers == [0.0, 0.0, 0.0, 1.0, 0.0]:
        return "sets"
    while len(numbers) > 3 and not numbers[-1]:
        numbers.pop()
    return ",".join(f"{one:g}" for one in numbers)


TABLE_POINTS = Named(points_in, "W,D,L|sets|apa_8ball|apa_9ball", spelled=points_spelled)


def names_in(text: str) -> tuple[str, ...]:
    """Return the words in a comma-separated list."""
    return tuple(part.strip() for part in text.split(",") if part.strip())


def ties_in(text: str) -> tuple[str, ...]:
    """Return the tie-breaks in a comma-separated list."""
    from evenbreak.league.tables.rules import TableRules

    return TableRules(ties=names_in(text)).ties


TIES = Named(ties_in, "RULE,...", spelled=",".join)

# What only the file has.


def _order(text: str) -> str:
    from evenbreak.teams.night import order_of

    if text.strip().lower() != "sealed":
        order_of(text, MOST_SETS, ["sealed"])
    return text.strip()


ORDER = Named(_order, "PATTERN")
COUNT = Choice(("sets", "games", "points"))


def _day(text: str) -> date:
    from evenbreak.files.tables.dates import read_date

    day = read_date(text.strip(), None)
    if day is None:
        raise InputError("{value!r} isn't a date. Write it as 2026-09-01.", value=text)
    return date.fromisoformat(str(day))


DAY = Named(_day, "DATE")


def _hours(text: str) -> tuple[time, time]:
    """Return when a night starts and ends.

    >>> _hours("19:00,23:00")[0].hour
    19
    """
    try:
        start, end = (time.fromisoformat(part.strip()) for part in text.split(","))
    except ValueError:
        raise InputError(
            '{value!r}: write when a night starts and ends, as in ["19:00", "23:00"]', value=text
        ) from None
    return start, end


HOURS = Named(_hours, spelled=lambda hours: ",".join(f"{one:%H:%M}" for one in hours))


def _color(text: str) -> str:
    if not re.fullmatch(r"#[0-9A-Fa-f]{6}", text.strip()):
        raise InputError('{value!r} isn\'t a color. Write one such as "#1b6e53".', value=text)
    return text.strip().lower()


COLOR = Named(_color, "COLOR")
PAPER = Choice(("letter", "a4"))
Shown = Literal["full", "initials", "hidden"]
"""How a site names a player, from the most detail to the least."""

NAMES = Choice(get_args(Shown))
MONEY = Number(0.0, 1e6, " isn't an amount of money, such as 10")


def _currency(text: str) -> str:
    if not 1 <= len(text.strip()) <= 5 or not text.isprintable():
        raise InputError('{value!r} isn\'t a currency symbol. Use one such as "$".', value=text)
    return text.strip()


CURRENCY = Named(_currency)


def _line(text: str) -> str:
    line = " ".join(unicodedata.normalize("NFC", text).split())
    if not 1 <= len(line) <= 200 or not line.isprintable():
        raise InputError(
            "{value!r} must be one line of up to 200 printable characters", value=line[:40]
        )
    return line


LINE = Named(_line)
FILE = Text("FILE")
