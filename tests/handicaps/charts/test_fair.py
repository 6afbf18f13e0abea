import subprocess
import sys
from fractions import Fraction
from itertools import pairwise
from math import comb

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.games import Rack, alternate_breaks, loser_breaks, winner_breaks
from evenbreak.handicaps import FairRace, fair_races
from evenbreak.matches.odds import race_odds

chances = st.floats(0.01, 0.99)


def exact_win(p, m, n):
    """Return W(p; m, n): player 1 has won m or more of m + n - 1 games."""
    p, games = Fraction(p), m + n - 1
    return sum(comb(games, k) * p**k * (1 - p) ** (games - k) for k in range(m, games + 1))


def test_a_two_to_one_favorite_to_seven_gives_three_games():
    (race,) = fair_races(Rack(2 / 3), race_to=7, top=1)
    assert (race.race_1, race.race_2) == (7, 4)
    assert race.p_win_1 == pytest.approx(float(exact_win(2 / 3, 7, 4)), rel=1e-13)


@pytest.mark.parametrize("p", [0.5, 0.55, 2 / 3, 0.31, 0.9])
def test_all_races_of_a_span_are_ranked_as_exact_arithmetic_ranks_them(p):
    found = fair_races(p, games=(3, 9), top=1000)
    expected = [
        (abs(exact_win(p, m, n) - Fraction(1, 2)), m + n - 1, m, n)
        for m in range(1, 10)
        for n in range(1, 10)
        if 3 <= m + n - 1 <= 9
    ]
    assert sorted((race.race_1, race.race_2) for race in found) == sorted(
        (m, n) for _, _, m, n in expected
    )
    for race in found:
        exact = float(exact_win(p, race.race_1, race.race_2))
        assert race.p_win_1 == pytest.approx(exact, rel=1e-13)
    ranked = [(m, n) for _, _, m, n in sorted((round(float(d), 12), *at) for d, *at in expected)]
    assert [(race.race_1, race.race_2) for race in found] == ranked


def test_of_ties_the_shortest_comes_first():
    races = [(race.race_1, race.race_2) for race in fair_races(0.5, games=(1, 9), top=5)]
    assert races == [(1, 1), (2, 2), (3, 3), (4, 4), (5, 5)]


def test_mirrored_ties_of_one_length_come_in_the_order_of_the_first_race():
    races = [(race.race_1, race.race_2) for race in fair_races(0.5, games=(4, 4))]
    assert races == [(2, 3), (3, 2), (1, 4), (4, 1)]


def test_length_and_ninety_percent_are_those_of_the_race():
    (race,) = fair_races(0.6, games=(9, 9), top=1)
    law = race_odds(race.race_1, race.race_2, 0.6)
    assert race == FairRace(race.race_1, race.race_2, law.p_win_1, law.mean, law.quantile(0.9))
    assert race.mean_games <= race.games_p90 <= 9


@given(chances, st.integers(1, 15))
def test_turning_the_players_round_turns_the_race_round(p, race_to):
    strong = fair_races(p, race_to=race_to, top=1)[0]
    weak = fair_races(1 - p, race_to=race_to, top=1)[0]
    if abs(p - 0.5) > 1e-9:
        assert weak.p_win_1 == pytest.approx(1 - strong.p_win_1, abs=1e-8)
        assert (weak.race_1, weak.race_2) == (strong.race_2, strong.race_1)


@given(chances, st.integers(1, 15), st.floats(0, 1))
def test_the_stronger_player_needs_what_was_asked_for(p, race_to, target):
    for race in fair_races(p, race_to=race_to, target=target, top=100):
        stronger, weaker = (race.race_1, race.race_2)[:: 1 if p >= 0.5 else -1]
        assert stronger == race_to
        assert 1 <= weaker <= race_to


