"""Rating engines of other packages, and evenbreak's, in the protocol of `fairness.py`.

    pip install glicko2 trueskill openskill whole-history-rating

Each has the settings that its users turn, and values around its usual ones. The chance of a race is
averaged over the error of the difference of two players where an engine knows one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from scipy.special import betainc, expit, ndtr

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings import Levels, Results, walk_forward

POINTS, _weights = np.polynomial.hermite_e.hermegauss(31)
WEIGHTS = _weights / _weights.sum()
"""A mean over a normal distribution is that over these points, with these weights."""


class Engine:
    """A rating engine that knows how far two players are apart, made as `Mine(40, **settings)`."""

    name = ""
    needs = ""
    """The module that it imports and the package that has it: "whr whole-history-rating"."""
    settings: ClassVar[Mapping[str, Sequence[float]]] = {}

    def __init__(self, players: int, **settings: float) -> None:
        self.players, self.set = players, settings
        self.start()

    def start(self) -> None:
        """Start everyone as a newcomer."""

    def learn(self, night: Results) -> None:
        """Learn from the matches of a night: game by game, as `games_of` orders them."""
        for winner, loser in games_of(night):
            self.beat(winner, loser)

    def chance(self, a: int, b: int, race: tuple[int, int]) -> float:
        """Return P(a wins the race), averaged over the error of the difference."""
        apart, error = self.apart(a, b)
        if not error:
            return float(betainc(*race, self.curve(apart)))
        return float(betainc(*race, self.curve(apart + error * POINTS)) @ WEIGHTS)

    def apart(self, a: int, b: int) -> tuple[float, float]:
        """Return how much better a is than b, and its standard error, 0 if that is not known."""
        raise NotImplementedError

    def curve(self, apart: Any) -> Any:
        """Return P(a wins a game) by how much better a is."""
        return expit(apart)

    def beat(self, winner: int, loser: int) -> None:
        """Learn from a game."""
        raise NotImplementedError


def games_of(night: Results) -> Iterator[tuple[int, int]]:
    """Yield (winner, loser) of each game; the games of the loser of a match are spread evenly.

    The order of games is not known; the winner of a race has won the last one.
    """
    columns = night.player_a, night.player_b, night.score_a, night.score_b
    for a, b, m, n in zip(*(column.tolist() for column in columns), strict=True):
        more, fewer = ((a, b), (b, a)) if m >= n else ((b, a), (a, b))
        most, least = max(m, n), min(m, n)
        for k in range(most):
            if (k * least) // most < ((k + 1) * least) // most:
                yield fewer
            yield more


class Evenbreak(Engine):
    """The ratings of `evenbreak rate`; it walks through the season by itself."""

    name = "evenbreak"
    settings: ClassVar = {
        "prior_sd": (0.12, 0.18, 0.25, 0.35, 0.5, 0.7, 1.0),
        "newcomers": (0.0, 0.8, 1.2, 1.8, 2.7),
        "field": (0.0, 0.45, 0.9, 1.5, 2.5),
        "half_life": (30.0, 60.0, 120.0, 365.0, math.inf),
    }

    def walk(self, season: Results, races: Sequence[tuple[Ints, Ints]]) -> Floats:
        """Return P(a wins) of each match, by race; only matches of earlier nights are used."""
        given = {"prior_sd": 0.5, "half_life": math.inf, "newcomers": 0.0, "field": 0.0} | self.set
        levels = Levels(newcomers=given["newcomers"], field=given["field"])
        fades = given["half_life"] if given["half_life"] < math.inf else None
        found = walk_forward(season, prior_sd=given["prior_sd"], half_life=fades, levels=levels)
        p = expit(found.difference[:, None] + found.sd[:, None] * POINTS)
        return np.array([betainc(m[:, None], n[:, None], p) @ WEIGHTS for m, n in races])


class BradleyTerry(Engine):
    """A Bradley-Terry model with a normal prior, games fading with age, by Newton's method."""

    name = "Bradley-Terry, fading"
    settings: ClassVar = {
        "prior_sd": (0.12, 0.18, 0.25, 0.35, 0.5, 0.7, 1.0),
        "half_life": (30.0, 60.0, 120.0, 365.0, math.inf),
    }

    def start(self) -> None:
        self.skill, self.won = np.zeros(self.players), np.zeros((self.players, self.players))
        self.last: Any = None

    def learn(self, night: Results) -> None:
        assert night.date is not None
        today = night.date[0]
        days = 0.0 if self.last is None else float((today - self.last).astype(int))
        self.won *= 0.5 ** (days / self.set["half_life"])
        self.last = today
        np.add.at(self.won, (night.player_a, night.player_b), night.score_a)
        np.add.at(self.won, (night.player_b, night.player_a), night.score_b)
        games, tight = self.won + self.won.T, self.set["prior_sd"] ** -2
        for _ in range(30):
            p = expit(self.skill[:, None] - self.skill[None, :])
            slope = (self.won - games * p).sum(1) - self.skill * tight
            if np.abs(slope).max() < 1e-6:
                break
            weight = games * p * (1.0 - p)
            bend = np.diag(weight.sum(1) + tight) - weight
            self.skill = self.skill + np.linalg.solve(bend, slope)

    def apart(self, a: int, b: int) -> tuple[float, float]:
        return float(self.skill[a] - self.skill[b]), 0.0


