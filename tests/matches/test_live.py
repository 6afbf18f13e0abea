from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak import InputError
from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.games import (
    Ahead,
    Race,
    Rack,
    alternate_breaks,
    loser_breaks,
    player_1_breaks,
    winner_breaks,
)
from evenbreak.matches import live_odds, match_length, match_odds, win_probability
from evenbreak.matches.rack_by_rack import rack_moves
from tiers import examples

SETS = Race(3, 1, Race(3, 3, Rack(2 / 3)))
MATCHES = [
    Race(5, 3, Rack(0.6)),
    Race(5, 4, Rack(0.7, 0.6), breaks=alternate_breaks, first_breaker=2),
    Race(4, 4, Rack(0.7, 0.4), breaks=loser_breaks),
    Race(3, 3, Rack(0.55), win_by=2),
    Ahead(3, 2, Rack(0.45)),
    Ahead(2, 2, Rack(0.7, 0.6), breaks=winner_breaks),
    SETS,
    Race(2, 2, Race(3, 2, Rack(0.6, 0.7), breaks=winner_breaks), breaks=alternate_breaks),
    Ahead(2, 1, Race(2, 2, Rack(0.4), win_by=2)),
    Race(2, 2, Race(2, 1, Race(1, 2, Rack(0.6)))),
]


def exact_race(p, m, n):
    @cache
    def W(a, b):  # noqa: N802
        if a == m or b == n:
            return Fraction(a == m)
        return p * W(a + 1, b) + (1 - p) * W(a, b + 1)

    return W


@given(st.integers(1, 7), st.integers(1, 7), st.integers(1, 19), st.data())
def test_a_race_against_fractions(m, n, twentieths, data):
    p = Fraction(twentieths, 20)
    W = exact_race(p, m, n)
    winners, a, b = [], 0, 0
    while a < m and b < n and data.draw(st.booleans()):
        winners.append(data.draw(st.sampled_from([1, 2])))
        a, b = a + (winners[-1] == 1), b + (winners[-1] == 2)
    live = live_odds(Race(m, n, Rack(float(p))), winners)
    assert live.now.scores == ((a, b),)
    assert live.now.p_win_1 == pytest.approx(float(W(a, b)), rel=1e-13)
    assert live.now.p_win_2 == pytest.approx(float(1 - W(a, b)), rel=1e-13)
    if a < m and b < n:
        assert live.now.leverage == pytest.approx(float(W(a + 1, b) - W(a, b + 1)), rel=1e-12)
        table = {standing.scores[0]: standing for standing in live.comebacks()}
        assert set(table) == {(i, j) for i in range(a, m) for j in range(b, n)}
        for score, standing in table.items():
            assert standing.p_win_1 == pytest.approx(float(W(*score)), rel=1e-13)
    else:
        assert live.now.leverage is None
        assert (live.now.mean_racks, live.now.racks_p90, live.comebacks()) == (0.0, 0, [])


@pytest.mark.parametrize("match", MATCHES)
def test_the_first_moment_is_what_the_other_kernels_say(match):
    live, odds = live_odds(match), match_odds(match)
    assert live.now.p_win_1 == pytest.approx(odds.p_win_1, rel=1e-12)
    assert live.now.p_win_2 == pytest.approx(odds.p_win_2, rel=1e-12)
    assert live.now.mean_racks == pytest.approx(odds.mean_games, rel=1e-12)
    assert live.now.racks_p90 == odds.games_p90


@pytest.mark.parametrize("match", MATCHES)
def test_every_moment_of_the_table_against_the_graph(match):
    chain = chain_of(match)
    values = live_odds(match)._values
    for state in values.moves:
        limit = stochastic_limit(chain, state)
        won = sum(limit[end] for end in limit if match.winner(end) == 1)
        assert values.standing(state).p_win_1 == pytest.approx(won, rel=1e-9)


@settings(max_examples=examples(60))
@given(st.sampled_from(MATCHES), st.lists(st.sampled_from([1, 2]), max_size=12))
def test_chances_are_what_the_next_rack_makes_of_them(match, winners):
    try:
        live = live_odds(match, winners)
    except InputError:
        return
    for standing, swing, winner in zip(live.course, live.swings, winners, strict=False):
        after = standing.p_win_1_after
        p = match.innermost_rack.chance(1, standing.breaker or 1)
        assert standing.p_win_1 == pytest.approx(p * after[0] + (1 - p) * after[1], rel=1e-11)
        assert standing.p_win_1 + swing == pytest.approx(after[winner - 1], abs=1e-12)
    assert sum(live.swings) == pytest.approx(live.now.p_win_1 - live.course[0].p_win_1)


def test_the_start_score_and_racks_on_the_way_to_it_tell_the_same():
    race = Race(7, 5, Rack(0.6, 0.55), breaks=alternate_breaks)
    on_the_way = live_odds(race, [1, 2, 2, 1])
    there = live_odds(Race(7, 5, Rack(0.6, 0.55), breaks=alternate_breaks, score=(2, 2)))
    assert on_the_way.now == there.now
    assert there.now.p_win_1 == pytest.approx(win_probability(race, (2, 2)), rel=1e-13)


