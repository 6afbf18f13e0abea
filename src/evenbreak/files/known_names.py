"""Finding players by the names that people type."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from difflib import get_close_matches

from evenbreak.files.player_names import same_name
from evenbreak.files.problems import quoted

MOST_HINTS = 3


class KnownNames:
    """The names of a league, and the place of each.

    Upper and lower case and blanks may differ where that leaves no doubt.

    >>> names = KnownNames(["Ann Lee", "Bo Diaz"])
    >>> names.place("ann  lee"), names.place("Ann")
    (0, None)
    >>> names.hint("Ann")
    " (did you mean 'Ann Lee'?)"
    """

    def __init__(self, names: Iterable[str]) -> None:
        self._exact = {name: place for place, name in enumerate(names)}
        self._folded: defaultdict[str, list[str]] = defaultdict(list)
        for name in self._exact:
            self._folded[name.casefold()].append(name)
        self._same: defaultdict[str, list[str]] = defaultdict(list)
        for name in self._exact:
            self._same[same_name(name)].append(name)
        self._hints: dict[str, str] = {}

    def place(self, name: str) -> int | None:
        """Return where a name stands in the list, or None if it is unknown or ambiguous."""
        same = [name] if name in self._exact else self._same.get(same_name(name), [])
        return self._exact[same[0]] if len(same) == 1 else None

    def hint(self, name: str) -> str:
        """Return which names may have been meant by one that was not found, '' if none."""
        if name not in self._hints:
            near = self._near(name.casefold())
            meant = " or ".join(map(quoted, near))
            self._hints[name] = f" (did you mean {meant}?)" if near else ""
        return self._hints[name]

    def _near(self, wanted: str) -> list[str]:
        if not wanted or wanted in self._folded:
            return self._folded.get(wanted, [])
        close = get_close_matches(wanted, self._folded, n=MOST_HINTS)
        parts = sorted(key for key in self._folded if wanted in key)
        keys = dict.fromkeys([*close, *parts])
        return [self._folded[key][0] for key in keys][:MOST_HINTS]
