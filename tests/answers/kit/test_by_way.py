"""What an answer says about the way that was asked for."""

from evenbreak.answers.kit.by_way import by_way


def quantities(*asked, **more):
    _, found = by_way(*asked, **more)
    return {one.name: one.value for one in found.of}


def test_nothing_is_said_if_no_way_was_asked_for() -> None:
    assert by_way(None, [(0.5, 0.25)]) == []


def test_the_largest_difference_counts_and_what_is_unknown_does_not() -> None:
    pairs = [(0.5, 0.5), (0.25, 0.375), (None, None), (None, 0.9)]
    assert quantities("eigen", pairs) == {"via": "eigen", "kernel_difference": 0.125}
    beside = quantities("eigen", pairs, beside="elimination")
    assert beside == {"via": "eigen", "elimination_difference": 0.125}


def test_a_way_is_not_compared_with_itself() -> None:
    assert quantities("kernel", [(0.5, 0.5)]) == {"via": "kernel", "kernel_difference": None}


def test_rounding_has_no_digits_that_vary_from_computer_to_computer() -> None:
    (_, tiny), (_, large) = (by_way("eigen", [(0.5, 0.5 + d)]) for d in (3e-16, 1e-9))
    shown = [one.text for part in (tiny, large) for one in part.shown()]
    assert shown == ["rounding only", "1.0e-09"]
