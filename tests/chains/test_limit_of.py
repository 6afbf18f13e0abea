"""The limit of a game is the same by every way."""

import networkx as nx
import pytest

from evenbreak.chains import limit_of
from evenbreak.chains.ways import WAYS
from evenbreak.errors import ChainError, InputError
from evenbreak.game import graph_of
from evenbreak.games import Drill, OneBall, Race, Rack

DRILL = Drill([0.9, 0.6, 0.2])


@pytest.mark.parametrize("via", [None, *WAYS])
def test_every_way_of_a_drill(via) -> None:
    limit = limit_of(DRILL, via=via)
    # By hand: the shares of levels 1, 2 and 3 are as 0.4 * 0.8 : 0.9 * 0.8 : 0.9 * 0.6.
    assert limit.to_dict() == pytest.approx({1: 32 / 158, 2: 72 / 158, 3: 54 / 158}, rel=1e-14)


@pytest.mark.parametrize("via", ["elimination", "eigen"])
def test_a_graph_and_a_start(via) -> None:
    game = OneBall(0.5, 0.25)
    graph: nx.DiGraph = graph_of(game)
    assert limit_of(graph, via=via)["W"] == pytest.approx(0.8, rel=1e-15)
    assert limit_of(game, start="S2", via=via)["W"] == pytest.approx(0.6, rel=1e-15)
    assert limit_of(graph, start="S2", via=via)["W"] == pytest.approx(0.6, rel=1e-15)


def test_a_start_that_others_do_not_lead_to() -> None:
    with pytest.raises(ChainError, match="9"):
        limit_of(graph_of(DRILL), start=9, via="eigen")
    assert graph_of(OneBall(0.5, 1.0), start="S2").nodes["S2"]["kind"] == "start"


def test_a_way_that_does_not_exist_names_those_that_do() -> None:
    with pytest.raises(InputError, match=r"power.*elimination"):
        limit_of(DRILL, via="power")
    with pytest.raises(ChainError, match="use elimination"):
        limit_of(Race(2, 2, Rack(0.4)), via="kernel")
