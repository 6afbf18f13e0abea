"""The races of a plan, and what a change in the course of the evening makes of it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, replace

from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.evening.events import Changed, Plan
from evenbreak.tournaments.odds.races import Fairest, Races


def races_of(plan: Plan) -> Races:
    """Return the races of a plan.

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


def changed(plan: Plan, change: Changed, bracket: Bracket | None, begun: Iterable[str]) -> Plan:
    """Return a plan with other tables or races; matches that have begun keep their race.

    Parameters
    ----------
    plan, change
        the plan so far, and what is changed.
    bracket
        the bracket; None before the draw.
    begun
        the matches that have been called, scored or played.

    >>> changed(Plan("double", 5, tables=4), Changed(race=4), None, ()).race
    4
    """
    given = {name: value for name, value in asdict(change).items() if value is not None}
    if bracket is None or not set(given) - {"tables"}:
        return replace(plan, **given)
    races, by_match = races_of(plan), dict(plan.by_match)
    for name in begun:
        race = races.of(bracket.match(name))
        by_match[name] = race.race_to if isinstance(race, Fairest) else int(race)  # type: ignore[arg-type]
    return replace(plan, **given, by_match=by_match)
