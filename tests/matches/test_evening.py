"""The promise of an evening (it ends by then 9 times in 10) is held to evenings played out."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.evening import Length, evening
from evenbreak.matches.length import match_length
from evenbreak.matches.minutes import match_minutes
from evenbreak.matches.pace import PACES, Pace, Turnover
from evenbreak.matches.races import race_odds
from evenings import played_evening
from rows import each_of
from tiers import examples

EVEN = Length([1, 2], [0.5, 0.5])
SKEW = Length([2, 3, 5], [0.25, 0.5, 0.25])
FIXED = Length([4], [1.0])
BY_GAMES = {"pace": Pace(0.0, 1.0, 0.0, 0.0), "turnover": Turnover(0.0)}
"""A minute a game, always, and no turnover: the end in games."""

NINE_BALL = (3.8, 5.58, 0.275, 0.094)
USUAL = (7.5, 10.8)
ROUND = [("Ann", "Bo"), ("Ann", "Cy"), ("Ann", "Di"), ("Bo", "Cy"), ("Bo", "Di"), ("Cy", "Di")]
APART = [(f"a{k}", f"b{k}") for k in range(8)]
RACES = [(7, 5, 0.6), (5, 5, 0.5), (9, 4, 0.7), (3, 2, 0.55), (7, 7, 0.45), (6, 3, 0.62)]


@pytest.mark.slow_after(1)
@pytest.mark.parametrize(
    ("tables", "pairs"), [(1, APART), (6, APART), (2, APART), (3, APART), (1, ROUND), (2, ROUND)]
)
def test_nine_of_ten_evenings_end_by_then(tables, pairs):
    lengths = [race_odds(*race) for race in RACES]
    promise = evening(lengths, "9-ball", tables=tables, players=pairs[:6])
    rng = np.random.default_rng(tables)
    played = 4000
    ends = np.array(
        [played_evening(rng, RACES, NINE_BALL, USUAL, tables, pairs) for _ in range(played)]
    )
    # p90 may itself be off by its standard error, which the density of the ends turns to a share.
    off = np.mean(np.abs(ends - promise.p90) < promise.p90_error)
    assert np.mean(ends <= promise.p90) == pytest.approx(
        0.9, abs=4 * np.hypot(0.3 / played**0.5, off)
    )
    error = ends.std() / played**0.5
    assert promise.mean == pytest.approx(ends.mean(), abs=4 * np.hypot(error, promise.mean_error))
    assert promise.sd == pytest.approx(ends.std(), rel=0.08)
    assert promise.exact == (tables in {1, 6})


def test_games_that_all_take_as_long_would_promise_too_much():
    """Of twelve matches on three tables, 9 of 10 evenings of equal games end 15 minutes sooner."""
    lengths = [race_odds(7, 5, 0.6)] * 12
    equal = Pace(0.0, 8.0, 0.0, 0.0)
    spread = Pace(0.0, 8.0, 0.29, 0.11)
    without, with_spread = (evening(lengths, pace, tables=3).p90 for pace in (equal, spread))
    assert with_spread > without + 15.0


def test_turnovers_lengthen_the_evening_but_not_after_its_last_match():
    one = evening([FIXED], Pace(0, 8, 0, 0), turnover=Turnover(10, 0))
    four = evening([FIXED] * 4, Pace(0, 8, 0, 0), turnover=Turnover(10, 0), tables=2)
    assert one.p90 == pytest.approx(32.0, abs=1e-3)
    assert four.p90 == pytest.approx(32.0 + 10.0 + 32.0, abs=1e-3)


def test_what_is_calculated_is_what_is_simulated():
    lengths = [race_odds(7, 5, 0.6)] * 20
    calculated = evening(lengths, "8-ball")
    simulated = evening(lengths, "8-ball", runs=20_000)
    assert calculated.exact
    assert not simulated.exact
    assert simulated.mean == pytest.approx(calculated.mean, abs=4 * simulated.mean_error)
    assert simulated.p90 == pytest.approx(calculated.p90, abs=4 * simulated.p90_error)
    assert simulated.sd == pytest.approx(calculated.sd, rel=0.02)


def test_four_players_need_no_third_table():
    two = evening([SKEW] * 6, **BY_GAMES, tables=2, players=ROUND, runs=500)
    three = evening([SKEW] * 6, **BY_GAMES, tables=3, players=ROUND, runs=500)
    assert two == three


def test_one_table_is_calculated_whoever_plays():
    answer = evening([SKEW] * 6, **BY_GAMES, players=ROUND)
    assert answer.exact
    assert answer.mean == pytest.approx(6 * 3.25)


@pytest.mark.parametrize(("tables", "end"), [(1, 24.0), (2, 12.0), (6, 4.0)])
def test_an_evening_without_luck_ends_when_it_must(tables, end):
    answer = evening([FIXED] * 6, **BY_GAMES, tables=tables)
    assert (answer.mean, answer.p90) == pytest.approx((end, end), rel=1e-5)
    assert (answer.sd, answer.mean_error, answer.p90_error) == pytest.approx((0, 0, 0), abs=1e-3)


def test_the_seed_decides():
    def ask(seed):
        rng = np.random.default_rng(seed)
        return evening([SKEW] * 6, "9-ball", tables=2, players=ROUND, rng=rng, runs=1_000)

    assert ask(1) == ask(1)
    assert ask(1) != ask(2)


def test_laws_of_races_will_do():
    law, length = race_odds(3, 2, 0.6), match_length(Race(3, 2, Rack(0.6)))
    assert evening([law], PACES["9-ball"]).mean == pytest.approx(3.8 + 5.58 * law.mean, rel=1e-12)
    assert evening([length] * 50, "9-ball", tables=50).exact


@pytest.mark.slow
def test_many_tables_are_simulated():
    law = race_odds(9, 9, 0.5)
    answer = evening([law] * 40, "9-ball", tables=9)
    assert not answer.exact
    assert 0.0 < answer.mean_error < answer.p90_error < 1.0


laws = st.lists(st.sampled_from([EVEN, SKEW, FIXED]), min_size=1, max_size=6)


@given(laws, st.integers(1, 4))
@settings(max_examples=examples(20), deadline=None)
def test_each_table_more_ends_the_evening_no_later(laws, tables):
    # Of matches that all begin in the order of the list; of other orders it need not be so.
    fewer = evening(laws, **BY_GAMES, tables=tables, runs=200)
    more = evening(laws, **BY_GAMES, tables=tables + 1, runs=200)
    assert more.mean <= fewer.mean + 1e-9
    assert more.p90 <= fewer.p90 + 1e-9


@each_of(
    "call, remedy",
    [
        (lambda: evening([], "9-ball"), "0 matches"),
        (lambda: evening([EVEN], "9-ball", tables=0), "1 or more"),
        (lambda: evening([EVEN], "snooker"), "snooker"),
        (lambda: evening([EVEN], 8), "pace must"),
        (lambda: evening([EVEN], "9-ball", turnover=5), "turnover must"),
        (lambda: match_minutes([5], [1.0], "9-ball"), "pace must be a Pace; you gave '9-ball"),
        (lambda: evening([Length([1, 2], [1.0])], "9-ball"), "length 1 is"),
        (lambda: evening([EVEN, Length([1.5], [1.0])], "9-ball"), "length 2 is"),
        (lambda: evening([Length([-1], [1.0])], "9-ball"), "numbers of games"),
        (lambda: evening([Length([1, 2], [0.5, 0.6])], "9-ball"), "that sum to 1; they don't"),
        (lambda: evening([EVEN], "9-ball", players=[]), "0 pairs for 1 matches"),
        (lambda: evening([EVEN], "9-ball", players=[("Ann", "Ann")]), "Ann"),
        (lambda: evening([EVEN] * 2, "9-ball", runs=1), "2 or more"),
        (lambda: evening([EVEN] * 1001, "9-ball", tables=50), "1 to 1,000"),
    ],
)
def test_refused(call, remedy):
    with pytest.raises(InputError, match=remedy):
        call()
