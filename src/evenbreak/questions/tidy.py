"""The question of a league's office that has results in several files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

from evenbreak.fields.kinds import File
from evenbreak.fields.question import Field
from evenbreak.questions.results import Results


@dataclass(frozen=True, kw_only=True)
class LeagueTidy(Results):
    """Make one clean list of matches of all results, and list what was changed.

    RESULTS.csv is any number of files that evenbreak reads: CSV, workbooks, JSON of other programs;
    or leave them out for those of league.toml. A match that two files have counts once; byes, and
    rows that cannot be read, are left out and listed with file, line and reason. Names that may be
    one player's are never merged silently: on a terminal you are asked, otherwise they are listed,
    with the lines for [aliases] in league.toml that settle it.
    """

    of_form: ClassVar[bool] = True
    """It says how the league's files are written, which other commands do not repeat."""
    examples = """\
  evenbreak league tidy
  evenbreak league tidy autumn.csv spring.xlsx cuescore.json --out season.csv
  evenbreak league tidy --csv > changes.csv
"""
    out: Annotated[str, Field(File("FILE"), "Where to write the matches, as CSV.")] = "tidy.csv"
