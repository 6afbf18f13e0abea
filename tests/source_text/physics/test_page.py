import re

import pytest

from evenbreak.source_text.answers import physics_findings
from evenbreak.source_text.pages import place_of
from evenbreak.source_text.published import physics_errata
from evenbreak.source_text.reproduce import figures, physics_tables

FIGURES = [name for name in figures() if name < "figure_5"]


@pytest.fixture(scope="module")
def page(reports):
    return reports["physics.md"].decode()


def test_all_figures_and_tables_are_linked(page):
    linked = set(re.findall(r"\]\(([^)#]+)\)", page))
    drawn = {f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg")}
    assert linked == {"index.md"} | drawn | {f"{name}.csv" for name in physics_tables()}


def test_no_place_is_left_open(page):
    assert "{{" not in page
    assert "}}" not in page


def test_every_number_stands_once(page):
    rows = re.findall(r"^\| `([^`]+)` \| ([^|]+) \| ([^|]*) \|", page, re.MULTILINE)
    found = sorted((problem, name, inputs.strip()) for name, problem, inputs in rows)
    assert found == sorted(finding.published[:3] for finding in physics_findings())


def test_every_slip_stands_where_it_occurs_and_in_the_list(page):
    body, _, listed = page.partition("## Slips of sections 1 to 4")
    for slip in physics_errata():
        assert body.count(slip.why) == 1, slip.where
        assert listed.count(slip.why) == 1, slip.where
    parts = re.split(r"\n### .*\n", listed)
    for part, class_ in zip(parts, ("slip", "remark", "copy"), strict=True):
        assert part.count("\n|") == sum(slip.class_ == class_ for slip in physics_errata()) + 2


def test_figures_come_in_order_and_have_words(page):
    assert re.findall(r"\*\*Figure (\d\.\d)\.\*\*", page) == [
        name.removeprefix("figure_").replace("_", ".") for name in sorted(FIGURES)
    ]
    assert all(len(words) > 60 for words in re.findall(r"!\[([^]]+)\]", page))


def test_tables_are_even(page):
    for block in re.findall(r"(?:^\|.*\n)+", page, re.MULTILINE):
        assert len({line.count("|") for line in block.splitlines()}) == 1, block


def test_numbers_in_the_page_are_the_computed_ones(page):
    assert "| `table speed` | P1.5 | t=7.00s | 96.7 | 96.7468 | agrees |" in page
    assert "| `V_NR/V_0` | P2.2 | J=-1 | 3/7 | 0.428571 | agrees |" in page
    assert "| `lag time, s` | P1.5 |  | 7.00 |  | given |" in page
    assert "| `alpha_max, deg` | P4.15 |  | 28.125 | 28.1255 | **erratum** |" in page
    assert "| `I_xy/(M R^2), integrated` | P1.3 |  | 0 | 0 | agrees |" in page
    assert "> P4.15. **Slip: last digit.** The text: 28.125 degrees. Right: 28.126." in page


@pytest.mark.parametrize(
    ("where", "place"),
    [("P3.6", (3, 6)), ("Rolling resistance, before P1.5", (1, 5)), ("Section 4", (4, 0))],
)
def test_places(where, place):
    assert place_of(where) == place
