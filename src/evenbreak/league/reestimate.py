"""Long-run error of ratings that are refitted to all results, as Fargo's are.

A ladder moves a rating by the last match alone. A league may instead refit all ratings to all
results every week, with older results counting less. The error that remains is not a chain with few
states, so it is simulated: leagues of players of known skill play by their ratings, and the ratings
are refitted to all results every week.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from evenbreak.arrays import Floats, Ints, array_values
from evenbreak.checks import seed_of, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.ladders.comparison import SystemRow, near
from evenbreak.handicaps.ladders.unfairness import CLEAR_FAVORITE
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.fit import fit
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import Scale, scale_of
from evenbreak.stats.summary import Distribution

_FIRST_NIGHT = np.datetime64("2001-01-01")

_NEWCOMERS = (1, -1, 1, -1)
"""How many doublings of the odds each newcomer is better than the league's mean."""


@array_values
@dataclass(frozen=True, eq=False)
class Reestimated:
    """Uncertainty of refitted ratings, by simulation, with Monte Carlo standard errors.

    Parameters
    ----------
    row
        the row as in `compare_systems`. The error, the favorite's chance and the length of a match
        come from the second half of the weeks before newcomers arrive; settling comes from the
        newcomers. The sum of all ratings is fixed, so there is no inflation.
    sd_error
        standard error of `row.sd`, in points, from the differences between the leagues.
    settling_error
        standard error of `row.settling_mean`, in matches, from the same differences.
    unsettled
        share of newcomers who had not settled by the end. They count as if they settled then, so if
        it is not 0, settling takes longer than the row shows.
    sd_by_week
        shape (leagues, weeks): standard deviation of rating minus skill after each week.
    """

    row: SystemRow
    sd_error: float
    settling_error: float
    unsettled: float
    sd_by_week: Floats


class _Plan(NamedTuple):
    """The data that all simulated leagues share."""

    skill: Floats
    begun_with: int
    chart: Chart
    scale: Scale
    weeks: tuple[int, int]
    half_life: float | None


class _Course(NamedTuple):
    """The results of one league."""

    sd: list[float]
    settled: Ints
    chances: Floats
    games: Ints


def reestimate(
    skill: ArrayLike,
    chart: Chart | str,
    *,
    scale: Any = "fargo",
    weeks: int = 52,
    newcomer_weeks: int = 30,
    half_life: float | None = None,
    leagues: int = 4,
    seed: int | np.random.Generator = 0,
) -> Reestimated:
    """Return the uncertainty of ratings refitted to all results, with old ones fading.

    Players with the given skills, which do not change, are paired at random each week (if their
    number is odd, one sits out). The chart gives the race for the current ratings, rounded to whole
    points, and the skills decide every game. All players, including newcomers, start at the mean
    skill; half of the newcomers are a doubling of the odds better than that, and half are a
    doubling worse.

    Parameters
    ----------
    skill
        the skill of each player, in points; two players or more.
    chart
        the races by rating difference.
    scale
        the scale of the ratings, as in `fit`.
    weeks
        number of weeks before newcomers arrive, 2 or more.
    newcomer_weeks
        weeks for which the four newcomers are followed.
    half_life
        weeks after which a match counts half; None: age does not matter.
    leagues
        number of simulated leagues, 2 or more.
    seed
        a whole number, which always gives the same answer, or a generator.

    Raises
    ------
    InputError
        if a parameter is invalid.

    Notes
    -----
    The fit is that of `ratings.fit` (Bradley-Terry, maximum a posteriori), anchored at the mean
    skill, which results cannot show. A newcomer has settled on the first night with a rating
    within a sixth of a doubling of the skill, as in `compare_systems`.

    >>> import numpy as np
    >>> from evenbreak.handicaps import chart
    >>> found = reestimate(np.zeros(12), chart("fargo_r6_hot"), weeks=20, leagues=2, seed=1)
    >>> 10 < found.row.sd < 60, found.sd_by_week.shape
    (True, (2, 20))
    """
    by = scale_of(scale)
    skills = np.asarray(skill, dtype=float)
    if skills.ndim != 1 or len(skills) < 2 or not np.isfinite(skills).all():
        raise InputError("skill must be a list of two or more finite numbers, one per player")
    if half_life is not None and not half_life > 0.0:
        raise InputError(
            "{half_life} must be a number of weeks above 0, or None; you gave {value!r}",
            value=half_life,
        )
    plan = _Plan(
        skill=np.append(skills, skills.mean() + by.points_per_doubling * np.array(_NEWCOMERS)),
        begun_with=len(skills),
        chart=chart_of(chart),
        scale=by,
        weeks=(
            whole(weeks, "weeks", at_least=2),
            whole(newcomer_weeks, "newcomer_weeks", at_least=1),
        ),
        half_life=None if half_life is None else 7.0 * half_life,
    )
    seeds = np.random.SeedSequence(seed_of(seed)).spawn(whole(leagues, "leagues", at_least=2))
    return _summed_up(plan, [_league(plan, np.random.default_rng(child)) for child in seeds])


