"""The API's error responses: problem details (RFC 9457) in JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from http import HTTPStatus
from typing import Annotated, Any

import msgspec
from msgspec import Meta
from starlette.requests import Request
from starlette.responses import Response

from evenbreak.errors import EvenbreakError
from evenbreak.files.catalogs import language_of
from evenbreak.questions.moves import COMMANDS
from evenbreak.web.guard import ROOT, RefusalError
from evenbreak.web.page import page_face, without_folder
from evenbreak.words import Face, Parameter, Sentence, capital_in_face, in_face


@dataclass(frozen=True)
class Lost:
    """A match that would leave its table, or a result that would no longer count."""

    match: Annotated[str, Meta(description="The match's number.")]
    players: tuple[str, str]
    table: Annotated[str | None, Meta(description="The table the match would leave.")]
    score: Annotated[
        tuple[int, int] | None, Meta(description="The score so far, or the final score.")
    ]
    result: Annotated[
        bool, Meta(description="Whether the match has a result, which would no longer count.")
    ]


@dataclass(frozen=True)
class Problem:
    """Why a request is rejected, in the language it asks for (Accept-Language)."""

    title: Annotated[str, Meta(description="HTTP's name for the status.", examples=["Bad Request"])]
    status: Annotated[int, Meta(description="The HTTP status.", ge=400, le=599)]
    detail: Annotated[str, Meta(description="What is wrong and how to correct it.")]
    parameter: Annotated[
        str, Meta(description="The parameter that is wrong, if the problem is a parameter.")
    ] = ""
    how: Annotated[
        dict[str, Any], Meta(description="What to add to the request to have it entered anyway.")
    ] = field(default_factory=dict)
    score: Annotated[
        tuple[int, int] | None, Meta(description="The current score, if it differs from `seen`.")
    ] = None
    lost: Annotated[
        list[Lost], Meta(description="What would be lost, if you have to confirm that first.")
    ] = field(default_factory=list)
    schema: Annotated[
        dict[str, Any], Meta(description="The JSON schema of the expected value.")
    ] = field(default_factory=dict)


class ProblemError(RefusalError):
    """A rejected API request: like a `RefusalError`, with the parameter's name.

    `more` is additional content for the answer, such as `how` or what would be lost.
    """

    def __init__(
        self,
        template: str,
        /,
        *,
        status: int = 400,
        parameter: str = "",
        more: Mapping[str, Any] | None = None,
        headers: Mapping[str, str] | None = None,
        **values: Any,
    ) -> None:
        super().__init__(template, status=status, **values)
        self.parameter = parameter
        self.more = more or {}
        self.headers = headers or {}


def is_asked(request: Request) -> bool:
    """Return whether a request is for the API."""
    return f"{request.url.path}/".startswith(f"{ROOT}/")


def problem(
    request: Request, why: Exception, status: int, headers: Mapping[str, str] | None = None
) -> Response:
    """Return why a request is rejected."""
    face = face_of(request)
    text = why.sentence if isinstance(why, EvenbreakError) else str(why)
    found = {
        "title": HTTPStatus(status).phrase,
        "status": status,
        "detail": without_folder(request, in_full(text, face)),
    }
    field = why.sentence.values.get("field") if isinstance(why, EvenbreakError) else None
    wrong = getattr(why, "parameter", "") or (str(field) if isinstance(field, Parameter) else "")
    found |= {"parameter": wrong} if wrong else {}
    if isinstance(why, ProblemError):
        found |= why.more
        headers = {**(headers or {}), **why.headers}
    head = {"content-language": face.language, **(headers or {})}
    return Response(encoded(found, face), status, head, media_type="application/problem+json")


def face_of(request: Request) -> Face:
    """Return how sentences are phrased for programs, with parameters and addresses."""
    plain = page_face(language_of(request.headers.get("accept-language", "")))

    def command(name: str, words: Sequence[str]) -> str:
        move = name.removeprefix("tournament ")
        return f"POST {ROOT}/v1/tonight/{move}" if move in COMMANDS else plain.command(name, words)

    return replace(plain, parameter=str, command=command)


def in_full(text: str, face: Face) -> str:
    """Return a message with its capital letter and period.

    >>> from evenbreak.words import PYTHON, say
    >>> in_full(say("there is no entry {entry}", entry=9), PYTHON)
    'There is no entry 9.'
    """
    said = capital_in_face(text, face)
    return said if said.endswith((".", "!", "?")) else f"{said}."


def encoded(value: Any, face: Face) -> bytes:
    """Return a value as JSON, with its sentences in the output format's language.

    >>> from evenbreak.words import PYTHON, say
    >>> encoded({"title": say("Round {n}", n=2)}, PYTHON)
    b'{"title":"Round 2"}'
    """

    def plain(value: Any) -> Any:
        if isinstance(value, Sentence):
            return str(in_face(value, face))
        if hasattr(value, "tolist"):
            return value.tolist()
        raise NotImplementedError(type(value).__name__)

    return msgspec.json.encode(value, enc_hook=plain)
