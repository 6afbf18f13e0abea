"""The beginning of an evening: the formats there are, and what goes with each."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from evenbreak.errors import InputError
from evenbreak.fields.question import declared
from evenbreak.tournaments.brackets.swiss import swiss_round
from evenbreak.tournaments.evening.bracket_of_plan import bracket_of, swiss_of
from evenbreak.tournaments.evening.events import Entrant, Opened, Plan
from evenbreak.tournaments.evening.format import MOST_PLAYERS, Format

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
"""The formats that a tournament can be begun in."""

FORMATS_WITH: Mapping[str, tuple[str, ...]] = {
    **{one.name: one.field.formats for one in declared(Format) if one.field.formats},
    "chips": ("chips",),
}
"""For the parts of a plan that only some formats have: which."""


def usual_seeding(form: str) -> str:
    """Return how the seeds of a format are ordered if nothing else is asked for.

    >>> usual_seeding("double"), usual_seeding("chips")
    ('listed', 'blind')
    """
    return "blind" if form == "chips" else "listed"


BYE = re.compile(r"byes?[\s\d]*", re.IGNORECASE)
"""How a bye is written on a list."""


def opened(plan: Plan, entrants: Sequence[Entrant]) -> Opened:
    """Begin an evening, if what is planned can be played by those who have entered.

    Parameters
    ----------
    plan
        what is played.
    entrants
        who has entered; more may enter later.

    Raises
    ------
    InputError
        if there are too few or too many players for the plan, or one of them is a bye.

    >>> two = [Entrant("Ann", 600.0), Entrant("Bo", 500.0)]
    >>> opened(Plan("single", 5), two).plan.form
    'single'
    >>> opened(Plan("double", 5, qualifiers=4), two)
    Traceback (most recent call last):
    ...
    evenbreak.errors.InputError: qualifiers must be a power of 2, at most 2 for this
    bracket; it is 4
    """
    names = tuple(one.name for one in entrants)
    if not 2 <= len(names) <= MOST_PLAYERS:
        raise InputError(
            "a tournament takes 2 to {most} players, and {entered:,} entered",
            most=MOST_PLAYERS,
            entered=len(names),
        )
    for name in names:
        refuse_bye(name)
    if plan.chips is not None:
        plan.chips.chips([one.rating for one in entrants])  # refuses ratings below the chart
    elif plan.form == "swiss":
        swiss_round(swiss_of(plan, names))  # refuses what cannot be paired
    else:
        bracket_of(plan, names, None)
    return Opened(plan, tuple(entrants))


def refuse_bye(name: str) -> None:
    """Refuse a bye in place of a player."""
    if BYE.fullmatch(name):
        raise InputError(
            "{name!r} is a bye, not a player; leave it out, the draw adds the byes", name=name
        )
