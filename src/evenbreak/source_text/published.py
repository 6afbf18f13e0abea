"""What the source text prints: its numbers and its errata.

The rows come with the package, for comparison with what it computes.
"""

from __future__ import annotations

from decimal import Decimal
from typing import NamedTuple

from evenbreak.source_text.cells import packaged_rows


class PublishedNumber(NamedTuple):
    """One number of the text, and how close a computed number should come to it.

    Parameters
    ----------
    problem
        where it is printed: a problem such as P5.13, a table, or NPL for the ladder.
    quantity, inputs
        what it is, and for which inputs, such as `p=0.5 m=8`; with the problem they identify it.
    printed
        the number with its printed digits; None if nothing is printed.
    tolerance
        how far a computed number may be from it. An erratum may be within its tolerance and
        is wrong all the same.
    verdict
        'agrees'; 'erratum' if the text is off by more than half its last place, see the note;
        'derived' if it prints nothing, or nothing legible. Sections 1 to 4 have two more:
        'formula' if the text prints a formula, and `printed` is its value for the inputs;
        'given' for numbers that the text takes from elsewhere.
    note
        a comment, or ''.
    value_is
        what `printed` is: 'printed' if the text prints the number; in sections 1 to 4 also
        'formula' for the value of a printed formula, and 'words' for what the text says without
        a number; '' if there is no value.
    """

    problem: str
    quantity: str
    inputs: str
    printed: Decimal | None
    tolerance: Decimal
    verdict: str
    note: str
    value_is: str = "printed"


class Erratum(NamedTuple):
    """An error of the text, a remark on it, or a gap in the copy that was read.

    Parameters
    ----------
    where
        the problem, table or passage.
    class_
        'slip' if the text is wrong; 'remark' if it is right but easy to misread; 'copy' for
        what is missing from the copy that was read.
    printed
        what it says, in short.
    correct
        what it should say, or for a remark what is true; '' if there is nothing to say.
    kind
        the kind of slip or remark, such as 'cut off' for truncated digits.
    why
        how this is known.
    """

    where: str
    class_: str
    printed: str
    correct: str
    kind: str
    why: str


def published_numbers() -> list[PublishedNumber]:
    """Return the numbers of section 5 in the order of the text, a table after its problem.

    >>> [number] = [row for row in published_numbers() if row.quantity == "P(run>=100)"]
    >>> number.problem, number.inputs, number.printed
    ('P5.13', 'p=.96', Decimal('0.017'))
    """
    return _numbers("published/section5_numbers.csv")


def physics_numbers() -> list[PublishedNumber]:
    """Return the numbers of sections 1 to 4, the physics of the table, in the order of the text.

    >>> [number] = [row for row in physics_numbers() if row.quantity == "alpha_crit, deg"]
    >>> number.problem, number.printed, number.value_is, number.verdict
    ('P4.19', Decimal('14.963'), 'printed', 'agrees')
    """
    return _numbers("published/physics_numbers.csv")


def physics_errata() -> list[Erratum]:
    """Return the slips of sections 1 to 4, with remarks, in the order of the text.

    >>> [slip.correct for slip in physics_errata() if slip.where == "P4.15"]
    ['28.126']
    """
    return [Erratum(*row) for row in packaged_rows("published/physics_errata.csv")]


def errata() -> list[Erratum]:
    """Return the slips of section 5, with remarks, in the order of the text.

    >>> [(slip.class_, slip.kind) for slip in errata() if slip.where == "P5.7"]
    [('slip', 'last digit')]
    """
    return [Erratum(*row) for row in packaged_rows("published/section5_errata.csv")]


def _numbers(path: str) -> list[PublishedNumber]:
    return [
        PublishedNumber(
            problem,
            quantity,
            inputs,
            Decimal(printed) if printed else None,
            Decimal(tolerance),
            *rest,
        )
        for problem, quantity, inputs, printed, tolerance, *rest in packaged_rows(path)
    ]
