"""What every handicap system of the catalog has to hold to."""

import pickle
from fractions import Fraction
from math import comb

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.games import Race, Rack
from evenbreak.handicaps.charts.chart import CHARTS
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.opponents import NATURAL
from evenbreak.handicaps.systems.by_match import PlayedMatch, StepSystem
from evenbreak.handicaps.systems.catalog import FAMILIES, SYSTEMS, system_of
from evenbreak.handicaps.systems.laws import broken_laws
from evenbreak.handicaps.systems.match_table import match_table
from evenbreak.handicaps.systems.npl import step_after
from evenbreak.matches import final_scores, race_win_probability

STEPS = {name: system for name, system in SYSTEMS.items() if isinstance(system, StepSystem)}
every = pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
systems = pytest.mark.parametrize("system", STEPS.values(), ids=STEPS)

GAMES = np.array([0.0, 5e-324, 1e-9, 0.2, 0.5, 0.77, 1.0 - 1e-9, 1.0])


@pytest.fixture(scope="module", params=STEPS.values(), ids=list(STEPS))
def table(request):
    return match_table(request.param)


def outcomes(table, step=1):
    """Yield (difference, outcome's place, race, games, moves, whether player 1 wins)."""
    for place in range(0, 2 * table.widest + 1, step):
        for k in range(sum(table.needs[place])):
            yield (
                place - table.widest,
                (place, k),
                tuple(table.needs[place].tolist()),
                tuple(table.games[place, k].tolist()),
                tuple(table.moves[place, k].tolist()),
                bool(table.won[place, k]),
            )


def winner_first(race, games, won, **more):
    turn = 1 if won else -1
    return PlayedMatch((0.0, 0.0), games[::turn], race[::turn], **more)


@every
def test_a_system_holds_to_the_laws_of_all_systems(system):
    assert broken_laws(system, seed=3) == []


@every
def test_a_system_says_its_rule_in_words(system):
    assert len(system.in_words) > 20


@every
def test_a_system_is_found_by_its_name_however_it_is_written(system):
    assert system_of(f" {system.name.upper()} ") == system
    assert system_of(system.name.replace(" ", "-")) == system
    assert system_of(system) is system


@systems
def test_a_system_has_a_chart_to_be_played_by(system):
    assert set(system.charts) <= set(CHARTS)
    assert system.usual_chart() in system.known_charts()
    assert len(system.known_charts()) >= len(system.charts)


@every
def test_a_system_goes_to_other_processes_and_comes_back(system):
    assert pickle.loads(pickle.dumps(system)) == system  # noqa: S301


def test_every_family_has_a_sample_named_as_it_says():
    assert {name.split()[0] for name in SYSTEMS} == set(FAMILIES)
    assert all(family.grammar.startswith(word) for word, family in FAMILIES.items())


def test_the_rule_says_whole_points_the_same_ones_every_time_and_everywhere(table):
    rule = table.system.rule
    for x, _, race, games, moves, won in outcomes(table, step=7):
        turn = 1 if won else -1
        for away in (0.0, 1500.0):
            match = PlayedMatch((x + away, away)[::turn], games[::turn], race[::turn])
            points = rule(match)
            assert all(type(point) is int for point in points)
            assert rule(match) == points == moves[::turn]


def test_the_winner_gains_what_the_loser_loses_or_the_system_says_that_it_does_not(table):
    kept = all(sum(moves) == 0 for *_, moves, _ in outcomes(table))
    assert kept == table.system.conserving


def test_the_worse_the_loser_did_the_better_for_the_winner(table):
    points = {}
    for x, _, race, games, moves, won in outcomes(table):
        mine, lost = (moves[0], games[1]) if won else (moves[1], games[0])
        points.setdefault((x, race, won), []).append((lost, mine))
    for scores in points.values():
        gains = [mine for _, mine in sorted(scores)]
        assert gains == sorted(gains, reverse=True)


def test_a_newcomer_goes_the_systems_factor_times_as_far(table):
    system = table.system
    for _, _, race, games, _, won in outcomes(table, step=23):
        up, down = system.rule(winner_first(race, games, won))
        for played in ((0, None), (None, 9), (10, 29), (30, 31)):
            factors = [step_after(each, system.newcomer_steps) for each in played]
            moved = system.rule(winner_first(race, games, won, played=played))
            assert moved == (up * factors[0], down * factors[1])


