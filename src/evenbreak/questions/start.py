"""What the commands ask that write a demo and the source text."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from evenbreak.fields.kinds import Named
from evenbreak.fields.question import Field, Question
from evenbreak.questions.common import OutFolder, folder


@dataclass(frozen=True, kw_only=True)
class Demo(Question):
    """Write made-up files to FOLDER, and show three commands to try on them.

    There are a league's results, the players of a tournament, two teams and a player's practice.
    FOLDER is evenbreak-demo unless given. A file there that is not the demo's is left alone.
    """

    examples = """\
  evenbreak demo
  evenbreak demo data
"""
    folder: Annotated[str, Field(Named(folder, "[FOLDER]"), argument=True)] = "evenbreak-demo"


@dataclass(frozen=True, kw_only=True)
class Reproduce(Question):
    """Write every table, figure and number of the source text, computed anew.

    Start with DIR/index.md for section 5, statistics, DIR/physics.md for sections 1 to 4, the
    physics of the table, or DIR/graph_to_limit.md for each game as graph, matrix, eigenvalues and
    limit. They show and explain every number, point out the errors of the text and link to the CSV
    files. The files are the same to the byte each time. If a number is not the one expected, the
    command says so and ends with exit code 1.
    """

    examples = """\
  evenbreak reproduce --out text
"""
    out: OutFolder
