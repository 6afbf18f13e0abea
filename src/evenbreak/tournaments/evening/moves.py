"""What can happen next: each function checks a move against the state and returns its event."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from evenbreak.errors import InputError
from evenbreak.evenings.move import AlreadyError
from evenbreak.tournaments.brackets.knockout import (
    blind_draw,
    by_rating,
    seeded_lines,
)
from evenbreak.tournaments.evening.events import (
    Called,
    CalledBack,
    Changed,
    Drawn,
    Dropped,
    Edited,
    Entrant,
    Event,
    Late,
    LaterDraw,
    Result,
    Scored,
    race_words,
)
from evenbreak.tournaments.evening.fold import ELIMINATIONS, Evening
from evenbreak.tournaments.evening.format import MOST_PLAYERS
from evenbreak.tournaments.evening.known import (
    check_entrant,
    entered,
    games_in,
    known_match,
    known_player,
    refuse_stranger,
    refuse_waiting,
    typed,
    undecided,
    winner_of,
)
from evenbreak.tournaments.evening.later_draws import draw_later
from evenbreak.tournaments.evening.plan import changed, refuse_tables
from evenbreak.tournaments.evening.undoing import losses
from evenbreak.words import Command, Parameter, listed, say, tally

__all__ = ["known_match", "known_player"]


def draw(state: Evening, rng: np.random.Generator, *, without: Sequence[str] = ()) -> Drawn:
    """Make the draw as planned; players left out (`without`) may be added late.

    Raises InputError if it has already been made, or there are too few players.
    """
    if state.drawn:
        raise InputError(
            "the draw has already been made; to take it back: {undo}",
            undo=Command("tournament undo"),
        )
    names = [name for name in state.entrants if name not in without]
    if len(names) < 2:
        raise InputError(
            "a tournament takes 2 to {most} players; {entered:,} have entered",
            most=MOST_PLAYERS,
            entered=len(names),
        )
    if state.plan.seeding == "rating":
        names = by_rating(names, [state.entrants[name].rating for name in names])
    elif state.plan.seeding == "blind":
        names = blind_draw(names, rng)
    lines = tuple(seeded_lines(len(names))) if state.plan.form in ELIMINATIONS else None
    return Drawn(tuple(names), lines)


def draw_next(
    state: Evening, rng: np.random.Generator, *, without: Sequence[str] = ()
) -> list[Drawn | LaterDraw]:
    """Make the next draw: the bracket, a Swiss round, or qualifiers.

    Raises InputError if there is nothing to draw, or it must wait for matches.
    """
    if state.drawn:
        return [draw_later(state, rng)]
    first = draw(state, rng, without=without)
    if state.plan.form != "swiss":
        return [first]
    return [first, draw_later(state.then(Event(state.events[-1].at, first)), rng)]


def result(
    state: Evening,
    match: str,
    score: tuple[int, int] | str,
    *,
    ended: str = "",
    winner: str = "",
) -> Result:
    """Return the entry for the result of an undecided match.

    In a chip tournament, the table's number is enough for the match, and the winner for the score.
    `ended`: why the race wasn't played out, "time" or "conceded". The winner is needed only if the
    score doesn't show it.
    """
    name = known_match(state, match)
    if (before := state.counted.get(name)) is not None:
        correct_it = Command("tournament correct", typed(state, name))
        if before.forfeit:
            raise InputError(
                "{match} was forfeited; to change that: {correct}",
                match=state.match_words(name),
                correct=correct_it,
            )
        again = score == tuple(before.games[player] for player in state.pair(name))
        why = say(
            "{match} already has a result ({result}); to change it: {correct}",
            match=state.match_words(name),
            result=state.result_words(before),
            correct=correct_it,
        )
        raise AlreadyError(why) if again else InputError(why)
    refuse_waiting(state, name)
    pair = state.pair(name)
    games = games_in(state, name, pair, score)
    return _result(state, name, pair, games, ended, winner)


def taps(state: Evening, match: str, winner: str, games: int) -> tuple[int, int]:
    """Return a match's score, given its winner and the loser's games."""
    name = known_match(state, match)
    pair = state.pair(name)
    refuse_stranger(state, winner, name, pair)
    needs = state.needed(name, pair)
    return (needs[0], games) if winner == pair[0] else (games, needs[1])


def _result(
    state: Evening,
    name: str,
    pair: tuple[str, str],
    games: tuple[int, int],
    ended: str,
    winner: str,
) -> Result:
    won = winner_of(state, name, pair, games, ended=ended, stated=winner)
    short = all(map(int.__lt__, games, state.needed(name, pair)))
    return Result(name, pair, games, won, ended=ended if short else "")


def correct(
    state: Evening,
    match: str,
    score: tuple[int, int] | str,
    *,
    follow: str = "",
    ended: str = "",
    winner: str = "",
) -> Result:
    """Correct a match's result; in a chip tournament, a table means its last rack.

    If `follow` is "keep", the player who has moved on stays, whatever the corrected score says.
    """
    name = known_match(state, match, over=True)
    if name not in state.counted:
        refuse_waiting(state, name)
        raise InputError(
            "{match} has no result to correct. Enter one, for example: {enter}",
            match=state.match_words(name),
            enter=_a_result(state, name),
        )
    pair = state.pair(name)
    found = _result(state, name, pair, games_in(state, name, pair, score), ended, winner)
    found, before = replace(found, corrects=True), state.counted[name]
    if follow == "keep" and found.winner != before.winner:
        found = replace(found, winner=before.winner, stands=True)
    same = (before.games, before.winner, before.ended) == (found.games, found.winner, found.ended)
    if not before.forfeit and same:
        raise AlreadyError(
            "{match} already has that result: {result}",
            match=state.match_words(name),
            result=state.result_words(before),
        )
    return found


def _a_result(state: Evening, name: str) -> Command:
    """Return the command that makes the first player the winner of a match."""
    pair = state.pair(name)
    won = pair[0] if state.plan.form == "chips" else f"{state.needed(name, pair)[0]}-0"
    return Command("tournament result", typed(state, name), won)


def corrections(
    state: Evening,
    match: str,
    score: tuple[int, int] | str,
    *,
    follow: str = "",
    ended: str = "",
    winner: str = "",
) -> list[Called | Result]:
    """Correct a result; if `follow` is "stop", matches in play start again with their new players.

    The calls to their tables come before the correction, so that if it is taken back, everything in
    play continues.
    """
    found = correct(state, match, score, follow=follow, ended=ended, winner=winner)
    if follow != "stop":
        return [found]
    after = state.then(Event(state.events[-1].at, found))
    calls = []
    for name, one in state.on_tables.items():
        if name in after.on_tables or name not in after.standing.to_play:
            continue
        pair = after.pair(name)
        busy = {player for there in after.on_tables.values() for player in there.call.players}
        if not busy & {*pair}:
            calls.append(Called(name, one.call.table, pair))
    return [*calls, found]


def score(state: Evening, match: str, score: tuple[int, int]) -> Scored:
    """Enter the score of a match in play."""
    if state.plan.form == "chips":
        raise InputError(
            "a rack has no score. Enter its winner, for example: {enter}",
            enter=_a_result(state, undecided(state, match)),
        )
    name = undecided(state, match)
    pair = state.pair(name)
    needs = state.needed(name, pair)
    live = state.live.get(name)
    if live is not None and (live.what.players, live.what.score) == (pair, score):
        raise AlreadyError(
            "{match} is already at {score}",
            match=state.match_words(name),
            score=tally(score),
        )
    if score[0] >= needs[0] or score[1] >= needs[1]:
        winner_of(state, name, pair, score)  # refuses what cannot be
        raise InputError(
            "{a}-{b} ends {match}, a {race}; to enter it: {enter}",
            a=score[0],
            b=score[1],
            match=state.match_words(name),
            race=race_words(needs),
            enter=Command("tournament result", typed(state, name), f"{score[0]}-{score[1]}"),
        )
    return Scored(name, pair, score)


def forfeit(state: Evening, player: str, match: str | None = None) -> Result:
    """Let a player, by full name, forfeit a match; None: the only one they can play now."""
    loser = entered(state, player)
    if match is None:
        ready = [name for name in state.standing.to_play if loser in state.pair(name)]
        if len(ready) != 1:
            if not ready:
                raise InputError("{player} has no match ready to forfeit", player=loser)
            raise InputError(
                "{player} has {n} matches ready. Say which: {matches}.",
                player=loser,
                n=len(ready),
                matches=listed([state.match_words(one) for one in ready]),
            )
        match = ready[0]
    name = undecided(state, match)
    pair = state.pair(name)
    refuse_stranger(state, loser, name, pair)
    return Result(name, pair, (0, 0), pair[loser == pair[0]], forfeit=True)


def drop(state: Evening, player: str) -> Dropped:
    """Let a player, by full name, go home."""
    name = entered(state, player)
    if name in state.dropped:
        raise InputError("{player} has already withdrawn", player=name)
    if not state.drawn and len(state.entrants) <= 1:
        raise InputError("{player} is the only player", player=name)
    return Dropped(name)


def late(state: Evening, entrant: Entrant) -> Late:
    """Add a late player: before the draw, or in place of the lowest seed's open bye.

    A bye is open as long as filling it changes no match that has been played or called. In a chip
    tournament, a late player goes to the end of the line, as long as two players are still in.
    """
    check_entrant(state, entrant)
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
        reason = say("every player with a bye has already played")
    else:
        reason = say("the bracket has no bye")
    raise InputError(
        "{player} can't enter after the draw: {reason}", player=entrant.name, reason=reason
    )


def call(state: Evening, match: str, table: int | None) -> Called:
    """Call a match to a table, or move it to another; None: the first free table."""
    name = undecided(state, match)
    on, names = state.on_tables.get(name), state.plan.table_name
    if on is not None and table in (None, on.call.table):
        raise AlreadyError(
            "{match} is already on table {table}",
            match=state.match_words(name),
            table=names(on.call.table),
        )
    if table is None and not (free := state.free_tables):
        if kept := [names(k) for k in state.kept_tables]:
            raise InputError(
                "the only free tables are those assigned by hand ({tables}). Name one of them.",
                tables=", ".join(kept),
            )
        raise InputError("no table is free (there are {tables})", tables=state.plan.tables)
    chosen = free[0] if table is None else table
    if not 1 <= chosen <= state.plan.tables:
        raise InputError(
            "there's no table {table}; the tables are 1 to {tables}",
            table=chosen,
            tables=state.plan.tables,
        )
    there = _on_table(state, chosen)
    if there is not None:
        why = say(
            "table {table} is taken by {match}", table=names(chosen), match=state.match_words(there)
        )
        if on is None:
            raise InputError(why)
        trade = Command("tournament swap-tables", typed(state, name), typed(state, there))
        raise InputError("{taken}; to let them trade tables: {trade}", taken=why, trade=trade)
    if chosen in state.elsewhere:
        raise InputError(
            "table {table} is taken by {players}",
            table=names(chosen),
            players=" – ".join(state.elsewhere[chosen]),
        )
    for there, one in state.on_tables.items():
        for player in set(state.pair(name)) & set(one.call.players) if there != name else ():
            raise InputError(
                "{player} is playing {match} on table {table}",
                player=player,
                match=state.match_words(there),
                table=names(one.call.table),
            )
    for taken, players in state.elsewhere.items():
        for player in set(state.pair(name)) & {*players}:
            raise InputError(
                "{player} is playing on table {table}", player=player, table=names(taken)
            )
    return Called(name, chosen, state.pair(name))


def _on_table(state: Evening, table: int) -> str | None:
    """Return the match being played on a table."""
    return next((n for n, one in state.on_tables.items() if one.call.table == table), None)


def change(
    state: Evening,
    *,
    tables: int | None = None,
    race: int | None = None,
    losers_race: int | None = None,
    final_race: int | None = None,
    name: str | None = None,
    date: str | None = None,
    labels: tuple[str, ...] | None = None,
    reserved: tuple[int, ...] | None = None,
    streamed: tuple[int, ...] | None = None,
    slower: float | None = None,
) -> Changed:
    """Change the occasion, the tables, or the races of matches that haven't started.

    A match on a table that is closed goes back to the queue; its score is kept.
    """
    races = race, losers_race, final_race
    found = Changed(tables, *races, name, date, labels, reserved, streamed, slower)
    if found == Changed():
        raise InputError(
            "nothing would change. Set {changes}.",
            changes=listed(
                [Parameter(name) for name in ("tables", "race", "losers_race", "final_race")], "or"
            ),
        )
    if state.plan.chart is not None and any(races):
        raise InputError("the races come from a chart, so only the number of tables can change")
    if state.plan.form == "chips" and any(races):
        raise InputError(
            "a chip tournament is played rack by rack, so only the number of tables can change"
        )
    sides = {match.side for match in state.whole.matches} if state.drawn else {"losers", "final"}
    if losers_race is not None and not sides & {"losers", "consolation"}:
        raise InputError(
            "there's no losers' side; to change the races, set {race}", race=Parameter("race")
        )
    if final_race is not None and "final" not in sides:
        raise InputError(
            "there's no final; to change the races, set {race}", race=Parameter("race")
        )
    refuse_tables(changed(state.plan, found, None, ()))
    return found


def call_back(state: Evening, match: str) -> CalledBack:
    """Take a match off its table; its score is kept."""
    name = known_match(state, match)
    if state.plan.form == "chips":
        raise InputError(
            "a chip tournament has no calls: the players at the tables just keep playing"
        )
    if name not in state.on_tables:
        raise InputError("{match} isn't on a table", match=state.match_words(name))
    return CalledBack(name, state.pair(name))


def edit(state: Evening, player: str, *, name: str = "", rating: float | None = None) -> Edited:
    """Correct the name or rating of a player, by full name, before the draw."""
    before = state.entrants[entered(state, player)]
    if state.drawn:
        raise InputError(
            "the draw has been made, so ratings can no longer change; to change a name: {rename}",
            rename=Command("tournament rename", player),
        )
    rated = before if rating is None else Entrant(player, rating)
    after = replace(rated, name=name or player)
    if after == before:
        raise InputError(
            "nothing about {player} would change. Enter a different name or rating.", player=player
        )
    check_entrant(state, after, besides=player)
    return Edited(player, after)


def _rival(state: Evening, line: int) -> int:
    """Return the seed of the opponent in a first match; -1 for a bye."""
    there = (state.lines or ())[line ^ 1]
    return -1 if there is None else there


def _fits(state: Evening, entrant: Entrant, line: int) -> bool:
    """Return whether everything played and called stays the same if a bye is filled."""
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
