"""Other programs' questions: `POST /api/v1/odds` returns what `evenbreak odds --json` prints.

These are the questions in the table of answers, with the fields that other computers may set: none
of these names a file on this computer, or code. They are calculated one at a time, in the
background.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import Any, NoReturn

from starlette.responses import Response

from evenbreak.answers.asked import ASKED, answer_to, question_of, schemas
from evenbreak.answers.faces.to_json import to_json
from evenbreak.answers.kit.patience import told
from evenbreak.errors import InputError
from evenbreak.fields.question import declared, from_afar
from evenbreak.web.api.problem import ProblemError
from evenbreak.web.api.resource import Call, Resource
from evenbreak.web.beside import Limited
from evenbreak.web.sessions import address_of
from evenbreak.words import say

MOST_SECONDS = 5.0
"""Processor time for one question."""
MOST_WAITING = 8
"""The most questions that can be waiting for their answers."""
MOST_OF_ONE = 2
"""How many of these can come from one address."""


async def _answered(command: str, call: Call) -> Response:
    """Return the answer to a question, as the command prints it."""
    site, address = call.site, address_of(call.request)
    if site.questions.full(address):
        raise ProblemError(
            "Too many questions. Wait a minute.", status=429, headers={"retry-after": "60"}
        )
    waiting = site.asked.waiting
    if len(waiting) >= MOST_WAITING or waiting.count(address) >= MOST_OF_ONE:
        raise ProblemError(
            "Too many questions are waiting. Try again in a moment.",
            status=503,
            headers={"retry-after": "5"},
        )
    site.questions.count(address)
    work = partial(answer_in_json, command, call.values)
    try:
        body = await site.asked.run(Limited(work, MOST_SECONDS), address)
    except TimeoutError:
        _refuse(say("This takes longer than {n:.0f} seconds", n=MOST_SECONDS))
    return Response(body, media_type="application/json")


def answer_in_json(command: str, values: dict[str, Any]) -> bytes:
    r"""Return the answer to a question, as `--json` prints it; reject long calculations.

    >>> answer_in_json("odds", {"p": 0.6, "race": (7, 5)})[:19]
    b'{\n  "p_game_a": 0.6'
    """
    try:
        with told(_refuse):
            return to_json(answer_to(command, question_of(command)(**values))).encode()
    except (MemoryError, OverflowError, RecursionError):
        raise InputError("The numbers in this question are too large. Ask for less.") from None


def _refuse(why: str) -> NoReturn:
    raise InputError("{why}. Ask for less, or run the command on your own computer.", why=why)


def _resources() -> Iterator[Resource]:
    for command in ASKED:
        question = question_of(command)
        asks = from_afar(question)
        if {one.name for one in declared(question) if one.required} <= {one.name for one in asks}:
            yield Resource(
                "/" + command.replace(" ", "/"),
                (question.__doc__ or "").partition("\n")[0],
                partial(_answered, command),
                schemas()[command],
                "POST",
                asks,
            )


RESOURCES = list(_resources())
