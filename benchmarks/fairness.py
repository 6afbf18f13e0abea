"""Fairness of rating engines and of handicap systems, all judged on the same seasons.

    pip install glicko2 trueskill openskill whole-history-rating  # one that is missing is left out
    python benchmarks/fairness.py --engine mine:Engine --system mine:Handicap --csv fairness.csv

**An engine** is a class of any module, named as `module:Class`. It is made anew for each season:

    class Engine:
        def __init__(self, players): ...      # how many; players are numbers from 0
        def learn(self, night): ...           # night.player_a, .player_b, .score_a, .score_b, .date
        def chance(self, a, b, race): ...     # P(a wins race[0] games before b wins race[1])

Each match is predicted before its night is learned. What users of an engine can set, it names with
the values to choose from, `settings = {"step": (0.05, 0.1)}`; they are passed by name to
`__init__`. The first half of the nights chooses (by the log-loss of games), and the second half
judges. An engine that walks through a season by itself has `walk(season, races)` in place of
`learn` and `chance`; whether it predicts the first half without the second is checked. `engines.py`
has evenbreak's and those of other packages.

**A handicap system** is a `System` by its name, that of an entry point of an installed package, or
`module:Class`: see docs/how-to/your-own-system.md.

The seasons: results of snooker (`--season FILE`; left out if it is not there), and simulated
leagues with true skills that are known (`synthetic_seasons.py`) and steady, or drift. Standard
errors take the matches of a night as one cluster; differences from the first engine are paired.
"""

from __future__ import annotations

import argparse
import csv
import itertools
import math
import sys
import warnings
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from engines import ENGINES
from scipy.special import betainc, expit, logit
from synthetic_seasons import season_with_truth

from evenbreak.arrays import Floats, Ints
from evenbreak.ratings import Results
from evenbreak.ratings.estimates import logistic_coefficient
from evenbreak.ratings.validation.walk_forward import even_races

PLACE = Path(__file__).resolve().parents[2] / "shared/data/snooker_2016_17_results.csv"
OFFERED = [(7, 7), *(race for n in range(6, 1, -1) for race in ((7, n), (n, 7)))]
"""The races of which the fairest is offered to two players, by their chances."""
SYSTEMS = ("fargo-like", "npl", "elo", "apa-like", "none")


class Season(NamedTuple):
    """Matches in their order, what kind of season they are, and the true chances if known."""

    kind: str
    played: Results
    better: Floats | None
    """By how much player a is truly better, in log-odds."""

    @property
    def nights(self) -> Ints:
        """The number of each match's night, from 0."""
        return np.unique(np.asarray(self.played.date), return_inverse=True)[1]


class Truth:
    """Knows how good everybody is: nobody can do better."""

    name, settings = "the true chances", {}

    def __init__(self, better: Floats) -> None:
        self.better = better

    def walk(self, season: Results, races: Sequence[tuple[Ints, Ints]]) -> Floats:
        """Return P(a wins) of each match, by race."""
        return np.array([betainc(m, n, expit(self.better[: len(season)])) for m, n in races])


class Judged(NamedTuple):
    """What an engine said of matches, one entry each, and what came of it."""

    game: Floats
    match: Floats
    score: Floats
    games: Floats
    won: Floats
    night: Ints
    uneven: Floats

    @property
    def game_losses(self) -> Floats:
        """The log-loss of the games of each match."""
        return -(self.score * np.log(self.game) + (self.games - self.score) * np.log1p(-self.game))

    @property
    def match_losses(self) -> Floats:
        """The log-loss of each match's winner."""
        return -np.where(self.won > 0.5, np.log(self.match), np.log1p(-self.match))


def made_of(kind: Any, season: Season, settings: Mapping[str, float]) -> Any:
    """Return an engine for a season."""
    if kind is Truth:
        return Truth(season.better)  # type: ignore[arg-type]
    return kind(players=len(season.played.players), **settings)


