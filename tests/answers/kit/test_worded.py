from evenbreak.answers.kit.worded import worded


def test_values_keep_their_order_and_get_their_words():
    values = {"throw_deg": 1.591, "side": 0.5, "miscue": True, "factor": 0.25}
    found = worded(values, {"throw_deg": ("throw", 1)}, {"factor": ("share", 3)})
    assert [one.name for one in found] == list(values)
    assert [one.words for one in found] == ["throw", None, None, "share"]
    assert [one.detail for one in found] == [False, False, False, True]
    assert found[0].show(found[0].value) == "1.6"
    assert found[2].show(found[2].value) == "yes"
    assert found[3].show(found[3].value) == "0.250"
