"""The handicap system of a question; apart from what a single match needs, which loads faster."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from evenbreak.fields.kinds import Named
from evenbreak.fields.question import Field
from evenbreak.handicaps.systems.catalogue import system_of
from evenbreak.handicaps.systems.system import System

SystemOf: TypeAlias = Annotated[
    System | None,
    Field(
        Named(system_of, "NAME", offers="systems", spelled=lambda system: str(system.name)),
        "How ratings move: npl, step UP [DOWN], margin [MOST], elo [K] or fixed [GAMES].",
        usual="npl",
    ),
]
"""A handicap system; `asked.system or system_of("npl")` is the one that is meant."""
