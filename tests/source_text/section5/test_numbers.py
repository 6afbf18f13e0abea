from evenbreak.source_text.section5.numbers import by_problem, findings


def test_a_table_goes_with_its_problem():
    grouped = by_problem(findings())
    assert {row.published.problem for row in grouped["P5.26"]} == {"Table 5.5"}
    assert {row.published.problem for row in grouped["P5.10"]} == {"P5.10", "Table 5.1"}
    assert sum(map(len, grouped.values())) == len(findings())


def test_findings_are_computed_once():
    assert findings() is findings()
