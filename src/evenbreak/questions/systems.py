"""The handicap system of a question; apart from what a single match needs, which loads faster."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from evenbreak.fields.kinds import Kind, Named, Number
from evenbreak.fields.question import Field, Question, Says
from evenbreak.files.league.values import SYSTEM
from evenbreak.questions.common import ChartName

if TYPE_CHECKING:
    from evenbreak.handicaps.systems.system import System
else:  # systems take a quarter of a second to load, which most questions do without
    System = Any


def _system(text: str) -> System:
    from evenbreak.handicaps.systems.catalog import system_of
    from evenbreak.handicaps.systems.own import own_system

    if ":" in text:
        if "" not in sys.path:  # a class in the folder where the command is run
            sys.path.append("")
        return own_system(text)
    return system_of(text)


@dataclass(frozen=True)
class _AnySystem(Named):
    """A system, perhaps by code of one's own, which other computers may not name."""

    def from_afar(self) -> Kind:
        """Return the kind of those that come with the program."""
        return SYSTEM


ANY_SYSTEM = _AnySystem(_system, SYSTEM.metavar, SYSTEM.offers, SYSTEM.spelled)
"""A handicap system that a user names, who may name code of their own; a file may not."""

SystemOf: TypeAlias = Annotated[
    System | None,
    Field(
        ANY_SYSTEM,
        "How ratings move: npl, step UP [DOWN], margin [MOST], elo [K], fixed [GAMES], "
        "none [GAMES], fargo-like, level-review, apa-like, tap-like, level-steps [STEPS], "
        "averages, win-percent, napa-like, or a class of your own as MODULE:CLASS.",
        usual="npl",
        more="`evenbreak systems` lists them, with those of installed packages. Put a name that "
        "has a space in quotes, or use a hyphen: `step-2`. Parameters can be set by name: "
        "`'level-review window=15'`. See [Systems](../systems.md).",
    ),
]
"""A handicap system; `asked.system or system_of("npl")` is the one that is meant."""

DAY_SD = Field(
    Number(0.0, 1e9, " isn't 0 or more points", metavar="POINTS"),
    "Variation of everyone's form from day to day (standard deviation).",
)


@dataclass(frozen=True, kw_only=True)
class BySystem(Question):
    """A question about a league that has a handicap system, and a chart that sets its races."""

    chart: Annotated[ChartName, Says(usual="the system's own")] = None
    system: SystemOf = None
