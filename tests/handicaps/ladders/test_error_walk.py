import pickle
from fractions import Fraction
from itertools import pairwise

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import InputError
from evenbreak.game import Game, graph_of
from evenbreak.handicaps import RatingLadder
from evenbreak.handicaps.ladders.error_walk import long_run_law


def exact_law(wins):
    """Return the stationary law of a +-1 ladder by detailed balance, without rounding."""
    weights = [Fraction(1)]
    for up, down in pairwise(wins):
        weights.append(weights[-1] * up / (1 - down))
    return [weight / sum(weights) for weight in weights]


@given(st.integers(1, 12), st.data())
def test_any_ladder_has_the_law_of_detailed_balance(widest, data):
    count = 2 * widest + 1
    wins = data.draw(st.lists(st.integers(1, 99), min_size=count, max_size=count))
    ladder = RatingLadder([win / 100 for win in wins])
    expected = [float(x) for x in exact_law([Fraction(win, 100) for win in wins])]
    np.testing.assert_allclose(ladder.law().probability, expected, rtol=1e-11)


@given(
    st.lists(st.integers(-4, 4), min_size=2, max_size=5, unique=True).filter(
        lambda steps: min(steps) < 0 < max(steps)
    ),
    st.integers(4, 9),
    st.randoms(use_true_random=False),
)
def test_any_walk_has_the_limits_of_its_chain(steps, widest, random):
    steps = np.array(sorted(steps))
    many = 2 * widest + 1
    kernel = np.array([[random.uniform(0.1, 1.0) for _ in steps] for _ in range(many)])
    kernel /= kernel.sum(axis=1, keepdims=True)
    law = long_run_law(steps, kernel)
    unit = int(np.gcd.reduce(steps))
    arcs = {}
    for place in range(many):
        for step, chance in zip(steps.tolist(), kernel[place].tolist(), strict=True):
            after = place + step if 0 <= place + step < many else place
            arcs[place, after] = arcs.get((place, after), 0.0) + chance
    chain = chain_of([(*arc, chance) for arc, chance in arcs.items()])
    expected = np.zeros(many)
    for first in range(unit):
        limit = stochastic_limit(chain, widest + first)
        for place, chance in limit.to_dict().items():
            expected[place] += chance / unit
    np.testing.assert_allclose(law, expected, rtol=1e-9, atol=1e-15)


def test_it_is_a_game_whose_two_routes_agree():
    ladder = RatingLadder([0.9, 0.75, 0.5, 0.375, 0.125])
    assert isinstance(ladder, Game)
    assert pickle.loads(pickle.dumps(ladder)) == ladder  # noqa: S301
    assert (ladder.start, ladder.widest) == (0, 2)
    assert ladder.winner(1) is None
    by_moves = nx.DiGraph()
    for state in range(-2, 3):
        for target, chance in ladder.moves(state).items():
            by_moves.add_edge(state, target, probability=chance)
    graph = graph_of(ladder)
    assert {(a, b): d["probability"] for a, b, d in graph.edges(data=True)} == {
        (a, b): d["probability"] for a, b, d in by_moves.edges(data=True)
    }
    limit = stochastic_limit(chain_of(by_moves), 0)
    for error, chance in zip(range(-2, 3), ladder.law().probability, strict=True):
        assert limit[error] == pytest.approx(chance, rel=1e-12)


def test_holding_at_the_ends_makes_powers_settle():
    ladder = RatingLadder([0.9, 0.75, 0.5, 0.375, 0.125])
    assert stochastic_limit(chain_of(ladder)).period == 1
    endless = graph_of(ladder)
    endless.remove_edges_from([(-2, -2), (2, 2)])
    endless.edges[-2, -1]["probability"] = endless.edges[2, 1]["probability"] = 1.0
    limit = stochastic_limit(chain_of(endless))
    assert limit.period == 2
    assert limit.is_cesaro


def test_a_certain_loss_is_a_wall():
    # From 1 on every match is lost: 2 is never reached, and below 0 every match is won.
    law = RatingLadder([1.0, 1.0, 0.5, 0.0, 0.0]).law()
    assert law.probability == pytest.approx([0.0, 0.25, 0.5, 0.25, 0.0], rel=1e-15)


def test_a_walk_that_stands_still_has_no_law():
    with pytest.raises(InputError, match="matches in this system never move a rating"):
        long_run_law(np.array([0]), np.ones((3, 1)))


@pytest.mark.parametrize(
    ("wins", "message"),
    [
        ([0.5], "wins must have one chance"),
        ([0.5, 0.5], "so an odd number of chances"),
        ([0.5, 1.5, 0.5], r"win chance 2 must be a number from 0 to 1; you gave 1\.5"),
        (0.5, r"wins must be a list of numbers from 0 to 1; you gave 0\.5"),
    ],
)
def test_wins_that_make_no_ladder_are_refused(wins, message):
    with pytest.raises(InputError, match=message):
        RatingLadder(wins)


@pytest.mark.parametrize("state", [-2, 2, 1000])
def test_beyond_the_ends_there_is_no_state(state):
    with pytest.raises(InputError, match="state must be a rating error from -1 to 1"):
        RatingLadder([0.75, 0.5, 0.25]).moves(state)
