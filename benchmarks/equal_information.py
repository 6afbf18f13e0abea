"""Rating systems on one season, all of them given the same results.

    python -m pip install -e . trueskill openskill glicko2 whole-history-rating  # imported as whr
    python benchmarks/equal_information.py SEASON.csv [SYSTEM ...]

Twice: with every frame (a 5:3 is eight games), and with the winner of each match alone. Each date
is predicted from the dates before it. Settings are chosen twice, too: by the log-loss of the first
part of the season, to predict the rest; and by the whole season, in hindsight. A difference from
evenbreak is paired, match by match, and its standard error takes each date as a cluster. A package
that is not installed is left out.
"""

from __future__ import annotations

import importlib.util
import itertools
import math
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.special import expit

from evenbreak.arrays import Floats
from evenbreak.files.results.results_file import read_results
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings import Levels, Results, walk_forward
from evenbreak.ratings.validation.walk_forward import even_races

PLACE = Path(__file__).resolve().parents[2] / "shared/data/snooker_2016_17_results.csv"

FIRST_PART = np.datetime64("2017-01-01")
"""The date before which settings are chosen, for the results from then on."""

Settings = Mapping[str, float]


class Chances(NamedTuple):
    """The chances that player a wins a game, and the match, of every match of a season."""

    game: Floats
    match: Floats


@dataclass(frozen=True)
class System:
    """A way to rate, the settings to choose from, and the package that it needs."""

    predict: Callable[[Results, Settings], Chances]
    settings: Mapping[str, tuple[float, ...]]
    package: str = "numpy"

    @property
    def is_here(self) -> bool:
        """Whether the package is installed."""
        return importlib.util.find_spec(self.package) is not None

    def ways(self) -> Iterator[Settings]:
        """Return every combination of the settings."""
        for values in itertools.product(*self.settings.values()):
            yield dict(zip(self.settings, values, strict=True))


class Day(NamedTuple):
    """The matches of one date: rows of the season, players and games won."""

    number: int
    rows: slice
    a: list[int]
    b: list[int]
    won_a: list[int]
    won_b: list[int]

    def games(self) -> Iterator[tuple[int, int]]:
        """Return (winner, loser) of each game; the losing side's games are spread evenly."""
        for a, b, m, n in zip(self.a, self.b, self.won_a, self.won_b, strict=True):
            more, fewer = ((a, b), (b, a)) if m >= n else ((b, a), (a, b))
            most, least = max(m, n), min(m, n)
            for k in range(most):
                # The order of games is not known; the winner of a race has won the last one.
                if (k * least) // most < ((k + 1) * least) // most:
                    yield fewer
                yield more


def days_of(season: Results) -> Iterator[Day]:
    dates = season.date
    assert dates is not None
    days, starts = np.unique(dates, return_index=True)
    for day, start, end in zip(days, starts, [*starts[1:], len(season)], strict=True):
        rows = slice(int(start), int(end))
        columns = season.player_a, season.player_b, season.score_a, season.score_b
        lists = (column[rows].tolist() for column in columns)
        yield Day(int((day - days[0]).astype(int)), rows, *lists)


def raced(season: Results, game: Floats) -> Chances:
    """Return the chances of matches by those of games: races as in the file."""
    race_a, race_b, _ = even_races(season)
    return Chances(game, race_win_probability(game, race_a, race_b))


def by_pair(
    season: Results, predict: Callable[[int, int], float], learn: Callable[[Day], None]
) -> Chances:
    """Predict each date pair by pair, then learn from it."""
    game = np.zeros(len(season))
    for day in days_of(season):
        game[day.rows] = [predict(a, b) for a, b in zip(day.a, day.b, strict=True)]
        learn(day)
    return raced(season, game)


def evenbreak(season: Results, with_: Settings) -> Chances:
    levels = Levels(newcomers=with_["newcomers"], field=with_["field"])
    found = walk_forward(season, prior_sd=with_["prior_sd"], levels=levels)
    return Chances(found.p_game_integrated, found.p_match_integrated)


def decayed_bradley_terry(season: Results, with_: Settings) -> Chances:
    """Newton's method for a Bradley-Terry model with a normal prior, games fading with age."""
    players = len(season.players)
    skill, won = np.zeros(players), np.zeros((players, players))
    game, last = np.zeros(len(season)), 0
    for day in days_of(season):
        won *= 0.5 ** ((day.number - last) / with_["half_life"])
        last = day.number
        games = won + won.T
        for _ in range(30):
            p = expit(skill[:, None] - skill[None, :])
            slope = (won - games * p).sum(1) - skill / with_["prior_sd"] ** 2
            if np.abs(slope).max() < 1e-7:
                break
            weight = games * p * (1.0 - p)
            bend = np.diag(weight.sum(1) + with_["prior_sd"] ** -2) - weight
            skill = skill + np.linalg.solve(bend, slope)
        game[day.rows] = expit(skill[day.a] - skill[day.b])
        np.add.at(won, (day.a, day.b), day.won_a)
        np.add.at(won, (day.b, day.a), day.won_b)
    return raced(season, game)


