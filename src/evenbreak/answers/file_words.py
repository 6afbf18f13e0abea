"""A file in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from evenbreak.files.results import ResultsFile
    from evenbreak.files.roster import RosterFile


def file_name(file: ResultsFile | RosterFile) -> str:
    """Return the name of a file without its folders."""
    return file.source.replace("\\", "/").rpartition("/")[2]
