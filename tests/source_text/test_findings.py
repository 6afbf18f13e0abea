from decimal import Decimal

import pytest

from evenbreak.source_text.answers import physics_findings, section_5_findings
from evenbreak.source_text.findings import (
    Finding,
    deciding_tolerance,
    differing,
    find,
    row_of,
    verdict_of,
)
from evenbreak.source_text.published import PublishedNumber

NUMBER = PublishedNumber("P4.19", "half", "p=1/2", Decimal("0.90"), Decimal("0.0101"), "agrees", "")


@pytest.mark.parametrize(
    ("expected", "computed", "verdict"),
    [
        ("agrees", 0.909, "agrees"),
        ("agrees", 0.92, "differs"),
        ("agrees", None, "differs"),
        ("formula", 0.9, "formula"),
        ("given", None, "given"),
        ("given", 0.9, "given"),
        ("given", 1.0, "differs"),
        # An erratum is right only within half its last place.
        ("erratum", 0.909, "erratum"),
        ("erratum", 0.904, "agrees"),
    ],
)
def test_the_verdict_on_a_number(expected, computed, verdict):
    assert verdict_of(NUMBER._replace(verdict=expected), computed) == verdict


def test_what_is_not_printed_is_derived():
    assert verdict_of(NUMBER._replace(printed=None), 0.5) == "derived"


def test_an_erratum_is_not_excused_by_its_tolerance():
    assert deciding_tolerance(NUMBER) == Decimal("0.0101")
    assert deciding_tolerance(NUMBER._replace(verdict="erratum")) == Decimal("0.005")


def test_a_number_is_computed_from_its_inputs():
    answers = {("P4.19", "half"): lambda inputs: inputs["p"] + 0.4}
    assert list(find([NUMBER], answers)) == [Finding(NUMBER, 0.9, "agrees")]
    given = NUMBER._replace(quantity="not held", verdict="given")
    assert list(find([given], answers)) == [Finding(given, None, "given")]
    with pytest.raises(KeyError):
        list(find([given._replace(verdict="agrees")], answers))


def test_nothing_differs():
    assert list(differing((*physics_findings(), *section_5_findings()))) == []


@pytest.mark.parametrize("computed", [2.5, None])
def test_what_differs_is_named(computed):
    wrong = section_5_findings()[0]._replace(verdict="differs", computed=computed)
    (line,) = differing([wrong])
    for words in ("P5.1: mean (x=0 1 1 4 5)", "2.2", "2.5" if computed else "nothing", "agrees"):
        assert words in line


def test_a_row_is_what_is_said_of_a_number():
    rows = {finding.published.quantity: row_of(finding) for finding in physics_findings()}
    row = rows["alpha_max, deg"]
    assert (row["printed"], row["computed"]) == (Decimal("28.125"), Decimal("28.1255057"))
    assert (row["difference"], row["tolerance"]) == (Decimal("0.0005057021"), Decimal("0.0005"))
    assert row["verdict"] == "erratum"
    assert rows["lag time, s"]["computed"] is rows["lag time, s"]["difference"] is None
    assert rows["full throw, deg"]["printed"] is rows["full throw, deg"]["difference"] is None


def test_a_filter_by_the_tolerance_finds_the_errata_and_nothing_else():
    for found in (section_5_findings(), physics_findings()):
        rows = [row_of(finding) for finding in found]
        known = [row for row in rows if row["difference"] is not None]
        off = [row for row in known if abs(row["difference"]) > row["tolerance"]]
        assert off == [row for row in rows if row["verdict"] == "erratum"]
