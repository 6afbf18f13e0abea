"""Diagrams of games, made by a walk or from the game's own arrays."""

from collections.abc import Callable

import numpy as np
import pytest

from evenbreak.errors import GameError, InputError
from evenbreak.game import ArcArrays, Game, arcs_of, graph_of
from evenbreak.games import (
    Ahead,
    Drill,
    OneBall,
    OneBallLookAhead,
    Race,
    Rack,
    Series,
    winner_breaks,
)


class Coin:
    """Toss until heads; the game may offer arrays of its own."""

    start = "toss"

    def __init__(self, arcs: ArcArrays | None = None) -> None:
        self._arcs = arcs
        self.asked = 0

    def moves(self, state: str) -> dict[str, float]:
        self.asked += 1
        return {"toss": 0.5, "heads": 0.5} if state == "toss" else {}

    def winner(self, state: str) -> int | None:
        return 1 if state == "heads" else None

    def arcs(self) -> ArcArrays | None:
        return self._arcs


def test_what_is_a_game() -> None:
    assert isinstance(Coin(), Game)
    assert not isinstance("a string", Game)


def test_a_diagram() -> None:
    graph = graph_of(Coin())
    assert dict(graph.nodes(data=True)) == {
        "toss": {"kind": "start", "winner": None},
        "heads": {"kind": "terminal", "winner": 1},
    }
    assert list(graph.edges(data="probability")) == [
        ("toss", "toss", 0.5),
        ("toss", "heads", 0.5),
    ]


def test_the_games_own_arrays_are_taken() -> None:
    arrays = ArcArrays(["toss", "heads"], np.array([0, 0]), np.array([0, 1]), np.array([0.5, 0.5]))
    game = Coin(arrays)
    assert arcs_of(game) is arrays
    assert list(graph_of(game)["toss"]) == ["toss", "heads"]
    assert game.asked == 0


def test_a_game_that_declines_to_give_arrays_is_walked() -> None:
    game = Coin()
    assert list(arcs_of(game).states) == ["toss", "heads"]
    assert game.asked == 2


def test_another_start_is_walked() -> None:
    assert list(arcs_of(Race(2, 2, Rack(0.5)), start=(1, 1)).states) == [(1, 1), (2, 1), (1, 2)]


def test_moves_of_probability_zero_are_left_out() -> None:
    assert list(graph_of(OneBall(0, 1)).edges) == [("S1", "S2"), ("S2", "L")]
    assert "W1" not in graph_of(OneBallLookAhead([0.0, 0.5]))


def test_a_game_that_is_over_has_one_terminal_state() -> None:
    graph = graph_of(Race(3, 2, Rack(0.5), score=(1, 2)))
    assert dict(graph.nodes(data=True)) == {(1, 2): {"kind": "terminal", "winner": 2}}


def test_the_most_states() -> None:
    race = Race(3, 3, Rack(0.5))
    assert len(graph_of(race, max_states=15)) == 15
    with pytest.raises(GameError, match="more than 14 states"):
        graph_of(race, max_states=14)


@pytest.mark.parametrize(
    "make",
    [
        lambda: Race(3, 3, Rack([0.4, 0.5])),
        lambda: Race(3, 3, Rack([0.4, 0.5]), win_by=2),
        lambda: Race(2, 2, Race(2, 2, Rack([0.4, 0.5]))),
        lambda: Race(2, 2, Rack(0.5, [0.4, 0.5]), breaks=winner_breaks),
        lambda: Ahead(2, 2, Rack([0.4, 0.5])),
        lambda: Series(Rack([0.4, 0.5], 0.5), breaks=winner_breaks),
        lambda: OneBall([0.4, 0.5], 0.5),  # type: ignore[arg-type]
        lambda: OneBallLookAhead([0.4, [0.4, 0.5]]),  # type: ignore[list-item]
        lambda: Drill([0.4, [0.4, 0.5]]),  # type: ignore[list-item]
    ],
)
def test_a_graph_has_no_room_for_arrays(make: Callable[[], Game]) -> None:
    with pytest.raises(InputError, match="one number"):
        graph_of(make())


@pytest.mark.parametrize("chance", [-0.1, 1.5, float("inf"), float("nan")])
def test_a_move_needs_a_probability(chance: float) -> None:
    coin = Coin()
    coin.moves = lambda _: {"heads": chance}  # type: ignore[method-assign]
    with pytest.raises(GameError, match=r"'toss' -> 'heads' has probability .*\. Give a number"):
        graph_of(coin)


def test_a_sum_that_misses_one_by_rounding_is_a_probability() -> None:
    coin = Coin()
    coin.moves = lambda state: {"heads": 1.0 + 2**-52} if state == "toss" else {}  # type: ignore[method-assign]
    assert graph_of(coin).edges["toss", "heads"]["probability"] > 1.0


def test_what_is_no_game_is_refused() -> None:
    with pytest.raises(GameError, match=r"Rack\(p1=0\.5, p2=None\) isn't a game"):
        graph_of(Rack(0.5))  # type: ignore[arg-type]
    with pytest.raises(GameError, match=r"chain_of\(graph, start=state\)"):
        graph_of(graph_of(Coin()))  # type: ignore[arg-type]
