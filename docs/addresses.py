"""The table of addresses in `reference/interface.md`, made from the interface's own list.

`python docs/addresses.py` (`make option-tables`) writes it between its marks.
"""

from __future__ import annotations

import re
from pathlib import Path

from evenbreak.web.api import RESOURCES
from evenbreak.web.api.resource import V1, Resource

PAGE = Path(__file__).parent / "reference" / "interface.md"
TABLE = re.compile(r"(<!-- addresses -->\n).*?(<!-- end of addresses -->)", re.DOTALL)
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


def with_table(text: str) -> str:
    """Return the page with its table as it is now."""
    return TABLE.sub(lambda mark: mark[1] + table() + mark[2], text)


if __name__ == "__main__":
    PAGE.write_text(with_table(PAGE.read_text("utf-8")), "utf-8")
