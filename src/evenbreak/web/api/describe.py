"""The API's description in OpenAPI 3.1, generated from its resources."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import msgspec

from evenbreak import __version__
from evenbreak.fields.question import Declared
from evenbreak.web.api.problem import Problem
from evenbreak.web.api.resource import V1, Resource

_TEMPLATE = "#/components/schemas/{name}"
_BEARER = "token"
_TAGS = {
    "tonight": "Tonight's tournament, as everyone in the room sees it.",
    "enter": "Entries that a program makes with a token created by the director.",
    "questions": "The answers of commands such as `evenbreak odds`.",
    "interface": "The interface itself.",
}
_REFUSALS = {
    400: "A parameter is wrong, missing or unknown.",
    401: "The token is missing, or it has been revoked.",
    403: "The token doesn't allow this.",
    404: "What you asked for doesn't exist, or doesn't exist yet.",
    409: "The entry would undo something else, or something else was entered in the meantime.",
    413: "More was sent than is allowed.",
    415: "The body is not JSON.",
    422: "This Idempotency-Key was already used for a different request.",
    429: "Too many requests came from this address within a minute.",
    503: "Too many requests are already waiting; Retry-After tells you when to try again.",
}


def describe(resources: Sequence[Resource]) -> dict[str, Any]:
    """Return the OpenAPI document for some addresses."""
    kinds = [Problem, *(one.gives for one in resources if _is_typed(one.gives))]
    _, components = msgspec.json.schema_components(kinds, ref_template=_TEMPLATE)
    paths: dict[str, dict[str, Any]] = {}
    for one in resources:
        paths.setdefault(V1 + one.path, {})[one.method.lower()] = _operation(one)
    return {
        "openapi": "3.1.0",
        "info": {
            "title": "evenbreak",
            "version": __version__,
            "summary": "Tonight's tournament, and answers to questions, for other programs.",
            "description": "Within a version of the address (v1), names may be added but are "
            "never changed or removed. Times are local, in ISO 8601 format "
            "without a time zone; chances run from 0 to 1. Sentences are in the "
            "language that Accept-Language asks for.",
            "license": {"name": "MIT", "identifier": "MIT"},
        },
        "servers": [{"url": "/", "description": "The computer that runs the tournament."}],
        "tags": [{"name": name, "description": does} for name, does in _TAGS.items()],
        "paths": paths,
        "components": {
            "schemas": open_to_more(components),
            "securitySchemes": {
                _BEARER: {
                    "type": "http",
                    "scheme": "bearer",
                    "description": "Created by the director, for scores only or for everything.",
                }
            },
        },
    }


def open_to_more(schema: Any) -> Any:
    """Return an answer's schema in a form for client generators, with room for new words.

    A client that knows only today's words must not fail on a new one.

    >>> open_to_more({"enum": ["free", "playing"]})["examples"]
    ['free', 'playing']
    """
    if isinstance(schema, list):
        return [open_to_more(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    found = {key: open_to_more(one) for key, one in schema.items()}
    if words := found.pop("enum", None):
        found |= {"type": "string", "examples": words}
    if "prefixItems" in found:
        each = found.pop("prefixItems")
        same = all(one == each[0] for one in each)
        found["items"] = each[0] if same else {"anyOf": each}
    return found


def operation_id(resource: Resource) -> str:
    """Return a resource's name in programs, such as get_tonight_bracket."""
    words = re.findall(r"\w+", resource.path.replace("-", "_").removesuffix(".json"))
    return "_".join([resource.method.lower(), *words])


def _is_typed(gives: Any) -> bool:
    return not isinstance(gives, Mapping)


def _tag(resource: Resource) -> str:
    if resource.method != "GET" and resource.path.startswith("/tonight"):
        return "enter"
    if resource.path.startswith("/tonight"):
        return "tonight"
    return "questions" if resource.method != "GET" else "interface"


def _operation(one: Resource) -> dict[str, Any]:
    found: dict[str, Any] = {
        "operationId": operation_id(one),
        "summary": one.does,
        "tags": [_tag(one)],
        "parameters": list(_parameters(one)),
        "responses": _responses(one),
    }
    if one.method != "GET":
        found["requestBody"] = {
            "required": any(asked.required for asked in one.body),
            "content": {"application/json": {"schema": body_schema(one.body)}},
        }
    if one.scope:
        found["security"] = [{_BEARER: [one.scope]}]
    return {key: value for key, value in found.items() if value != []}


def _parameters(one: Resource) -> Iterator[dict[str, Any]]:
    for asked in one.query:
        schema = asked.schema()
        says = schema.pop("description")
        required = asked.required
        yield {"name": asked.name, "in": "query", "description": says, "required": required} | {
            "schema": schema
        }
    if one.scope:
        yield {
            "name": "Idempotency-Key",
            "in": "header",
            "description": "A key chosen by the program, so that repeating a request doesn't "
            "enter anything twice.",
            "schema": {"type": "string", "minLength": 1, "maxLength": 200},
        }
    if one.method == "GET" and not one.streams:
        yield {
            "name": "If-None-Match",
            "in": "header",
            "description": "The ETag of the last answer; as long as nothing has changed, the "
            "answer is 304.",
            "schema": {"type": "string"},
        }


def body_schema(asks: Sequence[Declared]) -> dict[str, Any]:
    """Return a body's schema."""
    required = [one.name for one in asks if one.required]
    return {
        "type": "object",
        "properties": {one.name: one.schema() for one in asks},
        "additionalProperties": False,
    } | ({"required": required} if required else {})


def _responses(one: Resource) -> dict[str, Any]:
    found: dict[str, Any] = {
        "200": {
            "description": one.does,
            "content": {_media(one): {"schema": schema_of_answer(one)}},
        }
    }
    refusals = {400, 404} if one.query else set()
    if one.method == "GET" and not one.streams:
        found["304"] = {"description": "Nothing has changed since."}
        found["200"]["headers"] = {"ETag": {"schema": {"type": "string"}}}
    elif one.method != "GET":
        refusals |= {400, 413, 415, 429}
    if _tag(one) == "questions":
        refusals.add(503)
    if one.scope:
        refusals |= {401, 403, 409, 422}
    said = {"application/problem+json": {"schema": {"$ref": _TEMPLATE.format(name="Problem")}}}
    for status in sorted(refusals):
        found[str(status)] = {"description": _REFUSALS[status], "content": said}
    return found


def _media(one: Resource) -> str:
    return "text/event-stream" if one.streams else "application/json"


def schema_of_answer(one: Resource) -> dict[str, Any]:
    """Return the schema of a resource's answer; dataclasses are named in the components."""
    if not _is_typed(one.gives):
        return dict(one.gives)
    (schema,), _ = msgspec.json.schema_components([one.gives], ref_template=_TEMPLATE)
    return schema
