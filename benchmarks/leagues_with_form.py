"""Whether errors and form of the day hold the truth as often as they state, in simulated leagues.

python benchmarks/leagues_with_form.py [LEAGUES]

Forty players, of whom some come often and some rarely, play 2,000 races to 7 (or 600 races to 5).
Skills are normal with spread 0.5. Each half of a season is rated with and without form; the first
half predicts the games of the second.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from typing import NamedTuple

import numpy as np
from scipy.special import expit, log_expit, logsumexp

from evenbreak.arrays import Bools, Floats
from evenbreak.matches.form import center_of_form, normal_rule
from evenbreak.ratings import Ratings, Results, fit
from evenbreak.ratings.day_form import with_form
from evenbreak.ratings.validation.within_matches import play_races

PLAYERS, SPREAD = 40, 0.5
NODES, WEIGHTS = normal_rule(1.0, 2, 31)
OFTEN = 200
"""Games from which a player has many."""


class Design(NamedTuple):
    """A kind of league: the form, how many matches it plays, and to how many games."""

    form: float
    matches: int
    race: int


DESIGNS = [Design(form, *size) for size in ((2000, 7), (600, 5)) for form in (0.0, 0.35, 0.5)]


def league(design: Design, rng: np.random.Generator) -> tuple[Results, Floats]:
    """Return a season, and the skills."""
    skill = rng.normal(0.0, SPREAD, PLAYERS)
    often = rng.gamma(0.7, 1.0, PLAYERS) + 0.1
    a, b = np.array(
        [
            rng.choice(PLAYERS, 2, replace=False, p=often / often.sum())
            for _ in range(design.matches)
        ]
    ).T
    center = center_of_form(skill[a] - skill[b], 0.0, design.form)
    p = expit(center + design.form * rng.standard_normal(design.matches))
    needs = np.full(design.matches, design.race)
    won, games = play_races(p, needs, needs, rng)
    names = tuple(f"p{k:02d}" for k in range(PLAYERS))
    return Results(names, a, b, won, games - won), skill


def held(rated: Ratings, skill: Floats) -> dict[str, tuple[Bools, Floats]]:
    """Return for pairs with many and few games how many errors the truth is away."""
    first, second = np.triu_indices(PLAYERS, 1)
    miss = rated.scale.log_odds(rated.rating[first] - rated.rating[second])
    miss -= skill[first] - skill[second]
    away = np.abs(miss) / np.sqrt(rated.difference_variances(first, second))
    fewest = np.minimum(rated.games[first], rated.games[second])
    return {"many": away[fewest >= OFTEN], "few": away[(fewest > 0) & (fewest < OFTEN)]}


def loss(rated: Ratings, coming: Results) -> Floats:
    """Return the log-loss of each match's games, a game, the ratings' errors integrated out."""
    a, b = coming.player_a, coming.player_b
    mean = rated.scale.log_odds(rated.rating[a] - rated.rating[b])
    sd = np.sqrt(rated.difference_variances(a, b))
    x = mean[:, None] + sd[:, None] * NODES
    p, q = (np.exp(logsumexp(log_expit(s * x), axis=1, b=WEIGHTS)) for s in (1, -1))
    return -coming.score_a * np.log(p) - coming.score_b * np.log(q)


def study(design: Design, leagues: int) -> None:
    """Print what many leagues of one kind show."""
    away: dict[tuple[str, str, str], list[Floats]] = defaultdict(list)
    gains, found, covered, established = [], [], 0, 0
    for seed in range(leagues):
        rng = np.random.default_rng([seed, *map(int, (100 * design.form, design.matches))])
        season, skill = league(design, rng)
        half = len(season) // 2
        parts = {
            "first half": season.select(np.arange(half)),
            "second half": season.select(np.arange(half, len(season))),
            "season": season,
        }
        for part, results in parts.items():
            plain = fit(results, prior_sd=SPREAD)
            ways = {"without": plain, "with": with_form(results, plain)}
            for way, rated in ways.items():
                for games, errors in held(rated, skill).items():
                    away[part, way, games].append(errors)
            if part == "first half":
                coming = parts["second half"]
                games = (coming.score_a + coming.score_b).sum()
                before, after = (loss(rated, coming).sum() / games for rated in ways.values())
                gains.append(before - after)
        form = ways["with"].form
        assert form is not None
        found.append(form.variance.value)
        covered += form.variance.low <= design.form**2 <= form.variance.high
        established += form.established
    error = np.std(found) / np.sqrt(leagues)
    print(f"\n{design.matches} races to {design.race}, form {design.form} (v {design.form**2:.3f})")
    print(f"  v found {np.mean(found):.3f} ± {error:.3f}; its interval held v in {covered}, and it "
          f"was established in {established} of {leagues}")  # fmt: skip
    saved = np.array(gains) * 1e4
    error = saved.std() / np.sqrt(leagues)
    print(f"  saved a game, in 1e-4 nats: {saved.mean():.2f} ± {error:.2f}; "
          f"the worst league {saved.min():.1f}")  # fmt: skip
    for (part, way, games), errors in away.items():
        within = [np.mean(np.concatenate(errors) <= limit) for limit in (1.0, 1.96)]
        each = [np.mean(one <= 1.0) for one in errors if len(one)]
        sd = np.std(each) / np.sqrt(len(each))
        print(f"  {part}, {way} form, {games} games: {within[0]:.3f} ± {sd:.3f} of .683, "
              f"{within[1]:.3f} of .950")  # fmt: skip


if __name__ == "__main__":
    for one in DESIGNS:
        study(one, int(sys.argv[1]) if sys.argv[1:] else 200)
