"""An evening's plan: the available formats, how to start one, its bracket, and its races."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, replace
from functools import lru_cache
from typing import Any

import numpy as np

from evenbreak.errors import InputError
from evenbreak.fields.question import declared
from evenbreak.ratings.roster import Roster
from evenbreak.tournaments.brackets.bracket import Bracket, Slot, Source
from evenbreak.tournaments.brackets.double import (
    double_elimination,
    losers_qualifiers,
    pods,
    redrawn,
)
from evenbreak.tournaments.brackets.groups import groups_then_knockout, round_robin
from evenbreak.tournaments.brackets.knockout import (
    consolation,
    king_of_the_hill,
    single_elimination,
)
from evenbreak.tournaments.brackets.laid_out import laid_out
from evenbreak.tournaments.brackets.swiss import Pairing, Swiss, swiss, swiss_bracket, swiss_round
from evenbreak.tournaments.evening.chip_night import rack_bracket
from evenbreak.tournaments.evening.events import Changed, Entrant, Event, Opened, Plan, Result
from evenbreak.tournaments.evening.format import MOST_PLAYERS, Format, Occasion
from evenbreak.tournaments.odds.races import Fairest, Races

FORMATS = (
    "double",
    "single",
    "pods",
    "groups",
    "swiss",
    "round-robin",
    "consolation",
    "king-of-the-hill",
    "chips",
)
"""The formats in which a tournament can be started."""

FORMATS_WITH: Mapping[str, tuple[str, ...]] = {
    **{one.name: one.field.formats for one in declared(Format) if one.field.formats},
    "chips": ("chips",),
}
"""The formats for each part of a plan that only some formats have."""

BYE = re.compile(r"byes?[\s\d]*", re.IGNORECASE)
"""How a bye is written in a list."""

KNOCK_OUT = "K1"
"""The stage of the redraw: the first round of the knockout."""

TO_DRAW = "to draw"
"""In place of a match, the source of a player who is still to be drawn."""

Drawn = Mapping[str, tuple[str | None, ...]]
"""What has been drawn, by stage: a round's players in pairs, or where qualifiers come from."""


def entrants_of(roster: Roster) -> tuple[Entrant, ...]:
    """Return a list's players; if it doesn't state an error, the rating counts as exact.

    >>> entrants_of(Roster(["Ann"], [600.0]))
    (Entrant(name='Ann', rating=600.0, standard_error=0.0, provisional=False),)
    """
    errors = np.nan_to_num(roster.standard_error)
    columns = (one.tolist() for one in (roster.rating, errors, roster.provisional))
    return tuple(Entrant(*one) for one in zip(roster.players, *columns, strict=True))


def opened(plan: Plan, entrants: Sequence[Entrant]) -> Opened:
    """Start an evening, if the plan suits the entrants; more may enter later, or all of them.

    Raises InputError if there are too few or too many players for the plan, or one of them is a
    bye.
    """
    names = tuple(one.name for one in entrants)
    if len(names) == 1 or len(names) > MOST_PLAYERS:
        raise InputError(
            "a tournament takes 2 to {most} players; {entered:,} have entered",
            most=MOST_PLAYERS,
            entered=len(names),
        )
    for name in names:
        refuse_bye(name)
    refuse_tables(plan)
    if not names:
        return Opened(plan, ())
    if plan.chips is not None:
        plan.chips.chips([one.rating for one in entrants])  # refuses ratings below the chart
    elif plan.form == "swiss":
        swiss_round(swiss_of(plan, names))  # refuses what cannot be paired
    else:
        bracket_of(plan, names, None)
    return Opened(plan, tuple(entrants))


def refuse_tables(plan: Plan) -> None:
    """Reject tables if two have the same name, or a table doesn't exist."""
    names = [plan.table_name(table).casefold() for table in range(1, plan.tables + 1)]
    for name in names:
        if not name.strip() or names.count(name) > 1:
            raise InputError("two tables are called {table!r}. Give each its own name.", table=name)
    for table in (*plan.reserved, *plan.streamed):
        if table > plan.tables:
            raise InputError(
                "there's no table {table}; the tables are {tables}",
                table=table,
                tables=", ".join(plan.table_name(k) for k in range(1, plan.tables + 1)),
            )


def refuse_bye(name: str) -> None:
    """Reject a bye in place of a player."""
    if BYE.fullmatch(name):
        raise InputError(
            "{name!r} is a bye, not a player. Leave it out; the draw adds byes.", name=name
        )


@lru_cache(maxsize=8)
def bracket_of(plan: Plan, order: tuple[str, ...], lines: tuple[int | None, ...] | None) -> Bracket:
    """Return a draw's bracket, caching the last ones for the states that follow.

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
            return groups_then_knockout(
                order, many, qualifiers=plan.qualifiers or 2, knockout_size=plan.knockout_size
            )
        case "round-robin":
            return round_robin(order)
        case "swiss":
            return swiss_bracket(swiss_of(plan, order))
        case "chips":
            return rack_bracket(order)
    return king_of_the_hill(order)


def groups_of(plan: Plan, players: int) -> int:
    """Return the number of groups: by default, groups of four, or of three and four.

    >>> [groups_of(Plan("groups", 5), players) for players in (8, 12, 14, 16)]
    [2, 3, 4, 4]
    """
    return plan.groups or max(2, -(-players // 4))


def swiss_of(plan: Plan, order: tuple[str, ...]) -> Swiss:
    """Return a plan's Swiss: by default, with as many rounds as a single elimination.

    >>> swiss_of(Plan("swiss", 5), ("Ann", "Bo", "Cy", "Di", "Ed")).rounds
    3
    """
    return swiss(order, plan.rounds or (len(order) - 1).bit_length())


def bracket_now(bracket: Bracket, plan: Plan, drawn: Drawn) -> Bracket:
    """Return the matches whose players' sources are known from what has been drawn so far."""
    if plan.form == "swiss":
        rounds = pairings(drawn)
        return swiss_bracket(swiss_of(plan, bracket.players), rounds, to_come=False)
    if plan.placement != "redraw":
        return bracket
    slots: list[Slot] = [Source(TO_DRAW, k) for k, _ in enumerate(losers_qualifiers(bracket), 1)]
    if KNOCK_OUT in drawn:
        slots = [Source(str(name), "winner") for name in drawn[KNOCK_OUT]]
    return redrawn(bracket, slots)