def walked(engine: Any, played: Results, races: Sequence[tuple[Ints, Ints]]) -> Floats:
    """Return P(a wins) of each match before its night, by race."""
    if hasattr(engine, "walk"):
        found = np.asarray(engine.walk(played, races))
    else:
        found = np.empty((len(races), len(played)))
        starts = np.unique(np.asarray(played.date), return_index=True)[1].tolist()
        for start, end in itertools.pairwise([*starts, len(played)]):
            for k in range(start, end):
                a, b = int(played.player_a[k]), int(played.player_b[k])
                found[:, k] = [engine.chance(a, b, (int(m[k]), int(n[k]))) for m, n in races]
            engine.learn(played.select(np.arange(start, end)))
    return np.clip(found, 1e-9, 1.0 - 1e-9)


def ways_of(kind: Any) -> Iterator[dict[str, float]]:
    """Yield every combination of an engine's settings."""
    settings: Mapping[str, Sequence[float]] = getattr(kind, "settings", {})
    for values in itertools.product(*settings.values()):
        yield dict(zip(settings, values, strict=True))


def judge(kind: Any, season: Season) -> tuple[dict[str, float], Judged]:
    """Return the settings that the first half of the nights chooses; what it says of the rest."""
    played = season.played
    race_a, race_b, won = even_races(played)
    ones = np.ones(len(played), dtype=int)
    games, score = (played.score_a + played.score_b).astype(float), played.score_a.astype(float)
    late = season.nights > season.nights.max() // 2
    early = np.flatnonzero(~late)

    def loss(settings: Mapping[str, float]) -> float:
        part = played.select(early)  # which is all that the choice may know of
        p = walked(made_of(kind, season, settings), part, [(ones[early], ones[early])])[0]
        return float(-(score[early] * np.log(p) + (games - score)[early] * np.log1p(-p)).sum())

    ways = list(ways_of(kind))
    settings = min(ways, key=loss) if len(ways) > 1 else ways[0]
    races = [(ones, ones), (race_a, race_b)]
    if season.better is not None:
        races += [(m * ones, n * ones) for m, n in OFFERED]
    found = walked(made_of(kind, season, settings), played, races)
    if hasattr(kind, "walk"):
        again = walked(made_of(kind, season, settings), played.select(early), [(ones[early],) * 2])
        if np.abs(again[0] - found[0, early]).max() > 1e-5:
            raise SystemExit(f"{name_of(kind)} knows of matches that come later")
    uneven = np.full(len(played), np.nan)
    if season.better is not None:
        m, n = np.array(OFFERED)[np.abs(found[2:] - 0.5).argmin(axis=0)].T
        uneven = np.abs(betainc(m, n, expit(season.better)) - 0.5)
    rows = late & (race_a > 0)
    columns = found[0], found[1], score, games, won, season.nights, uneven
    return settings, Judged(*(column[rows] for column in columns))


class Estimate(NamedTuple):
    """A number and its standard error."""

    value: float
    error: float


def mean_of(amount: Floats, weight: Floats, night: Ints) -> Estimate:
    """Return a mean over games or matches; each night is a cluster."""
    value = float(amount.sum() / weight.sum())
    miss = np.bincount(night, amount - value * weight)
    many = len(np.unique(night))
    error = math.sqrt(float(miss @ miss) * many / (many - 1)) / float(weight.sum())
    return Estimate(value, error)


def line_of(p: Floats, won: Floats, night: Ints) -> tuple[Estimate, Estimate]:
    """Return the slope of the log-odds of winning on those that were stated; the favorites' gap.

    Right chances have slope 1 (below, they are too extreme) and gap 0 (above, favorites win more).
    """
    x, leads, ones = logit(p), p > 0.5, np.ones(len(p))
    slope = logistic_coefficient(x, won, ones, night)
    favorite = np.where(leads, won, 1.0 - won)
    gap = logistic_coefficient(ones, favorite, ones, night, offset=np.abs(x))
    return tuple(  # type: ignore[return-value]
        Estimate(one.value, (one.high - one.low) / 3.92) if one else Estimate(math.nan, math.nan)
        for one in (slope, gap)
    )


def bins_of(p: Floats, won: Floats) -> list[tuple[float, float, int]]:
    """Return the favorite's mean chance, how often they won, and the matches, by chance."""
    chance, wins = np.where(p > 0.5, p, 1.0 - p), np.where(p > 0.5, won, 1.0 - won)
    place = np.minimum(((chance - 0.5) * 10.0).astype(int), 4)
    rows = [place == k for k in range(5) if (place == k).any()]
    return [(float(chance[k].mean()), float(wins[k].mean()), int(k.sum())) for k in rows]


