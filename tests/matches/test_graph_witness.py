"""Every kernel against the graph of the same match and the stochastic limit of its chain.

A race m:n is a race 5:5 from the score 5-m : 5-n, so one chain that holds every state of
5:5, reachable or not, answers for all m, n <= 5; likewise all n-ahead matches with the
same m + n are one chain from different leads.
"""

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import numpy as np
import pytest

from evenbreak.chains import chain_of, limit_matrix, steps_to_absorption, stochastic_limit
from evenbreak.games import BREAK_FORMATS, CATALOG, Ahead, Race, Rack, alternate_breaks
from evenbreak.games.match import Match
from evenbreak.matches import (
    final_scores,
    match_length,
    match_odds,
    race_odds,
    race_win_probability,
    win_probability,
)

PROBABILITIES = np.array([0.0, 1 / 3, 0.5, 2 / 3, 1.0])
P1, P2 = np.meshgrid(PROBABILITIES, PROBABILITIES, indexing="ij")
MOST = 5
SIZES = list(product(range(1, MOST + 1), repeat=2))
FORMATS = pytest.mark.parametrize("breaks", BREAK_FORMATS.values(), ids=list(BREAK_FORMATS))

Limits = dict[Any, dict[Any, float]]


def arcs(match: Match, states: list[Any]) -> Iterator[tuple[Any, Any, float]]:
    for state in states:
        for target, chance in match.moves(state).items():
            yield state, target, chance


def limits(match: Match, states: list[Any]) -> Limits:
    """Return where play ends from each of the states: the non-zero entries."""
    chain = chain_of(arcs(match, states))
    matrix = limit_matrix(chain).tocoo()
    found: Limits = {state: {} for state in chain.states}
    for i, j, chance in zip(matrix.row, matrix.col, matrix.data, strict=True):
        if match.winner(chain.states[i]) is not None:
            found[chain.states[j]][chain.states[i]] = float(chance)
    return found


def scores_to(most: int) -> list[tuple[int, int]]:
    return list(product(range(most), repeat=2))


def all_limits(match_of: Callable[[Rack], Match], states: list[Any]) -> np.ndarray[Any, Any]:
    table = np.empty(P1.shape, dtype=object)
    for at in np.ndindex(P1.shape):
        table[at] = limits(match_of(Rack(float(P1[at]), float(P2[at]))), states)
    return table


def wins(match: Match, ends: dict[Any, float], player: int) -> float:
    return sum(chance for end, chance in ends.items() if match.winner(end) == player)


@pytest.mark.slow
@FORMATS
def test_races_in_a_break_format(breaks: Any) -> None:
    longest = Race(MOST, MOST, Rack(0.5, 0.5), breaks=breaks)
    states = [(a, b, s) for a, b in scores_to(MOST) for s in (1, 2)]
    table = all_limits(lambda rack: Race(MOST, MOST, rack, breaks=breaks), states)
    for (m, n), first in product(SIZES, (1, 2)):
        race = Race(m, n, Rack(P1, P2), breaks=breaks, first_breaker=first)
        chance = win_probability(race), win_probability(race, player=2)
        ends = final_scores(race).probability
        for at in np.ndindex(P1.shape):
            expected = table[at][MOST - m, MOST - n, first]
            odds = race_odds(m, n, Rack(float(P1[at]), float(P2[at])), breaks, first)
            for player, one, scalar in zip(
                (1, 2), chance, (odds.p_win_1, odds.p_win_2), strict=True
            ):
                witness = wins(longest, expected, player)
                assert one[at] == pytest.approx(witness, rel=1e-12, abs=0)
                assert scalar == pytest.approx(witness, rel=1e-12, abs=0)
            by_score: dict[Any, float] = {}
            for (a, b, _), mass in expected.items():
                score = a - MOST + m, b - MOST + n
                by_score[score] = by_score.get(score, 0.0) + mass
            found = {score: mass[at] for score, mass in ends.items() if mass[at]}
            assert found == pytest.approx(by_score, rel=1e-12, abs=0)
            by_length = {sum(score): 0.0 for score in by_score}
            for score, mass in by_score.items():
                by_length[sum(score)] += mass
            lengths = dict(zip(odds.games, odds.probability, strict=True))
            assert {k: mass for k, mass in lengths.items() if mass} == pytest.approx(
                by_length, rel=1e-12, abs=0
            )


def test_races_where_the_break_does_not_matter() -> None:
    for i, p in enumerate(PROBABILITIES):
        race = Race(MOST, MOST, Rack(float(p)))
        found = limits(race, scores_to(MOST))
        for m, n in SIZES:
            expected = [wins(race, found[MOST - m, MOST - n], player) for player in (1, 2)]
            short = Race(m, n, Rack(PROBABILITIES))
            kernels = [win_probability(short, player=player)[i] for player in (1, 2)]
            assert kernels == pytest.approx(expected, rel=1e-12, abs=0)
            assert race_win_probability(p, m, n) == pytest.approx(expected[0], rel=1e-12, abs=0)
            odds = race_odds(m, n, float(p))
            assert [odds.p_win_1, odds.p_win_2] == pytest.approx(expected, rel=1e-12, abs=0)


def deuce_states(win_by: int) -> list[tuple[int, int]]:
    """Return every state of a race 5:5 won by `win_by`, reachable or not."""
    race = Race(MOST, MOST, Rack(0.5), win_by=win_by)
    scores = product(range(MOST + win_by), repeat=2)
    return sorted({race.fold(a, b) for a, b in scores if race.decided(a, b) is None})


