"""Ratings from results: Bradley-Terry on games, maximum a posteriori, with standard errors."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import number
from evenbreak.errors import InputError
from evenbreak.matches.form import form_of
from evenbreak.ratings.beginning import Beginning, PriorMeans
from evenbreak.ratings.covariance import PairCounts, count_pairs
from evenbreak.ratings.decay import day_of, match_weights, until
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.form_weights import form_weights
from evenbreak.ratings.levels import Levels, means_of
from evenbreak.ratings.likelihood_terms import LikelihoodTerms, likelihood_terms
from evenbreak.ratings.posterior import find_mixed_mode, find_mode
from evenbreak.ratings.provisional import games_of_winner
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import DEFAULT_SCALE, Scale, scale_of

PRIOR_SD = math.log(2.0)
"""Default standard deviation of the prior, in natural log-odds: one doubling of the odds.

That is 30 points in the NPL and 100 on the Fargo scale. The NPL's own range, from beginners at 20
to professionals at 130, is four such standard deviations. The professional snooker season, whose
players are closer to each other, is predicted best with 0.36 (see `evenbreak.ratings.prior`); ln 2
costs 0.0024 more log-loss per frame there. The prior weighs as much as eight games against an equal
opponent, so after a few matches the results dominate.
"""

# Beyond these either the data or the prior is lost in the rounding of the other.
NARROWEST, WIDEST = 1e-3, 100.0

BREAK_SD = math.log(2.0)
"""Standard deviation of the break advantage's prior, centered at 0, in natural log-odds.

