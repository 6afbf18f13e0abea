"""What an entry in a tournament in progress changed, in words."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.answers.kit.wording import some_of
from evenbreak.answers.league.prior import unrated_words
from evenbreak.answers.tournament.chips import chip_changes, entered_words, rack_words
from evenbreak.answers.tournament.night import waits_for
from evenbreak.answers.tournament.tournament import against, met_words, place_words
from evenbreak.tournaments.brackets.bracket import Place, Source
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.evening.events import (
    Called,
    CalledBack,
    Changed,
    CheckedIn,
    Declined,
    Drawn,
    Dropped,
    Edited,
    Event,
    Late,
    LaterDraw,
    Ranked,
    Redone,
    Registered,
    Renamed,
    Result,
    Scored,
    Substituted,
    Swapped,
    Undone,
    Waits,
    What,
)
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.history import as_read
from evenbreak.tournaments.evening.plan import KNOCK_OUT, pairings
from evenbreak.tournaments.evening.settling import TieBreak
from evenbreak.tournaments.evening.undoing import losses
from evenbreak.words import Sentence, joined, say, tally


def live_words(state: Evening, match: str) -> Sentence:
    """Return the score of a match in play, in words."""
    score = state.live[match].what
    (first, second), (a, b) = score.players, score.score
    name = state.match_words(match)
    return say(
        "Score in {match}: {first} {a}, {second} {b}.",
        match=name,
        first=first,
        a=a,
        second=second,
        b=b,
    )


def happened(before: Evening, after: Evening, event: Event) -> list[Sentence]:
    """Return, in words, what a result changed: who moves where, what no longer counts."""
    if not isinstance(event.what, Result):
        return []
    result = event.what
    if after.plan.form == "chips":
        return [say("{result}.", result=rack_words(result)), *chip_changes(before, after)]
    said = [_result_words(after, result)]
    if any(_leads_on(after, result.match)):
        said += [_moves(after, result.match, name) for name in (result.winner, result.loser)]
    if result.corrects and after.plan.form == "swiss":
        said += _kept_rounds(after, result.match)
    return [*said, *reopened(before, after, result.match)]


def _result_words(state: Evening, result: Result) -> Sentence:
    return say(
        "{result} in {match}.",
        result=state.result_words(result),
        match=state.match_words(result.match),
    )


def shout(state: Evening, match: str) -> Sentence:
    """Return what to announce when a match is called to its table."""
    call = state.on_tables[match].call
    table, pair = state.plan.table_name(call.table), against(call.players)
    if state.beside:
        name = event_name(state)
        return say("Table {table}, {event}: {pair}.", table=table, event=name, pair=pair)
    return say("Table {table}: {pair}.", table=table, pair=pair)


def event_name(state: Evening) -> Sentence | str:
    """Return the name of one of the night's events."""
    return state.plan.name or say("Event {n}", n=state.event)


def called_words(before: Evening, after: Evening) -> list[Sentence]:
    """Return, in words, which matches have gone to a table and which have left one."""
    said = [
        shout(after, name)
        for name, one in after.on_tables.items()
        if before.on_tables.get(name) != one
    ]
    for name, one in before.on_tables.items():
        if name not in after.on_tables and name not in after.counted:
            table = after.plan.table_name(one.call.table)
            left = say(
                "Taken off table {table}: {match}", match=after.match_words(name), table=table
            )
            why = after.waiting_for.get(name)
            if why and why.absent:
                gone = and_words(list(why.absent))
                said.append(say("{left}, which is waiting for {players}.", left=left, players=gone))
            elif name in after.live:
                said.append(say("{left}; {score} is kept.", left=left, score=_live(after, name)))
            else:
                said.append(say("{left}.", left=left))
    return said


def _live(state: Evening, match: str) -> str:
    """Return the score of a match in play, in its players' order."""
    return tally(state.live[match].of(state.pair(match)))


def and_words(names: Sequence[str]) -> Sentence | str:
    """Return names with an "and" before the last one."""
    if len(names) < 2:
        return "".join(names)
    return say("{first} and {last}", first=", ".join(names[:-1]), last=names[-1])


