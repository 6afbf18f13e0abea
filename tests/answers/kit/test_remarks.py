from evenbreak.answers.kit.remarks import Remark, Remarks


def test_many_names_are_cut_and_counted():
    remark = Remark("8 players without a result", "rated at the mean", [f"P{k}" for k in range(8)])
    assert str(remark).endswith("(P0, P1, P2, P3, P4 and 3 more): rated at the mean.")
    assert (list(remark.shown_names), remark.more_names) == (["P0", "P1", "P2", "P3", "P4"], 3)


def test_remarks_are_a_paragraph_that_knows_its_items():
    remark = Remark("New", "treated as 80")
    assert Remarks([remark], "Assumed") == "Assumed:\n- New: treated as 80."
    assert Remarks([remark, remark]).items == (remark, remark)
