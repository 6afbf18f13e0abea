"""How replicas are divided into batches and chunks."""

import pytest

from evenbreak.league import LeaguePlayers, Season
from evenbreak.league.counting import ALONE
from evenbreak.league.simulate import Batching, batching_of


def season(players, weeks=30):
    return Season(LeaguePlayers.of([50] * players), "npl", weeks=weeks)


@pytest.mark.parametrize("replicas", [20, 1000, 100_000])
@pytest.mark.parametrize("players", [2, 16, 1000])
def test_there_are_twenty_batches_where_there_are_as_many_replicas(players, replicas):
    found = batching_of(season(players), replicas)
    assert replicas // found.replicas >= 20
    assert found.replicas * found.batches * players <= 1 << 16


def test_few_replicas_are_batches_of_one():
    assert batching_of(season(16), 5).replicas == 1


def test_in_a_large_league_each_replica_is_a_batch():
    assert batching_of(season(ALONE + 2), 1000) == Batching(1, 1)


def test_long_seasons_have_small_chunks():
    short, long = batching_of(season(16), 2000), batching_of(season(16, weeks=5000), 2000)
    assert short.replicas == long.replicas
    assert short.batches > long.batches
