"""The header of a table: which of its titles are the columns that a reader asks for."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence

from evenbreak.files.problems import Problems, quoted

MOST_LISTED = 12
"""How many names a message lists."""

_NUMBER = re.compile(r"[+-]?[0-9]+([.,][0-9]+)?", re.ASCII)
"""What stands in a row of values, but hardly in a header."""


class Header:
    """The names by which a reader knows its columns.

    Parameters
    ----------
    required, optional
        for each column its other names.
    instead
        for a required column the sets of columns that can take its place.
    """

    def __init__(
        self,
        required: Mapping[str, Sequence[str]],
        optional: Mapping[str, Sequence[str]],
        instead: Mapping[str, Sequence[Collection[str]]],
    ) -> None:
        self.required = required
        self.columns = (*required, *optional)
        self._instead = instead
        self._column = {
            _key(other): name
            for name, others in {**required, **optional}.items()
            for other in (*others, name)
        }

    def separator(self, possible: Mapping[str, Sequence[str]]) -> str:
        """Return the separator that makes the most known titles, given the titles of each."""

        def fit(separator: str) -> tuple[int, int]:
            titles = possible[separator]
            return sum(_key(title) in self._column for title in titles), len(titles)

        return max(possible, key=fit)

    def places(
        self, titles: Sequence[str], line: int, problems: Problems
    ) -> tuple[dict[str, int], list[str]]:
        """Return the place of each column, and the titles that are not used.

        Missing and repeated columns are added to the problems.
        """
        places: dict[str, int] = {}
        unused = []
        for place, title in enumerate(titles):
            name = self._column.get(_key(title))
            if name is None:
                unused += [title] if title.strip() else []
            elif name in places:
                problems.add(
                    line,
                    f"columns {quoted(titles[places[name]])} and {quoted(title)} both mean {name}; "
                    "leave one out",
                )
            else:
                places[name] = place
        if not places and any(_NUMBER.fullmatch(title.strip()) for title in titles):
            problems.add(
                line,
                f"{quoted_list(titles)} are not names of columns; write a header line above, "
                f"such as {','.join(self.required)}",
            )
            return places, unused
        for name in self.required:
            if name not in places and not self._replaced(name, places):
                others = " or ".join(map(quoted, self.required[name][:3]))
                problems.add(
                    line,
                    f"there is no column {name!r} among {quoted_list(titles)}; add it"
                    + (f" (it may also be called {others})" if others else ""),
                )
        return places, unused

    def _replaced(self, name: str, places: Mapping[str, int]) -> bool:
        return any(places.keys() >= set(group) for group in self._instead.get(name, ()))


def _key(name: str) -> str:
    """Return what a column's name is compared by: letters and digits, in one case."""
    return "".join(letter for letter in name.casefold() if letter.isalnum())


def quoted_list(names: Sequence[str]) -> str:
    """Return names as a message lists them.

    >>> quoted_list([" name", "club"])
    "'name', 'club'"
    """
    shown = ", ".join(quoted(name.strip()) for name in names[:MOST_LISTED])
    more = len(names) - MOST_LISTED
    return shown + (f" and {more} more" if more > 0 else "")
