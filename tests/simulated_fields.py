"""A city's evenings of different strength, to which newcomers come every week."""

import sys
from collections import Counter

import numpy as np

from evenbreak.ratings import Results, best_prior


def city(
    rng,
    *,
    apart=0.5,
    spread=0.45,
    venues=6,
    weeks=60,
    players=400,
    loyal=0.85,
    race=5,
    evening=12,
    founders=0.25,
    stay=20.0,
    named=True,
):
    """Return a season and each player's skill.

    Each venue has an evening a week for `evening` players, and the players whose home it is differ
    from those of others by `apart` (standard deviation).
    """
    venue = rng.normal(0.0, apart, venues)
    home = rng.integers(0, venues, players)
    skill = venue[home] + rng.normal(0.0, spread, players)
    first = np.where(rng.random(players) < founders, 0, rng.integers(1, weeks, players))
    until = first + rng.exponential(stay, players)
    keen = rng.gamma(1.0, 1.0, players)
    rows = []
    for week in range(weeks):
        here = np.flatnonzero((first <= week) & (week <= until))
        where = np.where(
            rng.random(len(here)) < loyal, home[here], rng.integers(0, venues, len(here))
        )
        # A newcomer's first evening is at home, and they come.
        new = first[here] == week
        where[new & (week > 0)] = home[here][new & (week > 0)]
        for v in range(venues):
            at = here[where == v]
            weight = np.where(first[at] == week, 1e3, keen[at])
            order = at[np.argsort(-rng.gumbel(size=len(at)) - np.log(weight))][:evening]
            order = rng.permutation(order)
            for _ in range(3):
                order = rng.permutation(order)
                for a, b in order[: len(order) // 2 * 2].reshape(-1, 2):
                    p = 1 / (1 + np.exp(skill[b] - skill[a]))
                    wins = rng.random(2 * race - 1) < p
                    k = np.cumsum(wins)
                    won = k[-1] >= race
                    if won:
                        n = int(np.argmax(k >= race)) + 1
                        score = race, n - race
                    else:
                        n = int(np.argmax(np.cumsum(~wins) >= race)) + 1
                        score = n - race, race
                    rows.append((a, b, *score, race, race, 7 * week + v, v))
    a, b, sa, sb, ra, rb, day, v = np.array(rows).T
    names = np.array([f"venue {k}" for k in range(venues)], dtype=object)[v]
    order = np.argsort(day, kind="stable")
    results = Results(
        tuple(f"p{k:04d}" for k in range(players)), a[order], b[order], sa[order], sb[order],
        date=np.datetime64("2026-01-01") + day[order], race_a=ra[order], race_b=rb[order],
        event=names[order] if named else None,
    )  # fmt: skip
    return results, skill


def small_city(seed, apart):
    """Return a season of some 900 matches at four venues."""
    rng = np.random.default_rng(seed)
    return city(rng, apart=apart, players=78, venues=4, weeks=30, evening=8, stay=12.0)[0]


def main(many=40):
    """Print how often the field is found where venues differ, and where they do not."""
    for apart in (0.0, 0.6, 1.0):
        used, field = [], []
        for seed in range(many):
            results = small_city([seed, 11], apart)
            evidence = best_prior(results, half_life=None).evidence
            used += [one.of for one in evidence if one.used]
            field += [one.value for one in evidence if one.used and one.of == "field"]
        sys.stdout.write(f"venues {apart} apart, {many} leagues: {dict(Counter(used))}, {field}\n")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
