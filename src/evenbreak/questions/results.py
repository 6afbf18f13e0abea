"""What every question about results asks: the files, and how they are to be read."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Literal, TypeAlias

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, File, Flag, Named, Text
from evenbreak.fields.question import Field, Question, Says
from evenbreak.files.tables.dates import is_two_dates, read_date
from evenbreak.questions.common import ChartName
from evenbreak.words import Parameter

_READING = "Reading the file"
_DAYS_AHEAD = 366

ON_STDIN = "- means standard input, which can stand for only one file. Name the others."

RESULTS = Field(File("RESULTS.csv..."), argument=True, many=True)
ROSTER = Field(File("ROSTER.csv"), "The list of ratings before these results.")

DATES = Field(
    Choice(("mdy", "dmy")),
    "The order of month and day in dates such as 9/3/2024: month first or day first.",
    usual="inferred from the file's other dates",
    section=_READING,
    more="See [dates](../files.md#dates).",
)

Day: TypeAlias = Annotated[str | None, Field(Text("DATE"), "A day.")]
"""A day as it is typed; `Results.day` reads it, in the order that --dates states."""


def columns_in(text: str) -> dict[str, str]:
    """Return the title of each column that a text names, for all files or for the one it names.

    >>> columns_in("player_a=Home,player_b=Away")
    {'player_a': 'Home', 'player_b': 'Away'}
    >>> columns_in("autumn.csv:player_a=Home,player_b=Away")
    {'autumn.csv:player_a': 'Home', 'autumn.csv:player_b': 'Away'}
    """
    columns: dict[str, str] = {}
    file, sign, rest = text.partition("=")[0].rpartition(":")
    text = rest + text[len(file + sign + rest) :]
    # A title may have a comma in it, but hardly words and an equals sign after it.
    for part in re.split(r",(?=[\w ]+=)", text):
        name, sign_of, title = (piece.strip() for piece in part.partition("="))
        name = file + sign + name.lower().replace(" ", "_")
        if not (part.partition("=")[0].strip() and sign_of and title):
            raise InputError(
                f"{part.strip()!r} isn't a column and its title. Write both, such as "
                "player_a=Home,player_b=Away."
            )
        if name in columns or title.casefold() in map(str.casefold, columns.values()):
            raise InputError(f"{part.strip()!r}; one of them was given before")
        columns[name] = title
    return columns


Columns: TypeAlias = Annotated[
    tuple[dict[str, str], ...],
    Field(
        Named(columns_in, "NAME=TITLE,..."),
        "Your file's column names, such as player_a=Home,player_b=Away.",
        many=True,
        section=_READING,
        more="With a file name and a colon in front, as in `autumn.csv:score=Stand`, a name "
        "applies only to that file. See [other names of "
        "columns](../files.md#other-names-of-columns).",
    ),
]


def in_one(columns: Sequence[Mapping[str, str]]) -> dict[str, str]:
    """Return the titles of all options --columns."""
    return {name: title for part in columns for name, title in part.items()}


@dataclass(frozen=True, kw_only=True)
class Reading(Question):
    """How a file of results is to be read."""

    aliases: Annotated[
        str | None,
        Field(
            File("ALIASES.csv"),
            "A file of names that mean the same player (columns name and means).",
            section=_READING,
            more="See [aliases](../files.md#aliases).",
        ),
    ] = None
    columns: Columns = ()
    skip_bad: Annotated[
        bool,
        Field(
            Flag(),
            "Skip unreadable rows and impossible scores, and list them.",
            usual="refuse the file",
            section=_READING,
            more="See [rows that are left out](../files.md#rows-that-are-left-out).",
        ),
    ] = False
    dates: Annotated[Literal["mdy", "dmy"] | None, DATES] = None

    def check(self) -> None:
        """Refuse a column that is named twice."""
        pairs = [pair for part in self.columns for pair in part.items()]
        titles = [(name.rpartition(":")[0], title.casefold()) for name, title in pairs]
        for k, (name, title) in enumerate(pairs):
            if name in dict(pairs[:k]) or titles[k] in titles[:k]:
                self.refuse(
                    "{columns} has {part!r}, but that column was already named",
                    part=f"{name}={title}",
                )

    @property
    def reading(self) -> dict[str, Any]:
        """How to read the results, as `files.read_results` takes it."""
        return {
            "aliases": self.aliases,
            "columns": in_one(self.columns),
            "dates": self.dates,
            "skip_bad": self.skip_bad,
        }

    def day(self, name: str) -> str | None:
        """Return the day in a field, written in any way of a results file, as 2026-01-31.

        In 9/3/2024 `dates` says which is the month. The day may lie up to a year ahead, for a
        tournament to come; a later one was mistyped.
        """
        import numpy as np

        text: str | None = getattr(self, name)
        if text is None:
            return None
        day = read_date(text.strip(), self.dates)
        if day is None:
            remedy = "Give a day such as 2026-01-31, 31.1.2026 or 1/31/2026."
            if is_two_dates(text.strip()):
                remedy = "Add {dates} mdy or {dates} dmy, or write 2026-01-31."
            self.refuse(
                "{part} {day!r} isn't a clear date. " + remedy, part=Parameter(name), day=text
            )
        if day > np.datetime64("today", "D") + np.timedelta64(_DAYS_AHEAD, "D"):
            self.refuse(
                "{part} must be no more than a year from today; you gave {day!r}",
                part=Parameter(name),
                day=text,
            )
        return str(day)


@dataclass(frozen=True, kw_only=True)
class ByChart(Reading):
    """Results whose races a chart may have set."""

    chart: Annotated[
        ChartName,
        Says(
            "Chart that set the races, if the file has skill levels (or ratings) but no races.",
            section=_READING,
            more="See [races that a chart has set](../files.md#races-that-a-chart-has-set).",
        ),
    ] = None

    @property
    def reading(self) -> dict[str, Any]:
        """How to read the results, as `files.read_results` takes it."""
        return {**super().reading, "chart": self.chart}


@dataclass(frozen=True, kw_only=True)
class Results(ByChart):
    """A question about results, in one file or several."""

    results: Annotated[tuple[str, ...], RESULTS]
