"""The plan of a tournament: its format and its races, as the terminal and the page ask for it."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Annotated, Any

from evenbreak.fields.kinds import Choice
from evenbreak.fields.question import Field, Question, declared
from evenbreak.questions.common import CHIPS, ChartOfRaces, EvenRace, HandicappedRace
from evenbreak.tournaments.evening.fold import ELIMINATIONS
from evenbreak.tournaments.evening.format import Format
from evenbreak.tournaments.evening.plan import FORMATS
from evenbreak.words import Parameter, say

_RACES = ("race", "race_to", "chart", "losers_race", "final_race")
SEEDINGS = ("listed", "rating", "blind", "drawn")
FORMAT_TITLES = {
    "double": say("Double elimination"),
    "single": say("Single elimination"),
    "round-robin": say("Round robin"),
    "groups": say("Groups, then knockout"),
    "consolation": say("Single elimination with consolation"),
    "king-of-the-hill": say("King of the hill"),
    "swiss": say("Swiss"),
    "chips": say("Chip tournament"),
    "pods": say("Pods: double elimination in small brackets, then single"),
}


@dataclass(frozen=True, kw_only=True)
class TournamentPlan(Format, Question):
    """What is played: the format and the races."""

    form: Annotated[
        str,
        Field(
            Choice(FORMATS),
            ", ".join(FORMATS).capitalize() + ".",
            option="format",
            label=say("Format"),
            titles=FORMAT_TITLES,
            metavar="FORMAT",
            more="`double` elimination, `single` elimination, `pods` (double elimination in "
            "pods, then single), `groups` (round robin in groups, then knockout), `swiss` "
            "(needs `pip install 'evenbreak[swiss]'`), `round-robin`, `consolation` "
            "(those who lose their first match play a second event), `king-of-the-hill` "
            "(the first two in the list play, the winner meets the third, and so on), or "
            "`chips`, which only `tournament new` takes: it [runs a chip "
            "night](../../how-to/run-a-chip-tournament.md#run-the-night). For the odds "
            "before the first rack, see [evenbreak chips](#evenbreak-chips).",
        ),
    ] = "double"
    race: EvenRace = None
    race_to: HandicappedRace = None
    chart: ChartOfRaces = None
    seeding: Annotated[
        str | None,
        Field(
            Choice(SEEDINGS),
            "The order of the seeds: listed (as in the file), rating, blind (at random), or drawn "
            "(on paper).",
            usual="listed; chips: blind",
            metavar="ORDER",
            label=say("Draw"),
            titles={
                "": say("Default: as listed; chip tournaments at random"),
                "listed": say("Seeded as listed"),
                "rating": say("Seeded by rating"),
                "blind": say("Blind draw"),
            },
            more="`blind` is drawn at random. `drawn` means that the draw has already been "
            "made: the first two players in the file meet, then the next two, and so on. "
            "The file has 2, 4, 8, 16 … rows, some of which may be named `bye 1`, `bye 2` …",
        ),
    ] = None
    chips: Annotated[
        str | None,
        Field(
            CHIPS,
            "The chips at the start of a chip tournament: hoboken, pharaohs, or a file.",
            section="Format",
            formats=("chips",),
            more="A [file](../files.md#chip-charts) has the columns rating_from and chips. Ratings "
            "are then on the Fargo scale unless the file or `--scale` says otherwise, and there "
            "are no races.",
        ),
    ] = None

    def check(self) -> None:
        """Refuse parts of a plan that do not go together, when there is a plan."""
        if not self.planned:
            return
        self._check_races()
        for one in declared(TournamentPlan):
            if one.field.formats and one.name in self.given and self.form not in one.field.formats:
                self.refuse(
                    "{part} is for {form} {formats}, not {asked}. Leave it out.",
                    part=Parameter(one.name),
                    formats=" or ".join(one.field.formats),
                    asked=self.form,
                )
        if self.knockout_size is not None and self.qualifiers is not None:
            self.refuse(
                "{qualifiers} is the number from each group, and {knockout_size} the "
                "number from all groups. Leave one out."
            )
        if self.qualifiers is not None:
            self._check_qualifiers(self.qualifiers)
        elif "placement" in self.given:
            self.refuse(
                "{placement} is for qualifiers. Give {qualifiers} M too, or leave {placement} out."
            )

    @property
    def planned(self) -> bool:
        """Whether there is a plan; a tournament under way has its own."""
        return True

    def _check_races(self) -> None:
        races = [one for one in (self.race, self.race_to, self.chart) if one is not None]
        apart = self.losers_race is not None or self.final_race is not None
        if self.form == "chips":
            if races or apart:
                extra = next(one for one in _RACES if getattr(self, one) is not None)
                self.refuse(
                    "a chip tournament is played by the rack. Leave out {extra}.",
                    extra=Parameter(extra),
                )
            if self.chips is None:
                self.refuse("Add a chip chart: {chips} NAME, such as hoboken.")
        elif len(races) != 1:
            if races:
                self.refuse(
                    "the races are given twice. Use only one of {race}, {race_to} and {chart}."
                )
            self.refuse("Add a race: one of {race}, {race_to} and {chart}.")
        elif self.chart is not None and apart:
            self.refuse("{chart} sets all races. Leave out {losers_race} and {final_race}.")

    def _check_qualifiers(self, qualifiers: int) -> None:
        if "final" in self.given:
            self.refuse("{qualifiers} leads to one final. Leave out {final}.")
        if self.form == "double" and (qualifiers < 2 or qualifiers & (qualifiers - 1)):
            self.refuse(
                "{qualifiers} must be 2, 4, 8 or another power of 2; you gave {m}", m=qualifiers
            )
        if self.form == "pods" and qualifiers > 2:
            self.refuse("{qualifiers} must be 1 or 2 for pods; you gave {m}", m=qualifiers)

    @property
    def seeded(self) -> str:
        """How the seeds are ordered."""
        return self.seeding or ("blind" if self.form == "chips" else "listed")

    @property
    def of_format(self) -> dict[str, Any]:
        """What the plan has for its format, by name."""
        return {one.name: getattr(self, one.name) for one in fields(Format)}


def refuse_lines(asked: TournamentPlan) -> None:
    """Refuse a draw made on paper for a format that draws otherwise."""
    if asked.seeding == "drawn" and asked.form not in ELIMINATIONS:
        asked.refuse(
            "{seeding} drawn is for eliminations, not {asked}. Use another order.", asked=asked.form
        )
