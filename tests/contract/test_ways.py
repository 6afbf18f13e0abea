"""Every function that answers for a chain gives the same by every way: kernel, limit, limit."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.chains import limit_of, stochastic_limit
from evenbreak.chains.explore import chain_of
from evenbreak.chains.ways import WAYS
from evenbreak.errors import AccuracyError, ChainError, InputError
from evenbreak.games import BREAK_FORMATS, CATALOG, Ahead, Drill, OneBall, Race, Rack
from evenbreak.games.match import Match
from evenbreak.handicaps import EQUAL_SKILL, Ladder, RatingLadder, chart, fair_races
from evenbreak.matches import game_odds, match_length, match_odds, win_probability
from evenbreak.practice import (
    ShotChoice,
    compare_break_formats,
    compare_shots,
    drill_statistics,
    long_run_share,
    one_ball_win,
)
from rows import each_of
from tiers import examples

ROADS = ("elimination", "eigen")
"""The ways that lead over the chain."""

EXACT = 1e-12
NPL = ("npl_8", "npl_10", "npl_12", "npl_20")
MATCHES = {name: game for name, game in CATALOG.items() if isinstance(game, Match)}
LADDERS = {name: Ladder(chart(name)) for name in NPL}
GAMES = CATALOG | LADDERS
CHANCES = st.floats(0.01, 0.99) | st.sampled_from([0.0, 0.5, 1.0])


def has_kernel(game):
    """Return whether the states stand in a line."""
    return chain_of(game).line is not None


@each_of("via", WAYS)
@each_of("game", GAMES.values())
def test_a_game_of_the_catalog_has_one_limit(game, via) -> None:
    expected = stochastic_limit(chain_of(game))
    if via == "kernel" and not has_kernel(game):
        with pytest.raises(ChainError, match="Use elimination"):
            limit_of(game, via=via)
        return
    limit = limit_of(game, via=via)
    assert limit.period == expected.period
    np.testing.assert_allclose(
        [limit[state] for state in expected.states], expected.probability, rtol=0, atol=EXACT
    )


@each_of("via", ROADS)
@each_of("match", MATCHES.values())
def test_a_match_of_the_catalog(match, via) -> None:
    for player in (1, 2):
        found = win_probability(match, player=player, via=via)
        assert found == pytest.approx(win_probability(match, player=player), rel=0, abs=EXACT)
    kernel, found = match_odds(match), match_odds(match, via=via)
    for name, value in kernel._asdict().items():
        if value is None:
            assert getattr(found, name) is None, name
        else:
            assert getattr(found, name) == pytest.approx(value, rel=EXACT, abs=EXACT), name


@pytest.mark.slow
@pytest.mark.parametrize("via", ROADS)
@given(
    p=CHANCES, q=CHANCES, breaks=st.sampled_from([*BREAK_FORMATS]), first=st.sampled_from([1, 2])
)
@settings(max_examples=examples(40), deadline=None)
def test_matches_of_any_players(via, p, q, breaks, first) -> None:
    rack, order = Rack(p, q), {"breaks": BREAK_FORMATS[breaks], "first_breaker": first}
    for match in (
        Race(4, 3, rack, **order),
        Race(2, 2, rack, win_by=2, **order),
        Ahead(2, 3, rack, **order),
    ):
        kernel, found = match_odds(match), match_odds(match, via=via)
        assert found[:3] == pytest.approx(kernel[:3], rel=0, abs=EXACT)
    share = long_run_share(p, q, order["breaks"], first_breaker=first)
    found = long_run_share(p, q, order["breaks"], first_breaker=first, via=via)
    assert found == pytest.approx(share, rel=0, abs=EXACT)


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("via", ROADS)
@given(p=CHANCES, q=CHANCES)
@settings(max_examples=examples(40), deadline=None)
def test_one_ball_games_of_any_players(via, p, q) -> None:
    for look_ahead in ("infinite", "two shots"):
        expected = one_ball_win(p, q, look_ahead=look_ahead)
        found = one_ball_win(p, q, look_ahead=look_ahead, via=via)
        assert found == pytest.approx(expected, rel=0, abs=EXACT)


@pytest.mark.parametrize("via", ROADS)
def test_shots_break_formats_and_drills(via) -> None:
    shots = [ShotChoice("1", 0.4, 0.8, (0.5, 0.2)), ShotChoice("2", 0.3, 0.3)]
    for look_ahead in ("infinite", "two shots", "all shots"):
        kernel = compare_shots(shots, look_ahead=look_ahead)
        found = compare_shots(shots, look_ahead=look_ahead, via=via)
        assert [one.shot for one in found] == [one.shot for one in kernel]
        assert [one.win for one in found] == pytest.approx([one.win for one in kernel], abs=EXACT)
    kernel, found = (compare_break_formats(Rack(0.9, 0.5), lose=2, via=way) for way in (None, via))
    for one, other in zip(kernel, found, strict=True):
        assert one.name == other.name
        assert one[1:] == pytest.approx(other[1:], abs=EXACT)
    for drill in (Drill.progressive(0.8), Drill.eight_ball(0.3), Drill([1, 0, 0.5]), Drill([0.5])):
        kernel, found = drill_statistics(drill), drill_statistics(drill, via=via)
        assert found.period == kernel.period
        assert found.distribution.probability == pytest.approx(
            kernel.distribution.probability, rel=0, abs=EXACT
        )


@pytest.mark.slow_after(7)
@pytest.mark.parametrize("via", ROADS)
@pytest.mark.parametrize(
    "ladder",
    [
        *LADDERS.values(),
        Ladder("npl", opponents=EQUAL_SKILL),
        Ladder("step 3"),
        Ladder("step 2 1"),
        Ladder("elo"),
        Ladder("npl", day_sd=5.0, drift=0.1),
        Ladder("npl", widest=960),
        RatingLadder([0.75, 0.5, 0.25]),
        RatingLadder([1.0, 1.0, 0.5, 0.0, 0.0]),
    ],
    ids=lambda ladder: repr(ladder)[:60],
)
def test_ladders(ladder, via) -> None:
    expected = np.array(ladder.law().probability)
    np.testing.assert_allclose(ladder.law(via=via).probability, expected, rtol=0, atol=EXACT)


@pytest.mark.parametrize("via", ROADS)
def test_fair_races(via) -> None:
    asked = {"games": (5, 13), "breaks": BREAK_FORMATS["winner"], "first_breaker": 2}
    for one, other in zip(
        fair_races(Rack(0.6, 0.5), **asked),
        fair_races(Rack(0.6, 0.5), **asked, via=via),
        strict=True,
    ):
        assert (one.race_1, one.race_2) == (other.race_1, other.race_2)
        assert one.p_win_1 == pytest.approx(other.p_win_1, rel=0, abs=EXACT)


def test_the_length_has_no_way_by_eigenvectors() -> None:
    match = Race(3, 2, OneBall(0.4, 0.8))
    kernel, found = match_length(match, via="kernel"), match_length(match, via="elimination")
    assert found.mean == pytest.approx(kernel.mean, rel=1e-13)
    assert found.probability == pytest.approx(kernel.probability, abs=EXACT)
    with pytest.raises(InputError, match="'elimination'"):
        match_length(match, via="eigen")


def test_a_game_of_ones_own_has_no_kernel() -> None:
    game = OneBall(0.4, 0.8)
    assert win_probability(game, via="eigen") == pytest.approx(game_odds(game).p_win[1], abs=EXACT)
    assert win_probability(game, "S2", via="eigen") == pytest.approx(0.2 * 5 / 11, abs=EXACT)
    for ask in (win_probability, match_length):
        with pytest.raises(InputError, match="Use elimination"):
            ask(game, via="kernel")


@pytest.mark.parametrize("slow", [1e-6, 1e-12])
def test_eigenvectors_answer_where_eigenvalues_are_next_to_1(slow) -> None:
    for way in ROADS:
        assert one_ball_win(slow, slow, via=way) == pytest.approx(0.5 / (1 - slow / 2), rel=1e-14)


def test_eigenvectors_that_cannot_be_trusted_to_12_digits_name_the_way_that_can() -> None:
    slow = 1e-17  # a factorization in floats cannot tell this from 0
    assert one_ball_win(slow, slow, via="elimination") == pytest.approx(0.5 / (1 - slow / 2))
    with pytest.raises(AccuracyError, match="Use elimination"):
        one_ball_win(slow, slow, via="eigen")


def test_what_has_one_way_only_is_refused() -> None:
    with pytest.raises(InputError, match="Leave out via"):
        win_probability(Race(2, 2, Rack(0.5)), exact=True, via="eigen")
    with pytest.raises(InputError, match=r"p1 must be one number\. For an array"):
        win_probability(Race(2, 2, Rack([0.5, 0.6])), via="eigen")
    with pytest.raises(InputError, match="p1"):
        one_ball_win([0.4, 0.5], 0.2, via="eigen")
    with pytest.raises(
        InputError, match="via must be 'kernel', 'elimination' or 'eigen'; you gave 'power'"
    ):
        drill_statistics(Drill([0.5, 0.5]), via="power")
