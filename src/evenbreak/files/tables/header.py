"""The header of a table: which of its titles are the columns that a reader asks for."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import NamedTuple

from evenbreak.files.tables.problems import Problems, quoted, quoted_list
from evenbreak.words import Parameter, Sentence, listed, say, say_count

MOST_ABOVE = 30
"""The header is looked for in this many rows."""

_NUMBER = re.compile(r"[+-]?[0-9]+([.,][0-9]+)?", re.ASCII)
"""What stands in a row of values, but hardly in a header."""

Hint = Callable[[Collection[str], Sequence[str], Sequence[Sequence[str]]], str]


class Fit(NamedTuple):
    """How well a row fits as the header; the greatest fits best.

    Parameters
    ----------
    complete
        whether it has every required column, or what takes its place.
    known
        how many of its titles are known.
    titles
        how many titles it has, blank ones aside.
    above
        how many rows stand above it, as a negative number: the first of equals is taken.
    """

    complete: bool
    known: int
    titles: int
    above: int


class Header:
    """The names by which a reader knows its columns.

    Parameters
    ----------
    required, optional
        for each column its other names.
    instead
        for a required column the sets of columns that can take its place.
    called
        for some columns the title that they have in this file, whatever other titles mean.
    hint
        what to do about missing columns, given those that are known, the other titles and some
        rows below the header.
    """

    def __init__(
        self,
        required: Mapping[str, Sequence[str]],
        optional: Mapping[str, Sequence[str]],
        instead: Mapping[str, Sequence[Collection[str]]],
        called: Mapping[str, str] | None = None,
        hint: Hint | None = None,
    ) -> None:
        self.required = required
        self.columns = (*required, *optional)
        self._instead = instead
        self._called = called or {}
        self._hint = hint
        self._column = {
            _key(alias): name
            for name, others in {**required, **optional}.items()
            for alias in (*others, name)
        }

    def best(self, rows: Sequence[Sequence[str]]) -> Fit:
        """Return how well the row fits that is most likely the header, and where it stands."""
        fits = [self._fit(titles, -above) for above, titles in enumerate(rows[:MOST_ABOVE])]
        complete = [fit for fit in fits if fit.complete]
        if complete:  # a table below another one is not what is read
            return next((fit for fit in complete if fit.known > 1), complete[0])
        nothing = Fit(complete=False, known=0, titles=0, above=0)
        best = max(fits, key=lambda fit: (fit.known, fit.above), default=nothing)
        if best.known > 1:
            return best
        # A single known word is as likely a cell: the header is then the first row of full width.
        return max(fits, key=lambda fit: (fit.titles, fit.above), default=nothing)

    def _fit(self, titles: Sequence[str], above: int) -> Fit:
        names = {name for name in map(self._name, titles) if name is not None}
        complete = bool(names) and not self._missing(names)
        values = any(_NUMBER.fullmatch(title.strip()) for title in titles)
        many = 0 if values and not complete else len(names)
        return Fit(complete, many, sum(bool(title.strip()) for title in titles), above)

    def _name(self, title: str) -> str | None:
        """Return the column that a title means."""
        for name, called in self._called.items():
            if _key(title) == _key(called) and title.strip():
                return name
        column = self._column.get(_key(title))
        return None if column in self._called else column

    def places(
        self,
        titles: Sequence[str],
        line: int,
        problems: Problems,
        sample: Sequence[Sequence[str]] = (),
    ) -> tuple[dict[str, int], list[str]]:
        """Return the place of each column, and the titles that are not used.

        Missing and repeated columns are added to the problems; `sample` has some rows below.
        """
        places: dict[str, int] = {}
        unused = []
        for place, title in enumerate(titles):
            name = self._name(title)
            if name is None:
                unused += [title] if title.strip() else []
            elif name in places:
                problems.add(
                    line,
                    "columns {title} and {other} both mean {column}; leave one out",
                    title=quoted(titles[places[name]]),
                    other=quoted(title),
                    column=name,
                )
            else:
                places[name] = place
        if not places and any(_NUMBER.fullmatch(title.strip()) for title in titles):
            problems.add(
                line,
                "{titles} are not names of columns; write a header line above, such as {header}",
                titles=quoted_list(titles),
                header=",".join(self.required),
            )
            return places, unused
        among = quoted_list(titles)
        for name, called in self._called.items():
            if name not in places:
                problems.add(
                    line,
                    "there is no column {title} among {titles}; correct {columns}",
                    title=quoted(called),
                    titles=among,
                    columns=Parameter("columns"),
                )
        missing = self._missing({*places, *self._called})
        if missing and self._hint is not None:
            rows = [[row[k] for k in range(len(row)) if k not in places.values()] for row in sample]
            others = [title for k, title in enumerate(titles) if k not in places.values()]
            remedy = self._hint(places.keys(), others, rows)
            problem = say_count(
                "there is no column {missing} among {titles}; {remedy}",
                "there are no columns {missing} among {titles}; {remedy}",
                len(missing),
                missing=listed(list(map(repr, missing))),
                titles=among,
                remedy=remedy,
            )
            problems.add(line, problem)
            return places, unused
        for name in missing:
            problems.add(line, missing_column(name, self.required[name], among))
        return places, unused

    def _missing(self, found: Collection[str]) -> list[str]:
        """Return the required columns that are not found, and not replaced."""
        return [
            name for name in self.required if name not in found and not self._replaced(name, found)
        ]

    def _replaced(self, name: str, found: Collection[str]) -> bool:
        return any(set(found) >= set(group) for group in self._instead.get(name, ()))


def missing_column(name: str, aliases: Sequence[str], titles: str = "") -> Sentence:
    """Return what to say of a missing column, and what else it may be called.

    >>> missing_column("rating", ["points"], "'name', 'club'")
    "there is no column 'rating' among 'name', 'club'; add it (it may also be called 'points')"
    """
    lacks = say("there is no column {column!r}", column=name)
    if titles:
        lacks = say("{lacks} among {titles}", lacks=lacks, titles=titles)
    if not aliases:
        return say("{lacks}; add it", lacks=lacks)
    also = listed(list(map(quoted, aliases[:3])), "or")
    return say("{lacks}; add it (it may also be called {also})", lacks=lacks, also=also)


def _key(name: str) -> str:
    """Return what a column's name is compared by: letters and digits, in one case."""
    return "".join(letter for letter in name.casefold() if letter.isalnum())
