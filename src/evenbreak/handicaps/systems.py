"""Handicap systems: a scale, the charts by which it is played, and how ratings move.

An update rule is a plain function from a match to the points that winner and loser move.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

from evenbreak.errors import InputError
from evenbreak.ratings.scale import SCALES, Scale

__all__ = ["SYSTEMS", "PlayedMatch", "System", "UpdateRule", "system_of"]


class PlayedMatch(NamedTuple):
    """A match as an update rule sees it: ratings, games won and games needed, winner first."""

    rating: tuple[float, float]
    games: tuple[int, int] | None
    race: tuple[int, int] | None


UpdateRule = Callable[[PlayedMatch], tuple[int, int]]


@dataclass(frozen=True)
class System:
    """A handicap system.

    Parameters
    ----------
    name
        what the system is called.
    scale
        what a difference of its ratings means.
    charts
        the names of the charts by which it is played.
    rule
        from a match to the points that winner and loser move.
    in_words
        the rule, for a person.
    """

    name: str
    scale: Scale
    charts: tuple[str, ...]
    rule: UpdateRule
    in_words: str


def one_point_a_match(match: PlayedMatch) -> tuple[int, int]:  # noqa: ARG001
    """Return the National Pool League's moves: the winner up a point, the loser down one."""
    return 1, -1


SYSTEMS: Mapping[str, System] = MappingProxyType(
    {
        system.name: system
        for system in (
            System(
                "npl",
                SCALES["npl"],
                ("npl_8", "npl_10", "npl_12", "npl_20"),
                one_point_a_match,
                "up 1 point for each match won, down 1 for each match lost",
            ),
        )
    }
)
"""The systems, by name."""


def system_of(name: str) -> System:
    """Return the system of this name.

    Raises
    ------
    InputError
        if there is none.

    >>> system_of("npl").charts
    ('npl_8', 'npl_10', 'npl_12', 'npl_20')
    """
    key = name.strip().lower()
    if key not in SYSTEMS:
        raise InputError(f"system is {name!r}; give one of {', '.join(SYSTEMS)}")
    return SYSTEMS[key]
