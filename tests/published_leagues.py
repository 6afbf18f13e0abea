"""Small leagues with dates, and the sites made from them."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np

from evenbreak.answers.league.roster_matchups import OfferedRaces
from evenbreak.answers.league.sheet import as_listed
from evenbreak.ratings import Results, fit
from evenbreak.site.league import PublishedLeague
from evenbreak.site.look import accent
from evenbreak.site.names import PublicNames, by_appearance
from evenbreak.site.races import LeagueRaces

PLAYERS = ("Zebulon Quackenbush", "Ophelia Wrzesniewski", "Ann Lee", "Bo Diaz", "José Álvarez")


def season(players: tuple[str, ...] = PLAYERS, rounds: int = 3, **columns: Any) -> Results:
    """Everybody plays everybody once a week, in races to 5; the first of two wins more often."""
    pairs = [*itertools.combinations(players, 2)] * rounds
    many = len(pairs)
    date = np.datetime64("2025-09-02") + 7 * (np.arange(many) * rounds // many)
    lost = np.arange(many) % 5
    first = np.arange(many) % 3 > 0
    return Results.from_names(
        [a for a, _ in pairs],
        [b for _, b in pairs],
        np.where(first, 5, lost),
        np.where(first, lost, 5),
        date=date,
        race_a=np.full(many, 5),
        race_b=np.full(many, 5),
        **columns,
    )


def published(
    results: Results | None = None, *, rule: Any = None, form: float = 0.0, **named: Any
) -> PublishedLeague:
    """Return a league as its site shows it."""
    private = season() if results is None else results
    names = PublicNames.of(by_appearance(private), **named)
    public = names.results(private)
    ratings = fit(public, scale="fargo", form=form)
    races = LeagueRaces(
        as_listed(ratings), ratings.scale, rule or OfferedRaces(race_to=7), form=form
    )
    return PublishedLeague("Tuesday", public, ratings, races, names, accent("#1b6e53"))
