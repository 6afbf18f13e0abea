"""The answer to a question, for every output format, including terminals and notebooks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from evenbreak.answers.faces.to_html import to_html
from evenbreak.answers.faces.to_json import as_dict
from evenbreak.answers.faces.to_text import to_text
from evenbreak.answers.kit.parts import Content, Quantities, Table

if TYPE_CHECKING:
    import pandas as pd


class Answer(Content):
    """The answer to one question: its content, and how it is shown.

    An `Answer` is made once, in one module per question, and shown by the renderers in
    `evenbreak.answers.faces`: on a terminal, as CSV, as JSON, as HTML. None of them adds a word.
    Its parameters are the same as for `Content`.

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

    def __repr__(self) -> str:
        return f"<Answer: {self.heading.partition(chr(10))[0]}>"

    def to_dict(self) -> dict[str, Any]:
        """Return the content of its JSON: plain numbers, words, lists and dicts."""
        return as_dict(self)

    def to_frame(self) -> pd.DataFrame:
        """Return its CSV as a DataFrame: one table, or quantities with values."""
        import pandas as pd

        match self.for_files:
            case Table() as table:
                return table.to_frame()
            case Quantities(of=listed):
                rows = [(one.name, one.value) for one in listed]
                return pd.DataFrame(rows, columns=["quantity", "value"])
        return pd.DataFrame()

    def __str__(self) -> str:
        """Return the answer as shown on a terminal."""
        return to_text(self).rstrip("\n")

    def _repr_html_(self) -> str:
        """Return the answer as shown in a notebook."""
        return to_html(self)
