import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.chart import CHARTS
from evenbreak.handicaps.systems import SYSTEMS, PlayedMatch, system_of

systems = pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)


@systems
def test_a_system_is_found_by_its_name(system):
    assert system_of(f" {system.name.upper()} ") == system


@systems
def test_a_system_is_played_by_charts_of_the_package(system):
    assert set(system.charts) <= set(CHARTS)
    assert system.charts


@systems
@pytest.mark.parametrize("games", [(5, 0), (5, 4), None])
@pytest.mark.parametrize("rating", [(0.0, 120.0), (80.0, 80.0), (120.0, 0.0)])
def test_the_winner_never_falls_and_the_loser_never_rises(system, games, rating):
    up, down = system.rule(PlayedMatch(rating, games, None))
    assert up >= 0 >= down


def test_the_pool_league_moves_a_point_a_match_whatever_the_match_was():
    rule = system_of("npl").rule
    assert rule(PlayedMatch((40.0, 130.0), (2, 6), (2, 7))) == (1, -1)
    assert rule(PlayedMatch((130.0, 40.0), None, None)) == (1, -1)


def test_an_unknown_system_is_told_with_those_there_are():
    with pytest.raises(InputError, match="system is 'fide'; give npl"):
        system_of("fide")
