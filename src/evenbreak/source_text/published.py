"""What the source text prints: its numbers and errata, and how they compare with computed values.

The numbers come with the package. Each has inputs, such as `winner breaks p1=.9` or `alpha=30deg
V_0=36in/s`, from which it is recomputed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from typing import Any, NamedTuple, TypeAlias

from evenbreak.physics.units import DEGREE, INCH, OUNCE
from evenbreak.source_text.cells import difference_cell, number_cell, packaged_rows


class PublishedNumber(NamedTuple):
    """One number in the text, and how close a computed number should come to it.

    Parameters
    ----------
    problem
        where it is printed: a problem such as P5.13, a table, or NPL for the ladder.
    quantity, inputs
        what it is, and for which inputs, such as `p=0.5 m=8`; with the problem they identify it.
    printed
        the number with its printed digits; None if nothing is printed.
    tolerance
        how far a computed number may be from it. An erratum may be within its tolerance and still
        be wrong.
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
    """An error in the text, a remark on it, or a gap in our copy.

    Parameters
    ----------
    class_
        'slip' if the text is wrong; 'remark' if it is right but easy to misread; 'copy' if
        something is missing from our copy.
    printed
        in short.
    correct
        what it should say, or for a remark what is true; '' if there is nothing to add.
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
    """Return the numbers in section 5 in the order of the text, each table after its problem.

    >>> [number] = [row for row in published_numbers() if row.quantity == "P(run>=100)"]
    >>> number.problem, number.inputs, number.printed
    ('P5.13', 'p=.96', Decimal('0.017'))
    """
    return _numbers("published/section5_numbers.csv")


def physics_numbers() -> list[PublishedNumber]:
    """Return the numbers in sections 1 to 4, the physics, in the order of the text.

    >>> [number] = [row for row in physics_numbers() if row.quantity == "alpha_crit, deg"]
    >>> number.problem, number.printed, number.value_is, number.verdict
    ('P4.19', Decimal('14.963'), 'printed', 'agrees')
    """
    return _numbers("published/physics_numbers.csv")


def physics_errata() -> list[Erratum]:
    """Return the slips in sections 1 to 4, with remarks, in the order of the text.

    >>> [slip.correct for slip in physics_errata() if slip.where == "P4.15"]
    ['28.126']
    """
    return [Erratum(*row) for row in packaged_rows("published/physics_errata.csv")]


def errata() -> list[Erratum]:
    """Return the slips in section 5, with remarks, in the order of the text.

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


_NUMBER = re.compile(r"(-?\d*\.?\d+(?:/\d+)?)(deg|in|in/s|oz|s)?")
_UNITS = {"deg": DEGREE, "in": INCH, "in/s": INCH, "oz": OUNCE}


@dataclass
class Inputs:
    """A quantity's inputs, by name.

    Numbers are exact, in the units in which they are written; `;` and `:` separate several with the
    same name, and "" names those without a name. `units` has the factors to SI units or radians, if
    not 1; `words` have no value.
    """

    numbers: dict[str, tuple[Fraction, ...]] = field(default_factory=dict)
    units: dict[str, float] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    words: list[str] = field(default_factory=list)

    def all(self, name: str = "") -> tuple[Fraction, ...]:
        """Return a name's numbers, without rounding."""
        return self.numbers[name]

    def one(self, name: str = "") -> Fraction:
        """Return a name's only number, without rounding."""
        (value,) = self.numbers[name]
        return value

    def __getitem__(self, name: str) -> Any:
        """Return a name's only number as a float in SI units or radians, or its text."""
        if name in self.texts:
            return self.texts[name]
        return float(self.one(name)) * self.units.get(name, 1.0)

    def get(self, name: str, default: Any = None) -> Any:
        """Return the same, or a default if there is no such name."""
        return self[name] if name in self.numbers or name in self.texts else default


Answers: TypeAlias = Mapping[tuple[str, str], Callable[[Inputs], Any]]
"""How to compute each quantity that the text prints, by problem and quantity."""


def parse_inputs(text: str) -> Inputs:
    """Return the numbers, texts and words in an input string.

    >>> found = parse_inputs("half ball b/R=1/2 V_0=2in/s balls=pool 1:5")
    >>> found["b/R"], found["V_0"], found["balls"], found.words
    (0.5, 0.0508, 'pool', ['half', 'ball'])
    >>> parse_inputs("1:5 p=0.3").all(), parse_inputs("mean run 24").one("run")
    ((Fraction(1, 1), Fraction(5, 1)), Fraction(24, 1))
    """
    inputs = Inputs()
    name = ""
    for word in text.split():
        before, equals, after = word.partition("=")
        if equals:
            name, word = before, after
        parts = [_NUMBER.fullmatch(part) for part in re.split("[;:]", word)]
        if None not in parts:
            numbers = [part for part in parts if part]
            exact = (Fraction(number[1]) for number in numbers)
            inputs.numbers[name] = (*inputs.numbers.get(name, ()), *exact)
            if unit := _UNITS.get(numbers[0][2] or ""):
                inputs.units[name] = unit
        elif equals:
            inputs.texts[name] = word.replace("_", " ")
        else:
            name = word
            inputs.words.append(word)
    return inputs


