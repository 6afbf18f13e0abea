"""What a plan has for its format: each part with its limits, as every face asks for it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, TypeAlias

from msgspec import Meta

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Choice, Flag, Whole
from evenbreak.fields.question import Field
from evenbreak.words import say

Race: TypeAlias = Annotated[int, Meta(ge=1, le=1_000)]
Table: TypeAlias = Annotated[int, Meta(ge=1, le=1_000)]
Slower: TypeAlias = Annotated[float, Meta(ge=0.5, le=2)]
Few: TypeAlias = Annotated[int, Meta(ge=1, le=256)]

DISCIPLINES = ("8-ball", "9-ball", "10-ball")
MOST_PLAYERS, MOST_TABLES, LONGEST_RACE = 256, 1000, 100
"""How large a tournament or a team night may be."""

Tables: TypeAlias = Annotated[
    Table, Field(Whole(1, MOST_TABLES), "The number of tables.", metavar="T", label=say("Tables"))
]
Discipline: TypeAlias = Annotated[
    str, Field(Choice(DISCIPLINES), "The game, for how long matches take.", label=say("Game"))
]

_FORMAT, _RACES = "Format", "Races"
_PLAYERS = Whole(1, MOST_PLAYERS)
_RACE = Whole(1, LONGEST_RACE)
LosersRace: TypeAlias = Annotated[
    Race | None,
    Field(
        _RACE,
        "Races on the losers' side, and in a consolation event.",
        usual="as the others",
        label=say("Race on the losers' side (blank: the same)"),
        section=_RACES,
        formats=("double", "pods", "consolation"),
    ),
]
FinalRace: TypeAlias = Annotated[
    Race | None,
    Field(
        _RACE,
        "Races of the final, and of a second final.",
        usual="as the others",
        label=say("Race in the final (blank: the same)"),
        section=_RACES,
        formats=("double", "single", "pods", "groups", "consolation", "king-of-the-hill"),
    ),
]


@dataclass(frozen=True, kw_only=True)
class Format:
    """What a plan has for its format, all of which the terminal and the page ask for.

    A field added here is one of the plan, and of every question about a tournament.
    """

    final: Annotated[
        str,
        Field(
            Choice(("true", "single")),
            "The final of a double elimination: must the undefeated player lose twice (true), or "
            "once (single)?",
            label=say("Final of a double elimination"),
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
            "How many go on: from a double elimination to a single one (2, 4, 8 ...), or from each "
            "group or pod.",
            usual="2 from a group, 1 from a pod",
            metavar="M",
            label=say("Players advancing from each group, pod or side (blank: default)"),
            section=_FORMAT,
            formats=("double", "groups", "pods"),
            more="Half of the qualifiers of a double elimination come from each side.",
        ),
    ] = None
    placement: Annotated[
        str,
        Field(
            Choice({"half-shift": "half shift", "redraw": "redraw"}),
            "How the losers' side's qualifiers meet the winners' side's: the halves crossed, or "
            "drawn.",
            label=say("How those from the losers' side meet the others"),
            titles={"half-shift": say("The halves crossed"), "redraw": say("Drawn again")},
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
            "Where losers of the winners' side drop to, in a double elimination or in pods.",
            metavar="NAME",
            label=say("Where losers of the winners' side drop to"),
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
            "How many players of all groups together go on.",
            usual="as many as those from each group",
            metavar="M",
            label=say("Players advancing from all groups together (blank: as many from each)"),
            section=_FORMAT,
            formats=("groups",),
            more="16 from 5 groups are the first three of each group and the best of those who are "
            "fourth: by the share of their matches won, then by games won minus games lost for "
            "each match, and then by lot.",
        ),
    ] = None
    pod_size: Annotated[
        Few,
        Field(
            Choice({"4": 4, "8": 8, "16": 16}, "N"),
            "The lines of a pod: 4, 8 or 16.",
            label=say("Players in a pod"),
            section=_FORMAT,
            formats=("pods",),
        ),
    ] = 8
    rounds: Annotated[
        Few | None,
        Field(
            _PLAYERS,
            "The rounds of a Swiss.",
            usual="as many as a single elimination has",
            label=say("Rounds of a Swiss (blank: as many as in a single elimination)"),
            section=_FORMAT,
            formats=("swiss",),
        ),
    ] = None
    losers_race: LosersRace = None
    final_race: FinalRace = None


@dataclass(frozen=True, kw_only=True)
class Occasion:
    """What the house says of an evening: its name, what its tables are called, its pace.

    Parameters
    ----------
    name, date
        what the event is called, and when it is.
    tables
        how many tables there are.
    labels
        what the house calls its tables, from the first; () and beyond them: their numbers.
    reserved
        the tables that are given out by hand only.
    streamed
        the tables that are filmed.
    slower
        how much longer matches take here than is usual.
    """

    tables: Tables = 4
    name: str = ""
    date: str = ""
    labels: tuple[str, ...] = ()
    reserved: tuple[Table, ...] = ()
    streamed: tuple[Table, ...] = ()
    slower: Slower = 1.0

    def table_name(self, table: int) -> str:
        """Return what the house calls a table.

        >>> plan = Occasion(labels=("1", "2", "TV"))
        >>> plan.table_name(3), plan.table_name(4)
        ('TV', '4')
        """
        return self.labels[table - 1] if table <= len(self.labels) else str(table)

    def table_number(self, text: str) -> int:
        """Return the number of a table, by what the house calls it or by the number itself.

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
            "there is no table {table}; the tables are {tables}",
            table=text.strip(),
            tables=", ".join(names),
        )
