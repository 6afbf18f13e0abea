"""Leagues with known levels, and how often estimates cover them.

The tests run a few of these leagues; `python tests/simulated_levels.py 200` runs 200 of each kind.
"""

import sys

import numpy as np
from scipy.special import betaincinv, logit

from evenbreak.ratings import Results, best_prior, fit
from evenbreak.ratings.levels import Levels, joined_late
from evenbreak.ratings.stretches import stretch_losses
from evenbreak.ratings.validation.validate import handicap_fairness
from evenbreak.ratings.validation.walk_forward import walk_forward

SPREAD, TEAMS = 0.4, 6
IMPLIED = logit(betaincinv(6, np.arange(6, 1, -1), 0.5))
"""The differences at which the races 6:6, 6:5, ... 6:2 are even."""


def league(
    rng, *, team_sd=0.0, below=0.0, races=None, players=36, days=30, a_day=18, joiners=1 / 3,
    drift=0.0, off=SPREAD,
):  # fmt: skip
    """Return a season and the truth: team levels, and each player's skill.

    A part of the players, `joiners`, join during the season, `below` weaker on average. `races` is
    the part of the stated difference that is real; None: there are no handicaps. Skills lie `off`
    from what races say, and go `drift` further a day, which the races follow.
    """
    team = np.arange(players) % TEAMS
    levels = rng.normal(0.0, team_sd, TEAMS) if team_sd else np.zeros(TEAMS)
    late = rng.permutation(players) < round(joiners * players)
    joins = np.where(late, rng.integers(days // 10, days - days // 6, players), 0)
    stated = np.zeros(players)
    if races is not None:
        stated = rng.normal(0.0, 0.35, players)
    skill = levels[team] + rng.normal(0.0, off, players) - below * (joins > 0)
    skill += (races or 0.0) * stated
    rows = []
    for day in range(days):
        if drift:
            further = rng.normal(0.0, drift, players)
            skill, stated = skill + further, stated + further / races
        present = rng.permutation(np.flatnonzero(joins <= day))
        for a, b in present[: 2 * min(a_day, len(present) // 2)].reshape(-1, 2):
            race = _race(stated[a] - stated[b])
            p = 1.0 / (1.0 + np.exp(skill[b] - skill[a]))
            won = [0, 0]
            while won[0] < race[0] and won[1] < race[1]:
                won[int(rng.random() >= p)] += 1
            rows.append((a, b, *won, *race, day))
    a, b, score_a, score_b, race_a, race_b, day = np.array(rows).T
    names = np.array([f"team {k}" for k in range(TEAMS)], dtype=object)
    results = Results(
        tuple(f"p{k:02d}" for k in range(players)), a, b, score_a, score_b,
        date=np.datetime64("2026-01-01") + 7 * day, race_a=race_a, race_b=race_b,
        team_a=names[team[a]], team_b=names[team[b]],
    )  # fmt: skip
    return results, levels, skill


def _race(difference):
    """Return the race that is nearest to even at a stated difference, the longer to 6."""
    give = int(np.abs(IMPLIED - abs(difference)).argmin())
    return (6, 6 - give) if difference >= 0 else (6 - give, 6)


def teams_covered(seed, team_sd=0.4):
    """Return which team levels, each less their mean, lie within their 95% intervals."""
    results, levels, _ = league(np.random.default_rng(seed), team_sd=team_sd)
    ratings = fit(results, prior_sd=SPREAD, levels=Levels(team_sd=team_sd))
    found = {group.name: group for group in ratings.groups}
    groups = [found[f"team {k}"] for k in range(TEAMS)]
    above = ratings.scale.log_odds(np.array([group.above for group in groups]))
    error = ratings.scale.log_odds(np.array([group.standard_error for group in groups]))
    return np.abs(above - (levels - levels.mean())) < 1.96 * error


def race_covered(seed, races):
    """Return whether the part of a stated difference that is real is covered; None: not found."""
    results, *_ = league(np.random.default_rng(seed), races=races)
    return _covered(results, "race", races)


def givers(seed, races, *, drift=0.0):
    """Return the share of those who give games, the share and the sum that they were said to win.

    `races` is by how much players differ for each unit that their races take back.
    """
    rng = np.random.default_rng(seed)
    results, *_ = league(rng, races=races, players=60, a_day=30, drift=drift, off=0.15)
    choice = best_prior(results)
    way = {"prior_sd": choice.prior_sd, "half_life": choice.half_life, "levels": choice.levels}
    spot = handicap_fairness(walk_forward(results, **way))[-1]
    return spot.share, spot.expected, spot.matches


def joined_covered(seed, below):
    """Return whether the true difference of those who joined late is covered; None: not found."""
    results, _, skill = league(np.random.default_rng(seed), below=below)
    late = joined_late(results) > 0
    return _covered(results, "joined", skill[~late].mean() - skill[late].mean())


def _covered(results, name, truth):
    for found in best_prior(results).evidence:
        if found.of == name and found.used:
            return abs(found.value - truth) < 1.96 * found.standard_error
    return None


def harm(seed):
    """Return what the levels that are found in a league without any cost a game in a new season."""
    results, *_ = league(np.random.default_rng(seed), days=60)
    first = results.select(np.asarray(results.date) < np.datetime64("2026-01-01") + 7 * 30)
    choice = best_prior(first)
    ways = [
        {"prior_sd": choice.prior_sd, "levels": levels, "half_life": half_life}
        for levels, half_life in ((Levels(), None), (choice.levels, choice.half_life))
    ]
    plain, chosen = stretch_losses(results, ways).means
    return chosen - plain, tuple(found.of for found in choice.evidence if found.used)


def main(many=200):
    """Print how often levels are covered, and what is lost where there are none."""
    teams = np.concatenate([teams_covered(seed) for seed in range(many)])
    sys.stdout.write(f"team levels covered: {teams.mean():.3f} of {len(teams)}\n")
    for truth in (3.0, 2.0, 1.0):
        for drift in (0.0, 0.06):
            won, said, of = np.array([givers(seed, truth, drift=drift) for seed in range(many)]).T
            off = won - said
            sys.stdout.write(
                f"givers, races take back 1/{truth:g}, drift {drift}: said {said.mean():.4f}, won "
                f"{won.mean():.4f}, off {off.mean():+.4f} +- {off.std() / many**0.5:.4f}, beyond "
                f"1.96 errors {(np.abs(off) > 1.96 * np.sqrt(won * (1 - won) / of)).mean():.3f}\n"
            )
    for truth in (3.0, 2.0, 1.0, 0.5):
        found = [race_covered(seed, truth) for seed in range(many)]
        known = [one for one in found if one is not None]
        sys.stdout.write(
            f"race {truth}: covered {np.mean(known):.3f} of {len(known)} that were found\n"
        )
    found = [joined_covered(seed, 0.8) for seed in range(many)]
    known = [one for one in found if one is not None]
    sys.stdout.write(f"joined late: covered {np.mean(known):.3f} of {len(known)} that were found\n")
    costs, used = zip(*(harm(seed) for seed in range(many)), strict=True)
    names = [name for one in used for name in one]
    sys.stdout.write(
        f"no levels: harm {np.mean(costs):.6f} a game, at worst {max(costs):.6f}; used {names}\n"
    )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
