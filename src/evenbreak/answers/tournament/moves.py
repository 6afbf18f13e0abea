"""What an entry into a tournament under way has changed, in words."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.answers.kit.wording import some_of
from evenbreak.answers.tournament.chips import chip_changes, entered_words, rack_words
from evenbreak.answers.tournament.night import waits_for
from evenbreak.answers.tournament.tournament import slot_words, unrated_words
from evenbreak.tournaments.brackets.bracket import Place, Source
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.evening.bracket_of_plan import KNOCK_OUT, pairings
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
from evenbreak.tournaments.evening.losses import losses
from evenbreak.tournaments.evening.settling import TieBreak


def happened(before: Evening, after: Evening, event: Event) -> list[str]:
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
        return [f"{rack_words(result)}.", *chip_changes(before, after)]
    said = [f"{score_words(result)} in {result.match}."]
    if any(_leads_on(after, result.match)):
        said += [_moves(after, result.match, name) for name in (result.winner, result.loser)]
    if result.corrects and after.plan.form == "swiss":
        said += _kept_rounds(after, result.match)
    return [*said, *reopened(before, after, result.match)]


def _kept_rounds(state: Evening, match: str) -> list[str]:
    """Return which rounds of a Swiss had been paired with the result that was corrected."""
    first = int(match[1:].partition(".")[0]) + 1
    last = len(state.later)
    if last < first:
        return []
    which = f"Round {first} was" if first == last else f"Rounds {first} to {last} were"
    return [
        f"{which} paired by the result as it stood before; the pairings stay as they are, and the "
        "standings count the corrected result."
    ]


def _leads_on(state: Evening, match: str) -> tuple[bool, bool]:
    """Return whether a match decides a place, and whether it leads to another match."""
    played = state.bracket.match(match)
    slots = [slot for one in state.bracket.matches for slot in one.slots]
    return (
        played.winner_place is not None or played.loser_place is not None,
        any(isinstance(slot, Source) and slot.match == match for slot in slots),
    )


def settled_words(before: Evening, after: Evening) -> list[str]:
    """Return in words the results that count otherwise since a match was let stand."""
    return [
        f"{score_words(result)} in {name}."
        for name, result in after.counted.items()
        if before.counted.get(name, result) != result
    ]


def reopened(before: Evening, after: Evening, besides: str = "") -> list[str]:
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
        said.append(f"Open again: {some_of([_open_words(after, name) for name in gone])}.")
    back = [
        f"{score_words(result)} in {name}"
        for name, result in after.counted.items()
        if name not in before.counted and name != besides and name in after.records
    ]
    if back:
        said.append(f"Counts again: {'; '.join(back)}.")
    return said


def lost_words(before: Evening, after: Evening) -> list[str]:
    """Return in words what an entry takes away besides that which it is about."""
    said = []
    for one in losses(before, after):
        match = f"{one.match}, {' against '.join(one.players)},"
        at = "" if one.score is None or not any(one.score) else "{}:{}".format(*one.score)
        if one.result is not None:
            said.append(f"{one.match}, {score_words(one.result)}, would no longer count.")
        elif one.table is None:
            said.append(f"{match} would end at {at}.")
        elif after.drawn and after.plan.form == "chips" and one.match in after.on_tables:
            now = " against ".join(after.pair(one.match))
            said.append(f"{match} would be {now} on table {one.table}.")
        else:
            said.append(f"{match} would leave table {one.table}{f' at {at}' if at else ''}.")
    return said


def _open_words(state: Evening, match: str) -> str:
    """Return a match with whoever plays it now, or what it waits for."""
    if match in state.standing.to_play:
        return f"{match} ({' against '.join(state.pair(match))})"
    waits = waits_for(state, match)
    return f"{match} (waits for {waits})" if waits else match


def _moves(state: Evening, match: str, player: str) -> str:
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
                f"the {slot_words(state.bracket, one.slots[1 - k])}"
                if other is None
                else state.order[other]
            )
            return f"{player} goes to {one.name} and meets {rival}."
    place = _place(state, match, player)
    return f"{player} finishes in place {place}." if place else f"{player} has no match to come."


def _place(state: Evening, match: str, player: str) -> Place | None:
    played = state.bracket.match(match)
    won = state.winners.get(match) == player
    return played.winner_place if won else played.loser_place


def forfeited(before: Evening, after: Evening) -> list[str]:
    """Return in words what follows from a player going home."""
    gone = set(after.dropped) - set(before.dropped) or set(before.entrants) - set(after.entrants)
    said = [f"{name} has dropped out." for name in sorted(gone)]
    if after.plan.form == "chips":
        return said + chip_changes(before, after)
    if after.drawn:
        said += [
            f"{score_words(result)} in {name}."
            for name, result in after.counted.items()
            if name not in before.counted
        ]
    return said


def entry_words(state: Evening, name: str) -> str:
    """Return in words where a late player plays first."""
    entrant = state.entrants[name]
    plan = state.plan
    if (entrant.rating, entrant.standard_error) == (plan.starter, plan.starter_error):
        return f"{_entered(state, name)} {unrated_words([name], plan.starter, plan.starter_error)}"
    return _entered(state, name)


def _entered(state: Evening, name: str) -> str:
    if not state.drawn:
        return f"{name} has entered."
    if state.plan.form == "chips":
        return entered_words(state, name)
    seat = state.order.index(name)
    for match, seats in state.standing.seats.items():
        if seat in seats:
            other = seats[1 - seats.index(seat)]
            rival = "a player to come" if other is None else state.order[other]
            return f"{name} has entered in place of a bye and meets {rival} in {match}."
    return f"{name} has entered."


def draw_words(before: Evening, after: Evening) -> str:
    """Return what was drawn."""
    said = [] if before.drawn else [f"{len(after.order)} players are drawn."]
    for stage in after.later.keys() - before.later.keys():
        if stage == KNOCK_OUT:
            said.append("The losers' qualifiers are drawn.")
        else:
            pairs = pairings(after.later)[int(stage[1:]) - 1]
            byes = [p.first for p in pairs if p.second is None]
            bye = f"; {byes[0]} has a bye" if byes else ""
            said.append(f"Round {stage[1:]} is drawn{bye}.")
    return " ".join(said)


def undone_words(what: What) -> str:
    """Return what was taken back.

    >>> undone_words(Result("W1.1", ("Ann", "Bo"), (7, 5), "Ann"))
    'Taken back: Ann beat Bo 7:5 in W1.1.'
    """
    return f"Taken back: {event_words(what)}."


def event_words(what: What) -> str:
    """Return what happened, in a few words.

    >>> event_words(Called("W1.1", 3, ("Ann", "Bo")))
    'the call of W1.1 to table 3'
    """
    match what:
        case Result(corrects=corrects, stands=stands):
            kind = "the correction " if corrects and not stands else ""
            return f"{kind}{score_words(what)} in {what.match}"
        case Scored(match=match, score=score):
            return f"the score {score[0]}:{score[1]} of {match}"
        case Ranked():
            return "the breaking of the ties"
        case Called():
            return f"the call of {what.match} to table {what.table}"
        case CalledBack(match=match):
            return f"{match} taken off its table"
        case Drawn():
            return "the draw"
        case LaterDraw(stage=stage):
            round_of = stage != KNOCK_OUT
            return f"the draw of round {stage[1:]}" if round_of else "the draw of the qualifiers"
        case _:
            return _entry_words(what)


def history_words(events: Sequence[Event]) -> list[str]:
    """Return what happened in each entry, in a few words; of an undo, what it took back.

    >>> called = Event("2025-03-01T19:30:00", Called("W1.1", 3, ("Ann", "Bo")))
    >>> history_words([called, Event("2025-03-01T19:31:00", Undone(1))])[1]
    'entry 1 taken back: the call of W1.1 to table 3'
    """
    said = [event_words(one.what) for one in events]
    for k, one in enumerate(events):
        if isinstance(one.what, Undone) and one.what.entry is not None:
            said[k] += f": {said[one.what.entry - 1]}"
    return said


def _entry_words(what: What) -> str:
    """Return in words what concerns the list of players, or the evening as a whole."""
    match what:
        case Changed():
            return "the change of tables or races"
        case Late():
            return f"the entry of {what.entrant.name}"
        case Edited(name=name, entrant=entrant):
            return f"{name} corrected to {entrant.name}, {entrant.rating:g}"
        case Dropped():
            return f"{what.name} dropping out"
        case Undone(entry=None):
            return "the last entry taken back"
        case Undone(entry=entry):
            return f"entry {entry} taken back"
        case _:
            return "the beginning"


def tie_words(found: TieBreak) -> list[str]:
    """Return in words how ties were broken."""
    said = [f"The order is {', '.join(found.ranked.order)}."]
    if found.by_lot:
        said.append(f"Drawn by lot: {', '.join(found.by_lot)}.")
    else:
        said.append("Games won minus games lost broke the ties.")
    return said
