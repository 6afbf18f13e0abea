"""The API for other programs: its addresses, under /api/v1, and their description."""

from __future__ import annotations

from functools import cache
from typing import Any

from evenbreak.web.api import ask, read, stream, write
from evenbreak.web.api.describe import describe
from evenbreak.web.api.resource import Call, Kept, Resource, routes_of


@cache
def description() -> dict[str, Any]:
    """Return the API's OpenAPI document."""
    return describe(RESOURCES)


async def _description(_: Call) -> Kept:
    return Kept(("description",), description)


RESOURCES = [
    *read.RESOURCES,
    *write.RESOURCES,
    *stream.RESOURCES,
    *ask.RESOURCES,
    Resource(
        "/openapi.json", "This description of the interface.", _description, {"type": "object"}
    ),
]
"""Every address of the API."""

ROUTES = routes_of(RESOURCES)