@systems
def test_a_rule_needs_what_it_asks_for_and_no_more(system):
    known = {"games": (5, 3), "race": (5, 5)}
    asked = PlayedMatch(
        (0.0, 0.0),
        known["games"] if "games" in system.asks else None,
        known["race"] if "race" in system.asks else None,
    )
    assert system.rule(asked) == system.rule(PlayedMatch((0.0, 0.0), (5, 3), (5, 5)))
    for missing in system.asks:
        with pytest.raises(InputError, match="is None"):
            system.rule(asked._replace(**{missing: None}))


def test_turned_round_the_table_is_the_same(table):
    for x, (place, k), race, games, moves, won in outcomes(table, step=5):
        there = table.widest - x
        other = list(map(tuple, table.games[there].tolist())).index(games[::-1])
        assert tuple(table.needs[there].tolist()) == race[::-1]
        assert tuple(table.moves[there, other].tolist()) == moves[::-1]
        assert bool(table.won[there, other]) is not won
        assert (place, k) == (x + table.widest, k)


def test_chances_are_those_of_the_final_scores_and_add_up_to_one(table):
    chances = table.chances(GAMES)
    np.testing.assert_allclose(chances.sum(axis=1), 1.0, rtol=1e-13)
    assert (chances >= 0.0).all()
    for place in range(0, 2 * table.widest + 1, 31):
        m, n = table.needs[place].tolist()
        scores = final_scores(Race(m, n, Rack(GAMES))).probability
        listed = [tuple(score) for score in table.games[place].tolist()[: m + n]]
        assert sorted(scores) == sorted(listed)
        for score, chance in zip(listed, chances[place], strict=False):
            np.testing.assert_allclose(chance, scores[score], rtol=1e-12, atol=1e-300)
        assert (table.games[place, m + n :] == -1).all()
        assert (chances[place, m + n :] == 0.0).all()
        assert (table.moves[place, m + n :] == 0).all()


def test_chances_are_the_fractions(table):
    p = Fraction(3, 7)
    chances = table.chances(float(p))
    for _, at, _, (a, b), _, won in outcomes(table, step=37):
        ways = comb(a + b - 1, b if won else a)
        assert chances[at] == pytest.approx(float(ways * p**a * (1 - p) ** b), rel=1e-12)


def test_wins_are_the_sum_of_the_chances_of_winning_scores_and_those_of_the_race(table):
    wins = table.wins(GAMES)
    m, n = table.needs.T[:, :, None]
    np.testing.assert_array_equal(wins, race_win_probability(GAMES, m, n))
    by_scores = (table.chances(GAMES) * table.won[..., None]).sum(axis=1)
    np.testing.assert_allclose(wins, by_scores, rtol=1e-12, atol=1e-300)


@systems
def test_a_rating_error_has_a_law_about_zero_where_the_system_is_conserving(system):
    law = Ladder(system, opponents=NATURAL).law()
    assert sum(law.probability) == pytest.approx(1.0, abs=1e-12)
    assert 0.0 < law.sd < system.scale.points_per_doubling
    if system.conserving:
        assert abs(law.mean) < 1e-6
    else:
        assert law.mean > 1.0


@pytest.mark.slow_after(4)
@systems
def test_the_law_of_a_ladder_is_the_limit_of_the_tables_moves(system):
    """A second route: many steps of the chain that the table's moves and chances make."""
    table = match_table(system, widest=3 * round(system.scale.points_per_doubling))
    size = 2 * table.widest + 1
    chain = np.zeros((size, size))
    chances = table.chances(0.5)
    for error in range(size):
        moves = table.moves[error, :, 0]
        to = np.where((error + moves >= 0) & (error + moves < size), error + moves, error)
        np.add.at(chain, (to, error), chances[error])
    # Steps of one size only swing between odd and even errors: take the mean of two steps.
    chain = np.linalg.matrix_power((chain + np.eye(size)) / 2.0, 20_000)
    # Steps of two points keep an error even or odd: the start may be either.
    limit = chain[:, [table.widest, table.widest + 1]].mean(axis=1)
    errors = np.arange(size) - table.widest
    mean = errors @ limit
    law = Ladder(system, opponents=NATURAL).law()
    assert law.mean == pytest.approx(mean, abs=1e-6)
    assert law.sd == pytest.approx(np.sqrt((errors - mean) ** 2 @ limit), rel=1e-6)
