"""The hierarchy of errors, and what code that does not know it can catch."""

import pickle

import pytest

from evenbreak import errors
from evenbreak.errors import DataError, EvenbreakError

KINDS = [
    kind
    for kind in vars(errors).values()
    if isinstance(kind, type) and issubclass(kind, EvenbreakError) and kind is not EvenbreakError
]


@pytest.mark.parametrize("kind", KINDS)
def test_every_error_is_also_one_of_pythons(kind: type[EvenbreakError]) -> None:
    assert issubclass(kind, (ValueError, ArithmeticError, RuntimeError))


def test_a_data_error_lists_its_problems() -> None:
    error = DataError(line for line in ["r.csv:2: x", "r.csv:3: y"])
    assert error.problems == ("r.csv:2: x", "r.csv:3: y")
    assert str(error) == "r.csv:2: x\nr.csv:3: y"


@pytest.mark.parametrize("kind", KINDS)
def test_an_error_comes_back_from_another_process(kind: type[EvenbreakError]) -> None:
    error = kind(["a", "b"]) if kind is DataError else kind("wrong")
    back = pickle.loads(pickle.dumps(error))  # noqa: S301
    assert type(back) is kind
    assert (str(back), vars(back)) == (str(error), vars(error))
