"""The commands that enter something in the tournament under way: one for each move."""

from __future__ import annotations

import secrets
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.tournament.evening import add, answer_of, moment
from evenbreak.fields.question import declared
from evenbreak.questions.evening import TimedUnderWay
from evenbreak.questions.moves import COMMANDS, PLAYER

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.fold import Evening


def _command(name: str, question: type[TimedUnderWay]) -> click.Command:
    def enter(asked: Any) -> Answer:
        from evenbreak.answers.tournament.move_table import MOVES

        move = MOVES[name]
        if getattr(asked, "seed", 0) is None:  # so that it draws and says the same
            asked = replace(asked, seed=secrets.randbelow(2**32))
        at = moment(asked.at, asked.path)
        before, after = add(asked, lambda state: move.decide(state, _in_full(asked, state), at))
        answer = answer_of(asked, after, move.said(before, after, asked))
        return replace(answer, warnings=[*move.doubts(before, after, asked), *answer.warnings])

    return command_of(question, name)(enter)


def _in_full(asked: Any, state: Evening) -> Any:
    """Return what is asked with the players' names in full, of which the beginning was typed."""
    from evenbreak.tournaments.evening.moves import known_player

    question: Any = type(asked)
    names = [one.name for one in declared(question) if one.kind == PLAYER]
    typed = {name: getattr(asked, name) for name in names if getattr(asked, name)}

    def full(text: Any) -> Any:
        return known_player(state, text) if isinstance(text, str) else tuple(map(full, text))

    return replace(asked, **{name: full(text) for name, text in typed.items()})


def __getattr__(name: str) -> click.Command:
    """Return the command of a move."""
    if name not in COMMANDS:
        raise AttributeError(name)
    return _command(name, COMMANDS[name][0])
