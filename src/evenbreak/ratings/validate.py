"""How far ratings can be trusted: a season predicted date by date, and what happened."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from evenbreak.checks import seed_of
from evenbreak.ratings.advantages import FirstBreaks, break_advantage, first_breaks, side_advantage
from evenbreak.ratings.calibration import CalibrationBin, Estimate, bootstrap_ratio, calibration
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.fit import PRIOR_SD
from evenbreak.ratings.handicap_fairness import HandicapFairness, handicap_fairness
from evenbreak.ratings.results import Results
from evenbreak.ratings.scored import (
    PRIORS,
    How,
    Of,
    Predictions,
    Scored,
    best_predictions,
    loss_as_it_went,
)
from evenbreak.ratings.walk_forward import Forecasts, walk_forward
from evenbreak.ratings.within_matches import Dispersion, Streaks, dispersion, streaks

FEWEST_DATES = 10
"""Dates from which the bootstrap resamples whole dates; with fewer it resamples matches."""

BINS = 10


@dataclass(frozen=True, eq=False)
class Validation:
    """What a season says about the ratings that were predicted from it.

    Attributes
    ----------
    forecasts
        the predictions with the prior `prior_sd`.
    prior_sd
        the prior to use: the best for single games, uncertainty integrated out.
    priors
        each prior that was tried with its log-loss a game, integrated.
    scored
        games and matches, plug-in and integrated, each with its own best prior; no matches
        where there are no races.
    usual
        the integrated predictions with the default prior, `PRIOR_SD`; empty where a prior
        was given.
    gain
        log-loss of plug-in less that of integrated, each with its own best prior, by what is
        predicted: above 0, integrating out the uncertainty helps.
    skill
        ln 2 less the log-loss a game, integrated: above 0, the ratings beat a coin.
    games, matches
        calibration of the favourites' chances, integrated, with the prior to use.
    matches_plug_in
        the same for matches, by the ratings at face value.
    toss_ups
        how many matches have no favourite and so are in no bin, by what is predicted.
    dispersion, streaks, side, breaker, first_breaks
        whether play inside matches agrees with the model; None where the file does not say.
    spots
        how often the player with the longer race won.
    drawn
        what the bootstrap resamples: 'dates' or 'matches'.
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
    spots: tuple[HandicapFairness, ...]
    drawn: Literal["dates", "matches"]


def validate(
    results: Results,
    *,
    prior_sd: float | None = None,
    half_life: float | None = None,
    seed: int | np.random.Generator = 1,
    progress: Callable[[int, int], None] = lambda _done, _all: None,
) -> Validation:
    """Predict a season date by date, and return how good the predictions were.

    Parameters
    ----------
    results
        the matches, with dates.
    prior_sd
        standard deviation of the prior in natural log-odds; None: each kind of prediction
        gets the one that suits it best, from `PRIORS` or between them.
    half_life
        days after which a game counts half; None: games never age.
    seed
        of the bootstrap and of the simulated seasons: a whole number, or a generator.
    progress
        called with how many steps are done, and of how many.

    Raises
    ------
    InputError
        as `walk_forward` does.

    Notes
    -----
    A prior chosen on the season by which it is judged looks slightly better than it is;
    `Scored.as_it_went` is free of that.

    >>> season = Results.from_names(["Ann", "Ann", "Bo"], ["Bo", "Bo", "Ann"], [7, 7, 3], [2, 4, 7],
    ...     date=["2024-09-03", "2024-09-10", "2024-09-17"])
    >>> found = validate(season, prior_sd=0.5)
    >>> [(row.of, row.how, round(row.log_loss.value, 3)) for row in found.scored[:2]]
    [('game', 'plug-in', 0.654), ('game', 'integrated', 0.655)]
    """
    check_results(results)
    seed = seed_of(seed)
    tried = PRIORS if prior_sd is None else (prior_sd,)
    steps = len(tried) + 5
    walks = []
    for done, sd in enumerate(tried, 1):
        walks.append(walk_forward(results, prior_sd=sd, half_life=half_life))
        progress(done, steps)
    raced = bool(walks[0].race_a.any())
    kinds: list[tuple[Of, How]] = [("game", "plug-in"), ("game", "integrated")]
    kinds += [("match", "plug-in"), ("match", "integrated")] if raced else []
    best = {}
    for done, kind in enumerate(kinds, len(tried) + 1):
        best[kind] = best_predictions(walks, *kind, results, half_life)
        progress(done, steps)
    used = best["game", "integrated"]
    walk = used.walk
    by_dates = int(walk.date_of[-1]) + 1 >= FEWEST_DATES
    cluster = walk.date_of if by_dates else np.arange(len(walk))
    rng = np.random.default_rng(seed)
    spread = dispersion(walk, rng)
    progress(steps, steps)
    scored = tuple(
        one.scored(cluster, rng, loss_as_it_went(walks, *kind)) for kind, one in best.items()
    )
    of_all = tuple(dict.fromkeys(of for of, _ in best))
    usual: tuple[Scored, ...] = ()
    if prior_sd is None:
        own_rng = np.random.default_rng(seed)
        default = walks[PRIORS.index(PRIOR_SD)]
        usual = tuple(
            Predictions.of_walk(default, of, "integrated").scored(cluster, own_rng) for of in of_all
        )
    tried_walks = sorted({*walks, walk}, key=lambda one: one.prior_sd)
    return Validation(
        forecasts=walk,
        prior_sd=walk.prior_sd,
        priors=tuple(
            (one.prior_sd, Predictions.of_walk(one, "game", "integrated").mean_loss)
            for one in tried_walks
        ),
        scored=scored,
        usual=usual,
        gain={
            of: bootstrap_ratio(
                best[of, "plug-in"].losses - best[of, "integrated"].losses,
                best[of, "plug-in"].trials,
                cluster,
                rng,
            )
            for of in of_all
        },
        skill=bootstrap_ratio(np.log(2.0) * used.trials - used.losses, used.trials, cluster, rng),
        games=_calibrated(used, spread),
        matches=_calibrated(Predictions.of_walk(walk, "match", "integrated")),
        matches_plug_in=_calibrated(Predictions.of_walk(walk, "match", "plug-in")),
        toss_ups={of: Predictions.of_walk(walk, of, "integrated").toss_ups for of in of_all},
        dispersion=spread,
        streaks=streaks(walk),
        side=side_advantage(walk),
        breaker=break_advantage(walk),
        first_breaks=first_breaks(walk),
        spots=tuple(handicap_fairness(walk)),
        drawn="dates" if by_dates else "matches",
    )


def _calibrated(
    predictions: Predictions, spread: Dispersion | None = None
) -> tuple[CalibrationBin, ...]:
    # Games of a match share what the ratings do not know, so each is worth less than one.
    worth = 1.0 if spread is None else min(1.0, 1.0 / spread.seen)
    return tuple(
        calibration(predictions.p, predictions.won, predictions.trials, bins=BINS, worth=worth)
    )
