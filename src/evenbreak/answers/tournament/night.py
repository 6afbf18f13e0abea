"""A tournament in progress: what just happened, what is next, the odds, the finish time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, columns_of
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import decimals, percent
from evenbreak.answers.tournament.bracket_view import group_words
from evenbreak.answers.tournament.chips import (
    chip_heading,
    chip_night_answer,
    odds_data,
    title_odds_of,
)
from evenbreak.answers.tournament.odds import favorites, points_off
from evenbreak.answers.tournament.prizes import Stake, stakes
from evenbreak.answers.tournament.time import (
    ends_words,
    finish_luck,
    finish_quantities,
    minute_of_day,
    time_of_day,
)
from evenbreak.answers.tournament.tournament import against, pair_words, races_words, short_place
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.clock.finish import Call
from evenbreak.tournaments.evening.chip_night import chips_of
from evenbreak.tournaments.evening.events import Result
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.later_draws import can_draw, stage_to_draw
from evenbreak.tournaments.evening.listed import decided_places, swiss_ranks
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.settling import tied_groups
from evenbreak.words import Command, Sentence, joined, listed, say, say_count

_LISTED = 8  # waiting matches that are named
_UNDECIDED = say(
    "How much each match decides isn't shown, because too many matches are left or a draw still "
    "has to be made."
)
_SHOWN = 6  # players whose title odds everybody sees


def played_words(state: Evening) -> Sentence:
    """Return the races, or the chips, in play."""
    return chip_heading(state) if state.plan.form == "chips" else races_words(state.races)


def heading(outlook: Outlook, source: str = "") -> str:
    """Return what is played, and by whom."""
    state = outlook.state
    chips = state.plan.form == "chips"
    races = played_words(state)
    if not state.drawn:
        count = say_count("{n} player", "{n} players", len(state.entrants))
        text = say("{players}, not drawn yet\n{races}", players=count, races=races)
    else:
        form = state.bracket.format
        played = len(state.winners)
        so_far = say_count("{n} match decided", "{n} matches decided", played)
        if chips:
            so_far = say_count("{n} rack played", "{n} racks played", played)
        text = say(
            "{format}: {players}, {so_far}\n{races}",
            format=form[0].upper() + form[1:],
            players=say_count("{n} player", "{n} players", len(state.order)),
            so_far=so_far,
            races=races,
        )
    return say("{file}: {heading}", file=source, heading=text) if source else text


def begun_at(outlook: Outlook) -> int:
    """Return the evening's start time, in minutes after midnight."""
    return minute_of_day(outlook.start)


def night_answer(
    night: Outlook,
    said: Sequence[str] = (),
    *,
    decides: bool = False,
    prizes: Sequence[float] = (),
    source: str = "",
) -> Answer:
    """Return a tournament's state: what to play next, title odds, finish time.

    `decides` adds what is at stake in each playable match.
    """
    state = night.state
    if not state.drawn:
        return _before_the_draw(state, heading(night, source), said)
    if state.plan.form == "chips":
        return chip_night_answer(night, said, heading(night, source))
    odds = night.odds
    words = list(said)
    parts: list[Part] = []
    tied = tied_groups(state)
    under_way = bool(state.standing.to_play or tied) or stage_to_draw(state) is not None
    if under_way:
        decided = stakes(night, prizes) if decides else {}
        said_now, shown = _what_is_next(night, decided, prizes, decides)
        words += said_now
        parts += shown
    else:
        first = [state.order[k] for k in np.flatnonzero(odds.title > 0.0).tolist()]
        if len(first) == 1:
            words.append(say("{player} wins the tournament.", player=first[0]))
        else:
            words.append(say("First place is tied: {players}.", players=listed(first)))
            if state.plan.form != "swiss":
                words.append(_break_the_ties())
        parts.append(_places(state))
    if state.plan.form == "swiss":
        parts += swiss_table(state)
    if under_way:
        parts.append(_title_table(night))
        if decides and state.standing.to_play and not decided:
            parts.append(_UNDECIDED)
    luck = [finish_luck(night.as_things_are.finishes)] if under_way else []
    data = odds_data(night)
    if under_way and not any(isinstance(part, Table) and part.name == "next" for part in parts):
        data["next"] = []  # nothing can be played before a draw or a tie-break
    warnings = [_aside_words(state, one.result) for one in state.aside]
    above = heading(night, source)
    said_all: list[Part] = [joined(words, "\n"), *parts]
    return Answer(above, said_all, details=luck, warnings=warnings, data=data)


