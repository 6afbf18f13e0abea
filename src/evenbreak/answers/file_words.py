"""A file in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak.answers.wording import listed

if TYPE_CHECKING:
    from evenbreak.files.lists.roster import RosterFile
    from evenbreak.files.results.results_file import ResultsFile


def file_name(file: ResultsFile | RosterFile) -> str:
    """Return the name of a file without its folders; the names of several, if they are one."""
    return listed([source.replace("\\", "/").rpartition("/")[2] for source, _ in _read(file)])


def fingerprints(file: ResultsFile | RosterFile, digits: int = 64) -> str:
    """Return the SHA-256 of a file, or of each of several, up to so many digits."""
    more = "…" if digits < 64 else ""
    return listed([f"{sha256[:digits]}{more}" for _, sha256 in _read(file)])


def _read(file: ResultsFile | RosterFile) -> tuple[tuple[str, str], ...]:
    return getattr(file, "read", ()) or ((file.source, file.sha256),)
