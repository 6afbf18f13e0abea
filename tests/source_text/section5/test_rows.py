from evenbreak.source_text.section5.rows import Row


def test_a_row_may_do_without_a_note():
    row = Row("formula: mean", "", "p / q")
    assert (row.quantity, row.inputs, row.computed, row.note) == ("formula: mean", "", "p / q", "")