def _summed_up(plan: _Plan, courses: list[_Course]) -> Reestimated:
    first, later = plan.weeks
    sd = np.array([course.sd for course in courses])
    sds = sd[:, first // 2 :].mean(axis=1)
    means = np.array([course.settled.mean() for course in courses])
    matches = np.concatenate([course.settled for course in courses])
    favored = np.concatenate([np.maximum(course.chances, 1 - course.chances) for course in courses])
    row = SystemRow(
        system="refit" if plan.half_life is None else f"refit, half-life {plan.half_life / 7:g}",
        chart=plan.chart.name,
        sd=float(sds.mean()),
        sd_doublings=float(sds.mean()) / plan.scale.points_per_doubling,
        settling_mean=float(means.mean()),
        settling_p90=int(Distribution.of(matches.tolist()).quantile(0.9)),
        favorite=float(favored.mean()),
        clear_favorite=float((favored >= CLEAR_FAVORITE).mean()),
        games=float(np.concatenate([course.games for course in courses]).mean()),
        inflation=0.0,
    )
    root = math.sqrt(len(courses))
    return Reestimated(
        row,
        float(sds.std(ddof=1)) / root,
        float(means.std(ddof=1)) / root,
        float((matches == later).mean()),
        sd,
    )


def _league(plan: _Plan, rng: np.random.Generator) -> _Course:
    """Play one league: first weeks with the given players, then weeks with newcomers as well."""
    skill, (first, later) = plan.skill, plan.weeks
    center = float(skill.mean())
    rating = np.full(len(skill), center)
    names = tuple(map(str, range(len(skill))))
    nights: list[Ints] = []
    dates: list[NDArray[np.datetime64]] = []
    sd: list[float] = []
    chances: list[Floats] = []
    settled = np.full(len(skill) - plan.begun_with, later)
    for week in range(first + later):
        there = plan.begun_with if week < first else len(skill)
        night, wins = _night(plan, rating[:there], rng)
        nights.append(night)
        dates.append(np.full(night.shape[1], _FIRST_NIGHT + np.timedelta64(7 * week, "D")))
        columns = np.concatenate(nights, axis=1)
        rating[:there] = fit(
            Results(names[:there], *columns, date=np.concatenate(dates)),
            scale=plan.scale,
            anchor=center,
            half_life=plan.half_life,
            as_of=_FIRST_NIGHT + np.timedelta64(7 * week, "D"),
        ).rating
        error = rating - skill
        if week < first:
            sd.append(float(error[:there].std()))
            chances.append(wins)
        else:
            is_near = near(error[plan.begun_with :], plan.scale) > 0.0
            settled[is_near] = np.minimum(settled[is_near], week - first + 1)
    half = slice(first // 2, first)
    games = np.concatenate(nights[half], axis=1)[2:].sum(axis=0)
    return _Course(sd, settled, np.concatenate(chances[half]), games)


def _night(plan: _Plan, rating: Floats, rng: np.random.Generator) -> tuple[Ints, Floats]:
    """Return rows of a, b and their games, shape (4, matches), and P(a wins)."""
    order = rng.permutation(len(rating))
    half = len(rating) // 2
    a, b = order[:half], order[half : 2 * half]
    points = np.rint(rating)
    m, n = plan.chart.races(points[a] - points[b])
    p = plan.scale.win_probability(plan.skill[a] - plan.skill[b])
    won = rng.random((int((m + n).max()) - 1, half)) < p
    games_a, games_b = won.cumsum(axis=0), (~won).cumsum(axis=0)
    last = ((games_a == m) | (games_b == n)).argmax(axis=0)
    at = (last, np.arange(half))
    night = np.stack([a, b, games_a[at], games_b[at]])
    return night, np.asarray(race_win_probability(p, m, n))
