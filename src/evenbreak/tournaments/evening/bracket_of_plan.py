"""The bracket of a plan, once the players are drawn."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.brackets.double import double_elimination, pods
from evenbreak.tournaments.brackets.groups import groups_then_knockout, round_robin
from evenbreak.tournaments.brackets.knockout import (
    consolation,
    king_of_the_hill,
    single_elimination,
)
from evenbreak.tournaments.brackets.laid_out import laid_out
from evenbreak.tournaments.brackets.swiss import swiss_bracket
from evenbreak.tournaments.evening.chip_night import rack_bracket
from evenbreak.tournaments.evening.events import Plan
from evenbreak.tournaments.evening.later_draws import swiss_of


@lru_cache(maxsize=8)
def bracket_of(plan: Plan, order: tuple[str, ...], lines: tuple[int | None, ...] | None) -> Bracket:
    """Return the bracket of a draw; that of the last draws is kept for the states that follow.

    >>> bracket_of(Plan("single", 5), ("Ann", "Bo", "Cy"), (0, None, 1, 2)).byes
    (('W1.1', 0),)
    """
    if plan.layout:
        return laid_out(plan.form, order, plan.layout)
    pattern: Any = plan.drops
    final: Any = plan.final
    match plan.form:
        case "double":
            return double_elimination(
                order, final=final, qualifiers=plan.qualifiers, drops=pattern, lines=lines
            )
        case "single":
            return single_elimination(order, third_place=plan.third_place, lines=lines)
        case "consolation":
            return consolation(order, lines=lines)
        case "pods":
            each: Any = plan.qualifiers or 1
            return pods(order, size=plan.pod_size, qualifiers=each, drops=pattern, lines=lines)
        case "groups":
            many = groups_of(plan, len(order))
            return groups_then_knockout(order, many, qualifiers=plan.qualifiers or 2)
        case "round-robin":
            return round_robin(order)
        case "swiss":
            return swiss_bracket(swiss_of(plan, order))
        case "chips":
            return rack_bracket(order)
    return king_of_the_hill(order)


def groups_of(plan: Plan, players: int) -> int:
    """Return the number of groups: unless given, groups of four, or of three and four.

    >>> [groups_of(Plan("groups", 5), players) for players in (8, 12, 14, 16)]
    [2, 3, 4, 4]
    """
    return plan.groups or max(2, -(-players // 4))