It is wide compared with real advantages, and keeps the estimate finite if every breaker won.
"""


def fit(
    results: Results,
    *,
    prior_sd: float = PRIOR_SD,
    scale: Any = DEFAULT_SCALE,
    anchor: float | Mapping[str, float] | None = None,
    half_life: float | None = None,
    as_of: Any = None,
    break_advantage: float | str | None = None,
    levels: Levels | None = None,
    provisional: int | None = None,
    form: float = 0.0,
    near: Ratings | None = None,
) -> Ratings:
    """Return the maximum a posteriori ratings, given the games in `results`.

    Every game counts alike: a match is a number of games won and lost, regardless of the race,
    unless players vary from match to match (see `evenbreak.ratings.form_weights`). A match known
    only by its winner counts according to its race (see `race_slopes`). Forfeits and 0-0 matches
    are left out and counted in the answer. The prior keeps the rating of a player who won (or lost)
    every game finite.

    Parameters
    ----------
    prior_sd
        standard deviation of the prior in natural log-odds, independent of the scale.
    scale
        'npl', 'fargo', 'elo', points that double the odds, or a `Scale`.
    anchor
        the prior mean in points; or the ratings of named players: their component is
        shifted so that on average they have these ratings. None: the mean of the ratings that
        players bring with them on this scale, or the scale's center if they bring none. It also
        applies to components without a named player.
    half_life
        days after which a match counts half; None: age does not matter.
    as_of
        the day to rate for: later matches are left out, and the age of a match is counted
        back from this day. None: the last date in the results.
    break_advantage
        how many points better the breaker of a rack plays; 'fit' to estimate it from the racks
        whose breaker is known (see `count_broken`); None: the break does not matter.
    levels
        how far newcomers are behind, how much teams and divisions differ, and the ratings that
        players bring with them; None: every player's prior has the same mean.
    provisional
        ratings from fewer games than this are not ranked in lists; None: see `established_from`.
    form
        how much players vary from match to match: the standard deviation of a game's log-odds.
    near
        ratings for the same results, used to calculate the weights with form; None: the ratings
        without form.

    Raises
    ------
    InputError
        if prior_sd is not in 0.001 to 100, form not in 0 to 3, an anchor is not finite or names
        an unknown player, half_life is not above 0, a date is missing where dates are needed, a
        score is negative, or the two players of a match are the same (see `find_problems`).
    AccuracyError
        if the mode is not found to within rounding.

    Notes
    -----
    Bradley & Terry (1952), "Rank analysis of incomplete block designs"; a prior as in
    Caron & Doucet (2012), though theirs is gamma and this one normal. Without named players
    and levels the ratings of a component have exactly the mean `anchor`.

    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann", "Bo", "Cy"], ["Bo", "Cy", "Ann"], [7, 7, 3], [4, 5, 7])
    >>> ratings = fit(season, scale="fargo")
    >>> ratings.rating.round(1), ratings.standard_error.round(1)
    (array([552.3, 492. , 455.8]), array([69.4, 68.3, 68.9]))
    >>> fit(season, scale="fargo", anchor={"Ann": 600}).rating.round(1)
    array([600. , 539.7, 503.5])
    """
    check_results(results)
    prior_sd = checked_prior(prior_sd)
    scale = scale_of(scale)
    form = form_of(form)
    if form and near is None:
        near = fit(
            results,
            prior_sd=prior_sd,
            scale=scale,
            anchor=anchor,
            half_life=half_life,
            as_of=as_of,
            break_advantage=break_advantage,
            levels=levels,
            provisional=provisional,
        )
    if anchor is None and levels and levels.beginning is not None:
        anchor = levels.beginning.anchor(results.players, scale, brought=levels.brought_sd > 0.0)
    center, named = _anchors(anchor, scale, results.players)
    day = None if as_of is None else day_of(as_of)
    in_time = results if day is None else results.select(until(results, day))
    scored, forfeits, empty = in_time.played()
    won_only = in_time.won_only()
    _refuse_nonsense(scored, won_only)
    pairs = count_pairs(
        len(results.players), scored.player_a, scored.player_b, scored.score_a, scored.score_b
    )
    played: PairCounts | LikelihoodTerms = pairs
    advantage = break_precision = None
    break_games = 0.0
    means = means_of(in_time, levels) if levels else None
    if means is not None and levels and levels.beginning is not None:
        means = means.faded(levels.beginning.kept(half_life, in_time, day))
    players = len(results.players)
    weights = weights_of(scored, won_only, half_life, day)
    weight = float(weights[0] @ (scored.score_a + scored.score_b) + weights[1].sum())
    start = None
    if form and near is not None:
        start = near.scale.log_odds(near.rating - near.anchor)
        by_form = form_weights(scored, won_only, start, form)
        weights = weights[0] * by_form[0], weights[1] * by_form[1]
    plain = not len(won_only) and half_life is None and break_advantage is None and means is None
    if plain and not form:
        mode = find_mode(pairs, prior_sd**-2)
    else:
        breaks = break_advantage is not None
        known_break = known_advantage(break_advantage, scale) if breaks else 0.0
        played = terms = likelihood_terms(scored, won_only, weights, breaks=breaks)
        break_games = terms.games_with_breaker if breaks else 0.0
        break_precision = BREAK_SD**-2 if known_break is None and break_games else None
        mode = find_mixed_mode(
            terms,
            prior_sd**-2,
            advantage=known_break or 0.0,
            break_precision=break_precision,
            means=means,
            start=start,
        )
        advantage = float(mode.point[-1]) if break_games else None
    skill = mode.point[:players]
    means = None if means is None else means.at(skill)
    component = _components(played.graph, None if means is None else means.information)
    rating = center + scale.points_per_log_odds * skill
    races_won, races_lost = _races(won_only)
    return Ratings(
        players=results.players,
        rating=_shifted(rating, named, results.players, component),
        games=pairs.won + pairs.lost,
        won=pairs.won,
        lost=pairs.lost,
        component=component,
        scale=scale,
        anchor=center,
        prior_sd=prior_sd,
        iterations=mode.iterations,
        gradient=mode.gradient,
        matches=len(scored) + len(won_only),
        forfeits=forfeits,
        empty=empty,
        races_won=races_won,
        races_lost=races_lost,
        weight=weight,
        match_form=form,
        named=tuple(named.items()),
        half_life=None if half_life is None else float(half_life),
        as_of=day,
        later=len(results) - len(in_time),
        break_advantage=None if advantage is None else scale.points(advantage),
        break_games=break_games,
        games_behind=_games_behind(
            pairs, won_only, None if levels is None else levels.beginning, means
        ),
        least_games=provisional,
        _played=played,
        levels=levels or Levels(),
        _skill=skill,
        _means=means,
        _level=np.zeros(0) if means is None else mode.point[players:-1],
        _break_precision=break_precision,
    )


def checked_prior(prior_sd: Any) -> float:
    """Return a prior's standard deviation in log-odds, if it is within the limits."""
    wanted = f"a number from {NARROWEST:g} to {WIDEST:g}, in log-odds"
    return number(prior_sd, "prior_sd", low=NARROWEST, high=WIDEST, wanted=wanted)


