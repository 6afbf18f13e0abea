"""A tournament in progress: everyone's odds from here on, and the expected finish."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of, quantities_of
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.scales import form_used_words
from evenbreak.answers.kit.wording import percent
from evenbreak.answers.tournament.chips import chip_time_answer
from evenbreak.answers.tournament.night import begun_at, heading
from evenbreak.answers.tournament.odds import bands_words, favorite_words, how_words, odds_table
from evenbreak.answers.tournament.prizes import stakes
from evenbreak.answers.tournament.time import (
    assumed_words,
    ends_words,
    finish_luck,
    finish_quantities,
    savings_words,
    starts_table,
    time_of_day,
    venue_words,
    what_if,
)
from evenbreak.answers.tournament.tournament import pair_words
from evenbreak.errors import InputError
from evenbreak.matches.pace import Turnover
from evenbreak.tournaments.clock.finish import Finish
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.later_draws import stage_to_draw
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.odds.races import Races
from evenbreak.tournaments.odds.title import TitleOdds
from evenbreak.words import joined, say

_TELLING = 3  # matches timed: fewer say too little of tonight's pace to be told


def odds_under_way(
    outlook: Outlook, *, sure: bool = False, prizes: Sequence[float] = (), source: str = ""
) -> Answer:
    """Return each player's chances of each place, given the results and scores so far.

    They are averaged over the ratings' errors, where known, unless `sure`.

    >>> from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan, Scored
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> both = Entrant("Ann", 80.0), Entrant("Bo", 80.0)
    >>> happened = Opened(Plan("single", 5), both), Drawn(("Ann", "Bo"), (0, 1))
    >>> happened += (Scored("F", ("Ann", "Bo"), (4, 3)),)
    >>> state = evening([Event("2025-03-01T19:30:00", what) for what in happened])
    >>> print(odds_under_way(Outlook(state, "2025-03-01T19:40:00")).sentences[0])
    The favorite is Ann, who wins the tournament 75% of the time; next is Bo (25%).
    """
    state, plug_in = outlook.state, outlook.as_if_sure
    odds = plug_in if sure else outlook.odds
    bands = {} if sure else outlook.bands
    table = odds_table(state.ratings, plug_in, odds, prizes, bands)
    quantities = quantities_of(
        {"exact": plug_in.exact and odds is plug_in, "ratings_averaged": odds is not plug_in}
    )
    if isinstance(odds, TitleOdds):
        quantities = [
            *quantities_of(
                {"p_second_final": odds.p_second_final, "matches_mean": odds.matches_mean}
            ),
            *quantities,
        ]
    parts: list[Part] = [favorite_words(odds, bands), Quantities(quantities), table]
    if state.standing.to_play:
        if (at_stake := _at_stake(outlook, prizes)).rows:
            parts.append(at_stake)
        parts.append(how_words(plug_in, odds, outlook.walkovers, _to_draw(state)))
    if unsure := bands_words(bands):
        parts.append(unsure)
    if form := form_used_words(state.plan.match_form, state.scale):
        parts.append(form)
    if odds is not plug_in and outlook.games:
        parts.append(
            "Tonight's games are taken into account: they move the ratings and narrow their errors."
        )
    return Answer(heading(outlook, source), parts, csv=table)


def _to_draw(state: Evening) -> str:
    """Return what the odds treat as still to be drawn."""
    if state.plan.form == "chips":
        return "racks"
    if stage_to_draw(state) is None:
        return "rounds" if state.plan.form == "swiss" and state.standing.to_play else ""
    return "rounds" if state.plan.form == "swiss" else "qualifiers"


def _at_stake(outlook: Outlook, prizes: Sequence[float]) -> Table:
    """Return what the playable matches change for the title, prizes and finish time."""
    decided = stakes(outlook, prizes)
    found = outlook.as_things_are if decided else None
    rows: list[list[Any]] = []
    for name, stake in decided.items():
        first, second = found.if_won(name) if found else (np.nan, np.nan)
        later = None if np.isnan(first - second) else first - second
        rows.append(
            [
                outlook.state.number_of(name),
                pair_words(outlook.state.standing, name, outlook.state.match_numbers),
                stake.title,
                later,
            ]
        )
        if stake.prize is not None:
            rows[-1].append(stake.prize)
    columns = columns_of("match pair title_at_stake minutes_if_a_wins")
    if prizes:
        columns.append(column_of("prize_at_stake"))
    return Table("at_stake", columns, rows, title="What the next matches decide")


def time_under_way(
    outlook: Outlook,
    *,
    tables: int | None = None,
    turnover: Turnover | None = None,
    source: str = "",
) -> Answer:
    """Return when the tournament ends and remaining matches start; InputError if none remain."""
    state = outlook.state
    if state.plan.form == "chips":
        above = heading(outlook, source)
        return chip_time_answer(outlook, above, tables=tables, turnover=turnover)
    if not state.standing.to_play and stage_to_draw(state) is None:
        raise InputError("all matches have been played")
    usual = state.plan.tables if tables is None else tables

    def ask(tables: int, races: Races) -> Finish:
        laws = outlook.laws if races is state.races else outlook.laws_of(races)
        return outlook.finish(laws=laws, tables=tables, turnover=turnover)

    races = state.races
    found = outlook.finish(tables=usual, turnover=turnover)
    changes = what_if(found, ask, state.whole, usual, races, taken=len(state.on_tables))
    if tables is None and turnover is None:
        found = outlook.as_things_are
    begun = begun_at(outlook)
    quantities = finish_quantities(found.finishes)
    table = starts_table(
        found, lambda minutes: time_of_day(begun + minutes), outlook.state.match_numbers
    )
    words = [ends_words(*(begun + at for at in found.bands)), savings_words(changes)]
    parts: list[Part] = [joined(filter(None, words), "\n"), quantities, table, changes]
    plan = state.plan
    parts += filter(None, [venue_words(plan.discipline, plan.earlier)])
    parts.append(assumed_words(usual, plan.discipline, turnover))
    if (timed := len(outlook.timed)) >= _TELLING:
        parts.append(
            say(
                "Going by the matches called and played so far ({n}), tonight is {pace}.",
                n=timed,
                pace=_pace_words(found.pace.per_game / outlook.pace.per_game),
            )
        )
    parts.append(finish_luck(found.finishes))
    return Answer(
        heading(outlook, source), parts, csv=table, data={"start": outlook.start.isoformat()}
    )


def _pace_words(factor: float) -> str:
    if abs(factor - 1.0) < 0.005:
        return say("as fast as usual")
    share = percent(abs(factor - 1.0))
    if factor > 1.0:
        return say("{share} slower than usual", share=share)
    return say("{share} faster than usual", share=share)
