"""The arrays of a race are its walked graph, state by state and arc by arc."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.game import ArcArrays, arcs_of
from evenbreak.games import BREAK_FORMATS, Race, Rack
from evenbreak.games.race_arcs import ScoreStates

CHANCES = st.sampled_from([0.0, 1e-300, 1 / 3, 0.5, 1.0])


def as_dict(arcs: ArcArrays) -> dict[object, dict[object, float]]:
    states = list(arcs.states)
    law: dict[object, dict[object, float]] = {state: {} for state in states}
    for j, i, p in zip(*(column.tolist() for column in arcs[1:]), strict=True):
        law[states[j]][states[i]] = p
    return law


def odd_format(breaker: int, winner: int) -> int:
    """Return a format of one's own: whoever breaks and wins goes on, else player 2 breaks."""
    return breaker if breaker == winner else 2


@st.composite
def races(draw: st.DrawFn) -> Race:
    m, n = draw(st.integers(1, 7)), draw(st.integers(1, 7))
    rack = draw(st.builds(Rack, CHANCES) | st.builds(Rack, CHANCES, CHANCES))
    return Race(
        m,
        n,
        rack,
        breaks=draw(st.sampled_from([*BREAK_FORMATS.values(), odd_format])),
        first_breaker=draw(st.sampled_from([1, 2])),
        score=(draw(st.integers(0, m - 1)), draw(st.integers(0, n - 1))),
    )


@given(races())
def test_arrays_are_the_walked_graph(race: Race) -> None:
    arcs = race.arcs()
    assert arcs is not None
    assert as_dict(arcs) == as_dict(arcs_of(Unaided(race)))
    assert arcs.states[0] == race.start


@given(races())
def test_arcs_lead_forward_and_come_sorted(race: Race) -> None:
    arcs = race.arcs()
    assert arcs is not None
    assert (arcs.sources < arcs.targets).all()
    key = arcs.sources * len(arcs.states) + arcs.targets
    assert (np.diff(key) > 0).all()
    racks = [state[0] + state[1] for state in arcs.states]
    assert racks == sorted(racks)


class Unaided:
    """A race that offers no arrays."""

    def __init__(self, race: Race) -> None:
        self.start, self.moves, self.winner = race.start, race.moves, race.winner


@pytest.mark.parametrize("score", [(3, 1), (1, 2), (3, 0)])
def test_a_race_that_is_over(score: tuple[int, int]) -> None:
    arcs = Race(3, 2, Rack(0.5), score=score).arcs()
    assert arcs is not None
    assert list(arcs.states) == [score]
    assert arcs.sources.size == 0


def test_other_races_have_no_arrays() -> None:
    assert Race(3, 3, Rack(0.5), win_by=2).arcs() is None
    assert Race(3, 3, Race(2, 2, Rack(0.5))).arcs() is None


def test_states_are_made_when_asked_for() -> None:
    cells = np.array([0, 0, 1, 1]), np.array([0, 1, 0, 1])
    states = ScoreStates(*cells, np.array([0, 3, 4, 7]), with_breaker=True)
    listed = [(0, 0, 1), (0, 1, 2), (1, 0, 1), (1, 1, 2)]
    assert list(states) == listed
    assert len(states) == 4
    assert states[-1] == (1, 1, 2)
    assert states[1:3] == listed[1:3]
    assert states[::-1] == listed[::-1]
    assert [states.index(state) for state in listed] == [0, 1, 2, 3]
    assert states.index((1, 0, 1), 1, 3) == 2
    assert all(type(entry) is int for state in (*states, states[0]) for entry in state)
    for absent in ((9, 9, 9), (0, 0), "AB", None, (0, 0, "x")):
        assert absent not in states
    with pytest.raises(IndexError):
        states[4]
    with pytest.raises(ValueError, match=r"1\) isn't a state"):
        states.index((0, 0, 1), 1)
