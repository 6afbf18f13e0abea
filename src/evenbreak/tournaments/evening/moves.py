"""What can happen next: each function checks a move against the state and returns its event."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from difflib import get_close_matches

import numpy as np

from evenbreak.errors import InputError
from evenbreak.ratings.results_frame import folded
from evenbreak.tournaments.brackets.bracket import some_of
from evenbreak.tournaments.brackets.knockout import (
    blind_draw,
    by_rating,
    seeded_lines,
)
from evenbreak.tournaments.evening.chip_night import chips_of
from evenbreak.tournaments.evening.events import (
    Called,
    CalledBack,
    Changed,
    Drawn,
    Dropped,
    Edited,
    Entrant,
    Late,
    LaterDraw,
    Result,
    Scored,
    race_words,
    score_words,
)
from evenbreak.tournaments.evening.fold import ELIMINATIONS, Evening
from evenbreak.tournaments.evening.format import MOST_PLAYERS
from evenbreak.tournaments.evening.later_draws import draw_later
from evenbreak.tournaments.evening.plan import refuse_bye
from evenbreak.tournaments.evening.undoing import losses
from evenbreak.words import Command, Parameter, listed, say


def draw(state: Evening, rng: np.random.Generator) -> Drawn:
    """Make the draw, in the way that the plan says.

    Raises
    ------
    InputError
        if it has been made, or there are too few players.
    """
    if state.drawn:
        raise InputError(
            "the draw has already been made; to take it back: {undo}",
            undo=Command("tournament undo"),
        )
    names = list(state.entrants)
    if len(names) < 2:
        raise InputError(
            "a tournament takes 2 to {most} players, and {entered:,} entered",
            most=MOST_PLAYERS,
            entered=len(names),
        )
    if state.plan.seeding == "rating":
        names = by_rating(names, [state.entrants[name].rating for name in names])
    elif state.plan.seeding == "blind":
        names = blind_draw(names, rng)
    lines = tuple(seeded_lines(len(names))) if state.plan.form in ELIMINATIONS else None
    return Drawn(tuple(names), lines)


def draw_next(state: Evening, rng: np.random.Generator) -> list[Drawn | LaterDraw]:
    """Draw what is to be drawn next: the bracket, the next round of a Swiss, or qualifiers.

    Raises
    ------
    InputError
        if there is nothing to draw, or it must wait for matches.
    """
    if state.drawn:
        return [draw_later(state, rng)]
    first = draw(state, rng)
    if state.plan.form != "swiss":
        return [first]
    return [first, draw_later(replace(state, order=first.order), rng)]


def result(state: Evening, match: str, score: tuple[int, int] | str) -> Result:
    """Enter the result of a match that has not been decided.

    Parameters
    ----------
    state
        the evening.
    match
        the match; in a chip tournament the number of its table will do.
    score
        the games of each player; in a chip tournament the winner will do.
    """
    name = known_match(state, match)
    if (before := state.counted.get(name)) is not None:
        correct_it = Command("tournament correct", name)
        if before.forfeit:
            raise InputError(
                "{match} was forfeited; to change that: {correct}", match=name, correct=correct_it
            )
        raise InputError(
            "{match} already has a result ({result}); to change it: {correct}",
            match=name,
            result=score_words(before),
            correct=correct_it,
        )
    _refuse_waiting(state, name)
    pair = state.pair(name)
    games = _games(state, name, pair, score)
    return Result(name, pair, games, _winner(state, name, pair, games))


def correct(state: Evening, match: str, score: tuple[int, int] | str) -> Result:
    """Correct the result of a match; in a chip tournament a table is that of its last rack."""
    name = known_match(state, match, over=True)
    if name not in state.counted:
        raise InputError(
            "{match} has no result to correct; to enter one: {enter}",
            match=name,
            enter=Command("tournament result", name),
        )
    pair = state.pair(name)
    games = _games(state, name, pair, score)
    found = Result(name, pair, games, _winner(state, name, pair, games), corrects=True)
    before = state.counted[name]
    if not before.forfeit and before.games == found.games and before.winner == found.winner:
        raise InputError(
            "{match} already has that result: {result}", match=name, result=score_words(before)
        )
    return found


def score(state: Evening, match: str, score: tuple[int, int]) -> Scored:
    """Enter the score of a match in play."""
    if state.plan.form == "chips":
        raise InputError(
            "a rack has no score; to enter its winner: {enter}",
            enter=Command("tournament result", match),
        )
    name = _undecided(state, match)
    pair = state.pair(name)
    needs = state.needed(name, pair)
    if score[0] >= needs[0] or score[1] >= needs[1]:
        raise InputError(
            "{a}:{b} ends {match}, a {race}; to enter it: {enter}",
            a=score[0],
            b=score[1],
            match=name,
            race=race_words(needs),
            enter=Command("tournament result", name, f"{score[0]}:{score[1]}"),
        )
    return Scored(name, pair, score)


def forfeit(state: Evening, player: str, match: str | None = None) -> Result:
    """Let a player, by their full name, forfeit a match; None: the only one they can play now."""
    loser = _entered(state, player)
    if match is None:
        ready = [name for name in state.standing.to_play if loser in state.pair(name)]
        if len(ready) != 1:
            if not ready:
                raise InputError(
                    "{player} has no match ready that could be forfeited", player=loser
                )
            raise InputError(
                "{player} has {n} matches ready; say which: {matches}",
                player=loser,
                n=len(ready),
                matches=", ".join(ready),
            )
        match = ready[0]
    name = _undecided(state, match)
    pair = state.pair(name)
    _refuse_stranger(loser, name, pair)
    return Result(name, pair, (0, 0), pair[loser == pair[0]], forfeit=True)


def drop(state: Evening, player: str) -> Dropped:
    """Let a player, by their full name, go home."""
    name = _entered(state, player)
    if name in state.dropped:
        raise InputError("{player} has already withdrawn", player=name)
    if not state.drawn and len(state.entrants) <= 1:
        raise InputError("{player} is the only player", player=name)
    return Dropped(name)


def late(state: Evening, entrant: Entrant) -> Late:
    """Let a late player in: before the draw, or in place of the lowest seed's bye still open.

    A bye is open as long as filling it changes no match that was played or called. In a chip
    tournament a late player goes to the end of the line, as long as two are still in.
    """
    _check_entrant(state, entrant)
    if len(state.entrants) >= MOST_PLAYERS:
        raise InputError("a tournament takes at most {most} players", most=MOST_PLAYERS)
    if state.plan.form == "chips":
        if state.drawn and len(state.chip_night.order) < 2:
            raise InputError("{player} can't enter: the tournament is over", player=entrant.name)
        return Late(entrant)
    if not state.drawn:
        return Late(entrant)
    byes = [k for k, seat in enumerate(state.lines or ()) if seat is None]
    for line in sorted(byes, key=lambda k: -_rival(state, k)):
        if _fits(state, entrant, line):
            return Late(entrant, line)
    if state.lines is None:
        reason = say("this format has no byes")
    elif byes:
        reason = say("every player with a bye has already played on")
    else:
        reason = say("the bracket has no bye")
    raise InputError(
        "{player} can't enter after the draw: {reason}", player=entrant.name, reason=reason
    )


def call(state: Evening, match: str, table: int | None) -> Called:
    """Call a match to a table, or move it to another; None: the first that is free."""
    name = _undecided(state, match)
    on = state.on_tables.get(name)
    if on is not None and table in (None, on.call.table):
        raise InputError("{match} is already on table {table}", match=name, table=on.call.table)
    free = free_tables(state)
    if table is None and not free:
        raise InputError("no table is free (there are {tables})", tables=state.plan.tables)
    chosen = free[0] if table is None else table
    if not 1 <= chosen <= state.plan.tables:
        raise InputError(
            "there is no table {table}; the tables are 1 to {tables}",
            table=chosen,
            tables=state.plan.tables,
        )
    if chosen not in free:
        there = next(n for n, one in state.on_tables.items() if one.call.table == chosen)
        raise InputError("table {table} is taken by {match}", table=chosen, match=there)
    for there, one in state.on_tables.items():
        for player in set(state.pair(name)) & set(one.call.players) if there != name else ():
            raise InputError(
                "{player} is playing {match} on table {table}",
                player=player,
                match=there,
                table=one.call.table,
            )
    return Called(name, chosen, state.pair(name))


def change(
    state: Evening,
    *,
    tables: int | None = None,
    race: int | None = None,
    losers_race: int | None = None,
    final_race: int | None = None,
) -> Changed:
    """Change the tables, or the races of the matches that have not begun."""
    found = Changed(tables, race, losers_race, final_race)
    if found == Changed():
        raise InputError(
            "nothing would change; set {changes}",
            changes=listed(
                [Parameter(name) for name in ("tables", "race", "losers_race", "final_race")], "or"
            ),
        )
    if state.plan.chart is not None and found != Changed(tables):
        raise InputError("the races come from a chart, so only the number of tables can change")
    if state.plan.form == "chips" and found != Changed(tables):
        raise InputError(
            "a chip tournament is played by the rack, so only the number of tables can change"
        )
    sides = {match.side for match in state.whole.matches} if state.drawn else {"losers", "final"}
    if losers_race is not None and not sides & {"losers", "consolation"}:
        raise InputError(
            "there is no losers' side; to change the races, set {race}", race=Parameter("race")
        )
    if final_race is not None and "final" not in sides:
        raise InputError(
            "there is no final; to change the races, set {race}", race=Parameter("race")
        )
    if tables is not None and state.drawn and state.plan.form != "chips":  # there it closes later
        taken = max((one.call.table for one in state.on_tables.values()), default=0)
        if tables < taken:
            raise InputError(
                "a match is on table {table}; finish it before you close the table", table=taken
            )
    return found


def call_back(state: Evening, match: str) -> CalledBack:
    """Take a match off its table; its score is kept."""
    name = known_match(state, match)
    if state.plan.form == "chips":
        raise InputError("a chip tournament has no calls: the players at the tables play on")
    if name not in state.on_tables:
        raise InputError("{match} is not on a table", match=name)
    return CalledBack(name, state.pair(name))


def edit(state: Evening, player: str, *, name: str = "", rating: float | None = None) -> Edited:
    """Correct the name or the rating of a player, by their full name, before the draw."""
    before = state.entrants[_entered(state, player)]
    if state.drawn:
        raise InputError("the draw has been made, so names and ratings can no longer change")
    rated = before if rating is None else Entrant(player, rating)
    after = replace(rated, name=name or player)
    if after == before:
        raise InputError(
            "nothing about {player} would change; enter another name or rating", player=player
        )
    _check_entrant(state, after, besides=player)
    return Edited(player, after)


def free_tables(state: Evening) -> list[int]:
    """Return the tables on which no called match is played."""
    taken = {one.call.table for one in state.on_tables.values()}
    return [table for table in range(1, state.plan.tables + 1) if table not in taken]


_NUMBERED = re.compile(r"(?:#|match|rack|partie)?\s*(\d+)")
"""A match by its number, in small letters and as people write it."""


def known_match(state: Evening, text: str, *, over: bool = False) -> str:
    """Return the name of a match, given by its number or its name.

    '12', '#12' and 'match 12' are the same. In a chip tournament a bare number is that of a table:
    of the rack on it, or of the last one that is over.
    """
    wanted = " ".join(text.split()).casefold()
    names = {name.casefold(): name for name in state.bracket.by_name}
    chips = state.plan.form == "chips"
    if chips:
        racks = state.chip_night.racks.values()
        names |= {str(r.table): r.name for r in racks if (r.name in state.counted) == over}
    if wanted not in names and (number := _NUMBERED.fullmatch(wanted)):
        called = {state.number_of(name): name for name in state.bracket.by_name}
        if not (chips and wanted.isdigit()) and int(number[1]) in called:
            return called[int(number[1])]
        wanted = f"r{number[1]}" if chips and not wanted.isdigit() else wanted
    if wanted in names:
        return names[wanted]
    if chips and wanted.upper() in state.records:
        raise InputError(
            "{match} does not count: a player had no chips left",
            match=say("rack {n}", n=int(wanted[1:])),
        )
    raise InputError(
        "there is no match {text!r}; the matches are {matches}",
        text=text,
        matches=some_of([str(n) for n in sorted(map(state.number_of, state.bracket.by_name))]),
    )


def known_player(state: Evening, text: str) -> str:
    """Return the name of a player, in whatever case and spacing it was written.

    The beginning of a first or last name will do if nobody else's begins like that.
    """
    wanted = " ".join(text.split()).casefold()
    names = {name.casefold(): name for name in state.entrants}
    if wanted not in names:
        begin = [name for name in names if wanted and f" {wanted}" in f" {name}"]
        if len(begin) == 1:
            return names[begin[0]]
        if begin:
            raise InputError(
                "{text!r} could be {players}",
                text=text,
                players=some_of([names[name] for name in begin]),
            )
        near = get_close_matches(wanted, names, 1)
        if near:
            raise InputError(
                "{player!r} is not in this tournament; did you mean {near}?",
                player=text,
                near=names[near[0]],
            )
        raise InputError("{player!r} is not in this tournament", player=text)
    return names[wanted]


def _check_entrant(state: Evening, entrant: Entrant, besides: str = "") -> None:
    """Refuse an entrant without a name or rating of their own."""
    refuse_bye(entrant.name)
    if not math.isfinite(entrant.rating):
        raise InputError(
            "the rating of {player} must be a finite number; it is {rating}",
            player=entrant.name,
            rating=entrant.rating,
        )
    names = {folded(name): name for name in state.entrants if name != besides}
    if folded(entrant.name) in names:
        raise InputError("{player} has already entered", player=names[folded(entrant.name)])
    if state.plan.form == "chips":
        chips_of(state.plan, entrant)  # refuses a rating below the chart


def _entered(state: Evening, name: str) -> str:
    """Return a name that is given in full: somebody else's that begins like it never counts."""
    if name not in state.entrants:
        raise InputError("{player!r} is not in this tournament", player=name)
    return name


