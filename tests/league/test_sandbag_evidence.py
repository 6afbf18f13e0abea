"""The likelihood ratio is one: over all that can happen its mean is 1, or less."""

from itertools import product
from math import comb

import numpy as np
import pytest

from evenbreak.league.sandbag_evidence import (
    DEPTHS,
    FARTHEST,
    SHARES,
    SHARES_MARKED,
    Likelihood,
    Result,
)
from evenbreak.league.sandbag_watch import watch_player
from evenbreak.ratings.scale import SCALES
from evenbreak.stats.summary import Distribution

NPL = SCALES["npl"]
LAW = Distribution((-6, 0, 6), (0.25, 0.5, 0.25))
ERRS = Likelihood(NPL, LAW)


def ends(m, n):
    """All final scores of a race with the number of ways in which each comes about."""
    won = [((m, k), comb(m - 1 + k, k), True) for k in range(n)]
    return won + [((k, n), comb(n - 1 + k, k), False) for k in range(m)]


def chance(games, difference):
    """Of a score in one of its ways, over the errors of the opponent."""
    return sum(
        float(w)
        * NPL.win_probability(difference + e) ** games[0]
        * NPL.win_probability(-difference - e) ** games[1]
        for e, w in zip(LAW.values, LAW.probability, strict=True)
    )


def test_scores_and_feigned_defeats_against_a_plain_sum():
    honest, feigned = ERRS.of((3, 5), (4, 5), won=False, first=-9, last=9)
    assert honest.shape == feigned.shape == (19,)
    for place in (0, 9, 18):
        assert honest[place] == pytest.approx(chance((3, 5), place - 9))
    total = sum(
        ways * ERRS.of(games, (4, 5), won=won, first=7, last=7)[1][0]
        for games, ways, won in ends(4, 5)
    )
    assert total == pytest.approx(1.0)


def test_a_match_of_which_only_the_winner_is_known():
    won, _ = ERRS.of(None, (4, 5), won=True, first=3, last=3)
    lost, feigned = ERRS.of(None, (4, 5), won=False, first=3, last=3)
    scores = sum(ways * chance(games, 3) for games, ways, ok in ends(4, 5) if ok)
    assert won[0] == pytest.approx(scores)
    assert won[0] + lost[0] == pytest.approx(1.0)
    assert feigned[0] == pytest.approx(1.0)
    assert ERRS.of(None, None, won=True, first=0, last=0)[0] == pytest.approx(1.0)


def seasons():
    """Two matches in all ways, each with its weight of ways."""
    races = ((3, 2), (2, 3))
    for first, second in product(ends(*races[0]), ends(*races[1])):
        results = [
            Result(rating, games, race, won, marked)
            for (games, _, won), race, rating, marked in (
                (first, races[0], 70, True),
                (second, races[1], 90, False),
            )
        ]
        yield results, first[1] * second[1]


@pytest.mark.parametrize("skill", [-180, -60, -25, 0, 8, 40])
@pytest.mark.parametrize("shares", [SHARES, SHARES_MARKED])
def test_its_mean_is_at_most_1_whatever_the_honest_skill(skill, shares):
    mean = 0.0
    for results, ways in seasons():
        probability = ways * np.prod(
            [chance(one.games, 80 + skill - one.opponent) for one in results]
        )
        mean += probability * np.exp(watch_player(80, results, ERRS, shares=shares)[0][-1])
    assert 0.001 < mean <= 1.0 + 1e-12


def test_its_mean_is_1_over_established_players():
    mean = 0.0
    for results, ways in seasons():
        # Rated 6 points too high or low, or rightly, at the start.
        probability = sum(
            float(w) * np.prod([chance(one.games, 80 - e - one.opponent) for one in results])
            for e, w in zip(LAW.values, LAW.probability, strict=True)
        )
        mean += ways * probability * np.exp(watch_player(80, results, ERRS)[1][-1])
    assert mean == pytest.approx(1.0, abs=1e-12)


