from fractions import Fraction

import pytest

from evenbreak.source_text.answers import (
    ANSWERS,
    PHYSICS,
    SECTION_5,
    compute,
    physics_findings,
    section_5_findings,
)


def test_no_two_modules_answer_the_same_quantity():
    assert len(ANSWERS) == sum(len(part.ANSWERS) for part in (*PHYSICS, *SECTION_5))


def test_exact_numbers_are_computed_exactly():
    assert compute("P5.4", "P(p;3,1)", "p=2/3") == Fraction(32, 81)
    assert compute("P5.6", "W(p;m,n)", "p=2/3 m=3 n=2") == Fraction(16, 27)
    assert compute("P5.13", "shot probability", "mean run 24") == Fraction(24, 25)


@pytest.mark.parametrize("problem", ["P4.17", "P5.4"])
def test_unknown_quantity_is_a_key_error(problem):
    with pytest.raises(KeyError):
        compute(problem, "phi, deg", "alpha=30deg")


def test_findings_are_computed_once():
    assert physics_findings() is physics_findings()
    assert section_5_findings() is section_5_findings()
