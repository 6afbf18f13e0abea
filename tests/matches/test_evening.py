from collections import Counter
from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.evening import Length, evening
from evenbreak.matches.length import match_length
from evenbreak.matches.races import race_odds

EVEN = Length([1, 2], [0.5, 0.5])
SKEW = Length([2, 3, 5], [0.25, 0.5, 0.25])
FIXED = Length([4], [1.0])


def end_of(lengths, tables, pairs):
    """Return when an evening ends, minute by minute: slow and obvious."""
    waiting = list(range(len(lengths)))
    playing = {}  # match -> when it ends
    now = 0
    while waiting or playing:
        playing = {match: end for match, end in playing.items() if end > now}
        busy = {player for match in playing for player in pairs[match]}
        for match in list(waiting):
            if len(playing) < tables and not busy & set(pairs[match]):
                playing[match] = now + lengths[match]
                busy |= set(pairs[match])
                waiting.remove(match)
        if waiting or playing:
            now += 1
    return now


def law_of_end(laws, tables, pairs):
    end = Counter()
    choices = [
        [(games, Fraction(p)) for games, p in zip(law.games, law.probability, strict=True)]
        for law in laws
    ]
    for one in product(*choices):
        chance = Fraction(1)
        for _, p in one:
            chance *= p
        end[end_of([games for games, _ in one], tables, pairs)] += chance
    return end


def described(end):
    mean = sum(time * chance for time, chance in end.items())
    variance = sum((time - mean) ** 2 * chance for time, chance in end.items())
    reached = Fraction(0)
    for time in sorted(end):
        reached += end[time]
        if reached >= Fraction(9, 10):
            return float(mean), float(variance) ** 0.5, time
    raise AssertionError


APART = [(f"a{k}", f"b{k}") for k in range(8)]


@pytest.mark.parametrize("tables", [1, 2, 3, 4, 5, 6, 9])
def test_every_course_of_an_evening(tables):
    laws = [EVEN, SKEW, EVEN, FIXED, SKEW, EVEN]
    mean, sd, p90 = described(law_of_end(laws, tables, APART))
    answer = evening(laws, tables=tables)
    assert answer.exact
    assert (answer.mean, answer.sd) == pytest.approx((mean, sd), rel=1e-12)
    assert answer.p90 == p90
    assert answer.mean_error == 0.0


ROUND = [("Ann", "Bo"), ("Ann", "Cy"), ("Ann", "Di"), ("Bo", "Cy"), ("Bo", "Di"), ("Cy", "Di")]


@pytest.mark.parametrize("tables", [1, 2, 3])
def test_nobody_plays_twice_at_once(tables):
    laws = [SKEW, EVEN, EVEN, SKEW, FIXED, EVEN]
    mean, sd, p90 = described(law_of_end(laws, tables, ROUND))
    answer = evening(laws, tables=tables, players=ROUND, runs=20_000)
    assert not answer.exact
    assert answer.mean == pytest.approx(mean, abs=4 * answer.mean_error)
    assert answer.sd == pytest.approx(sd, rel=0.05)
    assert answer.p90 == p90


def test_four_players_need_no_third_table():
    two = evening([SKEW] * 6, tables=2, players=ROUND, runs=500)
    three = evening([SKEW] * 6, tables=3, players=ROUND, runs=500)
    assert two == three


def test_one_table_is_exact_whoever_plays():
    answer = evening([SKEW] * 6, players=ROUND)
    assert answer.exact
    assert answer.mean == pytest.approx(6 * 3.25)


def test_fixed_lengths_played_out_have_no_error():
    answer = evening([FIXED] * 6, tables=2, players=ROUND)
    assert (answer.mean, answer.sd, answer.p90) == (12.0, 0.0, 12)
    assert answer.mean_error == 0.0


def test_the_seed_decides():
    def ask(seed):
        rng = np.random.default_rng(seed)
        return evening([SKEW] * 6, tables=2, players=ROUND, rng=rng, runs=1_000)

    assert ask(1) == ask(1)
    assert ask(1) != ask(2)


def test_playing_out_agrees_with_the_exact_answer():
    law = race_odds(7, 5, 0.6)
    laws = [Length(law.games, law.probability)] * 12
    exact = evening(laws, tables=3)
    played = evening(laws, tables=3, runs=50_000)
    assert exact.exact
    assert played.mean == pytest.approx(exact.mean, abs=4 * played.mean_error)
    assert abs(played.p90 - exact.p90) <= 1


def test_laws_of_races_will_do():
    law, length = race_odds(3, 2, 0.6), match_length(Race(3, 2, Rack(0.6)))
    assert evening([law]).mean == pytest.approx(law.mean, rel=1e-12)
    assert evening([length] * 50, tables=50).exact


def test_many_tables_are_played_out():
    law = race_odds(9, 9, 0.5)
    answer = evening([Length(law.games, law.probability)] * 40, tables=9)
    assert not answer.exact
    assert 0.0 < answer.mean_error < 0.1


laws = st.lists(st.sampled_from([EVEN, SKEW, FIXED]), min_size=1, max_size=6)


@given(laws, st.integers(1, 4))
@settings(max_examples=40, deadline=None)
def test_each_table_more_ends_the_evening_no_later(laws, tables):
    # Of matches that all begin in the order of the list; of other orders it need not be so.
    fewer, more = evening(laws, tables=tables), evening(laws, tables=tables + 1)
    assert more.mean <= fewer.mean + 1e-12
    assert more.p90 <= fewer.p90
    whole = sum(np.dot(law.games, law.probability) for law in laws)
    assert whole / tables - 1e-9 <= fewer.mean <= whole + 1e-9


@pytest.mark.parametrize(
    ("call", "remedy"),
    [
        (lambda: evening([]), "one for each match"),
        (lambda: evening([EVEN], tables=0), "1 or more"),
        (lambda: evening([Length([1, 2], [1.0])]), "length 1 is"),
        (lambda: evening([EVEN, Length([1.5], [1.0])]), "length 2 is"),
        (lambda: evening([Length([-1], [1.0])]), "numbers of games"),
        (lambda: evening([Length([1, 2], [0.5, 0.6])]), "do not sum to 1"),
        (lambda: evening([EVEN], players=[]), "0 pairs for 1 matches"),
        (lambda: evening([EVEN], players=[("Ann", "Ann")]), "Ann"),
        (lambda: evening([EVEN] * 2, runs=1), "2 or more"),
        (lambda: evening([EVEN] * 1001, tables=50, runs=2), "1,000 at most"),
    ],
)
def test_refused(call, remedy):
    with pytest.raises(InputError, match=remedy):
        call()