def binned(its: Judged) -> str:
    """Return the bins as text: stated chance, share of wins, matches."""
    bins = bins_of(its.match, its.won)
    return "; ".join(f"{stated:.3f} {seen:.3f} {n}" for stated, seen, n in bins)


def measures(its: Judged, first: Judged) -> dict[str, Estimate]:
    """Return what is said of an engine, and of how far it is behind the first."""
    many = np.ones(len(its.won))
    slope, intercept = line_of(its.match, its.won, its.night)
    bins = bins_of(its.match, its.won)
    miss = sum(n * abs(p - seen) for p, seen, n in bins) / len(its.won)
    return {
        "game_log_loss": mean_of(its.game_losses, its.games, its.night),
        "game_behind": mean_of(its.game_losses - first.game_losses, its.games, its.night),
        "match_log_loss": mean_of(its.match_losses, many, its.night),
        "match_behind": mean_of(its.match_losses - first.match_losses, many, its.night),
        "brier": mean_of((its.match - its.won) ** 2, many, its.night),
        "slope": slope,
        "intercept": intercept,
        "bins_off_by": Estimate(miss, math.nan),
        "race_off_even": mean_of(its.uneven, many, its.night),
        "race_off_behind": mean_of(its.uneven - first.uneven, many, its.night),
    }


def name_of(kind: Any) -> str:
    """Return what an engine is called."""
    return str(getattr(kind, "name", "") or kind.__name__)


def judged_engines(kinds: Sequence[Any], seasons: Sequence[Season]) -> Iterator[dict[str, Any]]:
    """Yield a row for each kind of season and engine; seasons of a kind are taken together."""
    for kind in dict.fromkeys(season.kind for season in seasons):
        alike = [season for season in seasons if season.kind == kind]
        first: Judged | None = None
        for engine in [*kinds, *([Truth] if alike[0].better is not None else [])]:
            found = [judge(engine, season) for season in alike]
            nights = itertools.accumulate((int(s.nights.max()) + 1 for s in alike), initial=0)
            parts = [
                one._replace(night=one.night + before)
                for (_, one), before in zip(found, nights, strict=False)
            ]
            its = Judged(*(np.concatenate(column) for column in zip(*parts, strict=True)))
            first = first or its
            shown = {", ".join(f"{k} {v:g}" for k, v in way.items()) for way, _ in found}
            row = {"season": kind, "name": name_of(engine), "matches": len(its.won)}
            for name, (value, error) in measures(its, first).items():
                row |= {name: value, f"{name}_error": error}
            yield row | {"settings": " | ".join(sorted(shown)), "bins": binned(its)}


def simulated(leagues: int, seed: int, *, matches: int = 640, players: int = 40) -> list[Season]:
    """Return leagues of 40 weekly nights, of which the true skills are known."""
    how = {"days": 40, "years": 40 / 52}
    return [
        Season(kind, *season_with_truth(matches, players, drift=drift, seed=seed + k, **how))  # type: ignore[arg-type]
        for kind, drift in (("simulated, steady skills", 0.0), ("simulated, drifting", 0.5))
        for k in range(leagues)
    ]


def real(place: Path) -> list[Season]:
    """Return the season of a results file; none if it is not there."""
    from evenbreak.files.results.results_file import read_results

    if not place.exists():
        print(f"{place.name} is not there: simulated leagues only", file=sys.stderr)
        return []
    played = read_results(place).results.played().results
    order = np.argsort(np.asarray(played.date), kind="stable")
    return [Season(place.stem, played.select(order), None)]


