"""A chip tournament in progress: who is at which table, the line, chips left, the finish time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import share
from evenbreak.answers.tournament.time import (
    CHANGES,
    WORTH_SAYING,
    earlier_words,
    ends_words,
    finish_luck,
    finish_quantities,
    minute_of_day,
    time_of_day,
    venue_words,
)
from evenbreak.answers.tournament.tournament import against
from evenbreak.errors import InputError
from evenbreak.matches.pace import Turnover
from evenbreak.tournaments.clock.finish import bands_of
from evenbreak.tournaments.evening.events import Result, score_words
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.words import Sentence, joined, ordinal, say, say_count


def chip_heading(state: Evening) -> Sentence:
    """Return what is played, in words."""
    chart = "" if state.plan.chips is None else state.plan.chips.name
    return say_count(
        "Chips from the chart {chart}, on {n} table",
        "Chips from the chart {chart}, on {n} tables",
        state.plan.tables,
        chart=chart,
    )


def rack_words(result: Result) -> Sentence:
    """Return who won a rack.

    >>> rack_words(Result("R7", ("Ann", "Bo"), (0, 1), "Bo"))
    'Bo beat Ann in rack 7'
    """
    rack = say("rack {n}", n=int(result.match.removeprefix("R")))
    if result.forfeit:
        return say("{result} in {match}", result=score_words(result), match=rack)
    return say(
        "{winner} beat {loser} in {match}", winner=result.winner, loser=result.loser, match=rack
    )


def chip_changes(before: Evening, after: Evening) -> list[Sentence]:
    """Return, in words, whose chips have changed, and who goes to a table."""
    if not (before.drawn and after.drawn):
        return []
    was, now = before.chip_night, after.chip_night
    said = []
    for name, chips in now.chips.items():
        if was.chips.get(name, chips) == chips:
            continue
        left = {"player": name, "chips": _chips_words(chips)}
        if name in now.gone:
            place = ordinal(len(now.order) + len(now.gone) - now.gone.index(name))
            said.append(say("{player} has {chips} left and finishes {place}.", place=place, **left))
        elif name in now.line:
            spot = now.line.index(name) + 1
            said.append(say("{player} has {chips} left and is no. {n} in line.", n=spot, **left))
        else:
            said.append(say("{player} has {chips} left.", **left))
    seated = {(one.table, one.players) for one in was.playing}
    said += [
        say("Table {n}: {pair}.", n=one.table, pair=against(one.players))
        for one in now.playing
        if (one.table, one.players) not in seated
    ]
    if len(now.order) > 1:
        said += [say("Table {n} is closed.", n=k) for k in was.tables if k not in now.tables]
    gone = {one.result.match for one in before.aside}
    came = [rack_words(one.result) for one in after.aside if one.result.match not in gone]
    said += [say("On hold: {result}.", result=words) for words in came]
    back = gone & after.counted.keys()
    return said + [
        say("Restored: {results}.", results=rack_words(after.counted[name]))
        for name in sorted(back)
    ]


def _chips_words(chips: int) -> Sentence:
    return say_count("{n} chip", "{n} chips", chips) if chips else say("no chips")


def entered_words(state: Evening, name: str) -> Sentence:
    """Return where a late player goes."""
    night = state.chip_night
    entered = {"player": name, "chips": _chips_words(night.chips[name])}
    if name in night.line:
        return say(
            "{player} has entered with {chips} and is no. {n} in line.",
            n=night.line.index(name) + 1,
            **entered,
        )
    rack = next(rack for rack in night.playing if name in rack.players)
    return say(
        "{player} has entered with {chips} and plays on table {table}.", table=rack.table, **entered
    )


def title_odds_of(night: Outlook) -> list[tuple[str, float, float]]:
    """Return each player's title odds, and the same with ratings treated as exact."""
    averaged, sure = night.odds.title.tolist(), night.as_if_sure.title.tolist()
    return list(zip(night.state.order, averaged, sure, strict=True))


def odds_data(night: Outlook) -> dict[str, Any]:
    """Return the odds for JSON, and the matches that are set aside."""
    names = ("name", "p_title", "p_title_if_sure")
    bands = {
        name: dict(zip(("p_title_low", "p_title_high"), ends, strict=True))
        for name, ends in night.bands.items()
    }
    return {
        "odds": [
            dict(zip(names, row, strict=True)) | bands.get(row[0], {})
            for row in title_odds_of(night)
        ],
        "odds_exact": night.odds.exact,
        "ratings_averaged": night.odds is not night.as_if_sure,
        "set_aside": [
            asdict(one.result)
            | {"match": night.state.number_of(one.result.match) or one.result.match}
            for one in night.state.aside
        ],
    }