def known_advantage(value: Any, scale: Scale) -> float | None:
    """Return the break advantage in log-odds, or None if it is to be estimated."""
    if value == "fit":
        return None
    return scale.log_odds(number(value, "break_advantage", wanted="points, 'fit' or None"))


def _anchors(anchor: Any, scale: Scale, players: tuple[str, ...]) -> tuple[float, dict[str, float]]:
    """Return the prior mean in points, and the ratings of named players."""
    if not isinstance(anchor, Mapping):
        if anchor is None:
            return scale.center, {}
        return number(anchor, "anchor", wanted="a finite number of points"), {}
    rated = {*players}
    for name in anchor:
        if name not in rated:
            raise InputError(
                "anchor {name!r} isn't in the results. Give a name that is.", name=name
            )
    return scale.center, {
        name: number(points, f"anchor of {name!r}", wanted="a finite number of points")
        for name, points in anchor.items()
    }


def _shifted(
    rating: Floats,
    named: Mapping[str, float],
    players: tuple[str, ...],
    component: Ints,
) -> Floats:
    """Return the ratings, with each component shifted so that its named players fit on average."""
    if not named:
        return rating
    place = {name: k for k, name in enumerate(players)}
    at = np.array([place[name] for name in named], dtype=np.int64)
    missing = np.array(list(named.values())) - rating[at]
    rating = rating.copy()
    for label in np.unique(component[at]):
        rating[component == label] += missing[component[at] == label].mean()
    return rating


def weights_of(
    scored: Results, won_only: Results, half_life: float | None, day: np.datetime64 | None
) -> tuple[Floats, Floats]:
    """Return the weight of each match; ages are counted back from the very last match."""
    if half_life is None:
        return np.ones(len(scored)), np.ones(len(won_only))
    if day is None:
        days = [
            part.date.max() for part in (scored, won_only) if part.date is not None and len(part)
        ]
        day = max(days, default=None)
    return match_weights(scored, half_life, day), match_weights(won_only, half_life, day)


def _races(won_only: Results) -> tuple[Ints, Ints]:
    """Return the matches known only by their winner that each player won and lost."""
    players = len(won_only.players)
    a_won = np.zeros(0, bool) if won_only.winner is None else won_only.winner == 1
    winner = np.where(a_won, won_only.player_a, won_only.player_b)
    loser = np.where(a_won, won_only.player_b, won_only.player_a)
    return np.bincount(winner, minlength=players), np.bincount(loser, minlength=players)


def _games_behind(
    pairs: PairCounts, won_only: Results, beginning: Beginning | None, means: PriorMeans | None
) -> Floats:
    """Return the games that each rating rests on, including those behind earlier ratings."""
    behind = (pairs.won + pairs.lost).astype(float)
    worth = games_of_winner(*won_only.races)
    for players in (won_only.player_a, won_only.player_b):
        behind += np.bincount(players, worth, len(behind))
    if beginning is not None and means is not None:
        behind += np.where(means.information > 0.0, beginning.games_of(won_only.players), 0.0)
    return behind


def _refuse_nonsense(scored: Results, won_only: Results) -> None:
    if (scored.score_a < 0).any() or (scored.score_b < 0).any():
        raise InputError(
            "the results have a negative score. Fix the problems that find_problems lists."
        )
    for part in (scored, won_only):
        if (part.player_a == part.player_b).any():
            raise InputError(
                "the results have a match with only one player. Fix the problems that "
                "find_problems lists."
            )


def _components(graph: sparse.csr_array, information: Floats | None) -> Ints:
    """Return each player's component, numbered from 1 in order of decreasing size.

    Players about whom something is `known` are linked by the ratings that they bring with them.
    """
    linked = np.flatnonzero(information) if information is not None else np.zeros(0, dtype=np.int64)
    if len(linked) > 1:
        ends = linked[:-1], linked[1:]
        chain = sparse.csr_array((np.ones(len(linked) - 1), ends), shape=graph.shape)
        graph = sparse.csr_array(graph + chain)
    number, label = connected_components(graph, directed=False)
    size = np.bincount(label, minlength=number)
    # Stable, so that of equal components the one with the earlier player comes first:
    # scipy labels components in the order of their first node.
    order = np.argsort(-size, kind="stable")
    rank = np.empty(number, dtype=np.int64)
    rank[order] = np.arange(1, number + 1)
    return rank[label]