def elo(season: Results, with_: Settings) -> Chances:
    rating = [0.0] * len(season.players)

    def predict(a: int, b: int) -> float:
        return 1.0 / (1.0 + math.exp(rating[b] - rating[a]))

    def learn(day: Day) -> None:
        for winner, loser in day.games():
            change = with_["step"] * (1.0 - predict(winner, loser))
            rating[winner] += change
            rating[loser] -= change

    return by_pair(season, predict, learn)


def glicko(season: Results, with_: Settings) -> Chances:
    """Each date is a rating period."""
    import glicko2

    player = [
        glicko2.Player(rating=1500, rd=with_["deviation"], vol=with_["volatility"])
        for _ in season.players
    ]

    def predict(a: int, b: int) -> float:
        one, other = player[a], player[b]
        spread = math.hypot(one.rd, other.rd) * math.log(10.0) / 400.0
        g = 1.0 / math.sqrt(1.0 + 3.0 * (spread / math.pi) ** 2)
        return float(1.0 / (1.0 + 10.0 ** (-g * (one.rating - other.rating) / 400.0)))

    def learn(day: Day) -> None:
        seen: dict[int, list[tuple[float, float, bool]]] = {}
        for winner, loser in day.games():
            for k, other, won in ((winner, loser, True), (loser, winner, False)):
                seen.setdefault(k, []).append((player[other].rating, player[other].rd, won))
        for k, games in seen.items():
            ratings, deviations, outcomes = map(list, zip(*games, strict=True))
            player[k].update_player(ratings, deviations, outcomes)

    return by_pair(season, predict, learn)


def trueskill(season: Results, with_: Settings) -> Chances:
    import trueskill as package

    env = package.TrueSkill(
        mu=0.0, sigma=1.0, beta=with_["beta"], tau=with_["tau"], draw_probability=0.0
    )
    rating = [env.create_rating() for _ in season.players]

    def predict(a: int, b: int) -> float:
        one, other = rating[a], rating[b]
        spread = math.sqrt(2.0 * with_["beta"] ** 2 + one.sigma**2 + other.sigma**2)
        return float(env.cdf((one.mu - other.mu) / spread))

    def learn(day: Day) -> None:
        for winner, loser in day.games():
            rating[winner], rating[loser] = env.rate_1vs1(rating[winner], rating[loser])

    return by_pair(season, predict, learn)


def openskill(season: Results, with_: Settings) -> Chances:
    from openskill.models import PlackettLuce

    model = PlackettLuce(mu=25.0, sigma=25 / 3, beta=with_["beta"], tau=with_["tau"])
    rating = [model.rating() for _ in season.players]

    def predict(a: int, b: int) -> float:
        return float(model.predict_win([[rating[a]], [rating[b]]])[0])

    def learn(day: Day) -> None:
        for winner, loser in day.games():
            (rating[winner],), (rating[loser],) = model.rate([[rating[winner]], [rating[loser]]])

    return by_pair(season, predict, learn)


def whole_history(season: Results, with_: Settings) -> Chances:
    from whr import WHR

    settings = {"w2": with_["w2"], "initial_prior_wins": with_["prior_wins"]}
    known: set[int] = set()
    model = WHR(settings)

    def predict(a: int, b: int) -> float:
        if not {a, b} & known:
            return 0.5
        integrated = model.probability_future_match(str(a), str(b), account_for_uncertainty=True)
        return min(max(float(integrated[0]), 1e-6), 1.0 - 1e-6)

    def learn(day: Day) -> None:
        for winner, loser in day.games():
            model.create_game(str(winner), str(loser), "B", day.number, 0)
            known.update((winner, loser))
        model.iterate(4)

    return by_pair(season, predict, learn)


SYSTEMS = {
    "evenbreak": System(
        evenbreak,
        {
            "prior_sd": (0.25, 0.35, 0.5, 0.7, 1.0),
            "newcomers": (0.0, 0.8, 1.2, 1.8),
            "field": (0.0, 0.5, 0.9),
        },
    ),
    "decayed Bradley-Terry": System(
        decayed_bradley_terry,
        {"prior_sd": (0.25, 0.35, 0.5, 0.7, 1.0), "half_life": (180.0, 365.0, 1e6)},
    ),
    "Elo": System(elo, {"step": (0.02, 0.03, 0.045, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4)}),
    "Glicko-2": System(
        glicko,
        {"deviation": (40.0, 60.0, 90.0, 120.0, 180.0), "volatility": (0.01, 0.06)},
        "glicko2",
    ),
    "TrueSkill": System(
        trueskill, {"beta": (0.7, 1.0, 1.5, 2.2, 3.2, 4.5), "tau": (0.0, 0.02)}, "trueskill"
    ),
    "openskill": System(
        openskill, {"beta": (8.0, 12.5, 25.0, 40.0, 60.0), "tau": (0.0, 0.1)}, "openskill"
    ),
    "whole-history rating": System(
        whole_history, {"w2": (0.3, 3.0, 14.0), "prior_wins": (1.5, 3.0, 6.0, 12.0, 24.0)}, "whr"
    ),
}


