"""How far ratings can be trusted: a season walked through, and what came of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.ratings.calibration import (
    CalibrationBin,
    Estimate,
    bootstrap_ratio,
    brier,
    calibration,
    log_loss,
    logistic_coefficient,
    no_favourites,
)
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.handicap_fairness import SpotFairness, spot_fairness
from evenbreak.ratings.prior import WIDTHS
from evenbreak.ratings.results import Results
from evenbreak.ratings.walk_forward import Forecasts, walk_forward
from evenbreak.ratings.within_matches import (
    Dispersion,
    FirstBreaks,
    Streaks,
    break_advantage,
    dispersion,
    first_breaks,
    side_advantage,
    streaks,
)

Floats = NDArray[np.float64]

PRIORS = WIDTHS[:9]
"""The prior standard deviations that are tried, in log-odds: 0.09 to 1.39, `PRIOR_SD` too."""

FEWEST_DATES = 10
"""Dates from which the bootstrap draws whole dates; with fewer it draws matches."""

BINS = 10

FEWEST_MATCHES = 30
"""Matches with a favourite from which a slope is told."""

WIDEST_SLOPE = 4.0
"""A slope whose interval is wider tells nothing."""

SUREST = 1e-12
"""No chance is taken to be nearer to 0 or 1."""


class Scored(NamedTuple):
    """How good one kind of prediction was, with the prior that suits it best.

    Parameters
    ----------
    of
        'game' or 'match': what is predicted.
    how
        'plug-in': the ratings as they stand; 'integrated': with their uncertainty
        integrated out.
    prior_sd
        the prior that gave the least log-loss, or the one that was given.
    log_loss, brier
        the mean over games (or matches), in nats; a toss-up has ln 2 and 1/4.
    slope
        the calibration slope: 1 is right, below it the predictions are too sure of
        themselves. None where it cannot be told: of fewer than 30 matches with a
        favourite, or where its interval is wider than 4.
    as_it_went
        the log-loss if each date is predicted with the prior that did best before it;
        None where the prior was given.
    """

    of: Literal["game", "match"]
    how: Literal["plug-in", "integrated"]
    prior_sd: float
    log_loss: Estimate
    brier: Estimate
    slope: Estimate | None
    as_it_went: float | None


@dataclass(frozen=True, eq=False)
class Validation:
    """What a season says of the ratings that it is rated with.

    Attributes
    ----------
    forecasts
        the predictions with the prior `prior_sd`.
    prior_sd
        the prior to use: the best for single games, uncertainty integrated out.
    priors
        each prior that was tried with its log-loss a game, integrated.
    scored
        games and matches, plug-in and integrated, each at its own best prior; no matches
        where there are no races.
    usual
        the integrated predictions with the prior that is used unless another is given,
        `PRIOR_SD`; empty where the prior was given here.
    gain
        log-loss of plug-in less that of integrated, each at its own best prior, by what
        is predicted: above 0, the uncertainty is worth its while.
    skill
        ln 2 less the log-loss a game, integrated: above 0, the ratings know something.
    games, matches
        calibration of the favourites' chances, integrated, at the prior to use.
    matches_plug_in
        the same of matches by the ratings as they stand.
    toss_ups
        how many matches have no favourite and so are in no bin, by what is predicted.
    dispersion, streaks, side, breaker, first_breaks
        whether play inside matches is what the model says; None where the file does not
        tell.
    spots
        how often the player with the longer race won.
    drawn
        what the bootstrap draws: 'dates' or 'matches'.
    """

    forecasts: Forecasts
    prior_sd: float
    priors: tuple[tuple[float, float], ...]
    scored: tuple[Scored, ...]
    usual: tuple[Scored, ...]
    gain: dict[str, Estimate]
    skill: Estimate
    games: tuple[CalibrationBin, ...]
    matches: tuple[CalibrationBin, ...]
    matches_plug_in: tuple[CalibrationBin, ...]
    toss_ups: dict[str, int]
    dispersion: Dispersion | None
    streaks: Streaks | None
    side: Estimate | None
    breaker: Estimate | None
    first_breaks: FirstBreaks | None
    spots: tuple[SpotFairness, ...]
    drawn: Literal["dates", "matches"]


def validate(
    results: Results,
    *,
    prior_sd: float | None = None,
    half_life: float | None = None,
    seed: int = 1,
    progress: Callable[[str], None] = lambda _: None,
) -> Validation:
    """Walk forward through a season, and say how good the predictions were.

    Parameters
    ----------
    results
        the matches, with dates.
    prior_sd
        standard deviation of the prior in natural log-odds; None: each kind of
        prediction gets that of `PRIORS`, or between them, which suits it best.
    half_life
        days after which a game counts half; None: games never age.
    seed
        of the bootstrap and of the seasons that chance plays.
    progress
        is told in a sentence what is done next.

    Raises
    ------
    InputError
        as `walk_forward` does.

    Notes
    -----
    A prior that is chosen on the season which it is judged by looks a little better than
    it is: `Scored.as_it_went` does not.

    >>> season = Results.from_names(["Ann", "Ann", "Bo"], ["Bo", "Bo", "Ann"], [7, 7, 3], [2, 4, 7],
    ...     date=["2024-09-03", "2024-09-10", "2024-09-17"])
    >>> found = validate(season, prior_sd=0.5)
    >>> [(row.of, row.how, round(row.log_loss.value, 3)) for row in found.scored[:2]]
    [('game', 'plug-in', 0.654), ('game', 'integrated', 0.655)]
    """
    tried = PRIORS if prior_sd is None else (prior_sd,)
    many = "" if len(tried) == 1 else f", with each of {len(tried)} priors"
    progress(f"Predicting each date from those before it{many}")
    walks = [walk_forward(results, prior_sd=sd, half_life=half_life) for sd in tried]
    found = {}
    for of in ("game", "match"):
        for how in ("plug-in", "integrated"):
            if of == "game" or walks[0].race_a.any():
                found[of, how] = _best(walks, of, how, results, half_life)
    used = found["game", "integrated"].walk
    dates = int(used.date_of[-1]) + 1
    drawn: Literal["dates", "matches"] = "dates" if dates >= FEWEST_DATES else "matches"
    cluster = used.date_of if drawn == "dates" else np.arange(len(used))
    rng = np.random.default_rng(seed)
    progress("Comparing the season with seasons that chance plays")
    spread = dispersion(used, rng)
    of_all = tuple(dict.fromkeys(of for of, _ in found))
    scored = tuple(_scored(best, cluster, rng) for best in found.values())
    return Validation(
        forecasts=used,
        prior_sd=used.prior_sd,
        priors=tuple(
            (walk.prior_sd, _mean_loss(walk, "game", "integrated"))
            for walk in sorted({*walks, used}, key=lambda walk: walk.prior_sd)
        ),
        scored=scored,
        usual=() if prior_sd is not None else _usual(walks, of_all, cluster, seed),
        gain=_gains(found, cluster, rng),
        skill=_skill(used, cluster, rng),
        games=_calibrated(used, "game", "integrated", spread),
        matches=_calibrated(used, "match", "integrated", None),
        matches_plug_in=_calibrated(used, "match", "plug-in", None),
        toss_ups={of: _toss_ups(used, of) for of in of_all},
        dispersion=spread,
        streaks=streaks(used),
        side=side_advantage(used),
        breaker=break_advantage(used),
        first_breaks=first_breaks(used),
        spots=tuple(spot_fairness(used)),
        drawn=drawn,
    )


class _Best(NamedTuple):
    """The walk whose prior suits one kind of prediction best."""

    of: str
    how: str
    walk: Forecasts
    as_it_went: float | None


def _best(
    walks: list[Forecasts], of: str, how: str, results: Results, half_life: float | None
) -> _Best:
    if len(walks) == 1:
        return _Best(of, how, walks[0], None)
    losses = [_mean_loss(walk, of, how) for walk in walks]
    least = int(np.argmin(losses))
    walk = walks[least]
    if 0 < least < len(walks) - 1:
        walk = walk_forward(results, prior_sd=_vertex(losses, least), half_life=half_life)
        if _mean_loss(walk, of, how) > losses[least]:
            walk = walks[least]
    return _Best(of, how, walk, _as_it_went(walks, of, how))


def _vertex(losses: list[float], least: int) -> float:
    """Return where the parabola through the least loss and its neighbours is lowest."""
    x = np.log(PRIORS)
    before, at, after = losses[least - 1 : least + 2]
    shift = 0.5 * (before - after) / (before - 2.0 * at + after)
    return float(np.exp(x[least] + shift * (x[1] - x[0])))


def _as_it_went(walks: list[Forecasts], of: str, how: str) -> float:
    """Return the log-loss where each date has the prior that did best on earlier dates."""
    date_of = walks[0].date_of
    many = int(date_of[-1]) + 1
    by_date = np.array(
        [np.bincount(date_of, log_loss(*_predictions(walk, of, how)), many) for walk in walks]
    )
    before = np.cumsum(by_date, axis=1) - by_date
    # Without a date to judge by all are equal up to rounding: then the default speaks.
    equal = np.ptp(before, axis=0) < 1e-9
    chosen = np.where(equal, PRIORS.index(PRIOR_SD), before.argmin(0))
    return float(by_date[chosen, np.arange(many)].sum() / _predictions(walks[0], of, how)[2].sum())


def _predictions(walk: Forecasts, of: str, how: str) -> tuple[Floats, Floats, Floats]:
    """Return the chances, wins and trials of all matches; none where there is no race."""
    plain = how == "plug-in"
    if of == "game":
        p = walk.p_game if plain else walk.p_game_integrated
        won, trials = walk.results.score_a.astype(float), walk.games.astype(float)
    else:
        raced = walk.race_a > 0
        p = np.where(raced, walk.p_match if plain else walk.p_match_integrated, 0.5)
        won, trials = np.where(raced, walk.won, 0.0), raced.astype(float)
    # Nothing is certain: a chance that rounds to 1 would cost more than can be counted.
    return np.clip(p, SUREST, 1.0 - SUREST), won, trials


def _mean_loss(walk: Forecasts, of: str, how: str) -> float:
    p, won, trials = _predictions(walk, of, how)
    return float(log_loss(p, won, trials).sum() / trials.sum())


def _scored(best: _Best, cluster: NDArray[np.int64], rng: np.random.Generator) -> Scored:
    p, won, trials = _predictions(best.walk, best.of, best.how)
    slope = logistic_coefficient(np.log(p) - np.log1p(-p), won, trials, cluster)
    favourites = int((trials > 0).sum()) - no_favourites(p, trials)
    if favourites < FEWEST_MATCHES or (slope and slope.high - slope.low > WIDEST_SLOPE):
        slope = None
    return Scored(
        best.of,  # type: ignore[arg-type]
        best.how,  # type: ignore[arg-type]
        best.walk.prior_sd,
        bootstrap_ratio(log_loss(p, won, trials), trials, cluster, rng),
        bootstrap_ratio(brier(p, won, trials), trials, cluster, rng),
        slope,
        best.as_it_went,
    )


def _usual(
    walks: list[Forecasts], of_all: tuple[str, ...], cluster: NDArray[np.int64], seed: int
) -> tuple[Scored, ...]:
    """Return how good the predictions are with the prior that is used unless told otherwise."""
    rng = np.random.default_rng(seed)
    walk = walks[PRIORS.index(PRIOR_SD)]
    return tuple(_scored(_Best(of, "integrated", walk, None), cluster, rng) for of in of_all)


def _toss_ups(walk: Forecasts, of: str) -> int:
    p, _, trials = _predictions(walk, of, "integrated")
    return no_favourites(p, trials)


def _gains(
    found: dict[tuple[str, str], _Best], cluster: NDArray[np.int64], rng: np.random.Generator
) -> dict[str, Estimate]:
    gains = {}
    for of in dict.fromkeys(of for of, _ in found):
        plain, whole = (
            _predictions(found[of, how].walk, of, how) for how in ("plug-in", "integrated")
        )
        gain = log_loss(*plain) - log_loss(*whole)
        gains[of] = bootstrap_ratio(gain, plain[2], cluster, rng)
    return gains


def _skill(walk: Forecasts, cluster: NDArray[np.int64], rng: np.random.Generator) -> Estimate:
    p, won, games = _predictions(walk, "game", "integrated")
    return bootstrap_ratio(np.log(2.0) * games - log_loss(p, won, games), games, cluster, rng)


def _calibrated(
    walk: Forecasts, of: str, how: str, spread: Dispersion | None
) -> tuple[CalibrationBin, ...]:
    p, won, trials = _predictions(walk, of, how)
    # Games of a match share what the ratings do not know, so they are worth fewer.
    worth = 1.0 if spread is None else min(1.0, 1.0 / spread.seen)
    return tuple(calibration(p, won, trials, bins=BINS, worth=worth))
