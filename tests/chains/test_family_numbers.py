"""Numbers that pass for one: what they answer, and what they refuse to answer."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from evenbreak.chains.family_numbers import Disagreement, Numbers, Program, Record


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


def test_a_program_repeats_what_was_done_in_little_memory() -> None:
    record, draw = Record(), np.random.default_rng(1)

    def work(x: Any, y: Any) -> list[Any]:
        terms = [x]
        for k in range(200):
            terms = [*terms[-2:], terms[-1] * y + k / (1.0 + x)]
        kept = np.where(x < y, terms[-1], terms[-2])
        return [kept, x, 0.5, (1.0 + x) * (1.0 + x)]

    x, y = draw.random((2, 50))
    outputs = work(Numbers(x, record), Numbers(y, record))
    program = Program(record, outputs)
    assert len(program._registers) < 250  # most of them are the constants k
    for size in (64, 7):
        x, y = draw.random((2, size))
        found = program.run([x, y])
        assert found is not None
        for one, other in zip(found, work(x, y), strict=True):
            np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize(
    ("ask", "others"),
    [
        (lambda p: p > 0.5, [0.7, 0.5]),
        (lambda p: p >= 0.6, [0.7, 0.59]),
        (lambda p: p < 0.5, [0.7, 0.4]),
        (lambda p: p >= 0.9, [0.7, 0.95]),
        (lambda p: p == 0.25, [0.7, 0.25]),
        (lambda p: p != 0.25, [0.7, 0.25]),
        (lambda p: p > 1.0 - p, [0.7, 0.3]),
        (lambda p: p * p > 0.25, [0.7, 0.5]),
        (lambda p: p - 0.5, [0.7, 0.5]),
    ],
)
def test_a_program_asks_again(ask: Callable[[Any], Any], others: list[float]) -> None:
    record = Record()
    p = Numbers(np.array([0.6, 0.8]), record)
    assert bool(ask(p)) == bool(ask(0.6))
    program = Program(record, [2.0 * p])
    again = program.run([np.array([0.65, 0.7])])
    assert again is not None
    assert again[0].tolist() == [1.3, 1.4]
    assert program.run([np.array(others)]) is None


def test_numbers_of_which_some_are_nan_do_not_agree() -> None:
    with pytest.raises(Disagreement) as who:
        bool(Numbers(np.array([0.6, math.nan])) < 1.0)
    assert who.value.true is not None
    assert who.value.true.tolist() == [True, False]
    assert not Numbers(np.array([math.nan, math.nan])) < 1.0