def test_e_against_plain_loops():
    results = [
        Result(84, (0, 5), (5, 5), won=False),
        Result(71, (5, 1), (5, 4), won=True),
        Result(90, (1, 5), (4, 5), won=False),
    ]
    start, sizes = 80, (0, 15, 30)
    sandbagger = {}
    for ahead, (e, w) in product(sizes, zip(LAW.values, LAW.probability, strict=True)):
        skill = start - e + ahead
        sandbagger[skill] = sandbagger.get(skill, 0.0) + float(w) / len(sizes)
    total = 0.0
    for share, how in product(SHARES, (*DEPTHS, None)):
        for skill, weight in sandbagger.items():
            term = weight
            for one in results:
                x = skill - one.opponent
                if how is not None:
                    dumped = chance(one.games, x - how)
                else:
                    dumped = ERRS.of(one.games, one.race, won=one.won, first=x, last=x)[1][0]
                term *= (1.0 - share) * chance(one.games, x) + share * dumped
            total += term / (len(SHARES) * (len(DEPTHS) + 1))
    best = max(
        np.prod(
            [
                chance(one.games, start + x + round(g * t) - one.opponent)
                for t, one in enumerate(results)
            ]
        )
        for x in range(-FARTHEST, FARTHEST + 1)
        for g in (-0.25, 0.0, 0.25, 0.5)
    )
    assert np.exp(watch_player(start, results, ERRS)[0][-1]) == pytest.approx(total / best)


def test_a_thousand_matches_stay_finite():
    results = [Result(80, (0, 5), (5, 5), won=False), Result(80, (5, 0), (5, 5), won=True)] * 500
    log_e, established = watch_player(80, results, ERRS)
    assert np.isfinite(log_e).all()
    assert np.isfinite(established).all()
    assert log_e[-1] > 100.0


def test_a_hopeless_beginner_is_no_sandbagger():
    # 140 points below his rating and beaten to nothing in all matches, all of which are marked.
    results = [Result(80, (0, 5), (5, 5), won=False)] * 60
    assert watch_player(80, results, ERRS, shares=SHARES_MARKED)[0].max() < 0.0


def test_scores_too_unlikely_for_a_float_weigh_nothing():
    _, feigned = ERRS.of((119, 120), (120, 120), won=False, first=-400, last=900)
    assert np.isfinite(feigned).all()
    assert feigned[-1] == 0.0 < feigned[400]


def test_the_form_of_the_day_is_averaged_over():
    form = 5.0
    known = Likelihood(NPL, LAW, form)
    rng = np.random.default_rng(4)
    # His own form and the opponent's, each rounded to whole points.
    mine, theirs = (np.rint(rng.normal(0.0, form, 20_000)).astype(int) for _ in range(2))
    each = np.array([chance((5, 2), 7 + apart) for apart in range(-60, 61)])[mine - theirs + 60]
    expected = known.of((5, 2), (5, 5), won=True, first=7, last=7)[0][0]
    assert abs(each.mean() - expected) < 4.5 * each.std() / 20_000**0.5
    assert expected != pytest.approx(chance((5, 2), 7), rel=1e-4)
    assert known.error.tolist() == ERRS.error.tolist()


def test_its_mean_is_1_over_established_players_of_varying_form():
    varying = Likelihood(NPL, LAW, 20.0)
    mean = 0.0
    for results, ways in seasons():
        probability = 0.0
        for e, w in zip(LAW.values, LAW.probability, strict=True):
            term = float(w)
            for one in results:
                at = 80 - int(e) - one.opponent
                term *= varying.of(one.games, one.race, won=one.won, first=at, last=at)[0][0]
            probability += term
        mean += ways * probability * np.exp(watch_player(80, results, varying)[1][-1])
    assert mean == pytest.approx(1.0, abs=1e-12)
