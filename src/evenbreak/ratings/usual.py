"""Rate a league in the usual way, with the prior that fits it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal

from evenbreak.ratings.beginning import Beginning
from evenbreak.ratings.day_form import with_form
from evenbreak.ratings.decay import day_of, until
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.fit import PRIOR_SD, fit
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.levels import begun
from evenbreak.ratings.prior import PriorChoice, Progress, best_prior
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import Scale
from evenbreak.ratings.stretches import can_be_predicted


def usual_ratings(
    results: Results,
    *,
    scale: Scale,
    prior: float | Literal["best"] | None = None,
    half_life: float | Literal["best"] | None = "best",
    as_of: str | None = None,
    beginning: Beginning | None = None,
    anchor: float | Mapping[str, float] | None = None,
    break_advantage: float | str | None = None,
    provisional: int | None = None,
    progress: Progress = lambda _done, _all: None,
) -> tuple[Ratings, PriorChoice | None]:
    """Return ratings with day-to-day form, and how their prior was chosen, if it was.

    Parameters
    ----------
    scale, as_of, anchor, break_advantage, provisional
        as for `fit`.
    prior
        the standard deviation of skills before any result, in log-odds; 'best': the one that
        predicts best; None: the same if the dates are enough to find it, else the usual one.
    half_life
        in days, or 'best', or None for no decay; 'best' needs a prior that is chosen.
    beginning
        ratings that players bring with them.
    progress
        called with the amount of the search done so far and the total.

    >>> from evenbreak.ratings.scale import scale_of
    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> ratings, choice = usual_ratings(season, scale=scale_of("fargo"))
    >>> ratings.players, choice
    (('Ann', 'Bo', 'Cy'), None)
    """
    check_results(results)
    choice = None
    if not isinstance(prior, float):
        choice = _choice(
            results,
            scale,
            half_life,
            as_of,
            break_advantage,
            beginning,
            progress,
            asked=prior == "best",
        )
    days = half_life if isinstance(half_life, float) else None
    ratings = fit(
        results,
        scale=scale,
        anchor=anchor,
        as_of=as_of,
        break_advantage=break_advantage,
        provisional=provisional,
        prior_sd=choice.prior_sd if choice else prior if isinstance(prior, float) else PRIOR_SD,
        half_life=choice.half_life if choice else days,
        levels=choice.levels if choice else begun(beginning),
    )
    return with_form(results, ratings), choice


def rated_alike(ratings: Ratings, results: Results) -> Callable[[Results], Ratings]:
    """Return a function that rates other results of the same players in the same way.

    Parameters
    ----------
    ratings, results
        the ratings, and the matches that they were fitted to.

    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> again = rated_alike(fit(season, prior_sd=0.4), season)
    >>> again(season.select([0])).prior_sd
    0.4
    """
    check_results(results)
    day = ratings.as_of
    if day is None and ratings.half_life is not None and results.date is not None:
        # The day from which ages were counted: a match left out must not make the others younger.
        day = results.date[results.counted].max()

    def again(matches: Results) -> Ratings:
        return fit(
            matches.select(matches.counted),  # forfeits may lack a date
            prior_sd=ratings.prior_sd,
            scale=ratings.scale,
            half_life=ratings.half_life,
            levels=ratings.levels,
            as_of=day,
            form=ratings.match_form,
        )

    return again


def _choice(
    results: Results,
    scale: Scale,
    half_life: float | Literal["best"] | None,
    as_of: str | None,
    break_advantage: float | str | None,
    beginning: Beginning | None,
    progress: Progress,
    *,
    asked: bool,
) -> PriorChoice | None:
    """Return the prior that predicts best; None if the dates don't show it and no one asked."""
    if as_of is not None:
        results = results.select(until(results, day_of(as_of)))
    if not asked and not can_be_predicted(results):
        return None
    choice = best_prior(
        results,
        half_life=half_life,
        beginning=beginning,
        break_advantage=break_advantage,
        scale=scale,
        progress=progress,
    )
    return choice if asked or choice.learned else None