def whole_bracket(bracket: Bracket, plan: Plan, drawn: Drawn) -> Bracket:
    """Return all matches, with a stand-in for anything still to be drawn."""
    if plan.form == "swiss":
        return swiss_bracket(swiss_of(plan, bracket.players), pairings(drawn))
    if plan.placement == "redraw" and KNOCK_OUT in drawn:
        return bracket_now(bracket, plan, drawn)
    return bracket


def pairings(drawn: Drawn, counted: Mapping[str, Result] | None = None) -> list[list[Pairing]]:
    """Return a Swiss's drawn rounds, with the winners so far.

    >>> drawn = {"R1": ("Ann", "Bo", "Cy", None)}
    >>> pairings(drawn, {"R1.1": Result("R1.1", ("Ann", "Bo"), (3, 5), "Bo")})
    [[Pairing(first='Ann', second='Bo', winner='Bo'),
      Pairing(first='Cy', second=None, winner=None)]]
    """
    found = []
    for number in range(1, len(drawn) + 1):
        if (seats := drawn.get(f"R{number}")) is None:
            raise InputError("round {n} hasn't been drawn, but a later one has", n=number)
        pairs = [(str(one), other) for one, other in zip(seats[::2], seats[1::2], strict=True)]
        pairs.sort(key=lambda pair: pair[1] is None)
        names = [f"R{number}.{k}" for k in range(1, len(pairs) + 1)]
        found.append(
            [
                Pairing(one, other, counted[name].winner if counted and name in counted else None)
                for name, (one, other) in zip(names, pairs, strict=True)
            ]
        )
    return found


def races_of(plan: Plan) -> Races:
    """Return a plan's races.

    >>> races_of(Plan("double", 7, losers_race=5)).losers
    5
    """
    if plan.chart is not None:
        return Races(plan.chart)
    if not plan.handicapped:
        return Races(plan.race, plan.losers_race, plan.final_race, plan.by_match)
    losers, last = (None if n is None else Fairest(n) for n in (plan.losers_race, plan.final_race))
    by_match = {name: Fairest(games) for name, games in plan.by_match.items()}
    return Races(Fairest(plan.race), losers, last, by_match)


def table_places(before: Occasion, after: Occasion) -> dict[int, int]:
    """Return the current number of each table that still exists, by its earlier number.

    Tables are identified by name. If there are as many tables as before, a table whose name is gone
    has been given the new name in its place.

    >>> house = Plan("double", 5, tables=4, labels=("1", "2", "TV", "4"))
    >>> table_places(house, replace(house, tables=3, labels=("1", "2", "4")))
    {1: 1, 2: 2, 4: 3}
    """
    old, new = (
        [plan.table_name(table).casefold() for table in range(1, plan.tables + 1)]
        for plan in (before, after)
    )
    found = {}
    for table, name in enumerate(old, 1):
        if name in new:
            found[table] = new.index(name) + 1
        elif len(old) == len(new) and new[table - 1] not in old:
            found[table] = table
    return found


def changed(plan: Plan, change: Changed, bracket: Bracket | None, begun: Iterable[str]) -> Plan:
    """Return a plan with different tables or races; matches that have started keep their race.

    >>> changed(Plan("double", 5, tables=4), Changed(race=4), None, ()).race
    4
    """
    given = {name: value for name, value in asdict(change).items() if value is not None}
    if {"tables", "labels"} & given.keys():  # of those that are closed, none is kept
        house = {name: given[name] for name in ("tables", "labels") if name in given}
        places = table_places(plan, replace(plan, **house))
        for name, those in (("reserved", plan.reserved), ("streamed", plan.streamed)):
            given.setdefault(name, tuple(places[table] for table in those if table in places))
    if bracket is None or not set(given) & {"race", "losers_race", "final_race"}:
        return replace(plan, **given)
    races, by_match = races_of(plan), dict(plan.by_match)
    for name in begun:
        race = races.of(bracket.match(name))
        by_match[name] = race.race_to if isinstance(race, Fairest) else int(race)  # type: ignore[arg-type]
    return replace(plan, **given, by_match=by_match)


def table_changes(events: Sequence[Event]) -> list[tuple[str, dict[int, int]]]:
    """Return when tables were opened, closed or renamed, and each one's number from then on."""
    found = []
    first = events[0].what
    plan = first.plan if isinstance(first, Opened) else None
    for one in events:
        if plan is not None and isinstance(one.what, Changed):
            before, plan = plan, changed(plan, one.what, None, ())
            found.append((one.at, table_places(before, plan)))
    return found
