import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.matches.crossings import form_roots, sign_at
from evenbreak.matches.win_formula import product

PLACES = st.lists(st.integers(1, 1023), max_size=7, unique=True)


def with_zeros(places, other=(1,)):
    form = list(other)
    for place in places:  # p = place / 1024: (1024 - place) p - place q
        form = product(form, [-place, 1024 - place])
    return form


@given(PLACES, st.lists(st.integers(1, 50), min_size=1, max_size=6))
def test_every_zero_is_found_and_no_other(places, other):
    assert form_roots(with_zeros(places, other)) == sorted(place / 1024 for place in places)


@given(st.integers(1, 1023), st.integers(2, 4))
def test_a_zero_of_any_order_is_told_once(place, order):
    (found,) = form_roots(with_zeros([place] * order))
    assert found == pytest.approx(place / 1024, abs=1e-13)


def test_a_touch_that_no_float_holds_is_found():
    third = product([-1, 2], [-1, 2])  # (2p - q)^2 is zero at p = 1/3 and negative nowhere
    assert form_roots(third) == [pytest.approx(1 / 3, abs=1e-13)]
    assert (
        form_roots([x + y for x, y in zip([10**6 * c for c in third], [1, 0, 0], strict=True)])
        == []
    )


def test_zeros_that_grids_miss():
    near = [500_000_000, 500_000_001]
    form = [1]
    for place in near:
        form = product(form, [-place, 10**9 - place])
    assert form_roots(form) == [place / 10**9 for place in near]


def test_none_and_everywhere():
    assert form_roots([3, 1, 2]) == []
    assert form_roots([0, 0, 0]) is None
    assert form_roots([0, -2, 1, 0]) == [2 / 3]


@given(PLACES, st.floats(0.01, 0.99))
def test_signs(places, p):
    exact = 1
    for place in places:
        exact *= (p > place / 1024) - (p < place / 1024)
    assert sign_at(with_zeros(places), p) == exact
