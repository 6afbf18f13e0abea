"""What a user writes, for type checkers: own argument names, own games, every door."""

from __future__ import annotations

from collections.abc import Mapping

import networkx as nx
import numpy as np
import pandas as pd
from matplotlib.axes import Axes

import evenbreak as eb
from evenbreak.chains import chain_of, kemeny_constant
from evenbreak.matches import GameOdds, MatchLength, game_odds
from evenbreak.plots import draw


class Killer:
    """Three players shoot in turn at one ball; whoever makes it wins."""

    start: str = "Ann"

    def moves(self, turn: str) -> Mapping[str, float]:
        after = {"Ann": "Bo", "Bo": "Cy", "Cy": "Ann"}
        return {f"{turn} wins": 0.5, after[turn]: 0.5} if turn in after else {}

    def winner(self, turn: str) -> int | None:
        return {"Ann wins": 1, "Bo wins": 2, "Cy wins": 3}.get(turn)


class Duel:
    """Two players, with numbers as states."""

    def __init__(self, p: float) -> None:
        self.p = p

    @property
    def start(self) -> int:
        return 0

    def moves(self, lead: int) -> dict[int, float]:
        return {} if abs(lead) == 2 else {lead + 1: self.p, lead - 1: 1 - self.p}

    def winner(self, lead: int) -> int | None:
        return {2: 1, -2: 2}.get(lead)


def own_games() -> object:
    game: eb.Game = Killer()
    odds: GameOdds = game_odds(game)
    chances: Mapping[int, float] = odds.p_win
    table: pd.DataFrame = odds.to_frame()
    chance: float = eb.win_probability(Killer(), player=3)
    length: MatchLength[float, float | None] = eb.match_length(Duel(0.6))
    race = eb.Race(7, 5, Duel(0.6))
    mean: float | None = eb.match_length(race).mean
    return (chances, table, chance, length.quantile(0.9), mean)


def matches() -> object:
    plain: float = eb.win_probability(eb.Race(9, 5, eb.Rack(2 / 3)))
    many = eb.win_probability(eb.Race(9, 5, eb.Rack(np.linspace(0.0, 1.0, 5))))
    return (plain, many.shape)


def chains() -> object:
    arcs = [("A", "B", 0.5), ("A", "A", 0.5), ("B", "A", 1.0)]
    graph: nx.DiGraph[str] = nx.DiGraph()
    graph.add_edge("A", "B", probability=1.0)
    chain = chain_of(arcs, start="A")
    others = [
        chain_of(graph),
        chain_of(np.array([[0.5, 0.5], [1.0, 0.0]]), rows="from"),
        chain_of([[0.5, 0.5], [1.0, 0.0]]),
        chain_of(pd.DataFrame([[0.5, 0.5], [1.0, 0.0]])),
        chain_of({"A": {"B": 1.0}, "B": {"A": 1.0}}),
        chain_of(Killer()),
    ]
    limit = eb.stochastic_limit(chain)
    numbers: float = limit["A"]
    paths = chain.simulate(10, 1, paths=3)
    return (others, numbers, limit.to_series(), paths.shape, kemeny_constant(chain))


def ratings() -> object:
    frame = pd.DataFrame({"player_a": ["Ann"], "player_b": ["Bo"], "score_a": [7], "score_b": [5]})
    fitted = eb.fit(eb.Results.from_frame(frame), scale="fargo")
    every: pd.DataFrame = eb.win_matrix(fitted, race=(7, 5))
    return (every, fitted.to_frame(), fitted.win_probability("Ann", "Bo"))


def pictures() -> object:
    axes: Axes = draw(eb.OneBall(0.4, 0.8))
    again: Axes = draw(Duel(0.5), ax=axes)
    return again
