"""What tells whether play inside matches is what the model says."""

import math
from itertools import pairwise, permutations

import numpy as np
import pytest

from evenbreak.matches import race_win_probability
from evenbreak.ratings import Results, walk_forward
from evenbreak.ratings.within_matches import (
    break_advantage,
    dispersion,
    first_breaks,
    play_races,
    side_advantage,
    streaks,
)

PLAYERS = 20


def played(rng, *, matches=1200, form=0.0, advantage=0.0, side=0.0, breaks=3, streak=0.0):
    """Return a season of races to 7, rack by rack, with what is odd in it."""
    skill = rng.normal(0.0, 0.5, PLAYERS)
    a = rng.integers(0, PLAYERS, matches)
    b = (a + rng.integers(1, PLAYERS, matches)) % PLAYERS
    first = rng.integers(1, 3, matches)
    racks = []
    for k in range(matches):
        d = skill[a[k]] - skill[b[k]] + side + form * rng.standard_normal()
        text, broke, last = "", first[k], 0.0
        while max(text.count("a"), text.count("b")) < 7:
            edge = advantage if broke == 1 else -advantage
            won = rng.random() < 1 / (1 + math.exp(-(d + edge + streak * last)))
            text, last = text + "ba"[won], 1.0 if won else -1.0
            broke = 3 - broke if breaks == 3 else (1 if won else 2)
        racks.append(text)
    return Results(
        tuple(f"p{k:02d}" for k in range(PLAYERS)), a, b,
        [text.count("a") for text in racks], [text.count("b") for text in racks],
        date=np.datetime64("2024-09-03") + np.arange(matches) // 40,
        racks=np.array(racks, dtype=object), first_break=first,
        break_format=np.full(matches, breaks),
    )  # fmt: skip


@pytest.fixture(scope="module")
def plain():
    return walk_forward(played(np.random.default_rng(1)), prior_sd=0.5)


def test_a_season_of_the_model_shows_nothing(plain):
    spread, runs = dispersion(plain, np.random.default_rng(2)), streaks(plain)
    first, side, breaker = first_breaks(plain), side_advantage(plain), break_advantage(plain)
    assert spread is not None
    assert runs is not None
    assert first is not None
    assert side is not None
    assert breaker is not None
    assert min(spread.p_value, runs.p_value, first.p_value) > 0.01
    assert spread.races == 1160
    assert side.low < 0.0 < side.high
    assert breaker.low < 0.0 < breaker.high


def test_good_and_bad_days_spread_the_scores():
    told = walk_forward(played(np.random.default_rng(3), form=0.6), prior_sd=0.5)
    found = dispersion(told, np.random.default_rng(2))
    assert found is not None
    assert found.seen > found.by_chance + 0.1
    assert found.p_value < 1e-4


@pytest.mark.parametrize(("streak", "sign"), [(0.5, -1), (-0.5, 1)])
def test_streaks_are_fewer_runs(streak, sign):
    told = walk_forward(played(np.random.default_rng(4), streak=streak), prior_sd=0.5)
    found = streaks(told)
    assert found is not None
    assert np.sign(found.z) == sign
    assert found.p_value < 1e-4


def test_good_and_bad_days_are_no_streaks():
    told = walk_forward(played(np.random.default_rng(5), form=1.0), prior_sd=0.5)
    found = streaks(told)
    assert found is not None
    assert found.p_value > 0.01


def test_runs_are_counted_as_every_order_of_the_racks_has_them():
    """A race 4-2 ends with an a; the other five racks come in any order."""
    results = Results.from_names(
        ["Ann", "Ann"], ["Bo", "Bo"], [4, 3], [2, 3], race_a=[4, 4], race_b=[4, 4],
        racks=["abbaaa", "ababba"], date=["2024-09-03", "2024-09-04"],
    )  # fmt: skip
    found = streaks(walk_forward(results))
    assert found is not None

    def runs(order):
        return 1 + sum(one != other for one, other in pairwise(order))

    laws = [[runs(order) for order in permutations(racks)] for racks in ("aaabb", "aaabbb")]
    assert found.runs == 3 + 5
    assert found.expected == pytest.approx(sum(np.mean(law) for law in laws))
    sd = math.sqrt(sum(np.var(law) for law in laws))
    assert found.z == pytest.approx((found.runs - found.expected) / sd)


@pytest.mark.parametrize("breaks", [3, 1], ids=["alternate", "winner"])
def test_the_advantage_of_the_breaker_is_found(breaks):
    told = walk_forward(
        played(np.random.default_rng(6), advantage=0.3, breaks=breaks), prior_sd=0.5
    )
    found = break_advantage(told)
    assert found is not None
    assert found.low < 0.3 < found.high
    assert found.low > 0.15


@pytest.mark.parametrize("form", [0.0, 0.6])
def test_who_breaks_because_he_is_the_stronger_gets_no_advantage_for_it(form):
    """Winner breaks give the break to whoever is stronger on the day."""
    told = walk_forward(played(np.random.default_rng(10), form=form, breaks=1), prior_sd=0.5)
    found = break_advantage(told)
    assert found is not None
    assert found.low < 0.0 < found.high
    assert found.high - found.low < 0.25


def test_the_advantage_of_the_first_column_is_found():
    told = walk_forward(played(np.random.default_rng(7), side=0.3), prior_sd=0.5)
    found = side_advantage(told)
    assert found is not None
    # The ratings take up a little of it, since they do not know it.
    assert 0.2 < found.value < 0.4
    assert found.low > 0.15


def test_two_dates_do_not_make_a_first_column_matter():
    """Two dates alone have hardly a spread that could be estimated."""
    off = 0
    for seed in range(40):
        rng = np.random.default_rng([11, seed])
        found = side_advantage(walk_forward(played(rng, matches=80), prior_sd=0.5))
        assert found is not None
        off += not found.low < 0.0 < found.high
    assert off <= 6  # 5 % of 40 are 2


def test_who_breaks_first_wins_more_when_the_break_is_worth_much():
    told = walk_forward(played(np.random.default_rng(8), advantage=0.8, breaks=3), prior_sd=0.5)
    found = first_breaks(told)
    assert found is not None
    assert found.won > found.expected
    assert found.p_value < 0.01


def test_what_the_file_does_not_tell_is_not_answered():
    results = Results.from_names(
        ["Ann", "Ann"], ["Bo", "Bo"], [4, 3], [4, 3], date=["2024-09-03", "2024-09-04"]
    )
    told = walk_forward(results)
    assert dispersion(told, np.random.default_rng(1)) is None
    assert streaks(told) is None
    assert first_breaks(told) is None
    assert break_advantage(told) is None


def test_races_played_by_chance_follow_their_law():
    rng = np.random.default_rng(9)
    p, m, n = np.full(20_000, 0.6), np.full(20_000, 5), np.full(20_000, 7)
    won, games = play_races(p, m, n, rng)
    lost = games - won
    assert ((won == 5) ^ (lost == 7)).all()
    assert (won == 5).mean() == pytest.approx(race_win_probability(0.6, 5, 7), abs=0.01)
    assert (won - 0.6 * games).mean() == pytest.approx(0.0, abs=0.05)
    assert ((won - 0.6 * games) ** 2).sum() / (0.24 * games).sum() == pytest.approx(1.0, abs=0.03)
