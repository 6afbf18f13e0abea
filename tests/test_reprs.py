"""No public result prints its arrays: a notebook shows each on a line or two."""

import dataclasses
import importlib
import inspect
import re
from collections.abc import Iterator

import numpy as np

from evenbreak import games
from evenbreak.chains import chain_of, spectrum, stochastic_limit
from evenbreak.games import CATALOG, Drill, Race, Rack, winner_breaks
from evenbreak.matches import final_scores, match_length
from rows import each_of

ROOMS = (
    "answers",
    "chains",
    "files",
    "games",
    "handicaps",
    "league",
    "matches",
    "practice",
    "ratings",
)
ARRAYS = re.compile(r"Floats|Ints|Bools|NDArray|DataFrame|csc_array|MeanT|ChanceT")


def classes() -> Iterator[tuple[str, type]]:
    for room in ROOMS:
        package = importlib.import_module(f"evenbreak.{room}")
        for name in dir(package):
            found = getattr(package, name)
            if inspect.isclass(found) and dataclasses.is_dataclass(found):
                shown = [field for field in dataclasses.fields(found) if field.repr]
                if any(ARRAYS.search(str(field.type)) for field in shown):
                    yield f"{room}.{name}", found


CLASSES = dict(classes())


@each_of("name", CLASSES)
def test_results_with_arrays_have_a_repr_of_their_own(name: str) -> None:
    assert not hasattr(CLASSES[name].__repr__, "__wrapped__")


@each_of(
    "value",
    [
        match_length(Race(50, 50, Rack(0.6))),
        match_length(Race(50, 50, Rack(np.linspace(0, 1, 99)))),
        final_scores(Race(50, 50, Rack(0.6))),
        spectrum(chain_of(Drill.progressive(0.8, levels=40))),
        chain_of(Race(7, 7, Rack(0.6))),
        chain_of(Race(7, 7, Rack(0.6))).states,
        chain_of(Race(7, 7, Rack(0.6))).structure,
        chain_of(Race(7, 7, Rack(0.6))).arcs,
        chain_of(Race(7, 7, Rack(0.6))).transient,
        Race(7, 7, Rack(np.linspace(0, 1, 99), 0.5), breaks=winner_breaks),
        stochastic_limit(chain_of(Race(7, 7, Rack(0.6)))),
    ],
)
def test_reprs_are_short(value: object) -> None:
    assert len(repr(value)) < 600
    assert "array(" not in repr(value)
    assert " at 0x" not in repr(value)


@each_of("name", CATALOG)
def test_a_game_is_written_so_that_python_reads_it_back(name: str) -> None:
    named = {public: getattr(games, public) for public in games.__all__}
    assert eval(repr(CATALOG[name]), named) == CATALOG[name]  # noqa: S307
