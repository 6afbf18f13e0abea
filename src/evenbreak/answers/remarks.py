"""Remarks: what a sheet leaves out or takes for granted, and why."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from evenbreak.answers.report_frames import file_name
from evenbreak.answers.wording import some_of
from evenbreak.files.results import ResultsFile
from evenbreak.files.roster import RosterFile

MOST_NAMES = 5


class Remark(NamedTuple):
    """Something worth knowing about a sheet, and what there is to say of it.

    Attributes
    ----------
    what
        what it is about.
    why
        what there is to say.
    names
        the players or pairs that it is about.
    """

    what: str
    why: str
    names: Sequence[str] = ()

    @property
    def shown_names(self) -> Sequence[str]:
        """The first of the names."""
        return self.names[:MOST_NAMES]

    @property
    def more_names(self) -> int:
        """How many names there are besides."""
        return len(self.names) - len(self.shown_names)

    @property
    def heading(self) -> str:
        """What it is about, with names."""
        return f"{self.what} ({some_of(self.names, MOST_NAMES)})" if self.names else self.what

    def __str__(self) -> str:
        """Return the remark as a sentence.

        >>> print(Remark("New players", "taken as 80 ± 30", ["Ann", "Bo"]))
        New players (Ann, Bo): taken as 80 ± 30.
        """
        return f"{self.heading}: {self.why}."


def warnings_of(file: ResultsFile | RosterFile) -> Iterator[Remark]:
    """Yield the warnings about a file, without the file's folder, which is private."""
    for warning in file.warnings:
        text = warning.removeprefix(f"{file.source}:")
        if text == warning:
            yield Remark("Warning", warning)
        else:  # after the name comes a blank, or the number of a line
            why = text.lstrip() if text.startswith(" ") else f"line {text}"
            yield Remark(f"Warning about {file_name(file)}", why)
