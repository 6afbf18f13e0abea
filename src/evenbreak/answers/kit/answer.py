"""What a question is answered with: sentences, quantities, tables and warnings, and no face.

An `Answer` is made once, in one module a question, and shown by the renderers of
`evenbreak.answers.faces`: on a terminal, as CSV, as JSON, as HTML. None of them adds a word.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from evenbreak.answers.faces.to_html import to_html
from evenbreak.answers.faces.to_json import as_dict
from evenbreak.answers.faces.to_text import to_text
from evenbreak.answers.kit.parts import Part, Quantities, Table

if TYPE_CHECKING:
    import pandas as pd


SCHEMA_VERSION = 1
"""Of an answer's JSON; it changes when a key changes its meaning."""


@dataclass(frozen=True)
class Answer:
    """The answer to one question, for every face.

    Parameters
    ----------
    heading
        what was asked, and of whom or what, in a line or two.
    parts
        what a person reads, in that order. The first is a paragraph: the answer in words.
    details
        what only those read who ask for it: statistics, with their words explained.
    warnings
        what may be wrong with what was given, a sentence each.
    data
        what JSON holds besides the quantities and tables of `parts` and `details`.
    csv
        the one of its tables or quantities that goes into a file or a pipe; without it the
        first of `parts`.
    schema_version
        of its JSON.

    >>> from evenbreak.answers.kit.columns import quantity_of
    >>> win = quantity_of("p_win_a", 0.875, a="A")
    >>> answer = Answer("race 7:7", ["A wins 7 matches of 8.", Quantities([win])])
    >>> print(answer)
    race 7:7
    <BLANKLINE>
    A wins 7 matches of 8.
    <BLANKLINE>
      A wins the match  0.8750
    >>> answer.to_dict()["p_win_a"]
    0.875
    """

    heading: str
    parts: Sequence[Part]
    details: Sequence[Part] = ()
    warnings: Sequence[str] = ()
    data: Mapping[str, Any] = field(default_factory=dict)
    csv: Quantities | Table | None = None
    schema_version: int = SCHEMA_VERSION

    def __repr__(self) -> str:
        return f"<Answer: {self.heading.partition(chr(10))[0]}>"

    @property
    def sentences(self) -> list[str]:
        """The paragraphs, those of the details left out."""
        return [part for part in self.parts if isinstance(part, str)]

    @property
    def for_files(self) -> Quantities | Table | None:
        """What goes into a file or a pipe."""
        numbers = (part for part in (*self.parts, *self.details) if not isinstance(part, str))
        return self.csv if self.csv is not None else next(numbers, None)

    def to_dict(self) -> dict[str, Any]:
        """Return what its JSON holds: plain numbers, words, lists and dicts."""
        return as_dict(self)

    def to_frame(self) -> pd.DataFrame:
        """Return as a DataFrame what goes into a file: one table, or quantities with values."""
        import pandas as pd

        match self.for_files:
            case Table() as table:
                return table.to_frame()
            case Quantities(of=listed):
                rows = [(one.name, one.value) for one in listed]
                return pd.DataFrame(rows, columns=["quantity", "value"])
        return pd.DataFrame()

    def __str__(self) -> str:
        """Return the answer as a terminal shows it."""
        return to_text(self).rstrip("\n")

    def _repr_html_(self) -> str:
        """Return the answer as a notebook shows it."""
        return to_html(self)
