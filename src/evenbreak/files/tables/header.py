"""A table's header: which of its titles are the columns that a reader needs."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from itertools import zip_longest
from typing import NamedTuple

from evenbreak.files.tables.problems import Problems, quoted, quoted_list
from evenbreak.files.tables.sided_titles import told_apart
from evenbreak.files.tables.titles import key_of, keys_of
from evenbreak.words import Parameter, Sentence, listed, say, say_count

MOST_ABOVE = 30
"""How many rows are searched for the header."""

UNREAD = "-"
"""The title for a column that shouldn't be read."""

_NUMBER = re.compile(r"[+-]?[0-9]+([.,][0-9]+)?", re.ASCII)
"""Something found in a row of values, but hardly ever in a header."""

Hint = Callable[[Mapping[str, int], Sequence[str], Sequence[Sequence[str]]], str]
"""Says what to do about missing columns, given the places of known columns, all titles, and some
rows below the header."""


class Fit(NamedTuple):
    """How well a row fits as the header; the greatest fits best.

    `complete`: it has every required column or a substitute. `above` is minus the number of rows
    above it, so that the first of several equals is chosen. `rows` is 2 if a row with Home and Away
    is above Player and Score.
    """

    complete: bool
    known: int
    titles: int
    above: int
    rows: int = 1

    @property
    def below(self) -> int:
        """Where the rows below the header start."""
        return self.rows - self.above


