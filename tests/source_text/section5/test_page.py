import re

import pytest

from evenbreak.source_text.pages import slips_of
from evenbreak.source_text.published import errata
from evenbreak.source_text.reproduce import figures, section_5_tables

FIGURES = [name for name in figures() if name.startswith(("figure_5", "figure_p5"))]


@pytest.fixture(scope="module")
def page(reports):
    return reports["index.md"].decode()


@pytest.fixture(scope="module")
def written():
    pictures = {f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg")}
    return {f"{name}.csv" for name in section_5_tables()} | pictures


def test_all_files_are_linked_and_all_links_lead_to_a_file(page, written):
    linked = set(re.findall(r"\]\(([^)#]+)\)", page))
    assert linked == written | {"physics.md"}


def test_no_place_is_left_open(page):
    assert "{{" not in page
    assert "}}" not in page


def test_every_figure_is_shown_with_words_for_those_who_do_not_see_it(page):
    shown = {name: words for words, name in re.findall(r"!\[([^]]+)\]\((\w+)\.png\)", page)}
    assert set(shown) == set(FIGURES)
    assert all(len(words) > 60 for words in shown.values())


def test_figures_tables_and_problems_come_in_order(page):
    for pattern in (r"\*\*Table 5\.(\d)\.\*\*", r"problem_5_(\d\d)\.csv"):
        numbers = [int(number) for number in re.findall(pattern, page)]
        first = list(dict.fromkeys(numbers))
        assert first == sorted(first), pattern
    assert len(re.findall(r"\*\*Table 5\.\d\.\*\*", page)) == 6
    assert len(re.findall(r"\*\*Figure 5\.\d+\.\*\*", page)) == 11


def test_every_slip_is_named_where_it_occurs_and_in_the_list(page):
    body, _, listed = page.partition("## Slips of the text")
    parts = re.split(r"\n### .*\n", listed)
    for part, class_ in zip(parts, ("slip", "remark", "copy"), strict=True):
        of_class = [slip for slip in errata() if slip.class_ == class_]
        assert part.count("\n|") == len(of_class) + 2
        assert all(slip.why.replace("|", "&#124;") in part for slip in of_class)
    for slip in errata():
        assert slip.why in body, slip.where


def test_tables_are_even(page):
    for block in re.findall(r"(?:^\|.*\n)+", page, re.MULTILINE):
        widths = {line.count("|") for line in block.splitlines()}
        assert len(widths) == 1, block


def test_numbers_in_the_page_are_the_computed_ones(page):
    assert "| 0.96 | 24.0 | 16.0 (text: 15.9) | 16 | 0.667 |" in page
    assert "| 10 | 0.95 | 0.94 | 0.545 (text: 0.54) | 0.503 | 0.505 |" in page
    assert "| 20 | 2 points | 3.668 | 3.697 |" in page
    assert "| p where W(p;2,1)=W(p;4,2) |  | 0.641 | 0.640388 | **erratum** |" in page
    assert "| W(p;2,1) | p=.641 | 0.411 | 0.410881 | agrees |" in page
    assert "| **4** | 1 | 4 | 6 | 4 | 1 |" in page
    assert "| N=120 p=0.52 | 61.92 | 62 | 1 | 62.4 | 5.47284 |" in page
    assert "| N=3 p=1/2 | 1 | 1 | 2 | 1.5 | 0.866025 |" in page
    assert "the eigenvalues of M are 1.0000, 1.0000, 0.3464, −0.3464" in page
    assert "| **S1** | 0 | 0 | q2 | 0 |" in page
    assert "| from S1: limit | 0.4545 | 0.0000 | 0.0000 | 0.5455 |" in page


def test_remarks_are_not_called_slips(page):
    assert "> **Remark: numerical trap.**" in page
    assert "> **Remark: condition too narrow.**" in page
    assert "> **Slip: last digit.**" in page
    assert page.count("> **The copy used.**") == 2


def test_slips_are_found_by_whole_numbers():
    assert [slip.where for slip in slips_of("P5.1")] == ["Median, before P5.1"]
    assert slips_of("P5.14") == [slip for slip in slips_of("P5.17") if "P5.14" in slip.where]
