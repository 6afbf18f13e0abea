"""A tournament's moves: what each does, and how it is described.

Commands, forms and their routes are made from this table; the options are in `questions.moves`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from datetime import datetime, timedelta

import numpy as np

from evenbreak.answers.kit.scales import far_doubts
from evenbreak.answers.tournament.leaving import would_words
from evenbreak.answers.tournament.moves import (
    called_words,
    draw_words,
    entry_words,
    event_words,
    forfeited,
    happened,
    live_words,
    reopened,
    settled_words,
    tie_words,
    undone_words,
)
from evenbreak.answers.tournament.night import next_calls
from evenbreak.answers.tournament.tournament import races_words
from evenbreak.errors import InputError
from evenbreak.evenings.move import AlreadyError, Move
from evenbreak.files.tables.names import NAME, clean_name, is_name
from evenbreak.questions.moves import (
    Accept,
    Call,
    Change,
    CheckIn,
    Correct,
    Decline,
    Drop,
    Edit,
    Ended,
    EnterResult,
    EnterScore,
    Forfeit,
    LetIn,
    MakeDraw,
    Redo,
    Rename,
    Stand,
    Substitute,
    Swap,
    SwapTables,
    TieBreak,
    Uncall,
    Undo,
    Wait,
)
from evenbreak.tournaments.evening import moves, roster, settling, tables, undoing
from evenbreak.tournaments.evening.events import BY_ITSELF, Entrant, Event, What
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.plan import table_places
from evenbreak.words import Command, Parameter, Sentence, say, say_count

_GAMES = Parameter("games")


def _draw(state: Evening, asked: MakeDraw, _: str) -> Sequence[What]:
    without = [name for name in state.entrants if asked.here and name not in state.arrived]
    return moves.draw_next(state, np.random.default_rng(asked.seed), without=without)


def _call(state: Evening, asked: Call, at: str) -> Sequence[What]:
    if state.plan.form == "chips":
        raise InputError(
            "a chip tournament needs no calls: each result brings the next player in line to "
            "the table. See {next}",
            next=Command("tournament next"),
        )
    if asked.match is not None:
        table = state.plan.table_number(asked.table) if asked.table else None
        return [moves.call(state, asked.match, table)]
    called = [moves.call(state, name, table) for table, name in next_calls(Outlook(state, at))]
    if not called:
        raise InputError("no match can be called: no table is free, or no match is ready")
    return called


def _result(state: Evening, asked: EnterResult, _: str) -> Sequence[What]:
    return [moves.result(state, asked.match, _score(state, asked), **_ended(asked))]


def _correct(state: Evening, asked: Correct, _: str) -> Sequence[What]:
    score, follow = _score(state, asked), asked.follow or ""
    return moves.corrections(state, asked.match, score, follow=follow, **_ended(asked))


def _ended(asked: Ended) -> dict[str, str]:
    return {"ended": asked.ended, "winner": asked.winner or ""} if asked.ended else {}


def _score(state: Evening, asked: Ended) -> tuple[int, int] | str:
    """Return a match's score, given the winner and perhaps the loser's games."""
    if asked.winner is None or asked.score is not None:
        return asked.score or ""
    if state.plan.form == "chips":
        return asked.winner
    match = moves.known_match(state, asked.match, over=isinstance(asked, Correct))
    if match not in {*state.standing.to_play, *state.counted}:
        return 0, 0  # it has no result, and that is what is refused
    if asked.games is None:
        raise InputError("{games} is missing. Enter how many games the loser won.", games=_GAMES)
    return moves.taps(state, asked.match, asked.winner, asked.games)


def _last_words(before: Evening, after: Evening, _: object) -> list[Sentence]:
    own = next(one for one in reversed(after.events) if not one.by.startswith(BY_ITSELF))
    called = called_words(before, after) if own is not after.events[-1] else []
    return [*happened(before, after, own), *called]


def _stand_words(before: Evening, after: Evening, _: object) -> list[Sentence]:
    return [*settled_words(before, after), *reopened(before, after)]


def _change(state: Evening, asked: Change, _: str) -> Sequence[What]:
    count, labels = asked.tables or (None, None)
    then = replace(state.plan, tables=count or state.plan.tables)
    then = replace(then, labels=then.labels if labels is None else labels)

    places = table_places(state.plan, then)
    old = {state.plan.table_name(k).casefold(): k for k in range(1, state.plan.tables + 1)}
    new = {then.table_name(k).casefold() for k in range(1, then.tables + 1)}

    def numbers(names: tuple[str, ...] | None) -> tuple[int, ...] | None:
        if names is None:
            return None
        # A form that closes a table still names it where it was: it is of no account there.
        gone = {name for name in names if name.casefold() in old.keys() - new}
        moved = [places[old[name.casefold()]] for name in gone if old[name.casefold()] in places]
        return (*map(then.table_number, [name for name in names if name not in gone]), *moved)

    return [
        moves.change(
            state,
            tables=count,
            race=asked.race,
            losers_race=asked.losers_race,
            final_race=asked.final_race,
            name=asked.name,
            date=asked.date,
            labels=labels,
            reserved=numbers(asked.reserved),
            streamed=numbers(asked.streamed),
            slower=asked.slower,
        )
    ]


def _change_words(before: Evening, after: Evening, _: Change) -> list[Sentence]:
    then, now = before.plan, after.plan
    names = [[plan.table_name(k) for k in range(1, plan.tables + 1)] for plan in (then, now)]
    said = []
    if names[0] != names[1]:
        tables = ", ".join(names[1])
        said.append(
            say_count("1 table: {names}.", "{n} tables: {names}.", now.tables, names=tables)
        )
    if now.reserved != then.reserved:
        tables = ", ".join(map(now.table_name, now.reserved)) or say("none")
        said.append(say("Assigned by hand only: {tables}.", tables=tables))
    if before.races != after.races:
        said.append(say("{races}.", races=races_words(after.races)))
    if (then.name, then.date) != (now.name, now.date):
        said.append(say("The event is called {name}.", name=" ".join((now.name, now.date)).strip()))
    return [*(said or [say("Changed.")]), *(called_words(before, after) if after.drawn else [])]


def _undo_words(before: Evening, after: Evening, _: object) -> list[Sentence]:
    gone = [
        event
        for number, event in zip(before.numbers, before.events, strict=True)
        if number not in after.numbers
    ]
    last = [event for event in gone if event.by != BY_ITSELF] or gone
    return [undone_words(last[-1].what, after), *reopened(before, after)]


def name_in(text: str) -> str:
    """Return a name as lists are read; reject a name that can't be printed."""
    name = clean_name(text)
    if not is_name(name):
        raise InputError("{name!r} isn't {what}", name=text, what=NAME)
    return name


