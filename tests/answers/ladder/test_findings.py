"""What a ladder says, and what is missing where a part cannot be had."""

import pytest

from evenbreak.answers.ladder.ladder import LadderFindings, LadderQuestion
from evenbreak.errors import AccuracyError
from evenbreak.handicaps import EQUAL_SKILL, Ladder

NATURAL = LadderQuestion(-30, 5, newcomer=False, opponents="natural")


def test_the_natural_law_is_worked_out_only_where_it_is_another():
    assert LadderFindings(Ladder("npl"), NATURAL).natural is None
    equal = Ladder("npl", opponents=EQUAL_SKILL)
    found = LadderFindings(equal, NATURAL._replace(opponents="equal skill"))
    assert found.natural.sd == Ladder("npl").law().sd
    assert LadderFindings(Ladder("npl", day_sd=5.0), NATURAL).natural.sd == found.natural.sd


def test_a_part_that_cannot_be_had_is_none_with_a_reason(monkeypatch):
    def too_small(_):
        raise AccuracyError("follow the ladder with ladder_mixing")

    monkeypatch.setattr("evenbreak.answers.ladder.ladder.ladder_gap", too_small)
    found = LadderFindings(Ladder("npl"), NATURAL)
    assert found.gap is None
    (reason,) = found.missing
    assert "ladder_mixing" not in reason


def test_sizes_of_errors_are_those_of_the_law():
    found = LadderFindings(Ladder("npl"), NATURAL)
    assert found.off.at_least(6) == pytest.approx(1.0 - found.law.between(-5, 5))
