"""The programs that may enter something tonight: their tokens, and what each may do."""

from __future__ import annotations

from collections.abc import Collection

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.errors import InputError
from evenbreak.files.store.tokens import DIRECTOR, SCORES, Token, at_table
from evenbreak.tournaments.evening.events import Plan
from evenbreak.words import Parameter, Sentence, say, say_count

_SCORES = say("scores, results and calls")
_DIRECTOR = say("everything a director can do")


def scopes(plan: Plan) -> dict[str, Sentence]:
    """Return what a token can be for, each in words."""
    tables = range(1, plan.tables + 1)
    one = {at_table(n): say("only table {table}", table=plan.table_name(n)) for n in tables}
    return {SCORES: _SCORES, **one, DIRECTOR: _DIRECTOR}


def scope_in(text: str, plan: Plan) -> str:
    """Return a token's scope as typed, with the venue's name for a table.

    >>> scope_in("table:TV", Plan("single", 5, tables=3, labels=("1", "2", "TV")))
    'table:3'
    """
    kind, _, table = text.strip().partition(":")
    if kind.lower() == "table" and table:
        return at_table(plan.table_number(table))
    if text.strip() not in (SCORES, DIRECTOR):
        raise InputError(
            "{may} must be scores, a table such as table:4, or director; you gave {value!r}",
            may=Parameter("may"),
            value=text,
        )
    return text.strip()


def scope_words(token: Token, plan: Plan) -> Sentence:
    """Return a token's scope in words."""
    table = {"table": plan.table_name(token.table or 1)}
    return scopes(plan).get(token.scope, say("only table {table}", **table))


def programs_answer(tokens: Collection[Token], plan: Plan, created: str = "") -> Answer:
    """Return the answer: the programs, and the newly created token."""
    count = len(tokens)
    said = [say_count("1 program can make entries.", "{n} programs can make entries.", count)]
    if not tokens:
        said = [say("No program can make entries.")]
    elif created:
        said = [say("The token, which is not shown again: {token}", token=created)]
    columns = columns_of("program may_enter created_at last_entry")
    rows = [
        (one.name, scope_words(one, plan), _minute(one.created), _minute(one.used))
        for one in tokens
    ]
    table = Table("programs", columns, rows)
    parts: list[Part] = [*said, *([table] if tokens else [])]
    data = {"token": created} if created else {}
    return Answer(say("Other apps"), parts, data=data, csv=table)


def _minute(at: str) -> str | None:
    """Return a time without its seconds."""
    return at[:16].replace("T", " ") or None
