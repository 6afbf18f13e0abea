"""Laws of every game in the catalog: a new game is tested by being listed there."""

import pickle
from dataclasses import FrozenInstanceError, fields, is_dataclass, replace

import networkx as nx
import numpy as np
import pytest

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.game import Game, arcs_of, graph_of
from evenbreak.games import CATALOG

pytestmark = pytest.mark.parametrize("game", CATALOG.values(), ids=CATALOG.keys())


class Walked:
    """A game without its arrays: only what the protocol asks for."""

    def __init__(self, game: Game) -> None:
        self.start, self.moves, self.winner = game.start, game.moves, game.winner


def states_of(game: Game) -> list[object]:
    return list(arcs_of(Walked(game)).states)


def test_it_is_a_game(game: Game) -> None:
    assert isinstance(game, Game)


def test_it_is_a_frozen_value(game: Game) -> None:
    assert is_dataclass(game)
    with pytest.raises(FrozenInstanceError):
        setattr(game, fields(game)[0].name, None)
    twin = replace(game)
    assert twin == game
    assert hash(twin) == hash(game)
    assert pickle.loads(pickle.dumps(game)) == game  # noqa: S301


def test_moves_are_probabilities_that_sum_to_1(game: Game) -> None:
    for state in states_of(game):
        moves = game.moves(state)
        assert all(isinstance(p, float) and 0.0 <= p <= 1.0 for p in moves.values()), state
        assert not moves or sum(moves.values()) == pytest.approx(1.0, abs=1e-15), state


def test_moves_are_the_same_each_time(game: Game) -> None:
    for state in states_of(game):
        moves = game.moves(state)
        moves_again = game.moves(state)
        assert moves == moves_again
        assert list(moves) == list(moves_again)


def test_terminal_states_have_a_winner_and_others_none(game: Game) -> None:
    for state in states_of(game):
        if game.moves(state):
            assert game.winner(state) is None, state
        else:
            assert game.winner(state) in (1, 2), state


def test_states_hash_and_print_well(game: Game) -> None:
    states = states_of(game)
    assert len(set(states)) == len(states)
    printed = [str(state) for state in states]
    assert len(set(printed)) == len(states)
    assert all(len(text) <= 40 and "object at" not in text and "\n" not in text for text in printed)


def test_all_states_are_reached_from_the_start(game: Game) -> None:
    graph = graph_of(game)
    assert nx.descendants(graph, game.start) | {game.start} == set(graph)


def test_the_graph_says_kind_and_winner(game: Game) -> None:
    graph = graph_of(game)
    for state, node in graph.nodes(data=True):
        terminal = not game.moves(state)
        kind = "terminal" if terminal else "start" if state == game.start else "transient"
        assert node == {"kind": kind, "winner": game.winner(state)}
    assert [s for s, kind in graph.nodes(data="kind") if kind == "start"] == [game.start]


def test_the_graph_carries_the_moves(game: Game) -> None:
    graph = graph_of(game)
    for state in graph:
        arcs = {target: arc["probability"] for target, arc in graph[state].items()}
        assert arcs == {target: p for target, p in game.moves(state).items() if p > 0}
        assert all(type(p) is float for p in arcs.values())


def test_all_routes_give_the_same_chain(game: Game) -> None:
    walked = chain_of(Walked(game))
    order = walked.states
    for chain in (chain_of(game), chain_of(graph_of(game)), chain_of(graph_of(Walked(game)))):
        assert chain.start == walked.start == game.start
        assert sorted(map(str, chain.states)) == sorted(map(str, order))
        place = [chain.index(state) for state in order]
        assert (chain.matrix.toarray()[np.ix_(place, place)] == walked.matrix.toarray()).all()


def test_the_limit_lies_where_the_game_ends_or_goes_on_for_ever(game: Game) -> None:
    limit = stochastic_limit(chain_of(game))
    assert limit.bound is None
    assert limit.probability.sum() == pytest.approx(1.0, abs=1e-14)
    assert (limit.probability >= 0.0).all()
    ended = [p for state, p in limit.to_dict().items() if not game.moves(state)]
    assert sum(ended) == (pytest.approx(1.0, abs=1e-14) if ended else 0)