@pytest.mark.slow_after(2)
@FORMATS
@pytest.mark.parametrize("win_by", [2, 3])
def test_races_won_by_more_than_one(breaks: Any, win_by: int) -> None:
    longest = Race(MOST, MOST, Rack(0.5, 0.5), breaks=breaks, win_by=win_by)
    states = [(a, b, s) for a, b in deuce_states(win_by) for s in (1, 2)]
    table = all_limits(lambda rack: Race(MOST, MOST, rack, breaks=breaks, win_by=win_by), states)
    for (m, n), first in product(SIZES, (1, 2)):
        race = Race(m, n, Rack(P1, P2), breaks=breaks, first_breaker=first, win_by=win_by)
        start = (*longest.fold(MOST - m, MOST - n), first)
        for player in (1, 2):
            expected = [wins(longest, table[at][start], player) for at in np.ndindex(P1.shape)]
            assert win_probability(race, player=player).ravel().tolist() == pytest.approx(
                expected, rel=1e-12, abs=0
            )


@pytest.mark.slow_after(1)
@FORMATS
def test_ahead_in_a_break_format(breaks: Any) -> None:
    for total in range(2, 2 * MOST + 1):
        # n-ahead total-1 : 1 from the lead `total - 1 - m` is n-ahead m : total - m.
        widest = Ahead(total - 1, 1, Rack(0.5, 0.5), breaks=breaks)
        states = [(lead, 0, s) for lead in range(total - 1) for s in (1, 2)]
        table = all_limits(lambda rack, t=total: Ahead(t - 1, 1, rack, breaks=breaks), states)  # type: ignore[misc]
        sizes = [(m, total - m) for m in range(1, total) if max(m, total - m) <= MOST]
        for (m, n), first in product(sizes, (1, 2)):
            match = Ahead(m, n, Rack(P1, P2), breaks=breaks, first_breaker=first)
            start = (total - 1 - m, 0, first)
            for player in (1, 2):
                expected = [wins(widest, table[at][start], player) for at in np.ndindex(P1.shape)]
                assert win_probability(match, player=player).ravel().tolist() == pytest.approx(
                    expected, rel=1e-12, abs=0
                )


MATCHES = {
    name: game
    for name, game in CATALOG.items()
    if isinstance(game, Match) and isinstance(game.innermost_rack, Rack)
}


@pytest.mark.parametrize("match", MATCHES.values(), ids=list(MATCHES))
def test_every_cataloged_match(match: Match) -> None:
    chain = chain_of(match)
    limit = stochastic_limit(chain).to_dict()
    passage = steps_to_absorption(chain)
    odds, length = match_odds(match), match_length(match)
    for player, scalar in ((1, odds.p_win_1), (2, odds.p_win_2)):
        expected = sum(mass for end, mass in limit.items() if match.winner(end) == player)
        assert scalar == pytest.approx(expected, rel=1e-12, abs=0)
        assert win_probability(match, player=player) == pytest.approx(expected, rel=1e-12, abs=0)
    mean, variance = passage.mean, passage.variance
    assert mean is not None
    assert variance is not None
    assert odds.mean_games == pytest.approx(mean, rel=1e-12)
    assert length.mean == pytest.approx(mean, rel=1e-12)
    assert odds.sd_games == pytest.approx(variance**0.5, rel=1e-11)
    assert length.sd == pytest.approx(variance**0.5, rel=1e-11)
    assert odds.games_p50 == length.quantile(0.5) == passage.quantile(0.5)
    assert odds.games_p90 == length.quantile(0.9) == passage.quantile(0.9)


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("first", [1, 2])
@pytest.mark.parametrize("outer", [None, alternate_breaks])
def test_matches_of_sets(outer: Any, first: int) -> None:
    for m, n in product(range(1, 4), repeat=2):
        sets = [
            Race(m, 2, Rack(P1, P2), breaks=alternate_breaks),
            Race(2, n, Rack(P1, P2), breaks=BREAK_FORMATS["loser"], score=(1, 0)),
            Ahead(m, n, Rack(P1, P2), breaks=BREAK_FORMATS["winner"]),
        ]
        for inner in sets:
            match = Race(m, n, inner, breaks=outer, first_breaker=first)
            found = win_probability(match), win_probability(match, player=2)
            scores = final_scores(match).probability
            for at in ((1, 1), (1, 3), (2, 4), (4, 3), (0, 2)):
                one = Race(
                    m,
                    n,
                    type(inner)(
                        inner.m,
                        inner.n,
                        Rack(float(P1[at]), float(P2[at])),
                        breaks=inner.breaks,
                        score=inner.score,
                    ),
                    breaks=outer,
                    first_breaker=first,
                )
                limit = stochastic_limit(chain_of(one)).to_dict()
                ends = {s: mass for s, mass in limit.items() if one.winner(s) and mass}
                for player in (1, 2):
                    expected = wins(one, ends, player)
                    assert found[player - 1][at] == pytest.approx(expected, rel=1e-12, abs=0)
                by_score: dict[Any, float] = {}
                for (a, b, _), mass in ends.items():
                    by_score[a, b] = by_score.get((a, b), 0.0) + mass
                assert {s: mass[at] for s, mass in scores.items() if mass[at]} == pytest.approx(
                    by_score, rel=1e-12, abs=0
                )
