from decimal import Decimal
from importlib.resources import files

import pytest

from evenbreak.source_text.pages import (
    compared,
    contents,
    errata_table,
    filled,
    printed_text,
    slip_blocks,
    verdicts_table,
)
from evenbreak.source_text.published import Erratum, Finding, PublishedNumber

NUMBER = PublishedNumber("P1", "q", "", Decimal("0.90"), Decimal("0.01"), "agrees", "")
SLIP = Erratum("P4.15", "slip", "28.125 degrees", "28.126", "last digit", "By hand.")
REMARK = SLIP._replace(class_="remark")
COPY = SLIP._replace(class_="copy", correct="", kind="scan")


def test_every_place_of_a_template_is_filled():
    class Echo(dict):
        def __missing__(self, name):
            return lambda rest: f"<{name}:{' '.join(rest.split())[:12]}>"

    page = filled("physics", Echo(slips=lambda _: ""))
    assert "{{" not in page
    assert "<verdicts:>" in page
    assert "<numbers:3.6 3.9>" in page
    assert "<figure:1.1 Two ball>" in page
    assert "\n\n\n" not in page


def test_verdicts_are_counted():
    found = [Finding(NUMBER, 0.9, verdict) for verdict in ("agrees", "erratum", "agrees")]
    assert verdicts_table(found).splitlines()[2:] == [
        *("| agrees | 2 |", "| erratum | 1 |", "| all | 3 |")
    ]


def test_cells_of_a_comparison():
    assert compared(Finding(NUMBER, 0.90909, "agrees")) == ["0.90", "0.90909", "agrees"]
    assert compared(Finding(NUMBER, None, "given")) == ["0.90", "", "given"]
    assert compared(Finding(NUMBER, 1.0, "erratum"))[2] == "**erratum**"


def test_a_printed_number_keeps_its_digits_unless_it_is_a_fraction():
    assert printed_text(Decimal("0.90")) == "0.90"
    assert printed_text(Decimal("0.3950617283950617")) == "32/81"
    assert printed_text(Decimal("0.041243638")) == "0.041243638"
    assert printed_text(None) == ""


def test_slips_remarks_and_losses_have_their_own_words():
    assert slip_blocks([SLIP]).startswith("> **Slip: last digit.**")
    assert slip_blocks([REMARK], placed=True).startswith("> P4.15. **Remark: last digit.**")
    assert slip_blocks([COPY]).startswith("> **The copy used.**")
    assert "28.126" in slip_blocks([SLIP])
    assert "\n>\n" in slip_blocks([SLIP, COPY])
    listed = errata_table([SLIP, REMARK, COPY], "slip")
    assert listed.count("\n") == 2
    assert "| P4.15 | 28.125 degrees | 28.126 | last digit | By hand. |" in listed


@pytest.mark.parametrize("section", ["section5", "physics"])
def test_every_section_is_in_the_contents(section):
    page = files("evenbreak.source_text").joinpath(f"templates/{section}.md").read_text("utf-8")
    assert page.count("[contents]") == 1
    links = contents(page).splitlines()
    assert len(links) == len(set(links)) == page.count("\n## ")


@pytest.mark.parametrize(
    ("kind", "shown"), [("printed", "0.90"), ("formula", "(0.90)"), ("words", "(0.90)")]
)
def test_what_is_not_printed_stands_in_parentheses(kind, shown):
    assert compared(Finding(NUMBER._replace(value_is=kind), 0.9, "agrees"))[0] == shown