def _what_is_next(
    night: Outlook, decided: dict[str, Stake], prizes: Sequence[float], decides: bool
) -> tuple[list[str], list[Part]]:
    """Return what is played next and when it ends, in words and as a table."""
    state, tied = night.state, tied_groups(night.state)
    words: list[str] = []
    found, calls = night.as_things_are, night.calls
    tables = _tables(night)
    if groups := [name for name in tied if not name.isdigit()]:
        words.append(
            say_count(
                "Group {groups} is tied.",
                "Groups {groups} are tied.",
                len(groups),
                groups=listed(groups),
            )
        )
    words += [
        say(
            "The {runner_up} is still undecided: some players have won the same share of their "
            "matches.",
            runner_up=group_words(runners_up),
        )
        for runners_up in tied[len(groups) :]
    ]
    words += [_break_the_ties()] if tied else []
    if can_draw(state):
        words.append(_draw_words(state))
    elif state.standing.to_play:
        words.append(_next_words(state, tables))
        if len(decided) > 1:
            words.append(_most_words(state, decided))
    words.append(ends_words(*(begun_at(night) + at for at in found.bands)))
    parts: list[Part] = [finish_quantities(found.finishes)]
    if tables:
        parts.append(_next_table(night, tables, decided, calls if decides else (), prizes))
    return words, parts


def _break_the_ties() -> Sentence:
    return say("To break the ties: {tiebreak}", tiebreak=Command("tournament tiebreak"))


def _draw_words(state: Evening) -> str:
    """Return a sentence saying that something can be drawn now."""
    stage = str(stage_to_draw(state))
    draw = Command("tournament draw")
    if state.plan.form == "swiss":
        return say("Round {n} can be drawn now: {draw}", n=stage[1:], draw=draw)
    return say("The losers' qualifiers can be drawn now: {draw}", draw=draw)


def _title_table(night: Outlook) -> Table:
    every, bands = title_odds_of(night), night.bands
    rows = [every[k] for k in favorites(night.odds, bands) if every[k][1] > 0.0][:_SHOWN]
    shown = columns_of("name p_title")
    few = [list(row[:2]) for row in rows]
    if bands.keys() & {row[0] for row in rows}:
        shown.append(column_of("p_title_band"))
        few = [[*row, bands.get(str(row[0]))] for row in few]
    if night.odds is not night.as_if_sure:
        shown.append(column_of("p_title_if_sure"))
        few = [[*row, every[2]] for row, every in zip(few, rows, strict=True)]
    title = say("Title odds")
    if not night.odds.exact:
        title = say("Title odds (± {points})", points=points_off(night.odds, title=True))
    return Table("", shown, few, title=title)


def _before_the_draw(state: Evening, heading: str, said: Sequence[str]) -> Answer:
    columns = columns_of("name rating", show={"rating": decimals(1)})
    rows = [[entrant.name, entrant.rating] for entrant in state.entrants.values()]
    if state.plan.form == "chips":
        columns.append(column_of("chips"))
        for row, entrant in zip(rows, state.entrants.values(), strict=True):
            row.append(chips_of(state.plan, entrant))
    words = [*said, say("To make the draw: {draw}", draw=Command("tournament draw"))]
    return Answer(heading, [joined(words, "\n"), Table("entrants", columns, rows)])


def _aside_words(state: Evening, result: Result) -> str:
    """Return what to do about a match that the wrong players have played."""
    name = result.match
    seats = state.standing.seats.get(name)
    stand = Command("tournament stand", str(state.number_of(name) or name))
    words = state.match_words(name)
    play = say("Play {match} again, let it stand ({stand})", match=words, stand=stand)
    if seats is None:  # its draw was undone
        now, play = say("the match is no longer in the draw"), say("Draw again")
    elif NOBODY in seats:
        now, play = say("the match is no longer needed"), say("Let it stand ({stand})", stand=stand)
    elif None in seats:
        now = say("the match is now waiting for {matches}", matches=waits_for(state, name))
    else:
        now = say("the match is now {pair}", pair=against(state.pair(name)))
    return say(
        "{result} in {match}, but {now}, so that result is on hold. {settle} or undo the "
        "correction",
        result=state.result_words(result),
        match=words,
        now=now,
        settle=play,
    )


def waits_for(state: Evening, match: str) -> Sentence | str:
    """Return the matches whose results decide who plays a match."""
    seats = state.standing.seats[match]
    slots = state.bracket.match(match).slots
    sources = [
        group_words(slot.match) if isinstance(slot.outcome, int) else state.match_words(slot.match)
        for slot, seat in zip(slots, seats, strict=True)
        if seat is None and isinstance(slot, Source)
    ]
    return listed(list(dict.fromkeys(sources))) if sources else ""


def _tables(night: Outlook) -> list[tuple[int | None, str]]:
    """Return matches on tables, then matches to call to free tables, then waiting matches."""
    state = night.state
    playing: list[tuple[int | None, str]] = sorted(
        (one.call.table, name) for name, one in state.on_tables.items()
    )
    waiting = [call.match for call in night.calls if call.match not in night.to_call]
    called = [(table, name) for name, table in night.tables_to_call.items()]
    return [*playing, *called, *((None, name) for name in waiting)]


