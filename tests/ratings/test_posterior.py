"""The mode of the plain model, where it can be worked out by hand."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq, minimize
from scipy.special import expit

from evenbreak.errors import AccuracyError, InputError
from evenbreak.ratings import Levels, Results, fit
from evenbreak.ratings.beginning import PriorMeans
from evenbreak.ratings.covariance import count_pairs
from evenbreak.ratings.fit import BREAK_SD, weights_of
from evenbreak.ratings.likelihood_terms import likelihood_terms
from evenbreak.ratings.posterior import (
    MOST_STEPS,
    WayToRate,
    damped,
    find_mixed_mode,
    find_mode,
    find_modes,
    find_zero,
    tolerance,
)
from evenbreak.ratings.results_frame import FORMATS
from evenbreak.ratings.stretches import SeasonSoFar
from tiers import examples


def two_players(won, lost):
    return count_pairs(2, np.array([0]), np.array([1]), np.array([won]), np.array([lost]))


@pytest.mark.parametrize("precision", [0.01, 1.0, 25.0])
def test_two_players_are_where_wins_and_prior_balance(precision):
    mode = find_mode(two_players(9, 3), precision)
    # Both skills are opposite: 12 expit(2x) - 9 + τx = 0.
    x = brentq(lambda x: 12 * expit(2 * x) - 9 + precision * x, 0, 5, xtol=1e-14)
    np.testing.assert_allclose(mode.point, [x, -x], atol=1e-8)
    assert mode.gradient <= 1e-8


def test_the_curvature_is_the_laplacian_of_games_plus_the_prior():
    skill = np.array([0.4, -0.2])
    weight = 12 * expit(0.6) * expit(-0.6)
    matrix = two_players(9, 3).curvature(skill, 0.0, 2.0, None).matrix.toarray()
    np.testing.assert_allclose(matrix, [[weight + 2, -weight], [-weight, weight + 2]])


def test_a_league_without_games_stays_at_the_prior():
    none = np.zeros(0, dtype=np.int64)
    mode = find_mode(count_pairs(3, none, none, none, none), 1.0)
    assert (mode.point.tolist(), mode.iterations) == ([0, 0, 0], 0)


def test_a_whitewash_has_a_finite_rating():
    mode = find_mode(two_players(1000, 0), 1.0)
    assert 0 < mode.point[0] < math.log(1000)


@pytest.mark.parametrize("opponents", [10, 15_000, 20_000, 50_000])
def test_a_player_with_very_many_opponents_is_rated(opponents):
    one, others = np.zeros(opponents, dtype=int), np.arange(1, opponents + 1)
    seven, three = np.full(opponents, 7), np.full(opponents, 3)
    mode = find_mode(count_pairs(opponents + 1, one, others, three, seven), 1.0)
    # Every opponent is at -x/n where the one player, who lost to all of them, is at x.
    x = brentq(
        lambda x: opponents * (10 * expit(x * (1 + 1 / opponents)) - 3) + x, -5, 0, xtol=1e-14
    )
    np.testing.assert_allclose(mode.point[:2], [x, -x / opponents], atol=1e-9)
    assert mode.iterations < 10


# The loop that all fits share.


def test_newton_steps_find_the_root_of_a_cube():
    def gradient_at(x):
        return x**3 - 8.0, lambda: (8.0 - x**3) / (3.0 * x**2)

    mode = find_zero(np.array([1.0, 5.0]), gradient_at, 1e-10)
    np.testing.assert_allclose(mode.point, 2.0, rtol=1e-11)
    assert mode.gradient <= 1e-10
    assert 0 < mode.iterations < 15


def test_a_start_at_the_mode_takes_no_step():
    mode = find_zero(np.zeros(3), lambda x: (x, lambda: -x), 0.0)
    assert (mode.gradient, mode.iterations) == (0.0, 0)


def test_giving_up_is_said():
    with pytest.raises(AccuracyError, match=f"after {MOST_STEPS} Newton steps"):
        find_zero(np.ones(1), lambda x: (x, lambda: 0.0 * x), 1e-8)


def test_short_steps_are_taken_whole_and_long_ones_shortened():
    low, high = np.array([0]), np.array([1])
    short, long = np.array([0.8, -0.8]), np.array([50.0, -50.0])
    assert damped(short, low, high) is short
    np.testing.assert_allclose(damped(long, low, high), long * np.log(101.0) / 100.0)


def test_a_weak_prior_needs_a_smaller_gradient_until_rounding_limits_it():
    assert tolerance(4.0, 100.0) == 1e-8
    assert tolerance(0.01, 100.0) == 1e-10
    assert tolerance(1e-6, 1e4) == pytest.approx(1e-10)


# Ratings from several kinds of results against scipy on a likelihood written out by hand.


LOG_ODDS = {"scale": math.log(2), "anchor": 0}  # a point is a log-odd


def race_chance(p, m, n):
    return math.fsum(math.comb(m - 1 + k, k) * p**m * (1 - p) ** k for k in range(n))


def logistic(x):
    return 1 / (1 + math.exp(-x))


def play(rng, players, matches, *, advantage=0.0, unscored=0.5, spread=0.7):
    """Return a season with racks, winner breaks and handicap races, and the skills behind it."""
    skill = rng.normal(0, spread, players)
    columns = {name: [] for name in ("a", "b", "sa", "sb", "ra", "rb", "w", "racks", "f", "x")}
    for _ in range(matches):
        a, b = rng.choice(players, 2, replace=False)
        race = rng.integers(2, 8, 2)
        first = breaker = int(rng.integers(1, 3))
        racks, score = "", [0, 0]
        while score[0] < race[0] and score[1] < race[1]:
            x = skill[a] - skill[b] + (advantage if breaker == 1 else -advantage)
            winner = 0 if rng.random() < logistic(x) else 1
            score[winner] += 1
            racks += "ab"[winner]
            breaker = winner + 1
        hidden = rng.random() < unscored
        row = (a, b, *((0, 0) if hidden else score), *race, 1 if score[0] == race[0] else 2)
        row += ("" if hidden else racks, first, hidden)
        for name, cell in zip(columns, row, strict=True):
            columns[name].append(cell)
    results = Results(
        tuple(f"p{k}" for k in range(players)),
        columns["a"],
        columns["b"],
        columns["sa"],
        columns["sb"],
        race_a=columns["ra"],
        race_b=columns["rb"],
        winner=columns["w"],
        racks=columns["racks"],
        first_break=columns["f"],
        break_format=[FORMATS.index("winner")] * matches,
        unscored=columns["x"],
    )
    return results, skill


def by_hand(results, prior_sd, break_sd):
    """Return the mode as scipy finds it, rack by rack and race by race."""
    players = len(results.players)

    def cost(x):
        skill, advantage = x[:players], x[players] if break_sd else 0.0
        total = float(skill @ skill) / (2 * prior_sd**2)
        total += advantage**2 / (2 * break_sd**2) if break_sd else 0.0
        for k in range(len(results)):
            d = skill[results.player_a[k]] - skill[results.player_b[k]]
            if results.unscored[k]:
                m, n = results.race_a[k], results.race_b[k]
                won = results.winner[k] == 1
                p = logistic(d)
                total -= math.log(race_chance(p, m, n) if won else race_chance(1 - p, n, m))
                continue
            breaker = results.first_break[k]
            for letter in results.racks[k]:
                p = logistic(d + (advantage if breaker == 1 else -advantage))
                total -= math.log(p if letter == "a" else 1 - p)
                breaker = 1 if letter == "a" else 2
        return total

    size = players + (1 if break_sd else 0)
    return minimize(cost, np.zeros(size), method="BFGS", options={"gtol": 1e-7}).x


def score_chance(x1, x2, score, form, first, last):
    """Return P(score, last winner | the log-odds of a on either break), rack by rack."""
    p = {1: logistic(x1), 2: logistic(x2)}
    states = {(0, 0, first): 1.0}
    for rack in range(sum(score)):
        after = {}
        for (i, j, breaker), chance in states.items():
            for winner in (1, 2):
                if rack == sum(score) - 1 and winner != last:
                    continue
                share = p[breaker] if winner == 1 else 1 - p[breaker]
                ahead = {"winner": winner, "loser": 3 - winner, "alternate": 3 - breaker}[form]
                key = (i + (winner == 1), j + (winner == 2), ahead)
                after[key] = after.get(key, 0.0) + chance * share
        states = after
    return sum(chance for (i, j, _), chance in states.items() if (i, j) == score)


def second_differences(cost, at, step=1e-3):
    """Return the Hessian of a function, by differences."""
    ways = step * np.eye(len(at))
    return np.array(
        [
            [
                cost(at + x + y) - cost(at + x - y) - cost(at - x + y) + cost(at - x - y)
                for y in ways
            ]
            for x in ways
        ]
    ) / (4 * step**2)


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("form", ["winner", "loser", "alternate"])
def test_scores_with_known_first_breaks_against_scipy(form):
    rng = np.random.default_rng(9)
    rows = []
    for _ in range(20):
        a, b = (int(k) for k in rng.choice(4, 2, replace=False))
        race, lost = int(rng.integers(2, 6)), int(rng.integers(0, 4))
        other, won = max(lost + 1, int(rng.integers(2, 6))), bool(rng.integers(0, 2))
        score, needs = ((race, lost), (race, other)) if won else ((lost, race), (other, race))
        rows.append((a, b, *score, *needs, int(rng.integers(1, 3))))
    a, b, sa, sb, ra, rb, first = (list(column) for column in zip(*rows, strict=True))
    code = FORMATS.index(form)
    results = Results(
        tuple("ABCD"),
        a,
        b,
        sa,
        sb,
        race_a=ra,
        race_b=rb,
        first_break=first,
        break_format=[code] * 20,
    )

    def cost(x):
        skill, advantage = x[:4], x[4]
        total = float(skill @ skill) / (2 * 0.9**2) + advantage**2 / (2 * BREAK_SD**2)
        for k in range(20):
            d = skill[a[k]] - skill[b[k]]
            last = 1 if sa[k] == ra[k] else 2
            total -= math.log(
                score_chance(d + advantage, d - advantage, (sa[k], sb[k]), form, first[k], last)
            )
        return total

    expected = minimize(cost, np.zeros(5), method="BFGS", options={"gtol": 1e-7})
    ratings = fit(results, prior_sd=0.9, break_advantage="fit", **LOG_ODDS)
    np.testing.assert_allclose(ratings.rating, expected.x[:4], atol=2e-5)
    assert ratings.break_advantage == pytest.approx(expected.x[4], abs=2e-5)
    covariance = np.linalg.inv(second_differences(cost, expected.x))
    assert ratings.break_error == pytest.approx(math.sqrt(covariance[4, 4]), rel=1e-4)
    np.testing.assert_allclose(
        ratings.standard_error, np.sqrt(np.diagonal(covariance)[:4]), rtol=1e-4
    )
    assert ratings.break_games == sum(sa) + sum(sb)


@pytest.mark.parametrize("unscored", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("breaks", [None, "fit"])
def test_the_mode_is_the_one_that_scipy_finds(unscored, breaks):
    results, _ = play(np.random.default_rng(5), 5, 25, advantage=0.4, unscored=unscored)
    ratings = fit(results, prior_sd=0.9, break_advantage=breaks, **LOG_ODDS)
    estimated = breaks == "fit" and unscored < 1
    expected = by_hand(results, 0.9, BREAK_SD if estimated else None)
    np.testing.assert_allclose(ratings.rating, expected[:5], atol=2e-5)
    assert ratings.gradient <= 1e-8
    if estimated:
        assert ratings.break_advantage == pytest.approx(expected[5], abs=2e-5)
    else:
        assert (ratings.break_advantage, ratings.break_error) == (None, None)


def test_where_all_games_count_alike_both_ways_find_the_same():
    results, _ = play(np.random.default_rng(6), 9, 60, unscored=0)
    none = results.select(np.zeros(0, dtype=int))
    terms = likelihood_terms(results, none, (np.ones(60), np.zeros(0)), breaks=False)
    quick = fit(results, prior_sd=0.5, **LOG_ODDS)
    general = find_mixed_mode(terms, 4.0)
    np.testing.assert_allclose(general.point[:-1], quick.rating, atol=1e-8)
    assert terms.amount == quick.weight


@pytest.mark.parametrize("form", ["winner", "loser", "alternate"])
def test_scores_alone_have_one_mode_along_the_break_advantage(form):
    """The likelihood need not be concave in it; the mode found is the only one on a grid."""
    rng = np.random.default_rng(14)
    results, _ = play(rng, 8, 60, advantage=0.3, unscored=0)
    results = replace(results, racks=None, break_format=np.full(60, FORMATS.index(form)))
    none = results.select(np.zeros(0, dtype=int))
    terms = likelihood_terms(results, none, (np.ones(60), np.zeros(0)), breaks=True)

    def cost(advantage):
        skill = find_mixed_mode(terms, 2.0, advantage=advantage).point[:-1]
        prior = skill @ skill + 0.5 * BREAK_SD**-2 * advantage**2
        return prior - terms.log_likelihood(skill, advantage)

    values = [cost(advantage) for advantage in np.linspace(-1.5, 1.5, 13)]
    assert sum(np.diff(np.sign(np.diff(values))) != 0) == 1
    found = find_mixed_mode(terms, 2.0, break_precision=BREAK_SD**-2)
    assert cost(found.point[-1]) <= min(values)


def test_a_known_break_advantage_is_kept():
    results, _ = play(np.random.default_rng(6), 5, 25, advantage=0.4)
    fitted = fit(results, break_advantage="fit", **LOG_ODDS)
    given_ = fit(results, break_advantage=fitted.break_advantage, **LOG_ODDS)
    np.testing.assert_allclose(given_.rating, fitted.rating, atol=1e-7)
    assert given_.break_error is None
    # Of what is certain no uncertainty is handed on.
    assert (given_.standard_error <= fitted.standard_error).all()
    none, zero = fit(results, **LOG_ODDS), fit(results, break_advantage=0, **LOG_ODDS)
    np.testing.assert_allclose(none.rating, zero.rating, atol=1e-7)


def test_a_race_to_one_is_a_game():
    rng = np.random.default_rng(7)
    a, step, won = rng.integers(0, 6, 40), rng.integers(1, 6, 40), rng.integers(0, 2, 40)
    b, names = (a + step) % 6, tuple("ABCDEF")
    games = fit(Results(names, a, b, won, 1 - won))
    ones, none = np.ones(40), np.zeros(40)
    results = Results(
        names, a, b, none, none, race_a=ones, race_b=ones, winner=2 - won, unscored=ones
    )
    races = fit(results)
    np.testing.assert_allclose(races.rating, games.rating, atol=1e-7)
    np.testing.assert_allclose(races.standard_error, games.standard_error, rtol=1e-8)
    assert (races.component == games.component).all()
    assert (races.races_won == games.won).all()
    assert (races.games.sum(), races.matches) == (0, 40)


races = st.lists(
    st.tuples(
        st.integers(0, 3),
        st.integers(1, 3),
        st.integers(1, 9),
        st.integers(1, 9),
        st.integers(1, 2),
    ),
    min_size=1,
    max_size=12,
)


def won_races(rows):
    a, step, m, n, winner = (np.array(column) for column in zip(*rows, strict=True))
    none = np.zeros(len(rows))
    return Results(
        tuple("ABCD"),
        a,
        (a + step) % 4,
        none,
        none,
        race_a=m,
        race_b=n,
        winner=winner,
        unscored=none + 1,
    )


@settings(deadline=None, max_examples=examples(50))
@given(races, st.lists(st.floats(-6, 6), min_size=4, max_size=4))
def test_there_is_one_mode_wherever_the_search_begins(rows, start):
    results = won_races(rows)
    ratings = fit(results, prior_sd=3.0, **LOG_ODDS)
    none = results.select(np.zeros(0, dtype=int))
    terms = likelihood_terms(none, results, (np.zeros(0), np.ones(len(rows))), breaks=False)
    again = find_mixed_mode(terms, 3.0**-2, start=np.array(start))
    np.testing.assert_allclose(again.point[:-1], ratings.rating, atol=1e-5)


@settings(deadline=None, max_examples=examples(50))
@given(races)
def test_needing_more_games_for_the_same_win_raises_a_rating(rows):
    a, step, m, n, winner = rows[0]
    harder = (a, step, m + (winner == 1), n + (winner == 2), winner)
    before = fit(won_races(rows)).rating
    after = fit(won_races([harder, *rows[1:]])).rating
    best = a if winner == 1 else (a + step) % 4
    assert after[best] > before[best]


@settings(deadline=None, max_examples=examples(30))
@given(races)
def test_it_does_not_matter_who_is_called_a(rows):
    turned = [((a + step) % 4, 4 - step, n, m, 3 - w) for a, step, m, n, w in rows]
    plain, other = fit(won_races(rows)), fit(won_races(turned))
    np.testing.assert_allclose(plain.rating, other.rating, atol=1e-6)


def test_standard_errors_of_races_and_breaks_cover_as_often_as_they_say():
    rng = np.random.default_rng(12)
    z, breaks, pairs = [], [], []
    for _ in range(50):
        results, skill = play(rng, 12, 80, advantage=0.3, spread=0.8)
        ratings = fit(results, prior_sd=0.8, break_advantage="fit", **LOG_ODDS)
        z.extend((ratings.rating - skill) / ratings.standard_error)
        breaks.append((ratings.break_advantage - 0.3) / ratings.break_error)
        error = ratings.difference_error("p0", "p1")
        pairs.append((ratings.rating[0] - ratings.rating[1] - skill[0] + skill[1]) / error)
    assert np.mean(np.abs(z) < 1) == pytest.approx(0.683, abs=0.05)
    assert np.mean(np.abs(z) < 2) == pytest.approx(0.954, abs=0.025)
    assert np.mean(np.abs(pairs) < 1) == pytest.approx(0.683, abs=0.17)
    assert np.std(breaks) == pytest.approx(1, abs=0.3)
    assert np.mean(breaks) == pytest.approx(0, abs=0.4)


def test_scores_alone_tell_the_break_advantage_less_surely_than_racks():
    rng = np.random.default_rng(13)
    z = []
    for _ in range(30):
        racks, _ = play(rng, 10, 150, advantage=0.3, unscored=0)
        scores = replace(racks, racks=None)
        by_racks, by_scores = (
            fit(season, break_advantage="fit", **LOG_ODDS) for season in (racks, scores)
        )
        assert by_scores.break_error > by_racks.break_error
        z.append((by_scores.break_advantage - 0.3) / by_scores.break_error)
    assert np.mean(z) == pytest.approx(0, abs=0.55)
    assert np.std(z) == pytest.approx(1, abs=0.4)


def test_breakers_who_won_every_rack_have_a_finite_advantage():
    results = Results.from_names(
        ["A", "B"], ["B", "A"], [30, 30], [0, 0], break_format=[4, 4]
    )  # a breaks
    ratings = fit(results, break_advantage="fit", **LOG_ODDS)
    assert 0.5 < ratings.break_advantage < 6
    assert ratings.break_games == 60


def test_forfeits_among_the_unscored_are_left_out():
    results = Results.from_names(
        ["A", "B"],
        ["B", "A"],
        [0, 0],
        [0, 0],
        race_a=[7, 7],
        race_b=[5, 5],
        winner=[1, 1],
        forfeit=[True, False],
        unscored=[True, True],
    )
    ratings = fit(results)
    assert (ratings.matches, ratings.forfeits, ratings.empty) == (1, 1, 0)
    assert ratings.races_won.tolist() == [0, 1]


@pytest.mark.parametrize(
    ("columns", "missing"),
    [
        ({}, "race_a"),
        ({"race_a": [7], "race_b": [5]}, "winner"),
        ({"race_a": [7], "race_b": [5], "winner": [0]}, "winner"),
        ({"race_a": [0], "race_b": [5], "winner": [1]}, "race_a"),
    ],
)
def test_an_unscored_match_needs_race_and_winner(columns, missing):
    with pytest.raises(InputError, match=f"without {missing}"):
        Results.from_names(["A"], ["B"], [0], [0], unscored=[True], **columns)
    with pytest.raises(InputError, match="Unmark"):
        Results.from_names(
            ["A"], ["B"], [7], [0], unscored=[True], race_a=[7], race_b=[7], winner=[1]
        )


def test_extreme_leagues_converge():
    """A chain of whitewashes in long races, and a prior that says next to nothing."""
    names = [f"p{k:03d}" for k in range(60)]
    zeros = np.zeros(59)
    results = Results.from_names(
        names[:-1],
        names[1:],
        zeros,
        zeros,
        race_a=zeros + 100,
        race_b=zeros + 2,
        winner=zeros + 1,
        unscored=zeros + 1,
    )
    ratings = fit(results, prior_sd=10.0)
    assert (np.diff(ratings.rating) < 0).all()


# The modes of several ways of rating, found together.


def season(matches=60, players=9, seed=5):
    """Scores, matches known by their winner alone, racks whose breaker is known, and teams."""
    rng = np.random.default_rng(seed)
    a = rng.integers(0, players, matches)
    b = (a + rng.integers(1, players, matches)) % players
    lost, race = rng.integers(0, 7, matches), np.full(matches, 7)
    a_won = rng.random(matches) < 0.5
    unscored = rng.random(matches) < 0.3
    return Results(
        tuple("ABCDEFGHI"[:players]), a, b, np.where(unscored, 0, np.where(a_won, 7, lost)),
        np.where(unscored, 0, np.where(a_won, lost, 7)),
        date=np.datetime64("2026-01-01") + np.sort(rng.integers(0, 90, matches)),
        race_a=race, race_b=race, unscored=unscored,
        break_format=np.full(matches, FORMATS.index("alternate")),
        first_break=rng.integers(1, 3, matches),
        winner=np.where(unscored, rng.integers(1, 3, matches), 0),
        team_a=np.array(["Cues", "Bridges", "Chalk"])[a % 3],
        team_b=np.array(["Cues", "Bridges", "Chalk"])[b % 3],
    )  # fmt: skip


def way(results, sd, *, half_life=None, means=None, advantage=0.0, break_precision=None):
    scored, won_only = results.played().results, results.won_only()
    weights = weights_of(scored, won_only, half_life, None)
    terms = likelihood_terms(scored, won_only, weights, breaks=True)
    return WayToRate(terms, sd**-2, advantage, break_precision, means)


def test_each_mode_is_that_of_its_way_alone():
    results = season()
    rng = np.random.default_rng(8)
    teams = PriorMeans(
        rng.normal(0.0, 0.5, 9), np.eye(3)[np.arange(9) % 3], np.array([0.3, 0.3, 0.8])
    )
    ways = [
        way(results, 0.1),
        way(results, 2.0, advantage=0.2),
        way(results, 0.5, half_life=20.0),
        way(results, 0.4, means=teams),
        way(results, 0.6, means=teams, break_precision=2.0),
        way(results, 1.5, break_precision=0.01, half_life=30.0),
    ]
    for skill, advantage, one in zip(*find_modes(ways), ways, strict=True):
        alone = find_mixed_mode(
            one.terms,
            one.precision,
            advantage=one.advantage,
            break_precision=one.break_precision,
            means=one.means,
        )
        assert skill == pytest.approx(alone.point[:9], abs=1e-7)
        assert advantage == pytest.approx(alone.point[-1], abs=1e-7)


def test_a_far_start_makes_no_difference():
    ways = [way(season(), 0.5), way(season(), 50.0)]
    far, near = find_modes(ways, np.linspace(-9.0, 9.0, 9)), find_modes(ways)
    assert far[0] == pytest.approx(near[0], abs=1e-3)


def test_both_routes_rate_alike(monkeypatch):
    results = season()
    ways = [
        {"prior_sd": sd, "half_life": days, "levels": Levels(newcomers=0.4, team_sd=0.2)}
        for sd, days in ((0.1, None), (0.4, 30.0))
    ]
    together, _ = SeasonSoFar(results).skills(ways)
    monkeypatch.setattr("evenbreak.ratings.stretches.SOLVED_AT_ONCE", 0)
    alone, _ = SeasonSoFar(results).skills(ways)
    assert together == pytest.approx(alone, abs=1e-7)
