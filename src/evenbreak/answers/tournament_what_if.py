"""What if: by how much one more table or shorter races would move the end of a tournament."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from evenbreak.answers.parts import Column, Table
from evenbreak.answers.wording import clock
from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.clock.finish import Finish, minutes_later
from evenbreak.tournaments.odds.races import Fairest, Race, Races

WORTH_SAYING = 10.0
"""How many minutes sooner are worth a sentence."""

_CHANGES = {
    "one_more_table": "one more table",
    "one_table_fewer": "one table fewer",
    "races_one_shorter": "all races one game shorter",
    "losers_races_one_shorter": "the losers' side one game shorter",
}


def what_if(
    found: Finish,
    ask: Callable[[int, Races], Finish],
    bracket: Bracket,
    tables: int,
    races: Races,
    *,
    taken: int = 0,
) -> Table:
    """Return by how much changes move the end.

    Parameters
    ----------
    found
        when it ends as it is.
    ask
        when it ends with so many tables and such races.
    bracket
        the tournament.
    tables, races
        the tables and races as they are.
    taken
        the tables with matches under way, which cannot be taken away.
    """
    changes = {"one_more_table": (tables + 1, races)}
    if tables > max(1, taken):
        changes["one_table_fewer"] = tables - 1, races
    if (fewer := shorter(races)) is not None:
        changes["races_one_shorter"] = tables, fewer
    losers = _one_less(races.race if races.losers is None else races.losers)
    if losers is not None and any(match.side == "losers" for match in bracket.matches):
        changes["losers_races_one_shorter"] = tables, replace(races, losers=losers)
    rows = []
    for key, change in changes.items():
        later, error = minutes_later(ask(*change), found)
        rows.append([key, f"With {_CHANGES[key]}", later, error])
    columns = [
        Column("change"),
        Column("in_words", "change", left=True),
        Column("minutes_later", "the finish\nmoves by", moves_words),
        Column(
            "minutes_later_error",
            "standard\nerror",
            lambda minutes: f"{minutes:.1f} min",
            detail=True,
        ),
    ]
    return Table("what_if", columns, rows, title="What if")


def savings(changes: Table) -> dict[str, float]:
    """Return by how many minutes one more table and shorter races bring the end forward."""
    found = {row[0]: -row[2] for row in changes.rows}
    return {key: found[key] for key in ("one_more_table", "races_one_shorter") if key in found}


def savings_words(changes: Table) -> str:
    """Return the changes that are worth it, in words; '' if none is."""
    return " ".join(
        f"With {_CHANGES[key]} it would end {clock(saved)} earlier."
        for key, saved in savings(changes).items()
        if saved >= WORTH_SAYING
    )


def moves_words(minutes: float) -> str:
    """Return by how much the finish moves.

    >>> moves_words(-72.0), moves_words(0.2)
    ('1 h 12 earlier', '0 min')
    """
    if abs(minutes) < 0.5:
        return "0 min"
    return f"{clock(abs(minutes))} {'later' if minutes > 0 else 'earlier'}"


def shorter(races: Races) -> Races | None:
    """Return all races one game shorter; None where they come from a chart, or one game is all."""
    found = [_one_less(race) for race in (races.race, races.losers, races.final)]
    given = [race for race in (races.race, races.losers, races.final) if race is not None]
    if found.count(None) > 3 - len(given) or found[0] is None:
        return None
    return replace(races, race=found[0], losers=found[1], final=found[2])


def _one_less(race: Race | None) -> Race | None:
    match race:
        case Fairest(race_to=games) if games > 1:
            return Fairest(games - 1)
        case int() if race > 1:
            return race - 1
    return None
