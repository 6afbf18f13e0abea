"""Fairness of rating engines, judged on the same seasons, and of handicap systems.

    pip install glicko2 trueskill openskill whole-history-rating  # one that is missing is left out
    python benchmarks/fairness.py --engine mine:Engine --system mine:Handicap --csv fairness.csv

**An engine** is a class of any module, named as `module:Class`. It is made anew for each season:

    class Engine:
        def __init__(self, players): ...      # how many; players are numbers from 0
        def learn(self, night): ...           # night.player_a, .player_b, .score_a, .score_b, .date
        def chance(self, a, b, race): ...     # P(a wins race[0] games before b wins race[1])

Each match is predicted before its night is learned. What users of an engine can set, it names with
the values to choose from, `settings = {"step": (0.05, 0.1)}`; they are passed by name to
`__init__`. The first half of the nights chooses (by the log-loss of games, one setting after the
other until none can be bettered), and the second half judges. A star marks an engine that chose
the first or last of a setting's values somewhere: there wider ones might do better. An engine that
walks through a season by itself has `walk(season, races)` in place of `learn` and `chance`; then
the results of several nights and all later ones are turned round, and what it says of matches up
to that night must stay the same. `engines.py` has evenbreak's and those of other packages.

**A handicap system** is a `System` by its name, that of an entry point of an installed package, or
`module:Class`: see docs/how-to/your-own-system.md. Systems play a simulated league of their own.

The seasons: results of snooker (`--season FILE`; left out if it is not there), and simulated
leagues with true skills that are known (`synthetic_seasons.py`) and steady, or drift. What an
engine knows of a player carries over from night to night, so standard errors take each league as
one cluster, and twelve blocks of nights where there is one season; differences from the first
engine are paired.
"""

from __future__ import annotations

import argparse
import csv
import itertools
import math
import sys
import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from engines import ENGINES
from scipy.special import betainc, expit, logit
from synthetic_seasons import season_with_truth

from evenbreak.arrays import Bools, Floats, Ints
from evenbreak.ratings import Results
from evenbreak.ratings.estimates import logistic_coefficient
from evenbreak.ratings.validation.walk_forward import even_races

PLACE = Path(__file__).resolve().parents[2] / "shared/data/snooker_2016_17_results.csv"
OFFERED = [(7, 7), *(race for n in range(6, 1, -1) for race in ((7, n), (n, 7)))]
"""The races of which the fairest is offered to two players, by their chances."""
BLOCKS = 12
"""Into how many blocks of nights, as clusters, a season is cut that is the only one of its kind."""
CHECKED = 5
"""At how many nights it is checked that an engine which walks by itself doesn't look ahead."""
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
    """Knows the true skills; no engine can do better."""

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
    cluster: Ints
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


