import pickle
from fractions import Fraction
from itertools import pairwise
from math import comb

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import AccuracyError, InputError
from evenbreak.game import Game, graph_of
from evenbreak.handicaps import Chart, RatingLadder, autocorrelated_ladder, chart, natural_ladder
from evenbreak.handicaps import ladder as module
from evenbreak.ratings import SCALES, Scale

PRINTED = {  # chart: natural, autocorrelated
    "npl_8": (4.963, 4.978),
    "npl_10": (4.634, 4.654),
    "npl_12": (4.269, 4.291),
    "npl_20": (3.668, 3.697),
}
SHORT = Chart("short", [(0, 0, 2, 2), (1, 2, 3, 2), (3, None, 2, 1)])


def exact_win(p, m, n):
    """Return W(p; m, n) for a fraction p: m or more of m + n - 1 games won."""
    games = m + n - 1
    return sum(comb(games, k) * p**k * (1 - p) ** (games - k) for k in range(m, games + 1))


def exact_law(wins):
    """Return the stationary law of a ladder by detailed balance, without rounding."""
    weights = [Fraction(1)]
    for up, down in pairwise(wins):
        weights.append(weights[-1] * up / (1 - down))
    return [weight / sum(weights) for weight in weights]


def exact_sd(law):
    middle = len(law) // 2
    return float(sum((k - middle) ** 2 * chance for k, chance in enumerate(law))) ** 0.5


def probabilities(found):
    return np.array(found.distribution.probability, dtype=float)


@pytest.mark.parametrize("name", PRINTED)
def test_standard_deviations_are_those_of_the_text(name):
    natural, autocorrelated = PRINTED[name]
    assert natural_ladder(chart(name)).distribution.sd == pytest.approx(natural, abs=5e-4)
    found = autocorrelated_ladder(chart(name))
    assert found.distribution.sd == pytest.approx(autocorrelated, abs=5e-4)


@pytest.mark.parametrize("name", PRINTED)
def test_natural_law_is_the_exact_one(name):
    wins = [exact_win(Fraction(1, 2), *chart(name).race(i)) for i in range(-60, 61)]
    expected = exact_law(wins)
    found = natural_ladder(chart(name))
    np.testing.assert_allclose(probabilities(found), [float(x) for x in expected], rtol=1e-12)
    assert found.distribution.sd == pytest.approx(exact_sd(expected), rel=1e-13)
    assert found.distribution.values == tuple(range(-60, 61))
    assert found.changes == ()


def test_autocorrelated_law_of_a_short_chart_is_the_one_of_exact_rounds():
    # On the scale of one point a doubling, all game chances are fractions.
    games = {j: 1 / (1 + Fraction(2) ** j) for j in range(-4, 5)}
    races = {i: SHORT.race(i) for i in range(-4, 5)}
    law = exact_law([exact_win(Fraction(1, 2), *races[i]) for i in races])
    for _ in range(60):
        wins = [
            sum(v * exact_win(games[j], *races[i]) for j, v in zip(games, law, strict=True))
            for i in races
        ]
        # Exact rounds would double the digits each time.
        law = [Fraction(round(x * 10**40), 10**40) for x in exact_law(wins)]
    found = autocorrelated_ladder(SHORT, widest=4, scale=Scale("one point", 1.0))
    np.testing.assert_allclose(probabilities(found), [float(x) for x in law], rtol=1e-12)


@pytest.mark.parametrize("name", PRINTED)
def test_the_law_is_the_same_for_opponents_and_player(name):
    found = autocorrelated_ladder(chart(name), widest=40)
    errors = np.arange(-40, 41)
    opponents = probabilities(found)
    games = SCALES["npl"].win_probability(-errors)
    wins = [
        sum(v * exact_win(p, *chart(name).race(i)) for v, p in zip(opponents, games, strict=True))
        for i in errors.tolist()
    ]
    np.testing.assert_allclose(found.ladder.wins, wins, rtol=1e-12)
    player = [float(x) for x in exact_law([Fraction(win) for win in wins])]
    np.testing.assert_allclose(opponents, player, rtol=1e-9)


@pytest.mark.parametrize("name", PRINTED)
def test_each_round_brings_the_change_down_to_two_hundredths(name):
    changes = autocorrelated_ladder(chart(name)).changes
    assert 5 <= len(changes) <= 8
    assert changes[-1] <= 1e-14
    for before, after in pairwise(changes[:5]):
        assert after < 0.02 * before


@pytest.mark.parametrize("name", PRINTED)
def test_without_symmetry_a_tilt_grows_and_changes_sides(name):
    errors = np.arange(-60, 61)
    found = autocorrelated_ladder(chart(name))
    m, n = np.array([chart(name).race(i) for i in errors.tolist()]).T
    games = SCALES["npl"].win_probability(-errors)

    def player_against(opponents):
        wins = module.race_win_probability(games[None, :], m[:, None], n[:, None]) @ opponents
        return np.array(RatingLadder(wins.tolist()).law().probability)

    # Opponents who are better than rated by .01 points on average.
    law = 0.99 * probabilities(found) + 0.01 * np.roll(probabilities(found), 1)
    means = [law @ errors]
    for _ in range(3):
        law = player_against(law)
        means.append(law @ errors)
    assert means[0] == pytest.approx(0.01)
    for before, after in pairwise(means):
        assert 1.05 < -after / before < 1.4