def _late(state: Evening, asked: LetIn, _: str) -> Sequence[What]:
    return [moves.late(state, _entrant(state, asked.player, asked.rating))]


def _rating_doubts(before: Evening, after: Evening, _: object) -> list[str]:
    """Return whether a rating is far from all others, unless the others already were."""
    then, now = ([one.rating for one in state.entrants.values()] for state in (before, after))
    if far_doubts(before.scale, then):
        return []
    return list(far_doubts(after.scale, now, list(after.entrants)))


def _edit(state: Evening, asked: Edit, _: str) -> Sequence[What]:
    name = name_in(asked.name) if asked.name else ""
    return [moves.edit(state, asked.player, name=name, rating=asked.rating)]


def _edit_words(before: Evening, after: Evening, _: object) -> list[Sentence]:
    (now,) = set(after.entrants.values()) - set(before.entrants.values())
    return [
        say(
            "{player} has been entered with a rating of {rating:g}.",
            player=now.name,
            rating=now.rating,
        )
    ]


def _wait(state: Evening, asked: Wait, at: str) -> Sequence[What]:
    until = ""
    if asked.until is not None:
        now = datetime.fromisoformat(at)
        when = now.replace(hour=asked.until // 60, minute=asked.until % 60, second=0)
        until = (when + timedelta(days=now - when > timedelta(hours=12))).isoformat()
    absent, reason = asked.absent, asked.reason
    return [tables.wait(state, asked.match, absent=absent, until=until, reason=reason)]


def _substitute(state: Evening, asked: Substitute, _: str) -> Sequence[What]:
    return [roster.substitute(state, asked.player, _entrant(state, asked.to, asked.rating))]


def _entrant(state: Evening, text: str, rating: float | None) -> Entrant:
    name = name_in(text)
    return state.plan.newcomer(name) if rating is None else Entrant(name, rating)


def _check_in(state: Evening, asked: CheckIn, at: str) -> Sequence[What]:
    arrived = True if asked.arrived is None is asked.paid else asked.arrived
    found = roster.check_in(state, asked.player, arrived=arrived, paid=asked.paid)
    after = state.then(Event(at, found))
    if (after.arrived, after.paid) == (state.arrived, state.paid):
        raise AlreadyError(event_words(found, state))
    return [found]


def _said(_: Evening, after: Evening, __: object) -> list[Sentence]:
    return [say("{entry}.", entry=event_words(after.events[-1].what, after))]


def _redone_words(before: Evening, after: Evening, _: object) -> list[Sentence]:
    events = dict(zip(after.numbers, after.events, strict=True))
    back = max(events.keys() - set(before.numbers))
    said = say("Redone: {entry}.", entry=event_words(events[back].what, after))
    return [said, *reopened(before, after)]


def _tie_break(state: Evening, asked: TieBreak) -> settling.TieBreak:
    return settling.break_ties(state, np.random.default_rng(asked.seed), only_lots=asked.lot)


MOVES: dict[str, Move[Evening, What]] = {
    "draw": Move(MakeDraw, _draw, lambda before, after, _: [draw_words(before, after)]),
    "call": Move(Call, _call, lambda before, after, _: called_words(before, after)),
    "uncall": Move(
        Uncall,
        lambda state, asked, _: [moves.call_back(state, asked.match)],
        lambda before, after, _: called_words(before, after),
    ),
    "result": Move(EnterResult, _result, _last_words),
    "score": Move(
        EnterScore,
        lambda state, asked, _: [moves.score(state, asked.match, asked.score)],
        lambda _, after, asked: [live_words(after, moves.known_match(after, asked.match))],
    ),
    "correct": Move(Correct, _correct, _last_words),
    "stand": Move(Stand, lambda state, asked, _: settling.stand(state, asked.match), _stand_words),
    "change": Move(Change, _change, _change_words),
    "undo": Move(Undo, lambda state, asked, _: undoing.undo(state, asked.entry), _undo_words),
    "late": Move(
        LetIn,
        _late,
        lambda _, after, asked: [entry_words(after, name_in(asked.player))],
        _rating_doubts,
    ),
    "edit": Move(Edit, _edit, _edit_words, _rating_doubts),
    "drop": Move(
        Drop,
        lambda state, asked, _: [moves.drop(state, asked.player)],
        lambda before, after, _: forfeited(before, after),
        would=would_words,
    ),
    "forfeit": Move(
        Forfeit,
        lambda state, asked, _: [moves.forfeit(state, asked.player, asked.match)],
        _last_words,
        would=would_words,
    ),
    "redo": Move(Redo, lambda state, asked, _: undoing.redo(state, asked.entry), _redone_words),
    "swap-tables": Move(
        SwapTables,
        lambda state, asked, _: tables.swap_tables(state, asked.one, asked.other),
        lambda before, after, _: called_words(before, after),
    ),
    "wait": Move(Wait, _wait, _said),
    "rename": Move(
        Rename,
        lambda state, asked, _: [roster.rename(state, asked.player, name_in(asked.to))],
        _said,
    ),
    "substitute": Move(Substitute, _substitute, _said, _rating_doubts),
    "swap": Move(Swap, lambda state, asked, _: [roster.swap(state, asked.one, asked.other)], _said),
    "check-in": Move(CheckIn, _check_in, _said),
    "accept": Move(
        Accept,
        lambda state, asked, _: [roster.accept(state, asked.name, unrated=asked.unrated)],
        lambda _, after, asked: [entry_words(after, asked.name)],
    ),
    "decline": Move(Decline, lambda state, asked, _: [roster.decline(state, asked.name)], _said),
    "tiebreak": Move(
        TieBreak,
        lambda state, asked, _: [_tie_break(state, asked).ranked],
        lambda before, _, asked: tie_words(_tie_break(before, asked)),
    ),
}
"""Each move by the name of its command and its form."""
