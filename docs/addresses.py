"""The table of addresses in `reference/interface.md`, made from the interface's own list.

The build of the pages puts it where the mark `<!-- addresses -->` stands.
"""

from __future__ import annotations

from evenbreak.web.api import RESOURCES
from evenbreak.web.api.resource import V1, Resource

MARK = "<!-- addresses -->"
_WHO = {"": "everyone in the room", "scores": "a token", "director": "a director's token"}


def table() -> str:
    """Return the table of all addresses."""
    lines = ["| address | what it does | parameters | for |", "|---|---|---|---|"]
    return "\n".join([*lines, *map(_row, RESOURCES), ""])


def _row(one: Resource) -> str:
    names = ", ".join(f"`{asked.name}`" for asked in one.asks if asked.name != "event")
    if one.method == "POST" and not one.scope:
        names = (
            f"[as the command](commands.md): `evenbreak {one.path[1:].replace('/', ' ')} --help`"
        )
    return f"| `{one.method} {V1}{one.path}` | {one.does} | {names} | {_WHO[one.scope]} |"


def with_tables(text: str) -> str:
    """Return a page with its table."""
    return text.replace(MARK, table())