def test_narrow_ladders_fall_short_and_wide_ones_agree():
    natural = {w: natural_ladder(chart("npl_8"), widest=w).distribution.sd for w in (15, 30, 60)}
    assert natural[15] == pytest.approx(4.949, abs=5e-4)
    assert natural[30] == pytest.approx(natural[60], abs=1e-8)


def test_the_top_is_flat_where_the_chart_is_even_and_falls_beyond():
    law = dict(zip(range(-60, 61), probabilities(natural_ladder(chart("npl_10"))), strict=True))
    # Errors up to 5 are played as 5:5, and the arcs between them are all one half.
    assert [law[i] for i in range(-5, 6)] == pytest.approx([law[0]] * 11, rel=1e-13)
    assert law[6] == pytest.approx(law[5] * 0.5 / 0.63671875, rel=1e-13)
    beyond = [law[i] for i in range(5, 61)]
    assert all(after < before for before, after in pairwise(beyond))


@pytest.mark.parametrize("model", [natural_ladder, autocorrelated_ladder])
@pytest.mark.parametrize("name", PRINTED)
def test_laws_are_symmetric(model, name):
    law = probabilities(model(chart(name), widest=30))
    np.testing.assert_allclose(law, law[::-1], rtol=1e-12)


@given(st.integers(1, 12), st.data())
def test_any_ladder_has_the_law_of_detailed_balance(widest, data):
    count = 2 * widest + 1
    wins = data.draw(st.lists(st.integers(1, 99), min_size=count, max_size=count))
    ladder = RatingLadder([win / 100 for win in wins])
    expected = [float(x) for x in exact_law([Fraction(win, 100) for win in wins])]
    np.testing.assert_allclose(ladder.law().probability, expected, rtol=1e-11)


def test_it_is_a_game_whose_two_routes_agree():
    ladder = natural_ladder(chart("npl_8"), widest=9).ladder
    assert isinstance(ladder, Game)
    assert pickle.loads(pickle.dumps(ladder)) == ladder  # noqa: S301
    assert ladder.start == 0
    assert ladder.winner(3) is None
    by_moves = nx.DiGraph()
    for state in range(-9, 10):
        for target, chance in ladder.moves(state).items():
            by_moves.add_edge(state, target, probability=chance)
    graph = graph_of(ladder)
    assert {(a, b): d["probability"] for a, b, d in graph.edges(data=True)} == {
        (a, b): d["probability"] for a, b, d in by_moves.edges(data=True)
    }
    limit = stochastic_limit(chain_of(by_moves), 0)
    for error, chance in zip(range(-9, 10), ladder.law().probability, strict=True):
        assert limit[error] == pytest.approx(chance, rel=1e-12)


def test_holding_at_the_ends_makes_powers_settle():
    ladder = natural_ladder(chart("npl_8"), widest=9).ladder
    assert stochastic_limit(chain_of(ladder)).period == 1
    endless = graph_of(ladder)
    endless.remove_edges_from([(-9, -9), (9, 9)])
    endless.edges[-9, -8]["probability"] = endless.edges[9, 8]["probability"] = 1.0
    limit = stochastic_limit(chain_of(endless))
    assert limit.period == 2
    assert limit.is_cesaro


def test_a_certain_loss_is_a_wall():
    # From 1 on every match is lost: 2 is never reached, and below 0 every match is won.
    law = RatingLadder([1.0, 1.0, 0.5, 0.0, 0.0]).law()
    assert law.probability == pytest.approx([0.0, 0.25, 0.5, 0.25, 0.0], rel=1e-15)


@pytest.mark.parametrize(
    ("wins", "message"),
    [
        ([0.5], "wins has 1 chances"),
        ([0.5, 0.5], "an odd number, three or more"),
        ([0.5, 1.5, 0.5], "win chance 2 is 1.5"),
        (0.5, "wins is 0.5; give a list"),
    ],
)
def test_wins_that_make_no_ladder_are_refused(wins, message):
    with pytest.raises(InputError, match=message):
        RatingLadder(wins)


@pytest.mark.parametrize("model", [natural_ladder, autocorrelated_ladder])
@pytest.mark.parametrize("widest", [0, -3, 2.5, "60"])
def test_a_width_that_is_none_is_refused(model, widest):
    with pytest.raises(InputError, match=r"widest is .*; give a whole number, 1 or more"):
        model(chart("npl_8"), widest=widest)


@pytest.mark.parametrize("model", [natural_ladder, autocorrelated_ladder])
def test_the_name_of_a_chart_is_no_chart(model):
    with pytest.raises(InputError, match="chart is 'npl_8'; give a Chart, such as chart"):
        model("npl_8")


def test_a_law_that_does_not_settle_is_not_given(monkeypatch):
    monkeypatch.setattr(module, "_ROUNDS", 3)
    with pytest.raises(AccuracyError, match="after 3 rounds"):
        autocorrelated_ladder(chart("npl_8"))
