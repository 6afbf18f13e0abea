import networkx as nx
import pytest

from evenbreak.answers.match.chain import road_of
from evenbreak.errors import GameError
from evenbreak.games import CATALOG
from evenbreak.handicaps import CHARTS, Ladder, chart, ladder_gap
from rows import each_of


@each_of("game", CATALOG.values())
def test_every_way_that_leads_there_leads_to_the_same_limit(game):
    road = road_of(game)
    assert isinstance(road.graph, nx.DiGraph)
    assert road.chain.matrix.format == "csc"
    assert {"elimination", "eigen"} <= set(road.limits)
    assert set(road.limits) | set(road.refused) >= {"kernel", "elimination", "eigen"}
    assert max(road.differences.values()) < 1e-12
    if road.spectrum is not None:
        assert max(map(abs, road.spectrum.values.tolist())) <= 1.0


@pytest.mark.parametrize("name", CHARTS)
def test_a_ladder_settles_as_the_answer_about_ladders_says(name):
    road = road_of(Ladder(chart(name)))
    assert road.gap == pytest.approx(ladder_gap(Ladder(chart(name))), rel=1e-9)
    assert road.period == 2
    assert max(map(abs, road.spectrum.values.tolist())) <= 1.0


def test_states_that_are_written_alike_are_refused():
    class Alike:
        start = 1

        def moves(self, state):
            return {"1": 1.0} if state == 1 else {}

        def winner(self, state):  # noqa: ARG002
            return None

    with pytest.raises(GameError, match="look the same"):
        road_of(Alike())
