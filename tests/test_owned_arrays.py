"""Whoever writes to an array that they gave or were given changes no answer.

The classes are found; `VALUES` has one of each kind that a person makes or asks for, and tries to
write to every array that it was made from, holds, or shows.
"""

import dataclasses
import importlib
import inspect
import re
from collections.abc import Callable, Iterator
from copy import deepcopy
from fractions import Fraction
from functools import cached_property
from typing import Any

import networkx as nx
import numpy as np
from scipy.sparse import csc_array

import evenbreak as eb
from evenbreak.chains import Chain, chain_of, first_passage, spectrum, stochastic_limit
from evenbreak.games import Race, Rack
from evenbreak.handicaps import margin_system, match_table
from evenbreak.league import FixedSchedule, LeaguePlayers
from evenbreak.matches import MatchMinutes, match_length
from evenbreak.physics import Ball, Cloth, Slide
from evenbreak.practice import DrillLog
from evenbreak.ratings import Beginning, Results, Roster
from evenbreak.teams import Squad, TeamNight, TeamSeason
from places import SRC
from rows import each_of

ARRAYS = re.compile(r"Floats|Ints|Bools|Places|NDArray|cs[cr]_array")
ROOMS = sorted(stub.parent.name for stub in SRC.glob("*/__init__.pyi"))


def classes() -> Iterator[tuple[str, type]]:
    for room in ROOMS:
        package = importlib.import_module(f"evenbreak.{room}")
        for name in dir(package):
            found = getattr(package, name)
            is_class = inspect.isclass(found) and dataclasses.is_dataclass(found)
            fields = dataclasses.fields(found) if is_class else ()
            if any(ARRAYS.search(str(field.type)) for field in fields):
                yield f"{room}.{name}", found


CLASSES = dict(classes())


@each_of("name", CLASSES)
def test_a_public_class_with_arrays_owns_them(name: str) -> None:
    assert hasattr(vars(CLASSES[name])["__init__"], "__wrapped__"), "decorate it with own_arrays"


def matrix() -> csc_array:
    given = csc_array(np.array([[0.5, 0.25], [0.5, 0.75]]))
    assert given.has_canonical_format  # which is what is kept without a conversion
    return given


def graph() -> nx.DiGraph:
    made = nx.DiGraph()
    made.add_edge("a", "b", probability=0.5)
    made.add_edge("a", "a", probability=0.5)
    made.add_edge("b", "a", probability=1.0)
    return made


NIGHT = {
    "player_a": [0, 1],
    "player_b": [1, 2],
    "score_a": [7, 3],
    "score_b": [5, 7],
    "race_a": [7, 7],
    "race_b": [7, 7],
}