@given(chances, st.floats(0, 1))
def test_nearer_races_come_first(p, target):
    distance = [abs(r.p_win_1 - target) for r in fair_races(p, games=(2, 8), target=target, top=99)]
    assert all(a <= b + 1e-9 for a, b in pairwise(distance))


@pytest.mark.parametrize("breaks", [winner_breaks, loser_breaks, alternate_breaks])
@pytest.mark.parametrize("first_breaker", [1, 2])
def test_break_formats_are_played_out(breaks, first_breaker):
    rack = Rack(0.65, 0.5)
    found = fair_races(
        rack, games=(1, 7), top=1000, breaks=breaks, first_breaker=first_breaker, target=0.4
    )
    assert len(found) == 28
    laws = {
        (m, n): race_odds(m, n, Rack(0.65, 0.5), breaks, first_breaker).p_win_1
        for m in range(1, 8)
        for n in range(1, 9 - m)
    }
    distance = [abs(race.p_win_1 - 0.4) for race in found]
    assert {(r.race_1, r.race_2): r.p_win_1 for r in found} == laws
    assert all(a <= b + 1e-9 for a, b in pairwise(distance))


def test_with_breaks_the_stronger_is_who_holds_the_break_more_often():
    (race,) = fair_races(Rack(0.5, 0.7), race_to=9, breaks=alternate_breaks, top=1)
    assert race.race_2 == 9
    assert race.race_1 < 9


@pytest.mark.parametrize(("p", "sure"), [(0.0, 0.0), (1.0, 1.0)])
def test_a_sure_winner_wins_every_race_and_the_shortest_is_first(p, sure):
    first, second = fair_races(p, games=(2, 3), top=2)
    assert (first.race_1, first.race_2, first.p_win_1) == (1, 2, sure)
    assert (second.race_1, second.race_2) == (2, 1)


@pytest.mark.parametrize(
    ("words", "options"),
    [
        ("games is None and race_to is None", {}),
        ("games is .* and race_to is", {"games": (1, 2), "race_to": 3}),
        ("smaller number first", {"games": (5, 3)}),
        ("must be a pair", {"games": (5,)}),
        ("games must", {"games": (0, 3)}),
        ("race_to must", {"race_to": 0}),
        ("target must", {"race_to": 3, "target": 2}),
        ("top must", {"race_to": 3, "top": 0}),
        ("first_breaker must", {"race_to": 3, "first_breaker": 3}),
    ],
)
def test_wrong_parameters_are_named(words, options):
    with pytest.raises(InputError, match=words):
        fair_races(0.6, **options)


def test_a_break_that_matters_needs_a_format():
    with pytest.raises(InputError, match="breaks is missing"):
        fair_races(Rack(0.6, 0.5), race_to=3)


def test_arrays_are_refused():
    with pytest.raises(InputError, match="arrays"):
        fair_races(Rack([0.5, 0.6]), race_to=3)


def test_no_numpy_on_the_way():
    program = (
        "import sys; from evenbreak.handicaps import fair_races; fair_races(.6, race_to=7); "
        "sys.exit('numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def test_of_many_races_the_best_are_those_of_the_whole_ranking():
    p, target = 0.55, 0.3
    whole = fair_races(p, games=(1, 12), target=target, top=1000)
    assert len(whole) == 78
    for top in (1, 2, 7, 40):
        assert fair_races(p, games=(1, 12), target=target, top=top) == whole[:top]


def test_a_long_even_race_is_even():
    races = fair_races(0.5, games=(1, 400), top=200)
    assert {(race.race_1, race.race_2) for race in races} == {(m, m) for m in range(1, 201)}
    assert all(race.p_win_1 == pytest.approx(0.5, rel=1e-12) for race in races)


@pytest.mark.parametrize("breaks", ["winner", lambda breaker, winner: breaker + winner])
def test_a_format_that_names_no_player_is_refused(breaks):
    with pytest.raises(InputError, match="breaks"):
        fair_races(Rack(0.5, 0.6), race_to=5, breaks=breaks)
