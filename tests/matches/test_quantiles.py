import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.matches.quantiles import quantile_of

WEIGHTS = st.lists(st.integers(0, 5), min_size=1, max_size=12).filter(any)


@given(WEIGHTS, st.integers(0, 20))
def test_ties_are_decided_as_on_paper(weights: list[int], twentieths: int) -> None:
    total = sum(weights)
    exact = next(
        k
        for k in range(len(weights))
        if weights[k] and 20 * sum(weights[: k + 1]) >= twentieths * total
    )
    assert quantile_of([w / total for w in weights], twentieths / 20) == exact


def test_a_tiny_tail_counts_at_the_very_top() -> None:
    assert quantile_of([1.0, 1e-30], 1.0) == 1
    assert quantile_of([1e-30, 1.0], 1e-40) == 0


def test_a_level_must_be_a_probability() -> None:
    with pytest.raises(InputError, match=r"gave -0\.1"):
        quantile_of([1.0], -0.1)
