"""A plan's format settings, each with its limits, as every interface asks for them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, NamedTuple, TypeAlias

from msgspec import Meta

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, Flag, Named, Whole
from evenbreak.fields.question import Field
from evenbreak.words import say

Race: TypeAlias = Annotated[int, Meta(ge=1, le=1_000)]
Table: TypeAlias = Annotated[int, Meta(ge=1, le=1_000)]
Slower: TypeAlias = Annotated[float, Meta(ge=0.5, le=2)]
Few: TypeAlias = Annotated[int, Meta(ge=1, le=256)]

DISCIPLINES = ("8-ball", "9-ball", "10-ball")
MOST_PLAYERS, MOST_TABLES, LONGEST_RACE = 256, 1000, 100
"""The largest size of a tournament or a team night."""

Tables: TypeAlias = Annotated[
    Table, Field(Whole(1, MOST_TABLES), "The number of tables.", metavar="T", label=say("Tables"))
]


class HouseTables(NamedTuple):
    """How many tables there are, and what the venue calls them; None: not stated."""

    many: int
    labels: tuple[str, ...] | None = None

    def __str__(self) -> str:
        return names_text(self.labels) if self.labels else str(self.many)


_SPAN = re.compile(r"([0-9]{1,4})\s*[-–—]\s*([0-9]{1,4})")
LONGEST_LABEL = 12


def names_in(text: str) -> tuple[str, ...]:
    """Return the table names in a list; numbers may be a range.

    >>> names_in("5-8, TV"), names_in("none")
    (('5', '6', '7', '8', 'TV'), ())
    """
    names: list[str] = []
    for part in (" ".join(one.split()) for one in re.split("[,;]", text)):
        span = _SPAN.fullmatch(part)
        names += map(str, range(int(span[1]), int(span[2]) + 1)) if span else [part]
    found = tuple(filter(None, names))
    return () if [one.casefold() for one in found] == ["none"] else found


def names_text(names: Sequence[str]) -> str:
    """Return table names as a list in the form `names_in` reads.

    >>> names_text(["1", "2", "3", "TV", "5"])
    '1-3, TV, 5'
    """
    runs: list[list[str]] = []
    for name in names:
        last = runs[-1][-1] if runs else ""
        if name.isdecimal() and last.isdecimal() and int(name) == int(last) + 1:
            runs[-1].append(name)
        else:
            runs.append([name])
    return ", ".join(f"{run[0]}-{run[-1]}" if len(run) > 1 else run[0] for run in runs)


def house_tables(text: str) -> HouseTables:
    """Return how many tables there are, or their names.

    Raises InputError if there are none, too many, or two with the same name.

    >>> house_tables("4"), house_tables("1-2, TV"), house_tables("1-4").labels
    (HouseTables(many=4, labels=None), HouseTables(many=3, labels=('1', '2', 'TV')), ())
    """
    names, plain = names_in(text), text.strip()
    if re.fullmatch("[0-9]{1,4}", plain, re.ASCII):
        count, names = int(plain), ()
    else:
        count = len(names) if len(names) > 1 else 0  # a word alone is a slip
    if not 1 <= count <= MOST_TABLES or any(len(name) > LONGEST_LABEL for name in names):
        raise InputError(
            "{tables!r}: write how many tables there are, from 1 to {most:,}, or their names, "
            "such as 1-3, TV",
            tables=text[:60],
            most=MOST_TABLES,
        )
    known = [name.casefold() for name in names]
    twice = next((name for name in names if known.count(name.casefold()) > 1), None)
    if twice:
        raise InputError("two tables are called {name}. Give each its own name.", name=twice)
    if not names:
        return HouseTables(count)
    numbered = names == tuple(map(str, range(1, count + 1)))
    return HouseTables(count, () if numbered else names)


NamedTables: TypeAlias = Annotated[
    HouseTables,
    Field(
        Named(house_tables, "T|NAME,...", number=True),
        "How many tables there are, or their names, such as 4, or 5-8,TV.",
        label=say("Tables (how many, or their names)"),
    ),
]
Discipline: TypeAlias = Annotated[
    str,
    Field(Choice(DISCIPLINES), "The game, which affects how long matches take.", label=say("Game")),
]

_FORMAT, _RACES = "Format", "Races"
_PLAYERS = Whole(1, MOST_PLAYERS)
_RACE = Whole(1, LONGEST_RACE)
LosersRace: TypeAlias = Annotated[
    Race | None,
    Field(
        _RACE,
        "The race on the losers' side, and in a consolation event.",
        usual="the same as the others",
        label=say("Race on the losers' side (blank: the same)"),
        section=_RACES,
        formats=("double", "pods", "consolation"),
    ),
]
FinalRace: TypeAlias = Annotated[
    Race | None,
    Field(
        _RACE,
        "The race in the final, and in a second final.",
        usual="the same as the others",
        label=say("Race in the final (blank: the same)"),
        section=_RACES,
        formats=("double", "single", "pods", "groups", "consolation", "king-of-the-hill"),
    ),
]


@dataclass(frozen=True, kw_only=True)
class Format:
    """A plan's format settings, which both the terminal and the page ask for.

    A field added here is added to the plan, and to every question about a tournament.
    """

    final: Annotated[
        str,
        Field(
            Choice(("true", "single")),
            "The final of a double elimination: does the undefeated player have to lose twice "
            "(true), or only once (single)?",
            label=say("Double-elimination final"),
            titles={
                "true": say("The unbeaten player must lose twice"),
                "single": say("One match decides"),
            },
            section=_FORMAT,
            formats=("double",),
        ),
    ] = "true"
    third_place: Annotated[
        bool,
        Field(
            Flag(),
            "Single elimination with a match for third place.",
            label=say("A match for third place (single elimination)"),
            section=_FORMAT,
            formats=("single",),
        ),
    ] = False
    qualifiers: Annotated[
        Few | None,
        Field(
            _PLAYERS,
            "How many players advance: from a double elimination to a single elimination (2, 4, "
            "8 ...), or from each group or pod.",
            usual="2 from a group, 1 from a pod",
            metavar="M",
            label=say("Players advancing from each group, pod or side (blank: default)"),
            section=_FORMAT,
            formats=("double", "groups", "pods"),
            more="In a double elimination, half of the qualifiers come from each side.",
        ),
    ] = None
    placement: Annotated[
        str,
        Field(
            Choice({"half-shift": "half shift", "redraw": "redraw"}),
            "How qualifiers from the losers' side are paired with those from the winners' side: "
            "by crossing the halves, or by a draw.",
            label=say("How qualifiers from the losers' side meet the others"),
            titles={"half-shift": say("Cross the halves"), "redraw": say("Redraw")},
            section=_FORMAT,
            rare=True,
            formats=("double",),
        ),
    ] = "half shift"
    drops: Annotated[
        str,
        Field(
            Choice(
                {"fewest-rematches": "fewest rematches", "usual": "usual", "straight": "straight"}
            ),
            "Where losers from the winners' side drop to, in a double elimination or in pods.",
            metavar="NAME",
            label=say("Where losers from the winners' side drop to"),
            titles={
                "fewest-rematches": say("Fewest rematches"),
                "usual": say("As in most programs"),
                "straight": say("Straight across"),
            },
            section=_FORMAT,
            rare=True,
            formats=("double", "pods"),
            more="`fewest-rematches`, `usual` (as most programs do) or `straight`.",
        ),
    ] = "fewest rematches"
    groups: Annotated[
        Few | None,
        Field(
            _PLAYERS,
            "The number of groups.",
            usual="groups of 4, or of 3 and 4",
            label=say("Number of groups (blank: groups of 3 and 4)"),
            section=_FORMAT,
            formats=("groups",),
        ),
    ] = None
    knockout_size: Annotated[
        Few | None,
        Field(
            _PLAYERS,
            "How many players advance from all groups together.",
            usual="the qualifiers from all groups",
            metavar="M",
            label=say(
                "Players advancing from all groups together (blank: the same number from each)"
            ),
            section=_FORMAT,
            formats=("groups",),
            more="If 16 advance from 5 groups, they are the top three in each group and the "
            "best fourth-place player: by the share of matches won, then by games won "
            "minus games lost per match, and then by lot.",
        ),
    ] = None
    pod_size: Annotated[
        Few,
        Field(
            Choice({"4": 4, "8": 8, "16": 16}, "N"),
            "How many players a pod holds: 4, 8 or 16.",
            label=say("Players in a pod"),
            section=_FORMAT,
            formats=("pods",),
        ),
    ] = 8
    rounds: Annotated[
        Few | None,
        Field(
            _PLAYERS,
            "How many rounds a Swiss has.",
            usual="as many as in a single elimination",
            label=say("Rounds of a Swiss (blank: as many as in a single elimination)"),
            section=_FORMAT,
            formats=("swiss",),
        ),
    ] = None
    losers_race: LosersRace = None
    final_race: FinalRace = None


@dataclass(frozen=True, kw_only=True)
class Occasion:
    """The venue's facts about an evening: its name, its tables, its pace.

    `labels` are the table names, starting with the first table; any further tables have numbers.
    `reserved` tables are assigned by hand only, `streamed` ones are filmed; `slower` is how many
    times as long as usual matches take.
    """

    tables: Tables = 4
    name: str = ""
    date: str = ""
    labels: tuple[str, ...] = ()
    reserved: tuple[Table, ...] = ()
    streamed: tuple[Table, ...] = ()
    slower: Slower = 1.0

    def table_name(self, table: int) -> str:
        """Return the venue's name for a table.

        >>> plan = Occasion(labels=("1", "2", "TV"))
        >>> plan.table_name(3), plan.table_name(4)
        ('TV', '4')
        """
        return self.labels[table - 1] if table <= len(self.labels) else str(table)

    def table_number(self, text: str) -> int:
        """Return a table's number, given the venue's name for it or the number itself.

        >>> plan = Occasion(labels=("1", "2", "TV"))
        >>> plan.table_number("tv"), plan.table_number("table 3"), plan.table_number("4")
        (3, 3, 4)
        """
        wanted = " ".join(text.casefold().removeprefix("table").split())
        names = [self.table_name(table) for table in range(1, self.tables + 1)]
        for table, name in enumerate(names, 1):
            if name.casefold() in (wanted, " ".join(text.casefold().split())):
                return table
        if wanted.isascii() and wanted.isdigit() and 1 <= int(wanted[:5]) <= self.tables:
            return int(wanted)
        raise InputError(
            "there's no table {table}; the tables are {tables}",
            table=text.strip(),
            tables=", ".join(names),
        )
