import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.matches.quantiles import quantile_of
from evenbreak.matches.slow_ends import quantiles_by_doubling

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


def test_what_lies_beyond_is_not_reached() -> None:
    assert quantile_of([0.25, 0.25], 0.5, beyond=0.5) == 1
    assert quantile_of([0.25, 0.2], 0.5, beyond=0.55) is None
    assert quantile_of([0.25, 0.25], 0.75, beyond=0.5) is None
    with pytest.raises(InputError, match=r"q is -0.1, not a probability"):
        quantile_of([1.0], -0.1)


def test_a_tiny_tail_counts_at_the_very_top() -> None:
    assert quantile_of([1.0, 1e-30], 1.0) == 1
    assert quantile_of([1e-30, 1.0], 1e-40) == 0


@given(st.integers(1, 60), st.floats(0.05, 0.95))
def test_doubling_finds_what_counting_finds(trials: int, leave: float) -> None:
    # Two states in a row, then a geometric wait.
    moves = {"a": [("b", 1.0)], "b": [("b", 1.0 - leave), ("over", leave)], "over": []}
    level = 1.0 - (1.0 - leave) ** trials
    if level < 1.0 - 1e-6:
        assert quantiles_by_doubling(moves, "a", [level * (1 - 1e-9)]) == [trials + 1]
        assert quantiles_by_doubling(moves, "a", [level * (1 + 1e-9)]) == [trials + 2]
