from evenbreak.cli.kit.output import aligned


def test_wide_letters_take_their_columns():
    rows = [["Ann", "5"], ["🎱 Bo", "12"], ["李娜", "3"], ["Zoe\u0308", "4"]]
    assert aligned(rows).splitlines() == [
        "  Ann     5",
        "  🎱 Bo  12",
        "  李娜    3",
        "  Zoe\u0308     4",
    ]


def test_flush_right_too():
    assert aligned([["🎱", "1"], ["abc", "2"]], left=0) == "   🎱  1\n  abc  2\n"
