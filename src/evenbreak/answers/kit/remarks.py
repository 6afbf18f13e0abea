"""Remarks: what an answer leaves out or takes for granted, and why."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from evenbreak.answers.kit.wording import some_of
from evenbreak.words import listed

if TYPE_CHECKING:  # they load numpy
    from evenbreak.files.lists.roster import RosterFile
    from evenbreak.files.results.results_file import ResultsFile

MOST_NAMES = 5
"""The most names that a remark lists."""


class Remark(NamedTuple):
    """Something worth knowing about an answer, and the players or pairs it is about."""

    what: str
    why: str
    names: Sequence[str] = ()

    @property
    def shown_names(self) -> Sequence[str]:
        """The first few names."""
        return self.names[:MOST_NAMES]

    @property
    def more_names(self) -> int:
        """How many more names there are."""
        return len(self.names) - len(self.shown_names)

    @property
    def heading(self) -> str:
        """The names it is about, as text."""
        return f"{self.what} ({some_of(self.names, MOST_NAMES)})" if self.names else self.what

    def __str__(self) -> str:
        """Return the remark as a sentence.

        >>> print(Remark("New players", "treated as 80 ± 30", ["Ann", "Bo"]))
        New players (Ann, Bo): treated as 80 ± 30.
        """
        return f"{self.heading}: {self.why}."


class Remarks(str):
    """A paragraph consisting of a list of remarks.

    >>> print(Remarks([Remark("New players", "treated as 80", ["Ann"])], "Assumed"))
    Assumed:
    - New players (Ann): treated as 80.
    """

    items: tuple[Remark, ...]
    above: str

    def __new__(cls, items: Iterable[Remark], above: str = "") -> Remarks:
        """Make the paragraph."""
        listed = tuple(items)
        head = [f"{above}:"] if above else []
        self = super().__new__(cls, "\n".join([*head, *(f"- {item}" for item in listed)]))
        self.items, self.above = listed, above
        return self


def file_name(file: ResultsFile | RosterFile) -> str:
    """Return a file's name without its folders; all names if it stands for several files."""
    return listed([source.replace("\\", "/").rpartition("/")[2] for source, _ in _read(file)])


def fingerprints(file: ResultsFile | RosterFile, digits: int = 64) -> str:
    """Return a file's SHA-256, or each file's, shortened to this many digits."""
    more = "…" if digits < 64 else ""
    return listed([f"{sha256[:digits]}{more}" for _, sha256 in _read(file)])


def _read(file: ResultsFile | RosterFile) -> tuple[tuple[str, str], ...]:
    return getattr(file, "read", ()) or ((file.source, file.sha256),)


def warnings_of(
    file: ResultsFile | RosterFile, warnings: Sequence[str] | None = None
) -> Iterator[Remark]:
    """Yield warnings about a file, without its folder, which is private."""
    for warning in file.warnings if warnings is None else warnings:
        text = warning.removeprefix(f"{file.source}:")
        if text == warning:
            yield Remark("Warning", warning)
        else:  # after the name comes a blank, or the number of a line
            why = text.lstrip() if text.startswith(" ") else f"line {text}"
            yield Remark(f"Warning about {file_name(file)}", why)
