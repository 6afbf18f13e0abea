"""The commands that enter something in the tournament under way."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.said import refuse
from evenbreak.cli.tournament.evening import add, answer_of, moment
from evenbreak.questions import evening as questions

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.events import Called, CalledBack, Late, Ranked, Result
    from evenbreak.tournaments.evening.fold import Evening


@command_of(questions.MakeDraw, "draw")
def draw(asked: questions.MakeDraw) -> Answer:
    """Make the draw."""
    import numpy as np

    from evenbreak.answers.tournament.moves import draw_words
    from evenbreak.tournaments.evening import moves

    rng = np.random.default_rng(asked.seed)
    before, state = add(asked, lambda state: moves.draw_next(state, rng))
    return answer_of(asked, state, [draw_words(before, state)])


@command_of(questions.Call, "call")
def call(asked: questions.Call) -> Answer:
    """Call matches to tables."""
    from evenbreak.answers.tournament.night import next_calls
    from evenbreak.tournaments.evening import moves
    from evenbreak.tournaments.evening.outlook import Outlook

    match = asked.match

    def decide(state: Evening) -> Sequence[Called | CalledBack]:
        if state.plan.form == "chips":
            refuse(
                "a chip tournament needs no calls: each result brings the next in the line to the "
                "table; see evenbreak tournament next"
            )
        if match is not None:
            if asked.back:
                return [moves.call_back(state, match)]
            return [moves.call(state, match, asked.table)]
        outlook = Outlook(state, moment(asked.at, asked.path))
        called = [moves.call(state, name, table) for table, name in next_calls(outlook)]
        if not called:
            refuse("no match can be called: no table is free, or no match is ready")
        return called

    before, state = add(asked, decide)
    said = [
        f"Table {playing.call.table}: {name}, {' against '.join(playing.call.players)}."
        for name, playing in state.on_tables.items()
        if before.on_tables.get(name) != playing
    ]
    said += [
        f"{name} is off table {playing.call.table}."
        for name, playing in before.on_tables.items()
        if name not in state.on_tables
    ]
    return answer_of(asked, state, said)


@command_of(questions.EnterResult, "result")
def result(asked: questions.EnterResult) -> Answer:
    """Enter the result of a match."""
    from evenbreak.tournaments.evening import moves

    return _played(asked, lambda state: moves.result(state, asked.match, asked.score))


def _played(asked: questions.TimedUnderWay, decide: Callable[[Evening], Result]) -> Answer:
    """Enter a result, and say what follows from it."""
    from evenbreak.answers.tournament.moves import happened

    before, state = add(asked, lambda state: [decide(state)])
    return answer_of(asked, state, happened(before, state, state.events[-1]))


@command_of(questions.EnterScore, "score")
def score(asked: questions.EnterScore) -> Answer:
    """Enter the score of a match in play."""
    from evenbreak.tournaments.evening import moves

    _, state = add(asked, lambda state: [moves.score(state, asked.match, asked.score)])
    name = moves.known_match(state, asked.match)
    (first, second), (games_1, games_2) = state.pair(name), asked.score
    return answer_of(asked, state, [f"{name}: {first} {games_1}, {second} {games_2}."])


@command_of(questions.Correct, "correct")
def correct(asked: questions.Correct) -> Answer:
    """Correct the result of a match."""
    from evenbreak.tournaments.evening import moves

    return _played(asked, lambda state: moves.correct(state, asked.match, asked.score))


@command_of(questions.Stand, "stand")
def stand(asked: questions.Stand) -> Answer:
    """Let a match stand that the wrong player has played."""
    from evenbreak.answers.tournament.moves import reopened, settled_words
    from evenbreak.tournaments.evening import settling

    before, state = add(asked, lambda state: settling.stand(state, asked.match))
    return answer_of(asked, state, [*settled_words(before, state), *reopened(before, state)])


@command_of(questions.Change, "change")
def change(asked: questions.Change) -> Answer:
    """Change the tables, or the races to come."""
    from evenbreak.tournaments.evening import moves

    names = ("tables", "race", "losers_race", "final_race")
    changes = {name: getattr(asked, name) for name in names}
    _, state = add(asked, lambda state: [moves.change(state, **changes)])
    return answer_of(asked, state)


@command_of(questions.Undo, "undo")
def undo(asked: questions.Undo) -> Answer:
    """Take back the last entry."""
    from evenbreak.answers.tournament.moves import reopened, undone_words
    from evenbreak.tournaments.evening import undoing

    before, state = add(asked, lambda state: [undoing.undo(state, asked.entry)])
    events = dict(zip(before.numbers, before.events, strict=True))
    (gone,) = events.keys() - set(state.numbers)
    said = [undone_words(events[gone].what), *reopened(before, state)]
    return answer_of(asked, state, said)


@command_of(questions.LetIn, "late")
def late(asked: questions.LetIn) -> Answer:
    """Let a late player in."""
    from evenbreak.answers.kit.scales import far_doubts
    from evenbreak.answers.tournament.moves import entry_words
    from evenbreak.files.tables.names import NAME, clean_name, is_name
    from evenbreak.tournaments.evening import moves
    from evenbreak.tournaments.evening.events import Entrant

    name, rating = clean_name(asked.player), asked.rating
    if not is_name(name):
        refuse(f"{asked.player!r} is not {NAME}")

    def decide(state: Evening) -> list[Late]:
        entrant = state.plan.newcomer(name) if rating is None else Entrant(name, rating)
        return [moves.late(state, entrant)]

    before, state = add(asked, decide)
    answer = answer_of(asked, state, [entry_words(state, name)])
    ratings = [entrant.rating for entrant in before.entrants.values()]
    if rating is None or far_doubts(state.scale, ratings):
        return answer
    doubts = far_doubts(state.scale, [*ratings, rating])
    return replace(answer, warnings=[*doubts, *answer.warnings])


@command_of(questions.Edit, "edit")
def edit(asked: questions.Edit) -> Answer:
    """Correct a name or a rating before the draw."""
    from evenbreak.files.tables.names import NAME, clean_name, is_name
    from evenbreak.tournaments.evening import moves

    right = clean_name(asked.name)
    if asked.name and not is_name(right):
        asked.refuse("{name}: {typed!r} is not {what}", typed=asked.name, what=NAME)

    before, state = add(
        asked,
        lambda state: [
            moves.edit(
                state, moves.known_player(state, asked.player), name=right, rating=asked.rating
            )
        ],
    )
    (now,) = set(state.entrants.values()) - set(before.entrants.values())
    return answer_of(asked, state, [f"{now.name} is entered with a rating of {now.rating:g}."])


@command_of(questions.Drop, "drop")
def drop(asked: questions.Drop) -> Answer:
    """Let a player go home."""
    from evenbreak.answers.tournament.moves import forfeited
    from evenbreak.tournaments.evening import moves

    before, state = add(
        asked, lambda state: [moves.drop(state, moves.known_player(state, asked.player))]
    )
    return answer_of(asked, state, forfeited(before, state))


@command_of(questions.Forfeit, "forfeit")
def forfeit(asked: questions.Forfeit) -> Answer:
    """Let a player forfeit a match."""
    from evenbreak.tournaments.evening import moves

    return _played(
        asked,
        lambda state: moves.forfeit(state, moves.known_player(state, asked.player), asked.match),
    )


@command_of(questions.TieBreak, "tiebreak")
def tiebreak(asked: questions.TieBreak) -> Answer:
    """Break the ties of a round robin."""
    import numpy as np

    from evenbreak.answers.tournament.moves import tie_words
    from evenbreak.tournaments.evening.settling import TieBreak, break_ties

    broken: list[TieBreak] = []
    rng = np.random.default_rng(asked.seed)

    def decide(state: Evening) -> list[Ranked]:
        broken.append(break_ties(state, rng, only_lots=asked.lot))
        return [broken[-1].ranked]

    _, state = add(asked, decide)
    return answer_of(asked, state, tie_words(broken[-1]))
