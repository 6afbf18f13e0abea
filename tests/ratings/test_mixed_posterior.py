"""Ratings from several kinds of results against scipy on a likelihood written out by hand."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from evenbreak.errors import InputError
from evenbreak.ratings import Results, fit
from evenbreak.ratings.fit import BREAK_SD
from evenbreak.ratings.likelihood_terms import likelihood_terms
from evenbreak.ratings.posterior import find_mixed_mode
from evenbreak.ratings.results_frame import FORMATS
from tiers import examples

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
    with pytest.raises(InputError, match="unmark"):
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