def _kept_rounds(state: Evening, match: str) -> list[Sentence]:
    """Return which rounds of a Swiss were paired with the result that was corrected."""
    first = int(match[1:].partition(".")[0]) + 1
    last = len(state.later)
    if last < first:
        return []
    if first == last:
        return [
            say(
                "Round {n} was paired using the earlier result. The pairings stay, and the "
                "standings count the corrected result.",
                n=first,
            )
        ]
    return [
        say(
            "Rounds {first} to {last} were paired using the earlier result. The pairings stay, "
            "and the standings count the corrected result.",
            first=first,
            last=last,
        )
    ]


def _leads_on(state: Evening, match: str) -> tuple[bool, bool]:
    """Return whether a match decides a place, and whether it leads to another match."""
    played = state.bracket.match(match)
    slots = [slot for one in state.bracket.matches for slot in one.slots]
    return (
        played.winner_place is not None or played.loser_place is not None,
        any(isinstance(slot, Source) and slot.match == match for slot in slots),
    )


def settled_words(before: Evening, after: Evening) -> list[Sentence]:
    """Return, in words, the results that count differently since a match was left standing."""
    return [
        _result_words(after, result)
        for name, result in after.counted.items()
        if before.counted.get(name, result) != result
    ]


def reopened(before: Evening, after: Evening, besides: str = "") -> list[Sentence]:
    """Return, in words, which matches are open again, and which results count again.

    `besides` is the match in which it happened.
    """
    if not (before.drawn and after.drawn):
        return []
    if after.plan.form == "chips":
        return chip_changes(before, after)
    said = []
    there = after.standing.seats  # without those of a round whose draw was taken back
    gone = [n for n in before.counted if n not in after.counted and n in there and n != besides]
    if gone:
        again = some_of([open_words(after, name) for name in gone])
        said.append(say("Reopened: {matches}.", matches=again))
    back = [
        say("{result} in {match}", result=after.result_words(result), match=after.match_words(name))
        for name, result in after.counted.items()
        if name not in before.counted and name != besides and name in after.records
    ]
    if back:
        said.append(say("Restored: {results}.", results=joined(back, "; ")))
    return said


def lost_words(before: Evening, after: Evening) -> list[Sentence]:
    """Return, in words, what an entry removes apart from its own subject."""
    said = []
    missing = [name for name in after.order if before.arrived and name not in before.arrived]
    if missing and not before.drawn:
        said.append(say("In the draw, but not here yet: {players}.", players=some_of(missing, 6)))
    if before.drawn and not after.drawn:
        said.append(say("The draw would be undone, and a new one may be different."))
    said += [
        say("The draw for round {n} would be undone.", n=stage[1:])
        for stage in before.later.keys() - after.later.keys()
        if after.drawn and stage != KNOCK_OUT
    ]
    for one in losses(before, after):
        name = before.match_words(one.match)
        match = say("{pair} ({match})", match=name, pair=against(one.players))
        at = "" if one.score is None or not any(one.score) else tally(one.score)
        table = None if one.table is None else before.plan.table_name(one.table)
        if one.result is not None:
            match = say("{result} ({match})", match=name, result=before.result_words(one.result))
            said.append(say("{match} would no longer count.", match=match))
        elif table is None:
            said.append(say("{match} would end at {score}.", match=match, score=at))
        elif after.drawn and one.match in after.on_tables:
            now = against(after.pair(one.match))
            where = {"match": match, "pair": now, "table": table}
            said.append(say("{match} would become {pair} on table {table}.", **where))
        elif at:
            where = {"match": match, "table": table, "score": at}
            said.append(say("{match} would leave table {table} at {score}.", **where))
        else:
            said.append(say("{match} would leave table {table}.", match=match, table=table))
    return said


def open_words(state: Evening, match: str) -> Sentence | str:
    """Return a match with its current players, or what it is waiting for."""
    name = state.match_words(match)
    if match in state.standing.to_play:
        return say("{match} ({pair})", match=name, pair=against(state.pair(match)))
    waits = waits_for(state, match)
    return say("{match} (waiting for {matches})", match=name, matches=waits) if waits else name