def next_calls(night: Outlook) -> list[tuple[int, str]]:
    """Return which matches to call to which free tables."""
    tables = _tables(night)
    return [(k, name) for k, name in tables if k and name not in night.state.on_tables]


def _next_words(state: Evening, tables: Sequence[tuple[int | None, str]]) -> str:
    ready = [
        say(
            "{match}, {pair}, on table {table}",
            match=state.match_words(name),
            pair=against(state.pair(name)),
            table=state.plan.table_name(table),
        )
        for table, name in tables
        if table is not None and name not in state.on_tables
    ]
    waiting = [state.number_of(name) for table, name in tables if table is None]
    said = []
    if ready:
        said.append(say("Now play {matches}.", matches=joined(ready, "; ")))
    if waiting and len(waiting) <= _LISTED:
        said.append(
            say_count(
                "Match {matches} is waiting for a table.",
                "Matches {matches} are waiting for a table.",
                len(waiting),
                matches=listed([str(number) for number in waiting]),
            )
        )
    elif waiting:
        said.append(
            say("{n} matches are waiting for a table or for their players.", n=len(waiting))
        )
    if not said:
        return say("No match can be called until one of the current matches is over.")
    return joined(said)


def _most_words(state: Evening, decided: Mapping[str, Stake]) -> str:
    """Return which match decides the most."""
    name, stake = next(iter(decided.items()))
    return say(
        "Match {n}, {pair}, matters most for the title: its result moves {share} of the title "
        "odds.",
        n=state.number_of(name),
        pair=against(state.pair(name)),
        share=percent(stake.title),
    )


def _next_table(
    night: Outlook,
    tables: Sequence[tuple[int | None, str]],
    decided: Mapping[str, Stake],
    calls: Sequence[Call],
    prizes: Sequence[float],
) -> Table:
    state = night.state
    later = {call.match: call.later for call in calls if np.isfinite(call.later)}
    show = {"table": state.plan.table_name}
    columns = columns_of("match pair race_pair score_pair table state_now", show=show)
    rows: list[list[Any]] = []
    for table, name in tables:
        pair = state.pair(name)
        if name in state.on_tables:
            since = begun_at(night) + night.minutes(state.on_tables[name].at)
            words = say("playing since {time}", time=time_of_day(since))
        else:
            words = say("call") if table else say("waiting for a table")
        score = night.scores.get(name)
        number = state.number_of(name)
        rows.append([number, pair, state.needed(name, pair), score, table, words])
        if calls:
            rows[-1].append(later.get(name))
        if decided:
            rows[-1].append(decided[name].title if name in decided else None)
        if decided and prizes:
            rows[-1].append(decided[name].prize if name in decided else None)
    if not any(row[3] for row in rows):
        columns[3] = column_of("-score_pair")
    if calls:
        columns.append(column_of("wait_costs"))
    if decided:
        columns.append(column_of("title_at_stake"))
    if decided and prizes:
        columns.append(column_of("prize_at_stake"))
    return Table("next", columns, rows)


def _places(state: Evening) -> Table:
    """Return who finished where."""
    found = sorted(decided_places(state).items(), key=lambda one: (one[1].event, one[1]))
    return Table(
        "places", columns_of("place name"), [[short_place(place), name] for name, place in found]
    )


def bracket_table(state: Evening) -> Table:
    """Return all the bracket's matches, with players, scores and where the players come from."""
    columns = columns_of(
        "match pair score_pair winner table", show={"table": state.plan.table_name}
    )
    rows = []
    for match in sorted(state.bracket.matches, key=lambda one: state.number_of(one.name)):
        seats = state.standing.seats[match.name]
        if NOBODY in seats:
            continue
        names = pair_words(state.standing, match.name, state.match_numbers)
        result = state.counted.get(match.name)
        score = winner = None
        if result is not None:
            winner = result.winner
            if result.forfeit:
                winner = say("{player} (forfeit)", player=winner)
            games = result.games
            score = None if result.forfeit else (games[names[0]], games[names[1]])
        on_table = state.on_tables.get(match.name)
        table = None if on_table is None else on_table.call.table
        rows.append([state.number_of(match.name), names, score, winner, table])
    return Table("matches", columns, rows)


def swiss_table(state: Evening) -> list[Part]:
    """Return a Swiss tournament's standings, once a round is over."""
    over, rows = swiss_ranks(state)
    if not over:
        return []
    columns = columns_of("name matches_won buchholz")
    title = say("Standings after round {n}", n=over)
    return [Table("standings", columns, [list(row[:3]) for row in rows], title=title)]