class Header:
    """The names by which a reader knows its columns, apart from those by language.

    `instead` has sets of columns that can replace a required column; `called` has this file's
    column titles, - for a column that shouldn't be read; with `maybe`, titles that the file lacks
    are ignored.
    """

    def __init__(
        self,
        required: Mapping[str, Sequence[str]],
        optional: Mapping[str, Sequence[str]],
        instead: Mapping[str, Sequence[Collection[str]]],
        called: Mapping[str, str] | None = None,
        hint: Hint | None = None,
        *,
        maybe: bool = False,
    ) -> None:
        self.required = required
        self.columns = (*required, *optional)
        self._instead = instead
        self._called = {name: t for name, t in (called or {}).items() if t != UNREAD}
        unread = (called or {}).keys() - self._called.keys()
        self._maybe = maybe
        self._hint = hint
        self._means: dict[str, tuple[str, ...]] = {}
        every = {name: t for name, t in {**required, **optional}.items() if name not in unread}
        own = {key_of(title): name for name, others in every.items() for title in (*others, name)}
        for name in every:
            for key in dict.fromkeys((*(k for k in own if own[k] == name), *keys_of(name))):
                # A name of a column comes before what another may be called in some language.
                if own.get(key, name) == name or key in keys_of(own[key]):
                    self._means[key] = (*self._means.get(key, ()), name)

    def best(self, rows: Sequence[Sequence[str]]) -> Fit:
        """Return how well the likeliest header fits, and where it is."""
        fits = [self._fit(titles, -above) for above, titles in enumerate(rows[:MOST_ABOVE])]
        complete = [fit for fit in fits if fit.complete]
        if not complete:
            complete = [
                fit
                for above in range(min(len(rows) - 1, MOST_ABOVE))
                if (fit := self._fit_of_two(rows, above)).complete
            ]
        if complete:  # a table below another one is not what is read
            best = next((fit for fit in complete if fit.known > 1), complete[0])
            if best.above and told_apart(rows[-best.above]) != [*rows[-best.above]]:
                upper = -best.above - 1  # which may say whose the repeated titles are
                both = self._fit_of_two(rows, upper)
                return both if both.complete and both.known >= best.known else best
            both = self._fit_of_two(rows, -best.above)  # Player may stand above First and Last name
            return both if both.complete and both.known > best.known else best
        nothing = Fit(complete=False, known=0, titles=0, above=0)
        best = max(fits, key=lambda fit: (fit.known, fit.above), default=nothing)
        if best.known > 1:
            return best
        # A single known word is as likely a cell: the header is then the first row of full width.
        return max(fits, key=lambda fit: (fit.titles, fit.above), default=nothing)

    def titles(self, rows: Sequence[Sequence[str]], fit: Fit) -> Sequence[str]:
        """Return the titles in the header with this fit."""
        if fit.rows == 1:
            return told_apart(rows[-fit.above])
        return self._of_two(*rows[-fit.above : fit.below])

    def _fit_of_two(self, rows: Sequence[Sequence[str]], above: int) -> Fit:
        if len(rows) < above + 2:
            return Fit(complete=False, known=0, titles=0, above=-above)
        return self._fit(self._of_two(*rows[above : above + 2]), -above, 2)

    def _of_two(self, upper: Sequence[str], lower: Sequence[str]) -> list[str]:
        """Return the titles in a two-row header; for an unknown title, its lower part.

        That part must be known, and appear only once: Player above Last name becomes Last name.
        """
        titles = _joined(upper, lower)
        lower = [*lower, *[""] * (len(titles) - len(lower))]
        names, alone = self._named(titles), self._named(lower)
        return [
            below.strip()
            if own and not name and own not in names and alone.count(own) == 1
            else title
            for title, below, name, own in zip(titles, lower, names, alone, strict=True)
        ]

    def _fit(self, titles: Sequence[str], above: int, rows: int = 1) -> Fit:
        names = {name for name in self._named(told_apart(titles)) if name}
        complete = bool(names) and not self._missing(names)
        values = any(_NUMBER.fullmatch(title.strip()) for title in titles)
        many = 0 if values and not complete else len(names)
        return Fit(complete, many, sum(bool(title.strip()) for title in titles), above, rows)

    def _named(self, titles: Sequence[str]) -> list[str]:
        """Return the column that each title means, '' if none; two titles may mean the same one.

        A title that may mean several columns means the first that no other title means: Home is the
        player, unless there is also a Home player.
        """
        called = {key_of(title): name for name, title in self._called.items()}
        settled = set(self._called)
        if self._maybe:
            settled = {called[key] for key in map(key_of, titles) if key in called}
        means = []
        for title in titles:
            key = key_of(title)
            own = called.get(key, "") if title.strip() else ""
            others = [name for name in self._means.get(key, ()) if name not in settled]
            means.append((own,) if own else tuple(others))
        taken = {names[0] for names in means if len(names) == 1}
        found = []
        for names in means:
            if len(names) > 1:
                names = (next((name for name in names if name not in taken), names[0]),)
                taken |= {*names}
            found.append(names[0] if names else "")
        return found

    def places(
        self,
        titles: Sequence[str],
        line: int,
        problems: Problems,
        sample: Sequence[Sequence[str]] = (),
    ) -> tuple[dict[str, int], list[str]]:
        """Return each column's place, and the unused titles.

        Missing and repeated columns are added to the problems; `sample` has some of the rows below.
        """
        places: dict[str, int] = {}
        unused = []
        for place, (title, name) in enumerate(zip(titles, self._named(titles), strict=True)):
            if not name:
                unused += [title] if title.strip() else []
            elif name in places:
                problems.add(
                    line,
                    "columns {title} and {other} both mean {column}. Remove one.",
                    title=quoted(titles[places[name]]),
                    other=quoted(title),
                    column=name,
                )
            else:
                places[name] = place
        if (
            self.required
            and not places
            and any(_NUMBER.fullmatch(title.strip()) for title in titles)
        ):
            problems.add(
                line,
                "the first line, {titles}, doesn't name the columns. In this file it must have "
                "{header}.",
                titles=quoted_list(titles),
                header=",".join(self.required),
            )
            return places, unused
        among = quoted_list(titles)
        for name, called in self._called.items():
            if name not in places and not self._maybe:
                problems.add(
                    line,
                    "there's no column {title} among {titles}. Correct {columns}.",
                    title=quoted(called),
                    titles=among,
                    columns=Parameter("columns"),
                )
        missing = self._missing({*places, *(() if self._maybe else self._called)})
        if len(missing) == 1 and self._hint is None:
            problem = missing_column(missing[0], self.required[missing[0]], among)
            if not places:
                problem = say("{problem} Is this the right file?", problem=problem)
            problems.add(line, problem)
        elif missing:
            remedy = say("Add them.") if self._hint is None else self._hint(places, titles, sample)
            problem = say_count(
                "there's no column {missing} among {titles}. {remedy}",
                "there are no columns {missing} among {titles}. {remedy}",
                len(missing),
                missing=listed(list(map(repr, missing))),
                titles=among,
                remedy=remedy,
            )
            problems.add(line, problem)
        return places, unused

    def _missing(self, found: Collection[str]) -> list[str]:
        """Return the required columns that are missing and haven't been replaced."""
        return [name for name in self.required if not self.has(name, found)]

    def has(self, name: str, found: Collection[str]) -> bool:
        """Return whether a column, or others that can replace it, have been found."""
        return name in found or any(
            set(found) >= set(group) for group in self._instead.get(name, ())
        )


def _joined(upper: Sequence[str], lower: Sequence[str]) -> list[str]:
    """Return the titles in a two-row header whose upper row has merged cells.

    >>> _joined(["Date", "Home", "", "Away", ""], ["", "Player", "Score", "Player", "Score"])
    ['Date', 'Home Player', 'Home Score', 'Away Player', 'Away Score']
    """
    titles, over = [], ""
    for above, below in zip_longest(map(str.strip, upper), map(str.strip, lower), fillvalue=""):
        over = above or (over if below else "")
        titles.append(f"{over} {below}".strip())
    return titles


def missing_column(name: str, aliases: Sequence[str], titles: str = "") -> Sentence:
    """Return the message about a missing column, with other names for it.

    >>> missing_column("rating", ["points"], "'name', 'club'")
    "there's no column 'rating' among 'name', 'club'. Add it (it may also be called 'points')."
    """
    lacks = say("there's no column {column!r}", column=name)
    if titles:
        lacks = say("{lacks} among {titles}", lacks=lacks, titles=titles)
    if not aliases:
        return say("{lacks}. Add it.", lacks=lacks)
    also = listed(list(map(quoted, aliases[:3])), "or")
    return say("{lacks}. Add it (it may also be called {also}).", lacks=lacks, also=also)