def test_sets_under_way():
    live = live_odds(SETS, [1, 1, 2, 1, 2])
    assert [standing.scores for standing in live.course] == [
        ((0, 0), (0, 0)),
        ((0, 0), (1, 0)),
        ((0, 0), (2, 0)),
        ((0, 0), (2, 1)),
        ((1, 0), (0, 0)),
        ((1, 0), (0, 1)),
    ]
    W = win_probability(Race(3, 3, Rack(2 / 3)))
    assert live.course[4].p_win_1 == pytest.approx(W**2)
    assert live.now == live_odds(Race(3, 1, SETS.rack, score=(1, 0)), set_score=(0, 1)).now
    assert live_odds(SETS, [2, 2, 2]).now.scores == ((0, 1),)


def test_the_break_goes_on_inside_a_set_that_is_under_way():
    match = Race(2, 2, Race(3, 3, Rack(1.0, 1.0), breaks=alternate_breaks), first_breaker=2)
    # Whoever breaks wins: the set goes to B, then A breaks first and wins one, then B.
    live = live_odds(match, set_score=(2, 2))
    assert (live.now.breaker, live.now.p_win_1_after) == (2, (1.0, 0.0))
    assert [s.breaker for s in live_odds(match, [2], set_score=(2, 2)).course] == [2, 1]


def test_an_ahead_match_counts_all_racks_and_its_table_tells_leads():
    live = live_odds(Ahead(3, 2, Rack(0.5)), [1, 1, 2, 1])
    assert live.now.scores == ((3, 1),)
    assert [standing.scores[0] for standing in live.comebacks()] == [(0, 0), (0, 1), (1, 0), (2, 0)]
    assert live.now.p_win_1 == pytest.approx(4 / 5)


def test_a_player_may_win_a_rack_without_a_chance():
    live = live_odds(Race(2, 2, Rack(1.0)), [2])
    assert [standing.p_win_1 for standing in live.course] == [1.0, 1.0]
    assert live.now.p_win_1_after == (1.0, 0.0)


def test_a_match_that_may_never_end():
    live = live_odds(Ahead(2, 2, Rack(1.0, 1.0), breaks=alternate_breaks))
    assert (live.now.p_win_1, live.now.p_win_2) == (0.0, 0.0)
    assert (live.now.mean_racks, live.now.racks_p90) == (None, None)


@pytest.mark.parametrize("match", MATCHES)
def test_the_length_from_a_score_on(match):
    (state, _), _ = rack_moves(match)[match.start]
    mass, racks = {state: 1.0}, 0
    while sum(mass.values()) > 0.1 * (1 + 1e-12):
        after = {}
        for here, held in mass.items():
            for target, chance in match.moves(here).items():
                if match.moves(target):
                    after[target] = after.get(target, 0.0) + held * chance
        mass, racks = after, racks + 1
    assert live_odds(match, [1]).now.racks_p90 == racks


def test_a_long_unbounded_match():
    match = Ahead(30, 30, Rack(0.5))
    assert live_odds(match).now.racks_p90 == match_length(match).quantile(0.9)
    assert live_odds(match).now.mean_racks == pytest.approx(900)


@pytest.mark.parametrize(
    ("match", "winners", "options", "remedy"),
    [
        (Race(2, 2, Rack(0.5)), [1, 1, 2], {}, r"over after 2 of 3 racks, at 2-0\. Leave out"),
        (Race(2, 2, Rack(0.5)), [3], {}, "winner of rack 1 must be 1 or 2; you gave 3"),
        (Race(2, 2, Rack([0.5, 0.6])), [], {}, "one number"),
        (
            Rack(0.5),
            [],
            {},
            (
                r"match must be a Race or an Ahead; you gave Rack\(p1=0\.5, p2=None\)\. For a "
                r"game use game_odds\(game\)\."
            ),
        ),
        (Race(2, 2, Rack(0.5)), [], {"set_score": (1, 0)}, "Leave it out"),
        (SETS, [], {"set_score": (3, 1)}, "set_score is 3-1"),
        (SETS, [], {"set_score": (4, 1)}, "set_score is 4-1, which can't be reached"),
        (Race(1, 1, SETS.rack, score=(1, 0)), [], {"set_score": (1, 0)}, r"is over\. Leave"),
    ],
)
def test_wrong_use_says_how_to_mend_it(match, winners, options, remedy):
    with pytest.raises(InputError, match=remedy):
        live_odds(match, winners, **options)


def test_a_break_for_one_player_only():
    live = live_odds(Race(3, 3, Rack(0.6, 0.5), breaks=player_1_breaks, first_breaker=2), [2])
    assert [standing.breaker for standing in live.course] == [2, 1]


def test_with_form_the_course_is_that_of_the_law_of_scores():
    race = Race(5, 4, Rack(0.55))
    live = live_odds(race, [1, 1, 2], form=0.5)
    for standing in (live.course[0], *live.comebacks()):
        (score,) = standing.scores
        odds = match_odds(replace(race, score=score), form=0.5)
        assert standing.p_win_1 == pytest.approx(odds.p_win_1, abs=1e-12)
        assert standing.p_win_2 == pytest.approx(odds.p_win_2, abs=1e-12)
        assert standing.mean_racks == pytest.approx(odds.mean_games, abs=1e-12)
    assert live.now.racks_p90 == match_odds(replace(race, score=(2, 1)), form=0.5).games_p90
    plain = live_odds(race, [1, 1, 2], form=0.0)
    assert plain.course == live_odds(race, [1, 1, 2]).course
    assert live.swings[0] > plain.swings[0]  # a rack won also shows form


def test_form_is_refused_where_order_matters():
    with pytest.raises(InputError, match="form"):
        live_odds(Race(3, 3, Rack(0.6), win_by=2), form=0.3)