class Elo(Engine):
    """Elo's ratings, moved by each game."""

    name = "Elo"
    settings: ClassVar = {"step": (0.01, 0.02, 0.03, 0.045, 0.07, 0.1, 0.15, 0.2, 0.3)}

    def start(self) -> None:
        self.rating = [0.0] * self.players

    def apart(self, a: int, b: int) -> tuple[float, float]:
        return self.rating[a] - self.rating[b], 0.0

    def beat(self, winner: int, loser: int) -> None:
        expected = 1.0 / (1.0 + math.exp(self.rating[loser] - self.rating[winner]))
        change = self.set["step"] * (1.0 - expected)
        self.rating[winner] += change
        self.rating[loser] -= change


class Glicko2(Engine):
    """Glicko-2, each night a rating period."""

    name, needs = "Glicko-2", "glicko2 glicko2"
    settings: ClassVar = {
        "deviation": (25.0, 40.0, 60.0, 90.0, 120.0, 180.0, 350.0),
        "volatility": (0.001, 0.01, 0.03, 0.06, 0.1, 0.2),
    }

    def start(self) -> None:
        import glicko2

        usual = {"rd": self.set["deviation"], "vol": self.set["volatility"]}
        self.player = [glicko2.Player(rating=1500, **usual) for _ in range(self.players)]
        self.known = set[int]()

    def apart(self, a: int, b: int) -> tuple[float, float]:
        one, other, unit = self.player[a], self.player[b], math.log(10.0) / 400.0
        return unit * (one.rating - other.rating), unit * math.hypot(one.rd, other.rd)

    def learn(self, night: Results) -> None:
        seen: dict[int, list[tuple[float, float, bool]]] = {}
        for winner, loser in games_of(night):
            for k, other, won in ((winner, loser, True), (loser, winner, False)):
                rival = self.player[other]
                seen.setdefault(k, []).append((rival.rating, rival.rd, won))
        for k, games in seen.items():
            self.player[k].update_player(*map(list, zip(*games, strict=True)))
        for k in self.known - seen.keys():
            self.player[k].did_not_compete()
        self.known |= seen.keys()


class TrueSkill(Engine):
    """TrueSkill, game by game."""

    name, needs = "TrueSkill", "trueskill trueskill"
    settings: ClassVar = {
        "beta": (0.7, 1.0, 1.5, 2.2, 3.2, 4.5), "tau": (0.0, 0.02, 0.06, 0.15),
    }  # fmt: skip

    def start(self) -> None:
        import trueskill

        self.env = trueskill.TrueSkill(mu=0.0, sigma=1.0, draw_probability=0.0, **self.set)
        self.rating = [self.env.create_rating() for _ in range(self.players)]

    def apart(self, a: int, b: int) -> tuple[float, float]:
        one, other = self.rating[a], self.rating[b]
        return one.mu - other.mu, math.hypot(one.sigma, other.sigma)

    def curve(self, apart: Any) -> Any:
        return ndtr(apart / (math.sqrt(2.0) * self.set["beta"]))

    def beat(self, winner: int, loser: int) -> None:
        both = self.env.rate_1vs1(self.rating[winner], self.rating[loser])
        self.rating[winner], self.rating[loser] = both


class OpenSkill(TrueSkill):
    """The Plackett-Luce model of openskill, game by game."""

    name, needs = "openskill", "openskill openskill"
    settings: ClassVar = {
        "beta": (6.0, 12.5, 25.0, 40.0, 60.0, 90.0, 140.0), "tau": (0.0, 0.1, 0.3, 1.0),
    }  # fmt: skip

    def start(self) -> None:
        from openskill.models import PlackettLuce

        self.model = PlackettLuce(mu=25.0, sigma=25 / 3, **self.set)
        self.rating = [self.model.rating() for _ in range(self.players)]

    def beat(self, winner: int, loser: int) -> None:
        both = self.model.rate([[self.rating[winner]], [self.rating[loser]]])
        (self.rating[winner],), (self.rating[loser],) = both


class WholeHistory(Engine):
    """Whole-history rating: all nights are fitted again, skills moving from day to day."""

    name, needs = "whole-history rating", "whr whole-history-rating"
    settings: ClassVar = {
        "w2": (0.3, 3.0, 14.0, 40.0, 100.0, 250.0), "prior_wins": (1.5, 3.0, 6.0, 12.0, 24.0, 48.0),
    }  # fmt: skip

    def start(self) -> None:
        from whr import WHR

        self.model = WHR({"w2": self.set["w2"], "initial_prior_wins": self.set["prior_wins"]})
        self.known, self.first = set[int](), None

    def apart(self, a: int, b: int) -> tuple[float, float]:
        last = {k: self.model.player_by_name(str(k)).days[-1] for k in {a, b} & self.known}
        elo = [last[k].elo if k in last else 0.0 for k in (a, b)]
        error = math.sqrt(sum(max(day.uncertainty, 0.0) for day in last.values()))
        return (elo[0] - elo[1]) * math.log(10.0) / 400.0, error

    def learn(self, night: Results) -> None:
        assert night.date is not None
        self.first = night.date[0] if self.first is None else self.first
        day = int((night.date[0] - self.first).astype(int))
        for winner, loser in games_of(night):
            self.model.create_game(str(winner), str(loser), "B", day, 0)
            self.known.update((winner, loser))
        self.model.iterate(4)


ENGINES: tuple[type[Engine], ...] = (
    Evenbreak, WholeHistory, BradleyTerry, TrueSkill, Glicko2, OpenSkill, Elo,
)  # fmt: skip