VALUES: dict[str, tuple[Callable[..., Any], dict[str, Any]]] = {
    "chain": (lambda m, s: Chain(s, m, s[0]), {"m": matrix(), "s": ["a", "b"]}),
    "chain of fractions": (
        lambda given: Chain("ab", matrix(), given=given),
        {"given": {(0, 0): Fraction(1, 2)}},
    ),
    "chain of a dense matrix": (
        lambda m: Chain("ab", m),
        {"m": np.array([[0.5, 0.25], [0.5, 0.75]])},
    ),
    "chain of a graph": (lambda g: chain_of(g, start="a"), {"g": graph()}),
    "limit": (lambda m: stochastic_limit(Chain("ab", m, "a")), {"m": matrix()}),
    "spectrum": (lambda m: spectrum(Chain("ab", m, "a")), {"m": matrix()}),
    "passage": (lambda m: first_passage(Chain("ab", m, "a"), "a", "b"), {"m": matrix()}),
    "structure": (lambda m: Chain("ab", m, "a").structure, {"m": matrix()}),
    "arcs": (lambda m: Chain("ab", m, "a").arcs, {"m": matrix()}),
    "rack": (Rack, {"p1": np.array([0.5, 0.25]), "p2": np.array([0.5, 0.75])}),
    "length": (
        lambda p: match_length(Race(3, 2, Rack(p))),
        {"p": np.array([0.5, 0.25])},
    ),
    "minutes": (
        MatchMinutes,
        {"probability": np.array([0.5, 0.5]), "means": np.array([20.0, 30.0]), "log_sd": 0.2},
    ),
    "results": (
        lambda **columns: Results(("Ann", "Bo", "Cy"), **columns),
        {name: np.array(column) for name, column in NIGHT.items()},
    ),
    "ratings": (
        lambda **columns: eb.fit(Results(("Ann", "Bo", "Cy"), **columns)),
        {name: np.array(column) for name, column in NIGHT.items()},
    ),
    "roster": (
        lambda r, e: Roster(["Ann", "Bo"], r, e),
        {"r": np.array([80.0, 70.0]), "e": np.array([5.0, 6.0])},
    ),
    "beginning": (lambda r: Beginning(["Ann", "Bo"], r), {"r": np.array([80.0, 70.0])}),
    "players": (LeaguePlayers.of, {"rating": np.array([80, 70]), "skill": np.array([80.0, 75.0])}),
    "schedule": (
        FixedSchedule,
        {"week": np.array([1, 1]), "a": np.array([0, 2]), "b": np.array([1, 3])},
    ),
    "slide": (
        lambda **start: Slide(Ball(), Cloth(), **start),
        {"position": np.zeros(2), "velocity": np.ones(2), "spin": np.zeros(3)},
    ),
    "drill log": (
        DrillLog,
        {"level": np.array([1, 2]), "success": np.array([True, False])},
    ),
    "team night": (
        lambda laws: TeamNight(Squad(("Ann", "Bo")), Squad(("Cy", "Di")), laws, sets=2),
        {"laws": np.full((2, 2, 2, 3), [[0.25, 0.0, 0.25], [0.25, 0.0, 0.25]])},
    ),
    "match table": (lambda: match_table(margin_system(2), eb.chart("npl_10")), {}),
    "team season": (
        lambda **given: TeamSeason(["A", "B"], **given),
        {
            "played": np.array([[0, 1, 3, 2]]),
            "to_come": np.array([[1, 0]]),
            "scores": np.array([[3, 2], [2, 3]]),
            "chances": np.array([[0.5, 0.5]]),
        },
    ),
}


def arrays_of(value: Any) -> Iterator[np.ndarray]:
    """Yield the arrays in a value, a list of them or a sparse matrix."""
    if isinstance(value, np.ndarray):
        yield value
    elif hasattr(value, "indptr") and hasattr(value, "data"):
        yield from (value.data, value.indices, value.indptr)
    elif isinstance(value, tuple | list):
        for one in value[:20]:
            yield from arrays_of(one)


def shown(value: Any) -> dict[str, Any]:
    """Return what a value shows: its fields and its properties."""
    names = [field.name for field in dataclasses.fields(value)] + [
        name
        for name, one in inspect.getmembers(type(value))
        if isinstance(one, property | cached_property) and not name.startswith("_")
    ]
    return {name: getattr(value, name) for name in names}


def content(value: Any) -> Any:
    """Return all numbers in a value, to compare."""
    if dataclasses.is_dataclass(value):
        return {name: content(part) for name, part in shown(value).items()}
    if isinstance(value, dict):
        return {name: content(part) for name, part in value.items()}
    arrays = [array.tolist() for array in arrays_of(value)]
    return arrays or (value if isinstance(value, str | int | float | tuple) else None)


@each_of("name", VALUES)
def test_writing_to_what_a_value_was_made_from_changes_nothing(name: str) -> None:
    make, given = VALUES[name][0], deepcopy(VALUES[name][1])
    late, early = make(**given), make(**given)
    before = repr(content(early))
    for one in given.values():
        for array in arrays_of(one):
            array[...] = 0
        if isinstance(one, list):
            one.reverse()
        elif isinstance(one, dict | nx.Graph):
            one.clear()
    assert repr(content(early)) == before
    assert repr(content(late)) == before  # what it remembers is found out only now


@each_of("name", VALUES)
def test_writing_to_what_a_value_shows_changes_nothing(name: str) -> None:
    make, given = VALUES[name][0], deepcopy(VALUES[name][1])
    value = make(**given)
    before = repr(content(value))
    for part in shown(value).values():
        for array in arrays_of(part):
            if array.flags.writeable:
                array[...] = 0
    assert repr(content(value)) == before