class Finding(NamedTuple):
    """A printed number, its computed value, and the verdict.

    `computed` is None if the library has no such number. The verdict is 'agrees', 'formula',
    'given', 'erratum' or 'derived' as for `PublishedNumber`; or 'differs', which should never
    happen.
    """

    published: PublishedNumber
    computed: float | None
    verdict: str


def find(rows: Iterable[PublishedNumber], answers: Answers) -> Iterator[Finding]:
    """Yield each number with its computed value."""
    for row in rows:
        computed = None
        if row.verdict != "given" or (row.problem, row.quantity) in answers:
            answer = answers[row.problem, row.quantity](parse_inputs(row.inputs))
            computed = float(answer)
        yield Finding(row, computed, verdict_of(row, computed))


def verdict_of(published: PublishedNumber, computed: float | None) -> str:
    """Return the verdict on a printed number, given the computed one.

    Within `deciding_tolerance`, the package data's verdict stands, except that a supposed erratum
    agrees. Outside it, the verdict is 'differs', unless the number is an erratum.
    """
    if published.printed is None:
        return "derived"
    if computed is None:
        return "given" if published.verdict == "given" else "differs"
    near = abs(computed - float(published.printed)) <= float(deciding_tolerance(published))
    if published.verdict == "erratum":
        return "agrees" if near else "erratum"
    return published.verdict if near else "differs"


def deciding_tolerance(published: PublishedNumber) -> Decimal:
    """Return the largest difference at which a printed and a computed number agree.

    This is the number's tolerance. A known erratum agrees only within half of its last printed
    place, as rounding would leave it.

    >>> known = PublishedNumber("P5.17", "", "", Decimal("0.457"), Decimal("0.0006"), "erratum", "")
    >>> deciding_tolerance(known), deciding_tolerance(known._replace(verdict="agrees"))
    (Decimal('0.0005'), Decimal('0.0006'))
    """
    if published.verdict != "erratum" or published.printed is None:
        return published.tolerance
    return Decimal((0, (5,), int(published.printed.as_tuple().exponent) - 1))


def differing(findings: Iterable[Finding]) -> Iterator[str]:
    """Yield a line for each number that doesn't have the expected verdict."""
    for row, computed, verdict in findings:
        if verdict != row.verdict:
            number = "nothing" if computed is None else f"{computed:.10g}"
            yield (
                f"{row.problem}: {row.quantity} ({row.inputs}): printed {row.printed}, "
                f"computed {number}: {verdict}, not {row.verdict}"
            )


def physics_row_of(finding: Finding) -> dict[str, Any]:
    """Return a number from sections 1 to 4 as a row, with what its value is.

    >>> number = PublishedNumber("P2.2", "q", "", Decimal(2), Decimal(0), "formula", "", "formula")
    >>> list(physics_row_of(Finding(number, 2.0, "formula")).items())[3:5]
    [('value', Decimal('2')), ('value_is', 'formula')]
    """
    cells: dict[str, Any] = {}
    for name, cell in row_of(finding).items():
        if name == "printed":
            cells |= {"value": cell, "value_is": finding.published.value_is}
        else:
            cells[name] = cell
    return cells


def row_of(finding: Finding) -> dict[str, Any]:
    """Return a number as a table row."""
    row, computed = finding.published, finding.computed
    difference = None
    if computed is not None and row.printed is not None:
        difference = difference_cell(computed, row.printed)
    return {
        "problem": row.problem,
        "quantity": row.quantity,
        "inputs": row.inputs,
        "printed": row.printed,
        "computed": None if computed is None else number_cell(computed),
        "difference": difference,
        "tolerance": number_cell(deciding_tolerance(row)),
        "verdict": finding.verdict,
        "note": row.note,
    }


class Row(NamedTuple):
    """One part of an answer: a number, or a formula or an enumeration as text."""

    quantity: str
    inputs: str
    computed: Any
    note: str = ""


Derived: TypeAlias = Mapping[str, Callable[[], Iterable[Row]]]
"""Each problem's rows, as functions that make them."""


def formulas(problem: str) -> list[Row]:
    """Return the formulas that answer a problem, and its matrices entry by entry.

    An entry is the chance on the arrow from one state to another, with q = 1 - p.

    >>> formulas("P5.9")[1]
    Row(quantity='formula: mean', inputs='', computed='N p', note='')
    """
    return [Row(*row) for home, *row in packaged_rows("section5/formulas.csv") if home == problem]