def judged_systems(names: Sequence[str], replicas: int, seed: int) -> list[dict[str, Any]]:
    """Return how even matches are under each system, and what losing on purpose pays.

    A league of 24 for two seasons of 30 weeks, a fifth new each season, a tenth sandbaggers.
    """
    from evenbreak.answers.league.compare import Comparison
    from evenbreak.handicaps import system_of
    from evenbreak.league import LeaguePlayers, World, play_systems
    from evenbreak.ratings.scale import SCALES

    skill = np.random.default_rng(seed).normal(0.0, 70.0, 24)
    players = LeaguePlayers.of(np.rint(525.0 + skill))
    world = World(players, SCALES["fargo"], weeks=30, seasons=2, sandbaggers=0.1)
    systems = [system_of(name) for name in names]
    contest = play_systems(world, systems, replicas=replicas, seed=seed)
    found = Comparison(contest, world, systems).measures
    rows = []
    for k, system in enumerate(systems):
        row: dict[str, Any] = {"season": "simulated league", "name": system.name}
        for name in ("p_even", "p_right", "p_better_wins", "sandbagging_pays", "mean_games"):
            row |= {name: float(found[name].value[k]), f"{name}_error": float(found[name].error[k])}
        rows.append(row)
    return rows


_SHOWN = {
    "game_log_loss": 4, "game_behind": 4, "match_behind": 4, "brier": 4, "slope": 2, "intercept": 2,
    "race_off_even": 4, "race_off_behind": 4,
    "p_even": 3, "p_right": 3, "p_better_wins": 3, "sandbagging_pays": 3, "mean_games": 1,
}  # fmt: skip


def table(rows: Sequence[Mapping[str, Any]]) -> str:
    """Return rows of one season as text; columns that nobody has a value of are left out."""
    shown = [
        name for name in _SHOWN if any(not math.isnan(row.get(name, math.nan)) for row in rows)
    ]
    lines = [f"| {rows[0]['season']} | {' | '.join(shown)} |", "|---" * (len(shown) + 1) + "|"]
    for row in rows:
        cells = [
            f"{row[name]:.{_SHOWN[name]}f} ± {row[f'{name}_error']:.{_SHOWN[name]}f}"
            if row[f"{name}_error"] > 0.0 else f"{row[name]:.{_SHOWN[name]}f}"
            for name in shown
        ]  # fmt: skip
        lines.append(f"| {row['name']} | {' | '.join(cells)} |")
    return "\n".join(lines)


def engine_of(name: str) -> Any:
    """Return the class named as module:Class."""
    module, _, attribute = name.partition(":")
    sys.path.insert(0, "")
    return getattr(import_module(module), attribute)


def installed(only: str = "") -> list[Any]:
    """Return the engines that are here: evenbreak's, and those with this in their names."""
    found: list[Any] = []
    for engine in ENGINES:
        module, _, package = engine.needs.partition(" ")
        if found and only.lower() not in engine.name.lower():
            continue
        if module and find_spec(module) is None:
            print(f"{engine.name} is left out: pip install {package}", file=sys.stderr)
            continue
        found.append(engine)
    return found


def main() -> None:
    """Print the tables, and write them."""
    how = argparse.ArgumentParser(description="Judge rating engines and handicap systems.")
    how.add_argument("--engine", action="append", default=[], help="module:Class, with the others")
    how.add_argument("--system", action="append", default=[], help="a name, or module:Class")
    how.add_argument("--season", type=Path, default=PLACE, help="a file of results")
    how.add_argument("--leagues", type=int, default=5, help="simulated, of each kind")
    how.add_argument("--replicas", type=int, default=200, help="leagues of each system")
    how.add_argument("--seed", type=int, default=1)
    how.add_argument("--only", default="", help="engines with this in their names, and the first")
    how.add_argument("--csv", type=Path, help="write all that was found here")
    asked = how.parse_args()
    warnings.simplefilter("ignore")
    kinds = installed(asked.only)
    kinds += [engine_of(name) for name in asked.engine]
    seasons = [*real(asked.season), *simulated(asked.leagues, asked.seed)]
    rows, found = list[dict[str, Any]](), judged_engines(kinds, seasons)
    for _, alike in itertools.groupby(found, key=lambda row: row["season"]):
        rows += (part := list(alike))
        print(table(part) + "\n", flush=True)
    systems = judged_systems([*asked.system, *SYSTEMS], asked.replicas, asked.seed)
    print(table(systems))
    if asked.csv:
        names = dict.fromkeys(name for row in [*rows, *systems] for name in row)
        with asked.csv.open("w", newline="") as file:
            writer = csv.DictWriter(file, list(names), lineterminator="\n")
            writer.writeheader()
            writer.writerows([*rows, *systems])


if __name__ == "__main__":
    main()
