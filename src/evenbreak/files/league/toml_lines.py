"""The line of each key in a TOML file, which Python's reader doesn't report."""

from __future__ import annotations

import tomllib
from collections import Counter
from collections.abc import Iterator
from typing import Any, TypeAlias

Keys: TypeAlias = tuple[str | int, ...]
"""The keys that lead to a value: ("results", 0, "file")."""


def lines_of(text: str) -> dict[Keys, int]:
    r"""Return the line where each table and key starts, in a valid file.

    >>> lines_of("tables = 6\n[team]\ncap = 23\n[[results]]\n")
    {('tables',): 1, ('team',): 2, ('team', 'cap'): 3, ('results', 0): 4, ('results',): 4}
    """
    lines: dict[Keys, int] = {}
    many: Counter[Keys] = Counter()
    here: Keys = ()
    statement: list[str] = []
    for number, line in enumerate(text.split("\n"), 1):
        statement.append(line.removesuffix("\r"))
        try:
            part = tomllib.loads("\n".join(statement))
        except tomllib.TOMLDecodeError:  # it goes on in the next line
            continue
        start = number - len(statement) + 1
        is_head = statement[0].lstrip().startswith("[")
        statement = []
        if is_head:
            here = _head(part, many)
            lines.setdefault(here, start)
            if here and isinstance(here[-1], int):
                lines.setdefault(here[:-1], start)
        else:
            for key in _keys_in(part):
                lines.setdefault((*here, *key), start)
    return lines


def _head(part: Any, many: Counter[Keys]) -> Keys:
    """Return the keys in a table's header; `many` counts the tables in each array of tables."""
    here: Keys = ()
    while part:
        key, part = next(iter(part.items()))
        here = (*here, key)
        if isinstance(part, list):
            many[here] += 1
            here, part = (*here, many[here] - 1), part[0]
        elif many[here]:  # a table of the last one, such as [results.columns]
            here = (*here, many[here] - 1)
    return here


def _keys_in(part: Any) -> Iterator[Keys]:
    """Yield the keys that lead to a table and to each value in it."""
    if isinstance(part, dict):
        for key, inner in part.items():
            yield (key,)
            yield from ((key, *more) for more in _keys_in(inner))