def _moves(state: Evening, match: str, player: str) -> Sentence:
    """Return where a player goes after a match."""
    seat = state.order.index(player)
    for one in state.bracket.matches:
        for k, slot in enumerate(one.slots):
            if not isinstance(slot, Source) or slot.match != match:
                continue
            if state.standing.seats[one.name][k] != seat:
                continue
            other = state.standing.seats[one.name][1 - k]
            if other == NOBODY:
                continue
            rival = (
                met_words(state.bracket, one.slots[1 - k], state.match_numbers)
                if other is None
                else state.order[other]
            )
            return say(
                "{player} goes to {match} and meets {opponent}.",
                player=player,
                match=state.match_words(one.name),
                opponent=rival,
            )
    if place := _place(state, match, player):
        return say("{player} finishes {place}.", player=player, place=place_words(place))
    return say("{player} has no matches left.", player=player)


def _place(state: Evening, match: str, player: str) -> Place | None:
    played = state.bracket.match(match)
    won = state.winners.get(match) == player
    return played.winner_place if won else played.loser_place


def forfeited(before: Evening, after: Evening) -> list[Sentence]:
    """Return, in words, what follows when a player goes home."""
    gone = set(after.dropped) - set(before.dropped) or set(before.entrants) - set(after.entrants)
    said = [say("{player} has withdrawn.", player=name) for name in sorted(gone)]
    if after.plan.form == "chips":
        return said + chip_changes(before, after)
    if after.drawn:
        said += [
            _result_words(after, result)
            for name, result in after.counted.items()
            if name not in before.counted
        ]
    return said


def entry_words(state: Evening, name: str) -> Sentence:
    """Return, in words, where a late player plays first."""
    entrant = state.entrants[name]
    plan = state.plan
    if (entrant.rating, entrant.standard_error) == (plan.starter, plan.starter_error):
        assumed = unrated_words([name], plan.starter, plan.starter_error)
        return joined([_entered(state, name), assumed])
    return _entered(state, name)


def _entered(state: Evening, name: str) -> Sentence:
    if not state.drawn:
        return say("{player} has entered.", player=name)
    if state.plan.form == "chips":
        return entered_words(state, name)
    seat = state.order.index(name)
    for match, seats in state.standing.seats.items():
        if seat in seats:
            other = seats[1 - seats.index(seat)]
            rival = say("an opponent not yet known") if other is None else state.order[other]
            return say(
                "{player} takes a bye's place and meets {opponent} in {match}.",
                player=name,
                opponent=rival,
                match=state.match_words(match),
            )
    return say("{player} has entered.", player=name)


def draw_words(before: Evening, after: Evening) -> Sentence:
    """Return what was drawn."""
    said: list[Sentence] = []
    if not before.drawn:
        said.append(say("The draw has been made: {n} players.", n=len(after.order)))
    for stage in after.later.keys() - before.later.keys():
        if stage == KNOCK_OUT:
            said.append(say("The losers' qualifiers are drawn."))
        else:
            pairs = pairings(after.later)[int(stage[1:]) - 1]
            byes = [p.first for p in pairs if p.second is None]
            if byes:
                said.append(
                    say("Round {n} is drawn; {player} has a bye.", n=stage[1:], player=byes[0])
                )
            else:
                said.append(say("Round {n} is drawn.", n=stage[1:]))
    return joined(said)


def undone_words(what: What, state: Evening) -> Sentence:
    """Return what was taken back."""
    return say("Undone: {entry}.", entry=event_words(what, state))


