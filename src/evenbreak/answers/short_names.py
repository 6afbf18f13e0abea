"""Names as they are written where there is little room."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable


def short_names(names: Iterable[str]) -> dict[str, str]:
    """Return the short form of each name that has one: first initial and last name.

    A form that two players would share is nobody's.

    >>> short_names(["Maximiliane Ndiaye-Roy", "Jean-Luc van Dam", "Ann Lee", "Al Lee", "Bo"])
    {'Jean-Luc van Dam': 'J.-L. van Dam', 'Maximiliane Ndiaye-Roy': 'M. Ndiaye-Roy'}
    """
    distinct = set(names)
    short = {name: _short(name) for name in sorted(distinct)}
    taken = Counter(short.values())
    return {
        name: form
        for name, form in short.items()
        if len(form) < len(name) and taken[form] == 1 and form not in distinct
    }


def _short(name: str) -> str:
    first, _, rest = name.partition(" ")
    parts = [part for part in first.split("-") if part]
    if not rest or not all(part[0].isalpha() for part in parts):
        return name
    return f"{'-'.join(f'{part[0]}.' for part in parts)} {rest}"
