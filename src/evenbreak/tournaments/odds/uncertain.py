"""Title odds when the ratings are uncertain: averaged over the possible ratings.

Odds that treat ratings as certain are overconfident: a player who is the favorite because of a
rating from few games is the favorite in every match at once. Ratings are drawn from their joint
distribution, each draw is solved, and the odds are averaged.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, islice

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import column, floats, whole
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Place
from evenbreak.tournaments.brackets.standing import Results, Standing, standing
from evenbreak.tournaments.odds.chances import Chances, Wins, chances_of
from evenbreak.tournaments.odds.passes import forward_pass
from evenbreak.tournaments.odds.plan import Plan
from evenbreak.tournaments.odds.planning import exact_plan
from evenbreak.tournaments.odds.rematches import (
    Meeting,
    averaged,
    group_meetings,
    meetings_so_far,
    place_odds,
    plan_meetings,
    settled_ranks,
)
from evenbreak.tournaments.odds.sampled import places_of_samples
from evenbreak.tournaments.odds.title import TitleOdds, odds_now

_CELLS = 300_000
_SAMPLES_EACH = 20  # of a bracket that is too large to be exact; the ratings vary more
_MOST_STATES = 1e6
_FEWEST, _MOST = 200, 2_000  # draws of the ratings


@own_arrays
@dataclass(frozen=True, eq=False)
class UncertainOdds:
    """Title odds, averaged over the ratings and with ratings treated as exact.

    Parameters
    ----------
    averaged
        the odds averaged over samples of the ratings; its `error` is the average's.
    as_if_sure
        the odds with the ratings treated as exact.
    bands
        two columns: each player's title odds, averaged over the fifth of the draws in which their
        own rating is lowest, and over the fifth in which it is highest. Their middles are the 10th
        and 90th percentiles of the rating.
    """

    averaged: TitleOdds
    as_if_sure: TitleOdds
    bands: Floats


def over_ratings(
    bracket: Bracket,
    win_of: Callable[[Floats], Wins],
    ratings: Sequence[float] | ArrayLike,
    spread: ArrayLike,
    *,
    samples: int | None = None,
    results: Results | None = None,
    live: Mapping[str, float] | None = None,
    walkovers: float | Mapping[str, float] = 0.0,
    rng: np.random.Generator | None = None,
) -> UncertainOdds:
    """Return title odds averaged over the uncertainty of the ratings.

    Parameters
    ----------
    bracket, results, live, walkovers
        as in `title_odds`; results only of matches whose players are known.
    win_of
        a function from the ratings to the matches' chances: what `title_odds` takes as `win`.
    spread
        how uncertain the ratings are: a standard deviation for each player, or a covariance matrix.
        Errors are normal.
    samples
        how many draws of the ratings, in pairs on either side of the mean; None: 200 to 2,000,
        fewer for larger brackets.
    rng
        the random number generator; None: a generator with seed 0.

    Raises
    ------
    InputError
        if a parameter has an invalid value.

    >>> from evenbreak.ratings.scale import scale_of
    >>> from evenbreak.tournaments import single_elimination
    >>> def by_fargo(ratings):
    ...     return scale_of("fargo").win_probability(ratings[:, None] - ratings)
    >>> found = over_ratings(single_elimination(4), by_fargo, [700, 500, 500, 500], [80] * 4)
    >>> found.as_if_sure.title[0].round(2), found.averaged.title[0].round(2)
    (np.float64(0.64), np.float64(0.59))
    """
    now = standing(bracket, results)
    if now.assumed:
        name = next(iter(now.assumed))
        raise InputError(
            "{results} has {name!r}. Give results of matches whose players are known.", name=name
        )
    mean = column(ratings, "ratings", len(bracket.players), "players")
    remaining = now.remaining
    plan = exact_plan(remaining, (), _MOST_STATES)
    if samples is None:
        samples = _draws(plan, len(mean))
    pairs = -(-whole(samples, "samples", at_least=4) // 2)
    rng = rng or np.random.default_rng(0)
    drawn = drawn_ratings(mean, spread, pairs, rng)

    def of_skills(rows: Iterable[Floats]) -> Iterator[Chances]:
        return (chances_of(now, win_of(row), live=live, walkovers=walkovers) for row in rows)

    sure = odds_now(now, next(of_skills([mean])), rng=rng)
    if plan is None:
        certain = place_odds(bracket, meetings_so_far(now), settled_ranks(now))
        every = _stacked(of_skills(drawn), 2 * pairs)
        laws = certain[:, :, None] + places_of_samples(now, every, 2 * pairs, _SAMPLES_EACH, rng)
        meetings = sure.meetings
    else:
        laws, meetings = _exactly(now, plan, of_skills(drawn), 2 * pairs)
    odds = TitleOdds(bracket, laws.mean(axis=2), error_of_pairs(laws), 2 * pairs, meetings)
    title = laws[:, bracket.places.index(Place(1, 1))]
    return UncertainOdds(odds, sure, title_bands(title, drawn))


def title_bands(title: Floats, drawn: Floats) -> Floats:
    """Return each player's title odds if their own rating is low, and if it is high.

    `title` has a column, and `drawn` has a row, for each draw of the ratings.
    """
    fifth = max(1, len(drawn) // 5)
    by_skill = np.take_along_axis(title, np.argsort(drawn.T, axis=1, kind="stable"), axis=1)
    ends = by_skill[:, :fifth], by_skill[:, -fifth:]
    return np.stack([end.mean(axis=1) for end in ends], axis=1)


def error_of_pairs(laws: Floats) -> Floats:
    """Return the standard error of a mean over samples whose second half may mirror the first.

    Samples, an even number, are on the last axis.
    """
    of_pair = laws.reshape(*laws.shape[:-1], 2, -1).mean(axis=-2)
    return np.asarray(of_pair.std(axis=-1, ddof=1) / np.sqrt(of_pair.shape[-1]))


def drawn_ratings(mean: Floats, spread: ArrayLike, pairs: int, rng: np.random.Generator) -> Floats:
    """Return draws of the ratings, `pairs` and their mirror images in the second half, one per row.

    The same generator gives the same draws on every machine: a covariance has many roots, and the
    symmetric root doesn't depend on the eigenvectors that a library happens to choose. `spread` has
    standard deviations, or is the covariance matrix.

    >>> drawn_ratings(np.array([600.0, 500.0]), [30, 0], 1, np.random.default_rng(0)).round()
    array([[604., 500.],
           [596., 500.]])
    """
    given, players = floats(spread, "spread"), len(mean)
    if given.shape == (players,):
        if (given < 0.0).any():
            raise InputError("spread must be standard deviations, 0 or more")
        root = np.diag(given)
    elif given.shape == (players, players):
        values, vectors = np.linalg.eigh(0.5 * (given + given.T))
        if values[0] < -1e-9 * max(values[-1], 1.0):
            raise InputError("spread must be a covariance matrix, without negative variances")
        root = (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
    else:
        raise InputError(
            "{spread} must have a standard deviation for each of {players} players, or "
            "their covariance matrix; its shape is {given_shape}",
            given_shape=given.shape,
            players=players,
        )
    errors = rng.standard_normal((pairs, players)) @ root
    return np.concatenate([mean + errors, mean - errors])


def drawn_chances(
    bracket: Bracket,
    win_of: Callable[[Floats], Wins],
    drawn: Floats,
    *,
    walkovers: float | Mapping[str, float] = 0.0,
) -> dict[str, Floats]:
    """Return each match's chances for many draws of the ratings, which are the third axis.

    Parameters
    ----------
    drawn
        the draws, one per row, as from `drawn_ratings`.

    The other parameters are as in `over_ratings`.

    >>> def by_points(ratings):
    ...     return 1.0 / (1.0 + 2.0 ** ((ratings - ratings[:, None]) / 100.0))
    >>> from evenbreak.tournaments import single_elimination
    >>> drawn = drawn_ratings(np.array([600.0, 500.0]), [30, 30], 2, np.random.default_rng(0))
    >>> drawn_chances(single_elimination(2), by_points, drawn)["F"].shape
    (2, 2, 4)
    """
    now = standing(bracket)
    each = (chances_of(now, win_of(row), walkovers=walkovers) for row in drawn)
    every = _stacked(each, len(drawn))
    inner: dict[int, Floats] = {}
    for table in every.tables.values():
        inner.setdefault(id(table), table[:-1, :-1])
    return {name: inner[id(table)] for name, table in every.tables.items()}


def _draws(plan: Plan | None, players: int) -> int:
    """Return how many draws of the ratings take a second or two."""
    if plan is None:
        return _FEWEST
    hundreds = min(4e5 / max(plan.states, 1), 5e4 / players**2) // 1
    return int(np.clip(100 * hundreds, _FEWEST, _MOST))


def _exactly(
    now: Standing, plan: Plan, draws: Iterator[Chances], many: int
) -> tuple[Floats, dict[str, Meeting]]:
    """Return the places for each draw, and the meetings averaged over them."""
    at_once = max(1, _CELLS // max((step.size for step in plan.steps), default=1))
    laws: list[Floats] = []
    sums: dict[str, Meeting] = {}
    for start in range(0, many, at_once):
        part = min(at_once, many - start)
        chances = _stacked(draws, part)
        through = forward_pass(plan, chances)
        meetings = plan_meetings(plan, through) | group_meetings(plan.bracket, chances)
        certain = meetings_so_far(now)
        ranks = {**settled_ranks(now), **through.ranks}
        law = place_odds(now.bracket, {**certain, **meetings}, ranks)
        shape = (*law.shape[:2], part)
        laws.append(np.broadcast_to(law.reshape(*law.shape[:2], -1), shape))
        _add(sums, averaged(meetings), part / many)
    found = meetings_so_far(now) | {
        name: part._replace(
            first_wins=np.divide(
                part.first_wins,
                part.probability,
                out=np.full_like(part.first_wins, 0.5),
                where=part.probability > 0.0,
            )
        )
        for name, part in sums.items()
    }
    return np.concatenate(laws, axis=2), {m.name: found[m.name] for m in now.bracket.matches}


def _add(sums: dict[str, Meeting], part: dict[str, Meeting], weight: float) -> None:
    """Add meetings to sums, where `first_wins` is P(they meet and slot 1's player wins)."""
    for name, (first, second, meet, p) in part.items():
        before = sums.get(name, Meeting(first, second, np.zeros(len(p)), np.zeros(len(p))))
        sums[name] = before._replace(
            probability=before.probability + weight * meet,
            first_wins=before.first_wins + weight * meet * p,
        )


def _stacked(draws: Iterator[Chances], many: int) -> Chances:
    """Return the next samples' chances merged, with samples as the last axis."""
    first = next(draws)
    made: dict[int, Floats] = {}
    names: dict[int, str] = {}
    for name, table in first.tables.items():
        if id(table) not in made:
            made[id(table)], names[id(table)] = np.empty((*table.shape, many)), name
    for k, part in enumerate(chain([first], islice(draws, many - 1))):
        for key, name in names.items():
            made[key][..., k] = part.of(name)
    return Chances({name: made[id(table)] for name, table in first.tables.items()})