def _games(
    state: Evening, name: str, pair: tuple[str, str], score: tuple[int, int] | str
) -> tuple[int, int]:
    """Return the score of a result; in a chip tournament it may be the winner's name."""
    if not isinstance(score, str):
        return score
    if state.plan.form != "chips":
        raise InputError(
            "{score!r} is not a score; write the games of each player, such as 7:5", score=score
        )
    winner = known_player(state, score)
    _refuse_stranger(winner, name, pair)
    return (1, 0) if winner == pair[0] else (0, 1)


def _refuse_stranger(player: str, match: str, pair: tuple[str, str]) -> None:
    if player not in pair:
        names = {"player": player, "match": match, "a": pair[0], "b": pair[1]}
        raise InputError("{player} is not in {match}: it is {a} against {b}", **names)


def _undecided(state: Evening, match: str) -> str:
    """Return the name of a match that can be played now, or refuse it."""
    name = known_match(state, match)
    if (before := state.counted.get(name)) is not None:
        raise InputError(
            "{match} already has a result: {result}", match=name, result=score_words(before)
        )
    _refuse_waiting(state, name)
    return name


def _refuse_waiting(state: Evening, name: str) -> None:
    if name in state.standing.to_play:
        return
    if name in state.standing.winners:
        raise InputError("{match} is not needed", match=name)
    slots = zip(state.bracket.match(name).slots, state.standing.seats[name], strict=True)
    waits = [slot.match for slot, seat in slots if seat is None and not isinstance(slot, int)]
    raise InputError(
        "{match} is not ready: it is waiting for {waits}",
        match=name,
        waits=listed(list(dict.fromkeys(waits))),
    )


def _winner(state: Evening, name: str, pair: tuple[str, str], score: tuple[int, int]) -> str:
    """Return the winner; refuse a score that does not end the race."""
    one, other = score
    m, n = state.needed(name, pair)
    if one == m and other < n:
        return pair[0]
    if other == n and one < m:
        return pair[1]
    raise InputError(
        "{a}:{b} can't be the final score of {match}, {player_a} against {player_b}: it's a {race}",
        a=one,
        b=other,
        match=name,
        player_a=pair[0],
        player_b=pair[1],
        race=race_words((m, n)),
    )


def _rival(state: Evening, line: int) -> int:
    """Return the seed of the player on the other line of a first match; -1 for a bye."""
    there = (state.lines or ())[line ^ 1]
    return -1 if there is None else there


def _fits(state: Evening, entrant: Entrant, line: int) -> bool:
    """Return whether all that was played and called stays as it is with a bye filled."""
    lines = list(state.lines or ())
    lines[line] = len(state.order)
    tried = replace(
        state,
        entrants={**state.entrants, entrant.name: entrant},
        order=(*state.order, entrant.name),
        lines=tuple(lines),
    )
    same = all(tried.counted.get(name) == one for name, one in state.counted.items())
    return same and not losses(state, tried)
