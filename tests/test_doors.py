"""Plain mistakes at the doors of the library: a wrong kind of thing is named, not a traceback."""

import importlib
import inspect
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import evenbreak as eb
from evenbreak.errors import EvenbreakError
from rows import each_of

WRONG = ([], [("A", "B", 1.0)], "x", 5, None, {"a": 1})
TAKES = ("Chain", "Results")


def functions() -> Iterator[tuple[str, Callable[..., Any]]]:
    for room in ("chains", "ratings", "league", "matches", "practice", "handicaps"):
        package = importlib.import_module(f"evenbreak.{room}")
        for name in dir(package):
            found = getattr(package, name)
            if not inspect.isfunction(found):
                continue
            first = next(iter(inspect.signature(found).parameters.values()), None)
            if first is not None and first.annotation in TAKES:
                yield f"{room}.{name}", found


FUNCTIONS = dict(functions())


def test_the_functions_are_found() -> None:
    assert {"chains.mixing_time", "chains.stochastic_limit", "ratings.fit"} <= set(FUNCTIONS)


@each_of("name", FUNCTIONS)
def test_what_is_not_a_chain_or_results_is_named(name: str) -> None:
    function = FUNCTIONS[name]
    needed = [
        parameter
        for parameter in inspect.signature(function).parameters.values()
        if parameter.default is parameter.empty
    ][1:]
    others = {parameter.name: "x" for parameter in needed}
    for wrong in WRONG:
        first = next(iter(inspect.signature(function).parameters))
        with pytest.raises(EvenbreakError, match=f"this is {type(wrong).__name__}"):
            function(**{first: wrong}, **others)


@pytest.mark.parametrize(
    "mistake",
    [
        lambda: eb.fit([("Ann", "Bo", 7, 5)]),
        lambda: eb.validate("season.csv"),
        lambda: eb.stochastic_limit([("A", "B", 1.0)]),
        lambda: eb.mixing_time(5),
    ],
)
def test_the_error_says_what_to_give(mistake: Callable[[], Any]) -> None:
    with pytest.raises(EvenbreakError, match=r"chain_of|from_frame"):
        mistake()