def event_words(what: What, state: Evening) -> Sentence:
    """Return what happened, in a few words, using a state's match numbers."""
    match what:
        case Result(corrects=corrects, stands=stands):
            found = say(
                "{result} ({match})",
                result=_short_words(state, what),
                match=state.match_words(what.match),
            )
            return say("correction: {result}", result=found) if corrects and not stands else found
        case Called(match=match):
            return say(
                "{match} called to table {table}",
                match=state.match_words(match),
                table=state.plan.table_name(what.table),
            )
        case CalledBack(match=match):
            return say("{match} taken off its table", match=state.match_words(match))
        case Waits(match=match, absent=absent):
            name = state.match_words(match)
            if absent:
                return say(
                    "{match} is waiting for {players}", match=name, players=and_words(absent)
                )
            return (
                say("{match} is waiting: {reason}", match=name, reason=what.reason or "–")
                if what
                else say("{match} is no longer waiting", match=name)
            )
        case Scored(match=match, score=score):
            name = state.match_words(match)
            return say("score {score} in {match}", score=tally(score), match=name)
        case Ranked():
            return say("tie-break")
        case Drawn():
            return say("draw")
        case LaterDraw(stage=stage):
            if stage == KNOCK_OUT:
                return say("draw for the qualifiers")
            return say("draw for round {n}", n=stage[1:])
        case _:
            return _entry_words(what)


def _short_words(state: Evening, result: Result) -> str:
    """Return a result as written on a sheet: Ann 5-3 Bo."""
    won, lost = result.games[result.winner], result.games[result.loser]
    names = {"winner": result.winner, "loser": result.loser}
    if result.stands or result.forfeit or result.ended or state.uneven_race(result):
        return state.result_words(result)
    return say("{winner} {score} {loser}", score=tally((won, lost)), **names)


def history_words(events: Sequence[Event], state: Evening) -> list[Sentence]:
    """Return what happened in each entry, in a few words; for an undo, what it took back.

    Players have their current names, and matches have their numbers.
    """
    told = as_read(events)
    said = [event_words(one.what, state) for one in told]
    for k, one in enumerate(told):
        entry = one.what.entry if isinstance(one.what, Undone | Redone) else None
        if entry is not None:
            words = (
                say("entry {n} undone: {entry}", n=entry, entry=said[entry - 1])
                if isinstance(one.what, Undone)
                else say("entry {n} redone: {entry}", n=entry, entry=said[entry - 1])
            )
            said[k] = words
    return said


def _entry_words(what: What) -> Sentence:
    """Return, in words, what affects the list of players, or the evening as a whole."""
    match what:
        case Late(entrant=entrant):
            return say("{player}'s entry", player=entrant.name)
        case Edited(name=name, entrant=entrant):
            return say(
                "{player} corrected to {name}, {rating:g}",
                player=name,
                name=entrant.name,
                rating=entrant.rating,
            )
        case Renamed(name=name, to=to):
            return say("{player} is now called {name}", player=name, name=to)
        case Substituted(name=name, entrant=entrant):
            return say("{name} plays in place of {player}", player=name, name=entrant.name)
        case Swapped(one=one, other=other):
            return say("{players} traded places", players=and_words([one, other]))
        case Dropped():
            return say("{player}'s withdrawal", player=what.name)
        case CheckedIn() | Registered() | Declined():
            return _list_words(what)
        case Changed():
            return say("tables or races changed")
        case Undone(entry=None):
            return say("last entry undone")
        case Undone(entry=entry):
            return say("entry {n} undone", n=entry)
        case _:
            return say("start")


def _list_words(what: CheckedIn | Registered | Declined) -> Sentence:
    """Return, in words, what was checked on the list of players."""
    player = what.name
    if isinstance(what, Registered):
        return say("{player} would like to play", player=player)
    if isinstance(what, Declined):
        return say("{player} isn't playing", player=player)
    here = say("{player} is here", player=player)
    if what.arrived is False:
        here = say("{player} is not here", player=player)
    paid = say("{player} has paid", player=player)
    if what.paid is False:
        paid = say("{player} has not paid", player=player)
    if what.arrived is None or what.paid is None:
        return paid if what.arrived is None else here
    return joined([here, paid], "; ")


def tie_words(found: TieBreak) -> list[Sentence]:
    """Return, in words, how ties were broken."""
    said = [say("The order is {players}.", players=", ".join(found.ranked.order))]
    if found.by_lot:
        said.append(say("Drawn by lot: {players}.", players=", ".join(found.by_lot)))
    elif found.ranked.group.isdigit():  # runners-up
        said.append(say("Ties were broken by games won minus games lost per match."))
    else:
        said.append(say("Games won minus games lost broke the ties."))
    return said
