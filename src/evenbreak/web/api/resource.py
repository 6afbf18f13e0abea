"""The API's addresses: their parameters, and how answers are sent.

An answer is encoded as JSON, with sentences in the language of Accept-Language. Its ETag is a hash
of its body: a client that sends it back as If-None-Match gets 304 while nothing has changed.
"""

from __future__ import annotations

import hashlib
from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Flag, Whole
from evenbreak.fields.question import Declared, Field
from evenbreak.web.api.body import object_in
from evenbreak.web.api.problem import ProblemError, encoded, face_of
from evenbreak.web.api.tokens import check_token
from evenbreak.web.guard import ROOT
from evenbreak.web.page import site_of
from evenbreak.web.site import Site
from evenbreak.words import say

V1 = f"{ROOT}/v1"
"""The prefix of this version's addresses."""

MOST_JSON = 64 << 10
"""The largest JSON body, in bytes."""

EVENT = Declared(
    "event",
    Field(
        Whole(1, 99),
        "The event's number, on a night with several events.",
        usual="the first event; for the queue, all events",
    ),
    None,
)
"""In the address even if the other parameters are in the body."""
_MOST_KEPT = 100
_SHOWN = 40  # characters of a wrong value that a problem repeats


class Call(NamedTuple):
    """An incoming request, with its values checked and defaults filled in."""

    request: Request
    site: Site
    values: dict[str, Any]


@dataclass(frozen=True)
class Resource:
    """An API address: its parameters, its answer, who may ask.

    `path` is below /api/v1; `does` is its summary in OpenAPI and in the reference; `answer` returns
    a value that JSON can hold, a `Kept`, or a whole `Response`, described by `gives`, a frozen
    dataclass or a JSON schema. `asks` are the parameters in the address (GET, and `EVENT`), or in
    the JSON body (POST). The scope is "" for everyone on the network, and "scores" or "director"
    for programs with a token.
    """

    path: str
    does: str
    answer: Callable[[Call], Awaitable[Any]]
    gives: Any
    method: str = "GET"
    asks: tuple[Declared, ...] = ()
    scope: str = ""
    streams: bool = False

    @property
    def query(self) -> tuple[Declared, ...]:
        """The parameters in the address."""
        return tuple(one for one in self.asks if self.method == "GET" or one is EVENT)

    @property
    def body(self) -> tuple[Declared, ...]:
        """The parameters in the JSON body."""
        return tuple(one for one in self.asks if one not in self.query)


class Kept(NamedTuple):
    """An answer made once for all clients, as long as the objects in `of` are the same."""

    of: Sequence[object]
    make: Callable[[], Any]


def routes_of(resources: Sequence[Resource]) -> list[Route]:
    """Return routes for addresses, one per path."""
    paths: dict[str, dict[str, Resource]] = {}
    for one in resources:
        paths.setdefault(one.path, {})[one.method] = one
    return [_route(path, methods) for path, methods in paths.items()]


def _route(path: str, methods: Mapping[str, Resource]) -> Route:
    heads = {"HEAD"} if "GET" in methods else set()
    allowed = ", ".join(sorted({*methods, *heads, "OPTIONS"}))

    async def endpoint(request: Request) -> Response:
        if request.method == "OPTIONS":
            return Response(status_code=204, headers={"allow": allowed})
        asked = "GET" if request.method == "HEAD" else request.method
        return await _answer(methods[asked], request)

    return Route(V1 + path, endpoint, methods=[*methods, "OPTIONS"])


async def _answer(resource: Resource, request: Request) -> Response:
    if resource.scope:  # before anything else is looked at
        await check_token(request, resource.path.rpartition("/")[2])
    values = queried(resource.query, request)
    if resource.method != "GET":
        values |= loaded(resource.body, await body_of(request))
    found = await resource.answer(Call(request, site_of(request), values))
    if isinstance(found, Response):
        return found
    face = face_of(request)
    if not isinstance(found, Kept):
        return _sent(request, _tagged(encoded(found, face)), face.language)
    kept = site_of(request).rendered_of(found.of)
    key = (resource.path, face.language, *((name, repr(one)) for name, one in values.items()))
    tagged = kept.get(key) or _tagged(encoded(found.make(), face))
    if len(kept) < _MOST_KEPT:  # addresses may be made up without end
        kept[key] = tagged
    return _sent(request, tagged, face.language)


def _tagged(body: bytes) -> tuple[bytes, str]:
    """Return a body and its ETag: a weak one, because the body may be sent compressed."""
    return body, f'W/"{hashlib.sha256(body).hexdigest()[:16]}"'


def _sent(request: Request, tagged: tuple[bytes, str], language: str) -> Response:
    body, tag = tagged
    head = {"content-language": language, "vary": "Accept-Language"}
    if request.method not in ("GET", "HEAD"):
        return Response(body, headers=head, media_type="application/json")
    head |= {"etag": tag, "cache-control": "no-cache"}
    known = [one.strip() for one in request.headers.get("if-none-match", "").split(",")]
    if "*" in known or tag.removeprefix("W/") in (one.removeprefix("W/") for one in known):
        return Response(status_code=304, headers=head)
    return Response(body, headers=head, media_type="application/json")


async def body_of(request: Request) -> dict[str, Any]:
    """Return the JSON object in a request's body; an empty body is an empty object."""
    kind = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if not kind and not await request.body():
        return {}
    if kind != "application/json":
        raise ProblemError(
            "The body must be JSON. Send it with Content-Type: application/json.", status=415
        )
    body = await request.body()
    if len(body) > MOST_JSON:
        raise ProblemError("More than {most} KB was sent.", status=413, most=MOST_JSON >> 10)
    return object_in(body)


def queried(asks: Sequence[Declared], request: Request) -> dict[str, Any]:
    """Return the parameter values in an address."""
    given = request.query_params
    _check_names(asks, given)
    return {
        one.name: _checked(one, _texts_read, given.getlist(one.name))
        if one.name in given
        else _left_out(one)
        for one in asks
    }


def _texts_read(one: Declared, texts: Sequence[str]) -> Any:
    if one.field.many:
        return tuple(one.kind.read(text) for text in texts)
    if len(texts) > 1:
        raise InputError("it is given {n} times. Give it once.", n=len(texts))
    return one.kind.read(texts[0])


def loaded(asks: Sequence[Declared], body: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameter values in a JSON body."""
    _check_names(asks, body)
    return {
        one.name: _checked(one, Declared.load, body[one.name])
        if one.name in body
        else _left_out(one)
        for one in asks
    }


def _check_names(asks: Sequence[Declared], given: Mapping[str, Any]) -> None:
    names = [one.name for one in asks]
    for name in given:
        if name not in names:
            allowed = ", ".join(names)
            wanted = say("has: {names}", names=allowed) if names else say("has none")
            raise ProblemError(
                "{field!r} isn't a parameter of this address, which {wanted}.",
                parameter=name[:_SHOWN],
                field=name[:_SHOWN],
                wanted=wanted,
            )


def _checked(one: Declared, read: Callable[[Declared, Any], Any], value: Any) -> Any:
    try:
        return read(one, value)
    except InputError as error:
        raise ProblemError(
            "{field!r}: {why}",
            parameter=one.name,
            more={"schema": one.schema()},
            field=one.name,
            why=error.sentence,
        ) from None


def _left_out(one: Declared) -> Any:
    if one.required:
        raise ProblemError(
            "{field!r} is missing.",
            parameter=one.name,
            more={"schema": one.schema()},
            field=one.name,
        )
    return False if isinstance(one.kind, Flag) and one.default is None else one.default