class Losses(NamedTuple):
    """The log-loss of each match, in its games and in its winner."""

    game: Floats
    match: Floats


def losses_of(season: Results, chances: Chances) -> Losses:
    _, _, won = even_races(season)
    p, q = (one.clip(1e-9, 1.0 - 1e-9) for one in chances)
    game = -(season.score_a * np.log(p) + season.score_b * np.log1p(-p))
    return Losses(game, -np.where(won > 0.5, np.log(q), np.log1p(-q)))


class Paired(NamedTuple):
    """A mean loss, and how far it is above another, with its standard error."""

    loss: float
    above: float
    error: float


def paired(loss: Floats, other: Floats, amount: Floats, date: Any) -> Paired:
    """Compare losses a game (or match); each date is a cluster."""
    _, cluster = np.unique(date, return_inverse=True)
    above = float((loss - other).sum() / amount.sum())
    miss = np.bincount(cluster, loss - other - above * amount)
    error = math.sqrt(float(miss @ miss) * len(miss) / (len(miss) - 1)) / float(amount.sum())
    return Paired(float(loss.sum() / amount.sum()), above, error)


@cache
def season_at(place: str) -> Results:
    played = read_results(place).results.played().results
    assert played.date is not None
    return played.select(np.argsort(played.date, kind="stable"))


def winners_only(season: Results) -> Results:
    """Return the same matches as races to one."""
    a_won = (season.score_a > season.score_b).astype(int)
    return Results(
        season.players, season.player_a, season.player_b, a_won, 1 - a_won, date=season.date
    )


@cache
def all_losses(place: str, name: str, frames: bool) -> dict[str, Losses]:
    """Return the losses of one system under each of its settings."""
    season = season_at(place) if frames else winners_only(season_at(place))
    found = {}
    for settings in SYSTEMS[name].ways():
        chances = SYSTEMS[name].predict(season, settings)
        found[", ".join(f"{k} {v:g}" for k, v in settings.items())] = losses_of(season, chances)
    return found


def chosen(losses: Mapping[str, Losses], of: str, by: Any) -> str:
    """Return the settings with the smallest loss over some matches."""
    return min(losses, key=lambda name: float(getattr(losses[name], of)[by].sum()))


def compare(place: str, name: str, frames: bool, of: str, hindsight: bool) -> tuple[str, Paired]:
    """Return the settings of a system and how its loss compares with evenbreak's."""
    season = season_at(place)
    assert season.date is not None
    late = season.date >= FIRST_PART
    judged = np.ones(len(season), dtype=bool) if hindsight else late
    by = judged if hindsight else ~late
    ways = [all_losses(place, one, frames) for one in (name, "evenbreak")]
    settings = [chosen(way, of, by) for way in ways]
    mine, ours = (getattr(way[one], of)[judged] for way, one in zip(ways, settings, strict=True))
    amount = (season.score_a + season.score_b if of == "game" else np.ones(len(season)))[judged]
    return settings[0], paired(mine, ours, amount.astype(float), season.date[judged])


def main() -> None:
    """Print the tables."""
    warnings.simplefilter("ignore")
    place = sys.argv[1] if sys.argv[1:] else str(PLACE)
    systems = ["evenbreak", *sys.argv[2:]] if sys.argv[2:] else list(SYSTEMS)
    for frames, of in ((True, "game"), (True, "match"), (False, "match")):
        given = "every game" if frames else "the winner of each match"
        print(f"\nGiven {given}: log-loss a {of}\n")
        print("| system | settings of the first part | above evenbreak | in hindsight | above |")
        print("|---|---|---|---|---|")
        for name in systems:
            system = SYSTEMS[name]
            if not system.is_here:
                print(f"| {name} | {system.package} is not installed |", flush=True)
                continue
            cells = []
            for hindsight in (False, True):
                settings, found = compare(place, name, frames, of, hindsight)
                cells.append(f"{found.loss:.4f} ({settings})")
                cells.append(
                    "" if name == "evenbreak" else f"{found.above:+.4f} ± {found.error:.4f}"
                )
            print(f"| {name} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
