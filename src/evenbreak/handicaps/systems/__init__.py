"""Handicap systems, one a file: a scale, the charts by which it is played, an update rule."""

from evenbreak.handicaps.systems.catalogue import FAMILIES, SYSTEMS, system_of
from evenbreak.handicaps.systems.npl import NEWCOMER_STEPS
from evenbreak.handicaps.systems.step import step_system
from evenbreak.handicaps.systems.system import PlayedMatch, System, UpdateRule, step_after

__all__ = [
    "FAMILIES",
    "NEWCOMER_STEPS",
    "SYSTEMS",
    "PlayedMatch",
    "System",
    "UpdateRule",
    "step_after",
    "step_system",
    "system_of",
]