def chosen(kind: Any, loss: Callable[[dict[str, float]], float]) -> dict[str, float]:
    """Return the settings with the least loss, found from the middle one setting at a time."""
    values: Mapping[str, Sequence[float]] = getattr(kind, "settings", {})
    way = {name: each[len(each) // 2] for name, each in values.items()}
    losses: dict[tuple[float, ...], float] = {}

    def known(way: dict[str, float]) -> float:
        key = tuple(way.values())
        if key not in losses:
            losses[key] = loss(way)
        return losses[key]

    while True:
        before = way
        for name, each in values.items():
            way = min(({**way, name: value} for value in each), key=known)
        if way == before:
            return way


def edges(kind: Any, way: Mapping[str, float]) -> list[str]:
    """Return the settings that are the first or last of their values, and could be wider."""
    values: Mapping[str, Sequence[float]] = getattr(kind, "settings", {})
    return [
        f"{name} {value:g}"
        for name, value in way.items()
        if value in (values[name][0], values[name][-1]) and value not in (0.0, math.inf)
    ]


def turned(played: Results, rows: Bools) -> Results:
    """Return results in which the other player has won some matches: 7-4 becomes 4-7."""
    race_a, race_b, won = even_races(played)
    a = np.where(won == 1.0, np.minimum(played.score_b, race_a - 1), race_a)
    b = np.where(won == 1.0, race_b, np.minimum(played.score_a, race_b - 1))
    a, b = np.where(race_a > 0, (a, b), (played.score_b, played.score_a))
    return replace(
        played,
        score_a=np.where(rows, a, played.score_a),
        score_b=np.where(rows, b, played.score_b),
    )


def judge(kind: Any, season: Season) -> tuple[dict[str, float], Judged]:
    """Return the settings that the first half of the nights chooses; what it says of the rest."""
    played, nights = season.played, season.nights
    race_a, race_b, won = even_races(played)
    ones = np.ones(len(played), dtype=int)
    games, score = (played.score_a + played.score_b).astype(float), played.score_a.astype(float)
    late = nights > nights.max() // 2
    early = np.flatnonzero(~late)

    def loss(settings: Mapping[str, float]) -> float:
        part = played.select(early)  # which is all that the choice may know of
        p = walked(made_of(kind, season, settings), part, [(ones[early], ones[early])])[0]
        return float(-(score[early] * np.log(p) + (games - score)[early] * np.log1p(-p)).sum())

    settings = chosen(kind, loss)
    races = [(ones, ones), (race_a, race_b)]
    if season.better is not None:
        races += [(m * ones, n * ones) for m, n in OFFERED]
    found = walked(made_of(kind, season, settings), played, races)
    checked = np.unique(np.linspace(1, nights.max(), CHECKED).astype(int))
    for night in checked.tolist() if hasattr(kind, "walk") else []:
        other = turned(played, nights >= night)
        again = walked(made_of(kind, season, settings), other, races)
        if np.abs(again - found)[:, nights <= night].max() > 1e-5:
            raise SystemExit(f"{name_of(kind)} knows results of night {night} or later before it")
    uneven = np.full(len(played), np.nan)
    if season.better is not None:
        m, n = np.array(OFFERED)[np.abs(found[2:] - 0.5).argmin(axis=0)].T
        uneven = np.abs(betainc(m, n, expit(season.better)) - 0.5)
    rows = late & (race_a > 0)
    night = np.unique(nights[rows], return_inverse=True)[1]
    block = night * BLOCKS // (night.max() + 1)
    said = (column[rows] for column in (found[0], found[1], score, games, won))
    return settings, Judged(*said, block, uneven[rows])


class Estimate(NamedTuple):
    """A number and its standard error."""

    value: float
    error: float


def mean_of(amount: Floats, weight: Floats, cluster: Ints) -> Estimate:
    """Return a mean over games or matches; those of a cluster may depend on each other."""
    value = float(amount.sum() / weight.sum())
    miss = np.bincount(cluster, amount - value * weight)
    many = len(np.unique(cluster))
    error = math.sqrt(float(miss @ miss) * many / (many - 1)) / float(weight.sum())
    return Estimate(value, error)


def line_of(p: Floats, won: Floats, cluster: Ints) -> tuple[Estimate, Estimate]:
    """Return the slope of the log-odds of winning on those that were stated; the favorites' gap.

    Right chances have slope 1 (below, they are too extreme) and gap 0 (above, favorites win more).
    """
    x, leads, ones = logit(p), p > 0.5, np.ones(len(p))
    slope = logistic_coefficient(x, won, ones, cluster)
    favorite = np.where(leads, won, 1.0 - won)
    gap = logistic_coefficient(ones, favorite, ones, cluster, offset=np.abs(x))
    return tuple(  # type: ignore[return-value]
        Estimate(one.value, (one.high - one.low) / 3.92) if one else Estimate(math.nan, math.nan)
        for one in (slope, gap)
    )


def measures(its: Judged, first: Judged) -> dict[str, Estimate]:
    """Return what is said of an engine, and of how far it is behind the first."""
    many = np.ones(len(its.won))
    slope, intercept = line_of(its.match, its.won, its.cluster)
    return {
        "game_log_loss": mean_of(its.game_losses, its.games, its.cluster),
        "game_behind": mean_of(its.game_losses - first.game_losses, its.games, its.cluster),
        "match_log_loss": mean_of(its.match_losses, many, its.cluster),
        "match_behind": mean_of(its.match_losses - first.match_losses, many, its.cluster),
        "brier": mean_of((its.match - its.won) ** 2, many, its.cluster),
        "slope": slope,
        "intercept": intercept,
        "from_even": mean_of(its.uneven, many, its.cluster),
        "from_even_behind": mean_of(its.uneven - first.uneven, many, its.cluster),
    }


def name_of(kind: Any) -> str:
    """Return what an engine is called."""
    return str(getattr(kind, "name", "") or kind.__name__)


def judged_engines(
    kinds: Sequence[Any], seasons: Sequence[Season], share: Callable[..., Iterable[Any]] = map
) -> Iterator[dict[str, Any]]:
    """Yield a row for each kind of season and engine; seasons of a kind are taken together."""
    for kind in dict.fromkeys(season.kind for season in seasons):
        alike = [season for season in seasons if season.kind == kind]
        first: Judged | None = None
        for engine in [*kinds, *([Truth] if alike[0].better is not None else [])]:
            ways, parts = zip(*share(judge, [engine] * len(alike), alike), strict=True)
            its = Judged(*(np.concatenate(column) for column in zip(*parts, strict=True)))
            if len(alike) > 1:
                leagues = np.repeat(np.arange(len(alike)), [len(part.won) for part in parts])
                its = its._replace(cluster=leagues)
            first = first or its
            row = {"season": kind, "name": name_of(engine), "matches": len(its.won)}
            for name, (value, error) in measures(its, first).items():
                row |= {name: value, f"{name}_error": error}
            texts = (", ".join(f"{k} {v:g}" for k, v in way.items()) for way in ways)
            at_edge = Counter(edge for way in ways for edge in edges(engine, way))
            yield row | {
                "settings": " | ".join(sorted(set(texts))),
                "edges": "; ".join(f"{edge} in {n} of {len(alike)}" for edge, n in at_edge.items()),
            }


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
    from evenbreak.league import LeaguePlayers, World, play_systems
    from evenbreak.questions.systems import ANY_SYSTEM
    from evenbreak.ratings.scale import SCALES

    skill = np.random.default_rng(seed).normal(0.0, 70.0, 24)
    players = LeaguePlayers.of(np.rint(525.0 + skill))
    world = World(players, SCALES["fargo"], weeks=30, seasons=2, sandbaggers=0.1)
    systems = [ANY_SYSTEM.read(name) for name in names]
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
    "from_even": 4, "from_even_behind": 4,
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
        lines.append(f"| {row['name']}{' *' * bool(row.get('edges'))} | {' | '.join(cells)} |")
    stars = [f"{row['name']}: {row['edges']}" for row in rows if row.get("edges")]
    lines += ["\n* chose the first or last of its values. " + ". ".join(stars)] * bool(stars)
    return "\n".join(lines)


def engine_of(name: str) -> Any:
    """Return the class named as module:Class."""
    module, _, attribute = name.partition(":")
    sys.path.insert(0, "")
    return getattr(import_module(module), attribute)


def installed() -> list[Any]:
    """Return the engines that are here."""
    found: list[Any] = []
    for engine in ENGINES:
        module, _, package = engine.needs.partition(" ")
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
    how.add_argument("--jobs", type=int, default=1, help="processes")
    how.add_argument("--csv", type=Path, help="write all that was found here")
    asked = how.parse_args()
    warnings.simplefilter("ignore")
    kinds = [*installed(), *(engine_of(name) for name in asked.engine)]
    seasons = [*real(asked.season), *simulated(asked.leagues, asked.seed)]
    rows = list[dict[str, Any]]()
    with ProcessPoolExecutor(asked.jobs) as pool:
        found = judged_engines(kinds, seasons, pool.map)
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
