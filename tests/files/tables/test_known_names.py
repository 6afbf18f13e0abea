import pytest

from evenbreak.files.tables.names import KnownNames

NAMES = KnownNames(["Ann", "Bo Lee", "Cy", "cy", "Lee, Di"])


@pytest.mark.parametrize(
    ("name", "place"),
    [("Ann", 0), ("ann", 0), ("BO LEE", 1), ("Cy", 2), ("cy", 3), ("CY", None), ("Ed", None)],
)
def test_case_may_differ_where_that_leaves_no_doubt(name, place):
    assert NAMES.place(name) == place


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("CY", ["'Cy'", "'cy'"]),
        ("Bo Lea", ["'Bo Lee'"]),
        ("lee", ["'Bo Lee'", "'Lee, Di'"]),
        ("Xaver", []),
        ("", []),
    ],
)
def test_a_hint_names_what_may_have_been_meant(name, meant):
    hint = NAMES.hint(name)
    assert [
        one for one in ("'Ann'", "'Bo Lee'", "'Cy'", "'cy'", "'Lee, Di'") if one in hint
    ] == meant
    assert bool(hint) == bool(meant)
