"""How far ratings can be trusted: a season predicted date by date and compared with its results."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from evenbreak.checks import seed_of
from evenbreak.ratings.beginning import Beginning
from evenbreak.ratings.day_form import with_form
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.estimates import Estimate, bootstrap_ratio, wilson
from evenbreak.ratings.fit import PRIOR_SD, fit
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.half_lives import HalfLifeGain, half_life_gains
from evenbreak.ratings.levels import Levels, begun, known_levels
from evenbreak.ratings.prior import PriorChoice, best_prior
from evenbreak.ratings.results import Results
from evenbreak.ratings.validation.advantages import (
    ByExperience,
    FirstBreaks,
    FirstColumn,
    break_advantage,
    by_experience,
    first_breaks,
    first_column,
    side_advantage,
)
from evenbreak.ratings.validation.calibration import (
    TOSS_UP,
    CalibrationBin,
    How,
    Of,
    Predictions,
    Scored,
    calibration,
)
from evenbreak.ratings.validation.starts import Starts, starts
from evenbreak.ratings.validation.walk_forward import Forecasts, Progress, in_order, walk_forward
from evenbreak.ratings.validation.within_matches import (
    Dispersion,
    MatchForm,
    Streaks,
    dispersion,
    match_form,
    streaks,
)
from evenbreak.workers import Share, crew

if TYPE_CHECKING:
    from concurrent.futures import Executor

    import distributed


class HandicapFairness(NamedTuple):
    """How often the player with the longer race won, over handicap races with the same spot.

    `spot` is their race minus the opponent's; None: all spots together. `share` has Wilson's 95%
    interval, and should be 1/2 with a fair chart; `expected` is their mean chance by the ratings
    before each date.
    """

    spot: int | None
    matches: int
    won: int
    share: float
    low: float
    high: float
    expected: float


def handicap_fairness(forecasts: Forecasts) -> list[HandicapFairness]:
    """Return how fair each spot was, in ascending order, with all of them together at the end.

    Only stated races count; the list is empty if none was a handicap race.
    """
    gives = forecasts.race_a - forecasts.race_b
    rows = gives != 0
    if not rows.any():
        return []
    a_gives = gives[rows] > 0
    won, p = forecasts.won[rows], forecasts.p_match_integrated[rows]
    won, p = np.where(a_gives, won, 1.0 - won), np.where(a_gives, p, 1.0 - p)
    spot = np.abs(gives[rows])
    by_start = []
    for games in (*np.unique(spot).tolist(), None):
        chosen = np.ones(len(spot), dtype=bool) if games is None else spot == games
        matches, wins = int(chosen.sum()), int(won[chosen].sum())
        share = wins / matches
        expected = float(p[chosen].mean())
        by_start.append(
            HandicapFairness(games, matches, wins, share, *wilson(share, matches), expected)
        )
    return by_start


class RaceLengths(NamedTuple):
    """Even races of similar length: how often the favorite won, with Wilson's 95% interval.

    `predicted` is the favorites' mean chance, with the ratings' uncertainty integrated out.
    """

    shortest: int
    longest: int
    matches: int
    won: int
    share: float
    low: float
    high: float
    predicted: float


FEW_STARTS = 0.25
"""Largest share of uneven races with which even ones are judged: more leave only equals."""


def mostly_even(forecasts: Forecasts) -> bool:
    """Return whether few races have a head start, so that the others have favorites."""
    raced = forecasts.race_a > 0
    uneven = forecasts.race_a != forecasts.race_b
    return bool(uneven.sum() <= FEW_STARTS * raced.sum())


def race_lengths(forecasts: Forecasts) -> list[RaceLengths]:
    """Return how often favorites won the shorter and the longer half of the even races.

    The halves are as nearly equal as whole lengths allow. The list is empty if all races are
    equally long, or if more than a quarter have a head start.
    """
    even, p = (
        (forecasts.race_a > 0) & (forecasts.race_a == forecasts.race_b),
        forecasts.p_match_integrated,
    )
    rows = even & (np.abs(np.where(even, p, 0.5) - 0.5) > TOSS_UP)
    needed = forecasts.race_a[rows]
    if not mostly_even(forecasts) or len(np.unique(needed)) < 2:
        return []
    a_leads = p[rows] > 0.5
    chance = np.where(a_leads, p[rows], 1.0 - p[rows])
    won = np.where(a_leads, forecasts.won[rows], 1.0 - forecasts.won[rows])
    lengths, counts = np.unique(needed, return_counts=True)
    up_to = np.cumsum(counts)[:-1]
    last_short = lengths[np.abs(2 * up_to - len(needed)).argmin()]
    halves = []
    for half in (needed <= last_short, needed > last_short):
        matches, wins = int(half.sum()), int(won[half].sum())
        share = wins / matches
        ends = int(needed[half].min()), int(needed[half].max())
        predicted = float(chance[half].mean())
        halves.append(RaceLengths(*ends, matches, wins, share, *wilson(share, matches), predicted))
    return halves


FEWEST_DATES = 10
"""Dates needed for the bootstrap to resample whole dates; with fewer, it resamples matches."""

BINS = 10


@dataclass(frozen=True, eq=False)
class Validation:
    """What a season shows about the ratings that were used to predict it.

    Attributes
    ----------
    forecasts
        the predictions with the prior `prior_sd`.
    ratings
        the ratings that `fit` returns for all these matches with the same settings.
    prior_sd
        the prior that was given, or else the one that `best_prior` chooses.
    choice
        how it was chosen; None if it was given.
    scored
        games and matches, plug-in and integrated; no matches if there are no races.
    usual
        the integrated predictions with the default prior, `PRIOR_SD`; empty if a prior was given.
    gain
        log-loss of plug-in minus that of integrated, by what is predicted: above 0, integrating out
        the uncertainty helps.
    half_lives
        the gain from letting old games count less; empty unless `half_life` is 'best' and the
        season is long enough to tell.
    skill
        ln 2 minus the log-loss per game, integrated: above 0, the ratings beat a coin.
    games, matches
        calibration of the favorites' chances, integrated, with the prior to use.
    matches_plug_in
        the same for matches, with the ratings at face value.
    toss_ups
        how many matches have no favorite and so are in no bin, by what is predicted.
    form
        how much chances vary from match to match; None with fewer than 100 races.
    dispersion, streaks, breaker, first_breaks
        whether play inside matches agrees with the model; None if the file does not say.
    side, first_column
        how much stronger players in the first column are than their ratings, in log-odds, and how
        many matches they won; None if no one did, or if nothing shows it.
    lengths
        how often favorites won short races and long ones, if there are both and few starts.
    spots
        how often the player with the longer race won.
    starts
        how much of the difference between players the games given make up for; None if there are
        too few.
    experience
        how the less experienced player in a match did, by the number of games played before.
    drawn
        what the bootstrap resamples: 'dates' or 'matches'.
    """

    forecasts: Forecasts
    ratings: Ratings
    prior_sd: float
    choice: PriorChoice | None
    scored: tuple[Scored, ...]
    usual: tuple[Scored, ...]
    gain: dict[str, Estimate]
    half_lives: tuple[HalfLifeGain, ...]
    skill: Estimate
    games: tuple[CalibrationBin, ...]
    matches: tuple[CalibrationBin, ...]
    matches_plug_in: tuple[CalibrationBin, ...]
    toss_ups: dict[str, int]
    form: MatchForm | None
    dispersion: Dispersion | None
    streaks: Streaks | None
    side: Estimate | None
    first_column: FirstColumn | None
    breaker: Estimate | None
    first_breaks: FirstBreaks | None
    spots: tuple[HandicapFairness, ...]
    starts: Starts | None
    lengths: tuple[RaceLengths, ...]
    experience: tuple[ByExperience, ...]
    drawn: Literal["dates", "matches"]

    def __repr__(self) -> str:
        return f"<Validation of {len(self.forecasts):,} matches by ratings from earlier dates>"


def validate(
    results: Results,
    *,
    prior_sd: float | None = None,
    half_life: float | Literal["best"] | None = "best",
    beginning: Beginning | None = None,
    seed: int | np.random.Generator = 1,
    executor: Executor | distributed.Client | None = None,
    jobs: int = 1,
    progress: Progress = lambda *_: None,
) -> Validation:
    """Predict a season date by date, and return how good the predictions were.

    Parameters
    ----------
    prior_sd
        standard deviation of the prior in natural log-odds, the same for everyone; None: the
        prior that `best_prior` chooses from all matches with a date, with levels if they help.
    half_life
        days after which a game counts half; None: games never age. 'best': chosen with the prior;
        if the prior is given, games never age, and the result says whether that is right.
    beginning
        ratings that players bring with them; None: there are none.
    seed
        for the bootstrap and the simulated seasons: a whole number, or a generator.
    executor, jobs
        what runs the work: any executor of `concurrent.futures` or a `distributed.Client`; None: as
        many processes as `jobs` says. The answer is the same.
    progress
        called with the number of dates predicted so far, the total over all rating methods, and the
        fraction of the work done.

    Raises
    ------
    InputError
        as `walk_forward` does.
    WorkerError
        if a worker process ends before its work is done.

    Notes
    -----
    A prior chosen on the same season that it is judged by looks slightly better than it is;
    `PriorChoice.as_it_went` is free of that.

    >>> season = Results.from_names(["Ann", "Ann", "Bo"], ["Bo", "Bo", "Ann"], [7, 7, 3], [2, 4, 7],
    ...     date=["2024-09-03", "2024-09-10", "2024-09-17"])
    >>> found = validate(season, prior_sd=0.5)
    >>> [(row.of, row.how, round(row.log_loss.value, 3)) for row in found.scored[:2]]
    [('game', 'plug-in', 0.654), ('game', 'integrated', 0.655)]
    """
    check_results(results)
    seed = seed_of(seed)
    with crew(executor=executor, jobs=jobs) as share:
        choice, half_lives, ratings, usual_walk, walk = _walked(
            results, prior_sd, half_life, beginning, progress, share
        )
    rng = np.random.default_rng(seed)
    raced = bool(walk.race_a.any())
    of_all: tuple[Of, ...] = ("game", "match") if raced else ("game",)
    hows: tuple[How, ...] = ("plug-in", "integrated")
    made = {(of, how): Predictions.of_walk(walk, of, how) for of in of_all for how in hows}
    used = made["game", "integrated"]
    by_dates = int(walk.date_of[-1]) + 1 >= FEWEST_DATES
    cluster = walk.date_of if by_dates else np.arange(len(walk))
    spread = dispersion(walk, rng)
    usual: tuple[Scored, ...] = ()
    if usual_walk is not None:
        own_rng = np.random.default_rng(seed)
        usual = tuple(
            Predictions.of_walk(usual_walk, of, "integrated").scored(cluster, own_rng)
            for of in of_all
        )
    return Validation(
        forecasts=walk,
        ratings=ratings,
        prior_sd=walk.prior_sd,
        choice=choice,
        scored=tuple(predicted.scored(cluster, rng) for predicted in made.values()),
        usual=usual,
        gain={
            of: bootstrap_ratio(
                made[of, "plug-in"].losses - made[of, "integrated"].losses,
                made[of, "plug-in"].trials,
                cluster,
                rng,
            )
            for of in of_all
        },
        half_lives=half_lives,
        skill=bootstrap_ratio(np.log(2.0) * used.trials - used.losses, used.trials, cluster, rng),
        games=_calibrated(used, spread),
        matches=_calibrated(Predictions.of_walk(walk, "match", "integrated")),
        matches_plug_in=_calibrated(Predictions.of_walk(walk, "match", "plug-in")),
        toss_ups={of: made[of, "integrated"].toss_ups for of in of_all},
        form=match_form(walk, ratings.form, cluster, np.random.default_rng(seed)),
        dispersion=spread,
        streaks=streaks(walk),
        side=side_advantage(walk),
        first_column=first_column(walk),
        breaker=break_advantage(walk),
        first_breaks=first_breaks(walk),
        spots=tuple(handicap_fairness(walk)),
        starts=starts(walk.results),
        lengths=tuple(race_lengths(walk)),
        experience=tuple(by_experience(walk)),
        drawn="dates" if by_dates else "matches",
    )


def _tested(choice: PriorChoice) -> tuple[HalfLifeGain, ...]:
    """Return the gain from each half-life, as found when the prior was chosen."""
    return tuple(
        HalfLifeGain(days, gain)
        for evidence in choice.evidence
        if evidence.of == "half_life"
        for days, gain in zip(evidence.tried, evidence.gains, strict=True)
    )


def _walked(
    results: Results,
    prior_sd: float | None,
    half_life: float | Literal["best"] | None,
    beginning: Beginning | None,
    progress: Progress,
    share: Share | None,
) -> tuple[PriorChoice | None, tuple[HalfLifeGain, ...], Ratings, Forecasts | None, Forecasts]:
    """Return how the prior was chosen, the ratings with it, and walks with the usual prior and it.

    There is no walk with the usual prior if another was given.
    """
    season, _ = in_order(results)
    dated = results.select(~np.isnat(np.asarray(results.date)))
    never = None if half_life == "best" else half_life
    sizes = len(known_levels(dated, beginning)) + (half_life == "best")
    searches = SEARCH * (2 * sizes + 2 if prior_sd is None else half_life == "best")
    dates = len(np.unique(np.asarray(season.date)))
    done = _Done(progress, dates, (float(prior_sd is None), searches, 1.0))
    choice = None
    half_lives: tuple[HalfLifeGain, ...] = ()
    usual_walk: Forecasts | None = None
    usual_way: dict[str, Any] = {"prior_sd": PRIOR_SD, "half_life": never, "levels": Levels()}
    way = {**usual_way, "prior_sd": prior_sd, "levels": begun(beginning)}
    if prior_sd is None:
        usual_walk = walk_forward(results, **usual_way, progress=done.part(0), share=share)
        searched = done.part(1)
        choice = best_prior(
            dated, half_life=half_life, beginning=beginning, progress=searched, share=share
        )
        half_lives = _tested(choice)
        way = {name: getattr(choice, name) for name in way}
    if half_life == "best" and not half_lives:
        half_lives = half_life_gains(dated, way["prior_sd"], progress=done.part(1), share=share)
    ratings = with_form(season, fit(season, **way))
    walk = usual_walk
    if walk is None or ratings.match_form or way != usual_way:
        form, shown = ratings.match_form, done.part(2)
        walk = walk_forward(results, **way, form=form, progress=shown, share=share)
    done.end()
    return choice, half_lives, ratings, usual_walk, walk


SEARCH = 0.25
"""Cost of one step in the search for a prior, in walks through the season."""


class _Done:
    """Progress of a validation, from that of its parts, each of which goes through all dates.

    `work` is the time that each part takes, in walks through the season; 0 for parts that don't
    occur.
    """

    def __init__(self, progress: Progress, dates: int, work: tuple[float, ...]) -> None:
        self._progress, self._dates, self._work = progress, dates, work
        self._all = dates * sum(one > 0.0 for one in work)

    def part(self, number: int) -> Progress:
        """Return the progress callback of one part."""

        def show(done: int, total: int, share: float | None = None) -> None:
            part = done / total if share is None else share
            before = sum(work > 0.0 for work in self._work[:number])
            work = sum(self._work[:number]) + part * self._work[number]
            dates = before * self._dates + round(self._dates * done / total)
            self._progress(dates, self._all, min(work / sum(self._work), 1.0))

        return show

    def end(self) -> None:
        """Report that everything is done, including parts that weren't needed."""
        self._progress(self._all, self._all, 1.0)


def _calibrated(
    predictions: Predictions, spread: Dispersion | None = None
) -> tuple[CalibrationBin, ...]:
    # Games of a match share what the ratings do not know, so each is worth less than one.
    worth = 1.0 if spread is None else min(1.0, 1.0 / spread.seen)
    return tuple(
        calibration(
            predictions.p,
            predictions.won,
            predictions.trials,
            bins=BINS,
            worth=worth,
            weight=predictions.weight,
        )
    )
