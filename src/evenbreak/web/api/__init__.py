"""The interface for other programs: its addresses, under /api/v1, and their description."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any

from msgspec import Meta

from evenbreak import __version__
from evenbreak.web.api import ask, read, stream, write
from evenbreak.web.api.describe import describe
from evenbreak.web.api.resource import V1, Call, Kept, Resource, routes_of


@cache
def description() -> dict[str, Any]:
    """Return the OpenAPI document of the interface."""
    return describe(RESOURCES)


@dataclass(frozen=True)
class Address:
    """An address of the interface."""

    method: str
    address: str
    does: str
    scope: Annotated[str, Meta(description="Of the token that it takes; '': none.")]


@dataclass(frozen=True)
class Addresses:
    """All addresses of this version of the interface."""

    evenbreak: Annotated[str, Meta(description="The version of the program.")]
    description: Annotated[str, Meta(description="Where the OpenAPI document is.")]
    addresses: list[Address]


async def _addresses(_: Call) -> Addresses:
    every = [Address(one.method, V1 + one.path, one.does, one.scope) for one in RESOURCES]
    return Addresses(__version__, f"{V1}/openapi.json", every)


async def _description(_: Call) -> Kept:
    return Kept(("description",), description)


RESOURCES = [
    *read.RESOURCES,
    *write.RESOURCES,
    *stream.RESOURCES,
    *ask.RESOURCES,
    Resource("", "The addresses of the interface.", _addresses, Addresses),
    Resource(
        "/openapi.json", "This description of the interface.", _description, {"type": "object"}
    ),
]
"""Every address of the interface."""

ROUTES = routes_of(RESOURCES)
