"""The likelihood ratio is one: its mean over everything that can happen is at most 1."""

from itertools import product

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
from rows import each_of
from slow_results import LAW, NPL, chance, ends

ERRS = Likelihood(NPL, LAW)


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


@each_of("skill", [-180, -60, -25, 0, 8, 40])
@each_of("shares", [SHARES, SHARES_MARKED])
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
    # 140 points below the rating and shut out in all matches, all of which are marked.
    results = [Result(80, (0, 5), (5, 5), won=False)] * 60
    assert watch_player(80, results, ERRS, shares=SHARES_MARKED)[0].max() < 0.0


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
