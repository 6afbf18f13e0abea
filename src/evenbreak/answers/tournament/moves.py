"""What an entry into a tournament under way has changed, in words."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.answers.kit.wording import some_of
from evenbreak.answers.league.prior import unrated_words
from evenbreak.answers.tournament.chips import chip_changes, entered_words, rack_words
from evenbreak.answers.tournament.night import waits_for
from evenbreak.answers.tournament.tournament import (
    against,
    met_words,
    place_words,
)
from evenbreak.tournaments.brackets.bracket import Place, Source
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.evening.events import (
    Called,
    CalledBack,
    Changed,
    Drawn,
    Dropped,
    Edited,
    Event,
    Late,
    LaterDraw,
    Ranked,
    Result,
    Scored,
    Undone,
    What,
    score_words,
)
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.plan import KNOCK_OUT, pairings
from evenbreak.tournaments.evening.settling import TieBreak
from evenbreak.tournaments.evening.undoing import losses
from evenbreak.words import Sentence, joined, say


def called_words(before: Evening, after: Evening) -> list[Sentence]:
    """Return in words which matches have come to a table, and which have left theirs."""
    said = [
        say(
            "Table {table}: {match}, {pair}.",
            table=one.call.table,
            match=after.match_words(name),
            pair=against(one.call.players),
        )
        for name, one in after.on_tables.items()
        if before.on_tables.get(name) != one
    ]
    said += [
        say(
            "Taken off table {table}: {match}.",
            match=before.match_words(name),
            table=one.call.table,
        )
        for name, one in before.on_tables.items()
        if name not in after.on_tables
    ]
    return said


def live_words(state: Evening, match: str) -> Sentence:
    """Return the score of a match in play in words."""
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
    """Return in words what a result changed: who moves where, what no longer counts.

    Parameters
    ----------
    before, after
        the state before and after it.
    event
        what happened.
    """
    if not isinstance(event.what, Result):
        return []
    result = event.what
    if after.plan.form == "chips":
        return [say("{result}.", result=rack_words(result)), *chip_changes(before, after)]
    said = [_result_words(result.match, result)]
    if any(_leads_on(after, result.match)):
        said += [_moves(after, result.match, name) for name in (result.winner, result.loser)]
    if result.corrects and after.plan.form == "swiss":
        said += _kept_rounds(after, result.match)
    return [*said, *reopened(before, after, result.match)]


def _result_words(match: str, result: Result) -> Sentence:
    return say("{result} in {match}.", result=score_words(result), match=match)


def _kept_rounds(state: Evening, match: str) -> list[Sentence]:
    """Return which rounds of a Swiss had been paired with the result that was corrected."""
    first = int(match[1:].partition(".")[0]) + 1
    last = len(state.later)
    if last < first:
        return []
    if first == last:
        return [
            say(
                "Round {n} was paired by the result as it was before. The pairings stay, and the "
                "standings count the corrected result.",
                n=first,
            )
        ]
    return [
        say(
            "Rounds {first} to {last} were paired by the result as it was before. The pairings "
            "stay, and the standings count the corrected result.",
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
    """Return in words the results that count otherwise since a match was let stand."""
    return [
        _result_words(name, result)
        for name, result in after.counted.items()
        if before.counted.get(name, result) != result
    ]


def reopened(before: Evening, after: Evening, besides: str = "") -> list[Sentence]:
    """Return in words which matches are open again, and which results count again.

    Parameters
    ----------
    before, after
        the state before and after something happened.
    besides
        the match in which it happened.
    """
    if not (before.drawn and after.drawn):
        return []
    if after.plan.form == "chips":
        return chip_changes(before, after)
    said = []
    gone = [name for name in before.counted if name not in after.counted and name != besides]
    if gone:
        again = some_of([_open_words(after, name) for name in gone])
        said.append(say("Must be replayed: {matches}.", matches=again))
    back = [
        say("{result} in {match}", result=score_words(result), match=name)
        for name, result in after.counted.items()
        if name not in before.counted and name != besides and name in after.records
    ]
    if back:
        said.append(say("Counts again: {results}.", results=joined(back, "; ")))
    return said


def lost_words(before: Evening, after: Evening) -> list[Sentence]:
    """Return in words what an entry takes away besides that which it is about."""
    said = []
    for one in losses(before, after):
        match = say("{match} ({pair})", match=one.match, pair=against(one.players))
        at = "" if one.score is None or not any(one.score) else "{}:{}".format(*one.score)
        if one.result is not None:
            match = say("{match} ({result})", match=one.match, result=score_words(one.result))
            said.append(say("{match} would no longer count.", match=match))
        elif one.table is None:
            said.append(say("{match} would end at {score}.", match=match, score=at))
        elif after.drawn and after.plan.form == "chips" and one.match in after.on_tables:
            now = against(after.pair(one.match))
            said.append(
                say(
                    "{match} would become {pair} on table {table}.",
                    match=match,
                    pair=now,
                    table=one.table,
                )
            )
        elif at:
            said.append(
                say(
                    "{match} would leave table {table} at {score}.",
                    match=match,
                    table=one.table,
                    score=at,
                )
            )
        else:
            said.append(say("{match} would leave table {table}.", match=match, table=one.table))
    return said


def _open_words(state: Evening, match: str) -> str:
    """Return a match with whoever plays it now, or what it waits for."""
    if match in state.standing.to_play:
        return say("{match} ({pair})", match=match, pair=against(state.pair(match)))
    waits = waits_for(state, match)
    return say("{match} (waits for {matches})", match=match, matches=waits) if waits else match


def _moves(state: Evening, match: str, player: str) -> Sentence:
    """Return where a player goes from a match."""
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
                met_words(state.bracket, one.slots[1 - k]) if other is None else state.order[other]
            )
            return say(
                "{player} goes to {match} and meets {opponent}.",
                player=player,
                match=one.name,
                opponent=rival,
            )
    if place := _place(state, match, player):
        return say("{player} finishes {place}.", player=player, place=place_words(place))
    return say("{player} has no match left.", player=player)


def _place(state: Evening, match: str, player: str) -> Place | None:
    played = state.bracket.match(match)
    won = state.winners.get(match) == player
    return played.winner_place if won else played.loser_place


def forfeited(before: Evening, after: Evening) -> list[Sentence]:
    """Return in words what follows from a player going home."""
    gone = set(after.dropped) - set(before.dropped) or set(before.entrants) - set(after.entrants)
    said = [say("{player} has withdrawn.", player=name) for name in sorted(gone)]
    if after.plan.form == "chips":
        return said + chip_changes(before, after)
    if after.drawn:
        said += [
            _result_words(name, result)
            for name, result in after.counted.items()
            if name not in before.counted
        ]
    return said


def entry_words(state: Evening, name: str) -> Sentence:
    """Return in words where a late player plays first."""
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
                "{player} has entered in place of a bye and meets {opponent} in {match}.",
                player=name,
                opponent=rival,
                match=match,
            )
    return say("{player} has entered.", player=name)


def draw_words(before: Evening, after: Evening) -> Sentence:
    """Return what was drawn."""
    said: list[Sentence] = []
    if not before.drawn:
        said.append(say("{n} players are drawn.", n=len(after.order)))
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


def undone_words(what: What) -> Sentence:
    """Return what was taken back.

    >>> undone_words(Result("W1.1", ("Ann", "Bo"), (7, 5), "Ann"))
    'Undone: Ann beat Bo 7:5 in W1.1.'
    """
    return say("Undone: {entry}.", entry=event_words(what))


def event_words(what: What) -> Sentence:
    """Return what happened, in a few words.

    >>> event_words(Called("W1.1", 3, ("Ann", "Bo")))
    'call of W1.1 to table 3'
    """
    match what:
        case Result(corrects=corrects, stands=stands):
            found = say("{result} in {match}", result=score_words(what), match=what.match)
            return say("correction: {result}", result=found) if corrects and not stands else found
        case Scored(match=match, score=score):
            return say("score {a}:{b} in {match}", a=score[0], b=score[1], match=match)
        case Ranked():
            return say("tie-break")
        case Called():
            return say("call of {match} to table {table}", match=what.match, table=what.table)
        case CalledBack(match=match):
            return say("{match} taken off its table", match=match)
        case Drawn():
            return say("draw")
        case LaterDraw(stage=stage):
            if stage == KNOCK_OUT:
                return say("draw of the qualifiers")
            return say("draw of round {n}", n=stage[1:])
        case _:
            return _entry_words(what)


def history_words(events: Sequence[Event]) -> list[Sentence]:
    """Return what happened in each entry, in a few words; of an undo, what it took back.

    >>> called = Event("2025-03-01T19:30:00", Called("W1.1", 3, ("Ann", "Bo")))
    >>> history_words([called, Event("2025-03-01T19:31:00", Undone(1))])[1]
    'entry 1 undone: call of W1.1 to table 3'
    """
    said = [event_words(one.what) for one in events]
    for k, one in enumerate(events):
        if isinstance(one.what, Undone) and one.what.entry is not None:
            said[k] = say(
                "entry {n} undone: {entry}", n=one.what.entry, entry=said[one.what.entry - 1]
            )
    return said


def _entry_words(what: What) -> Sentence:
    """Return in words what concerns the list of players, or the evening as a whole."""
    match what:
        case Changed():
            return say("change of tables or races")
        case Late():
            return say("entry of {player}", player=what.entrant.name)
        case Edited(name=name, entrant=entrant):
            return say(
                "{player} corrected to {name}, {rating:g}",
                player=name,
                name=entrant.name,
                rating=entrant.rating,
            )
        case Dropped():
            return say("withdrawal of {player}", player=what.name)
        case Undone(entry=None):
            return say("last entry undone")
        case Undone(entry=entry):
            return say("entry {n} undone", n=entry)
        case _:
            return say("start")


def tie_words(found: TieBreak) -> list[Sentence]:
    """Return in words how ties were broken."""
    said = [say("The order is {players}.", players=", ".join(found.ranked.order))]
    if found.by_lot:
        said.append(say("Drawn by lot: {players}.", players=", ".join(found.by_lot)))
    elif found.ranked.group.isdigit():  # runners-up
        said.append(say("Games won minus games lost, for each match, broke the ties."))
    else:
        said.append(say("Games won minus games lost broke the ties."))
    return said
