from evenbreak.source_text.answers import section_5_findings
from evenbreak.source_text.section5.order import by_problem, place_of


def test_a_table_goes_with_its_problem():
    grouped = by_problem(section_5_findings())
    assert {row.published.problem for row in grouped["P5.26"]} == {"Table 5.5"}
    assert {row.published.problem for row in grouped["P5.10"]} == {"P5.10", "Table 5.1"}
    assert sum(map(len, grouped.values())) == len(section_5_findings())


def test_numbers_come_in_the_order_of_the_text_a_table_after_its_problem():
    rows = [finding.published for finding in section_5_findings()]
    assert rows == sorted(rows, key=place_of)
    problems = [row.problem for row in rows]
    assert problems.index("Table 5.1") > problems.index("P5.10")
    assert problems.index("NPL") > problems.index("Table 5.5")
