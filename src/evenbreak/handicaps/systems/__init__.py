"""Handicap systems, one a file: a scale, the charts by which it is played, an update rule."""

from evenbreak.handicaps.systems.catalogue import FAMILIES, SYSTEMS, system_of
from evenbreak.handicaps.systems.elo import elo_system
from evenbreak.handicaps.systems.fixed import fixed_length_system
from evenbreak.handicaps.systems.margin import margin_system
from evenbreak.handicaps.systems.newcomers import NEWCOMER_STEPS, step_after
from evenbreak.handicaps.systems.step import step_system
from evenbreak.handicaps.systems.system import PlayedMatch, System, UpdateRule

__all__ = [
    "FAMILIES",
    "NEWCOMER_STEPS",
    "SYSTEMS",
    "PlayedMatch",
    "System",
    "UpdateRule",
    "elo_system",
    "fixed_length_system",
    "margin_system",
    "step_after",
    "step_system",
    "system_of",
]