def chip_night_answer(night: Outlook, said: Sequence[str], heading: str) -> Answer:
    """Return a chip tournament's state: tables, line, chips, odds, finish time.

    >>> from evenbreak.tournaments import CHIP_CHARTS
    >>> from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> plan = Plan("chips", 1, chips=CHIP_CHARTS["hoboken"], scale="fargo")
    >>> both = Entrant("Ann", 650.0), Entrant("Bo", 500.0)
    >>> happened = Opened(plan, both), Drawn(("Ann", "Bo"), None)
    >>> state = evening([Event("2025-03-01T19:30:00", what) for what in happened])
    >>> answer = chip_night_answer(Outlook(state, "2025-03-01T19:30:00"), [], "")
    >>> answer.to_frame()[["name", "chips", "table", "p_title"]].round(4)
      name  chips  table  p_title
    0  Ann      4      1   0.8127
    1   Bo      6      1   0.1873
    """
    state = night.state
    playing = len(state.chip_night.order) > 1
    words = list(said)
    parts: list[Part] = []
    luck: list[Part] = []
    if playing:
        parts.append(_tables(night))
        finishes = night.chip_finishes()
        parts.insert(0, finish_quantities(finishes))
        luck.append(finish_luck(finishes))
        begun = minute_of_day(night.start)
        words += [say("Next in line: {player}.", player=name) for name in state.chip_night.line[:1]]
        words.append(ends_words(*(begun + at for at in bands_of(finishes)[0])))
    else:
        words += [
            say("{player} wins the tournament.", player=name) for name in state.chip_night.order
        ]
    table = _players(night, playing=playing)
    data = odds_data(night)
    warnings = [
        say(
            "{result}, but with the corrected result, one of them was already out of chips by "
            "then. That rack is on hold, and the chip lost in it is given back",
            result=rack_words(one.result),
        )
        for one in state.aside
    ]
    shown: list[Part] = [joined(words, "\n"), *parts, table]
    return Answer(heading, shown, details=luck, warnings=warnings, data=data, csv=table)


def _tables(night: Outlook) -> Table:
    columns = columns_of("table chip_rack chip_pair state_now")
    begun = minute_of_day(night.start)
    rows = [
        [
            rack.table,
            rack.name,
            rack.players,
            say("since {time}", time=time_of_day(begun + night.minutes(rack.since))),
        ]
        for rack in night.state.chip_night.playing
    ]
    return Table("next", columns, rows)


def _players(night: Outlook, *, playing: bool) -> Table:
    """Return everyone: players at the tables, in line, and out."""
    state = night.state.chip_night
    title = dict(zip(night.state.order, night.odds.title.tolist(), strict=True))
    table = {name: rack.table for rack in state.playing for name in rack.players}
    rows: list[list[Any]] = []
    for name in state.order:
        number = state.line.index(name) + 1 if name in state.line else None
        rows.append([name, state.chips[name], table.get(name), number, None, title[name]])
    if not playing:
        rows = [[name, state.chips[name], None, None, 1, 1.0] for name in state.order]
    bands = night.bands if playing else {}
    for place, name in enumerate(reversed(state.gone), len(rows) + 1):
        rows.append([name, state.chips[name], None, None, place, 0.0])
    columns = [
        *columns_of("name chips table in_line"),
        column_of("place") if state.gone else column_of("-place"),
        *columns_of("p_title", show={"p_title": lambda p: share(p) if p else ""}),
    ]
    if not playing:
        columns = columns_of("name chips -table -in_line place -p_title")
    if bands:
        columns.append(column_of("p_title_band"))
        rows = [[*row, bands.get(row[0])] for row in rows]
    return Table("players", columns, rows)


def chip_time_answer(
    outlook: Outlook, heading: str, *, tables: int | None = None, turnover: Turnover | None = None
) -> Answer:
    """Return a chip tournament's finish time, and what another table would change.

    Raises InputError if nothing is left to play.
    """
    state = outlook.state
    if len(state.chip_night.order) < 2:
        raise InputError("all racks have been played")
    usual = state.plan.tables if tables is None else tables
    finishes = outlook.chip_finishes(tables=usual, turnover=turnover)
    bands, _ = bands_of(finishes)
    begun = minute_of_day(outlook.start)
    words = ends_words(*(begun + at for at in bands))
    rows = []
    for key, many in {"one_more_table": usual + 1, "one_table_fewer": usual - 1}.items():
        if many:
            moved = outlook.chip_finishes(tables=many, turnover=turnover)
            later = float(np.median(moved)) - bands[1]
            rows.append([key, say("With {change}", change=CHANGES[key]), later])
            if key == "one_more_table" and later <= -WORTH_SAYING:
                words = joined([words, earlier_words(key, -later)])
    columns = columns_of("-change in_words minutes_later")
    change = Table("what_if", columns, rows, title=say("What if"))
    parts: list[Part] = [words, finish_quantities(finishes), change, finish_luck(finishes)]
    plain = outlook.pace.mean_minutes(1)
    usual_words = say(
        "A rack of {game} usually takes about {minutes:.0f} minutes, including the time to "
        "change players.",
        game=state.plan.discipline,
        minutes=plain,
    )
    if timed := len(outlook.timed):
        adjusted = say_count(
            "The finish time is adjusted for the {n} rack timed so far tonight.",
            "The finish time is adjusted for the {n} racks timed so far tonight.",
            timed,
        )
        usual_words = joined([usual_words, adjusted])
    parts += filter(None, [usual_words, venue_words(state.plan.discipline, state.plan.earlier)])
    return Answer(heading, parts, csv=change, data={"start": outlook.start.isoformat()})
