"""How long matches take, as questions about an evening ask it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, TypeAlias

from evenbreak.fields.kinds import File
from evenbreak.fields.question import Field, Question
from evenbreak.files.league import values
from evenbreak.tournaments.evening.format import Discipline

MINUTES = Field(
    values.MINUTES,
    "Average minutes per game, instead of the discipline's usual time.",
    metavar="MINUTES",
)
Turnover: TypeAlias = Annotated[
    float | None,
    Field(values.TURNOVER, "Average minutes between two matches on a table.", metavar="MINUTES"),
]
EarlierNights: TypeAlias = Annotated[
    tuple[str, ...],
    Field(
        File("FILE.db"),
        "An earlier tournament at this venue, or a folder of them: their times set the pace.",
        usual="the usual pace",
        many=True,
        section="Details",
        more="Only nights of the same discipline count. A file also remembers the nights used "
        "to plan its own tournament, so the latest file is enough. "
        "[Brackets](../../explanation/brackets.md#time) explains the method.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class Pace(Question):
    """How fast matches are played."""

    discipline: Discipline | None = None
    minutes_per_game: Annotated[float | None, MINUTES] = None

    def check(self) -> None:
        """Refuse two paces."""
        if self.discipline is not None and self.minutes_per_game is not None:
            self.refuse(
                "{discipline} and {minutes_per_game} can't be used together. Leave one out."
            )
