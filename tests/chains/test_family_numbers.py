"""Numbers that pass for one: what they answer, and what they refuse to answer."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from evenbreak.chains.family_numbers import Disagreement, Numbers


def test_arithmetic_goes_entry_by_entry() -> None:
    p = Numbers(np.array([0.25, 0.5]))
    assert (2 * p**2 - p / (1 + p)).values.tolist() == [0.125 - 0.2, 0.5 - 1 / 3]
    assert np.where(p < 0.5, p, 0.0).values.tolist() == [0.25, 0.0]  # type: ignore[call-overload]


def test_comparisons_answer_when_all_agree_and_say_who_differs() -> None:
    p = Numbers(np.array([0.25, 0.5, 0.75]))
    assert 0.0 < p <= 1.0
    assert not p > 1.0
    with pytest.raises(Disagreement) as who:
        bool(p >= 0.5)
    assert who.value.true is not None
    assert who.value.true.tolist() == [False, True, True]


@pytest.mark.parametrize("use", [float, int, str, repr, round, math.sqrt, "{:.2f}".format, list])
def test_what_needs_one_number_is_refused(use: Callable[[Any], Any]) -> None:
    with pytest.raises((Disagreement, TypeError)):
        use(Numbers(np.array([0.25, 0.5])))


def test_arrays_and_other_functions_are_refused() -> None:
    p = Numbers(np.array([0.25, 0.5]))
    for use in (lambda: p * np.ones(2), lambda: np.add.reduce(p), lambda: np.sort(p), lambda: {p}):
        with pytest.raises((Disagreement, TypeError)):
            use()
