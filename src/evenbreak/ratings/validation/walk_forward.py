"""Walk forward through a season: each date is predicted before its results are used.

Only matches that the ratings have not seen show how good they are. So the ratings from all earlier
dates predict every match of a date, and only then are refitted with its results.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit

from evenbreak.arrays import Bools, Floats, Ints, own_arrays
from evenbreak.checks import number
from evenbreak.errors import InputError
from evenbreak.matches.form import center_of_form, form_of
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.doors import check_results
from evenbreak.ratings.fit import PRIOR_SD, checked_prior
from evenbreak.ratings.form_weights import games_weight
from evenbreak.ratings.integrated import normal_nodes
from evenbreak.ratings.levels import Knowledge, Levels
from evenbreak.ratings.results import Results
from evenbreak.ratings.validation.daily_refit import DailyRefit
from evenbreak.workers import Share


@own_arrays
@dataclass(frozen=True, eq=False)
class Forecasts:
    """The chances that the ratings gave for each match before its date, and its result.

    There is one entry per match, in date order; all chances are those of player a, given the
    results of earlier dates, the model and the prior.

    Attributes
    ----------
    results
        the matches that were predicted: played, with a date.
    date_of
        the number of each match's date, counted from 0.
    difference, sd
        skill a - skill b in natural log-odds: the posterior mode before the date, and
        its standard deviation (Laplace).
    known_a, known_b
        games that each player had played before that date.
    p_game, p_game_integrated
        P(a wins a game): from the mode alone (plug-in), and averaged over the posterior of
        the difference (integrated; Gauss-Hermite).
    race_a, race_b
        the race: as stated, or else an even race to the winner's games (see
        `even_races`); 0 where there is none.
    p_match, p_match_integrated
        P(a wins the match), likewise; NaN where there is no race. They are also averaged over
        day-to-day form, which the games of a match share; it leaves the chance of a single game
        unchanged.
    won
        1 where a won the race, 0 where b did, NaN where there is none.
    prior_sd, half_life, levels, form
        what the ratings were fitted with.
    undated, forfeits, empty, unscored
        rows left out because they have no date, are forfeits, stand at 0-0, or state only
        the winner.
    """

    results: Results
    date_of: Ints
    difference: Floats
    sd: Floats
    known_a: Floats
    known_b: Floats
    p_game: Floats
    p_game_integrated: Floats
    race_a: Ints
    race_b: Ints
    p_match: Floats
    p_match_integrated: Floats
    won: Floats
    prior_sd: float
    half_life: float | None
    levels: Levels
    form: float
    undated: int
    forfeits: int
    empty: int
    unscored: int

    def __len__(self) -> int:
        return len(self.results)

    def __repr__(self) -> str:
        return f"<Forecasts of {len(self):,} matches between {len(self.results.players):,} players>"

    @property
    def games(self) -> Ints:
        """The games of each match."""
        return self.results.score_a + self.results.score_b

    @property
    def new(self) -> Bools:
        """Whether at least one of the two players had not played before."""
        return np.asarray((self.known_a == 0) | (self.known_b == 0))


def walk_forward(
    results: Results,
    *,
    prior_sd: float = PRIOR_SD,
    half_life: float | None = None,
    levels: Levels | None = None,
    form: float = 0.0,
    progress: Progress = lambda *_: None,
    share: Share | None = None,
) -> Forecasts:
    """Predict every dated match in `results` from the matches on earlier dates alone.

    Parameters
    ----------
    results
        the matches. All matches of a date are predicted before any of them is used.
    prior_sd
        standard deviation of the prior in natural log-odds.
    half_life
        in days; None: games never age.
    levels
        how far newcomers are behind, how much teams and divisions differ, and the ratings that
        players bring with them.
    form
        day-to-day form: the standard deviation of a game's log-odds.
    progress
        called with the number of dates done, the number of all dates, and the fraction of the work
        done.
    share
        passes spans of dates to other processes (see `evenbreak.workers`), for the same answer;
        None: only this process works.

    Raises
    ------
    InputError
        if there are not two dates with games, or prior_sd or half_life is out of range.
    AccuracyError
        if a mode is not found to within rounding.

    Notes
    -----
    The prequential principle: Dawid (1984), "Statistical theory: the prequential
    approach". The fit of each date is that of `fit`.

    >>> season = Results.from_names(["Ann", "Ann"], ["Bo", "Bo"], [7, 7], [2, 4],
    ...     date=["2024-09-03", "2024-09-10"])
    >>> forecasts = walk_forward(season)
    >>> forecasts.p_game.round(3), forecasts.p_game_integrated.round(3)
    (array([0.5  , 0.687]), array([0.5  , 0.675]))
    """
    check_results(results)
    precision = checked_prior(prior_sd) ** -2
    form = form_of(form)
    if half_life is not None:
        wanted = "a number from 0.01 to 1,000,000, in days"
        half_life = number(half_life, "half_life", low=0.01, high=1e6, wanted=wanted)
    season, left_out = in_order(results)
    days, date_of = np.unique(np.asarray(season.date), return_inverse=True)
    levels = levels or Levels()
    walk = _Walk(season, days, date_of, precision, half_life, levels, form)
    spans = walk.spans()
    parts = [_walked(walk, span, progress) for span in spans] if share is None else []
    if share is not None:
        for span, part in zip(spans, share(_walked, walk, spans), strict=True):
            parts.append(part)
            progress(span[1], len(days), walk.done[span[1]])
    difference, variance = (np.concatenate(part) for part in zip(*parts, strict=True))
    return _forecasts(
        season,
        date_of,
        difference,
        np.sqrt(variance),
        prior_sd=float(prior_sd),
        half_life=half_life,
        levels=levels,
        form=form,
        **left_out,
    )


Progress: TypeAlias = Callable[..., None]
"""Called with the dates done, the total number of dates, and the fraction of the work done."""

SPANS, LEAST_DATES = 12, 25
"""The most spans that a season is cut into, and the fewest dates in each."""

OF_MODE = 25
"""Finding a date's mode takes about as long as the variances of this many matches."""


class _Walk(NamedTuple):
    """Season in date order, to be walked through from any date on."""

    season: Results
    days: NDArray[np.datetime64]
    date_of: Ints
    precision: float
    half_life: float | None
    levels: Levels
    form: float = 0.0

    @property
    def starts(self) -> Ints:
        """The first match of each date, and the number of matches."""
        return np.searchsorted(self.date_of, np.arange(len(self.days) + 1))

    @property
    def done(self) -> Floats:
        """Fraction of the work done before each date, and at the end; later dates take longer.

        The time for a date grows with the pairs that have met, and with its matches.
        """
        a, b = self.season.player_a, self.season.player_b
        pairs = np.minimum(a, b) * len(self.season.players) + np.maximum(a, b)
        first = np.unique(pairs, return_index=True)[1]
        met = np.searchsorted(np.sort(first), self.starts[:-1])
        work = (1_000.0 + met) * (OF_MODE + np.diff(self.starts))
        return np.append(0.0, np.cumsum(work) / work.sum())

    def spans(self) -> list[tuple[int, int]]:
        """Return the spans of dates, with about equal work, that are walked separately.

        Each starts with a fit of everything before it, so it makes no difference which process
        walks it.
        """
        many = max(min(SPANS, len(self.days) // LEAST_DATES), 1)
        cuts = np.searchsorted(self.done[1:-1], np.arange(1, many) / many)
        ends = np.unique([0, *(cuts + 1).tolist(), len(self.days)])
        return list(pairwise(ends.tolist()))


def _walked(
    walk: _Walk, span: tuple[int, int], progress: Progress = lambda *_: None
) -> tuple[Floats, Floats]:
    """Return the differences and variances before each match in a span of dates."""
    season, days, half_life, levels = walk.season, walk.days, walk.half_life, walk.levels
    a, b, starts = season.player_a, season.player_b, walk.starts
    first, last = span
    knowledge = Knowledge(season, levels)
    league = DailyRefit(len(season.players), a, b, walk.precision, knowledge.means())
    if levels.beginning is not None:
        league.fade(levels.beginning.kept(half_life, season, days[0]))
    if first:
        before = slice(0, starts[first])
        kept = np.ones(len(days))
        if half_life is not None:
            kept = np.exp2((days - days[first - 1]).astype(float) / half_life)
            league.fade(float(kept[0]))
        weight = kept[walk.date_of[before]]
        in_full = weight * season.score_a[before], weight * season.score_b[before]
        league.learn(before, *in_full)
        knowledge.see(before)
        knowledge.play(before)
        if walk.form:
            # As in a fit, matches have the weights that ratings without form give them.
            league.begin_day(knowledge.means() if levels else None)
            apart = league.skill[a[before]] - league.skill[b[before]]
            games = season.score_a[before] + season.score_b[before]
            less = games_weight(apart, games, walk.form) - 1.0
            league.learn(before, less * in_full[0], less * in_full[1])
    done = walk.done
    difference, variance = [], []
    for day in range(first, last):
        rows = slice(starts[day], starts[day + 1])
        if half_life is not None and day:
            passed = (days[day] - days[day - 1]).astype(int)
            league.fade(0.5 ** (float(passed) / half_life))
        knowledge.see(rows)
        league.begin_day(knowledge.means() if levels else None)
        difference.append(league.skill[a[rows]] - league.skill[b[rows]])
        variance.append(league.difference_variance(a[rows], b[rows]))
        won, lost = season.score_a[rows], season.score_b[rows]
        worth = games_weight(difference[-1], won + lost, walk.form)
        league.learn(rows, worth * won, worth * lost)
        knowledge.play(rows)
        progress(day + 1, len(days), done[day + 1])
    return np.concatenate(difference), np.concatenate(variance)


def even_races(results: Results) -> tuple[Ints, Ints, Floats]:
    """Return the race of each match and whether a won it: race_a, race_b, won.

    A match without a stated race is treated as an even race to the winner's games, unless some such
    match ended in a draw: then none of them was a race. If there is no race, its games are 0 and
    `won` is NaN.

    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Ann"], [7, 4], [5, 6])
    >>> even_races(season)
    (array([7, 6]), array([7, 6]), array([1., 0.]))
    """
    score_a, score_b = results.score_a, results.score_b
    race_a, race_b = results.races
    stated = (race_a > 0) & (race_b > 0)
    drawn = bool((~stated & (score_a == score_b)).any())
    most = np.zeros_like(score_a) if drawn else np.maximum(score_a, score_b)
    race_a, race_b = np.where(stated, race_a, most), np.where(stated, race_b, most)
    won_a, won_b = score_a >= race_a, score_b >= race_b
    raced = (race_a > 0) & (won_a ^ won_b)
    won = np.where(raced, won_a.astype(float), np.nan)
    return np.where(raced, race_a, 0), np.where(raced, race_b, 0), won


def in_order(results: Results) -> tuple[Results, dict[str, int]]:
    """Return the played matches that have a date, by date, and how many rows were left out.

    Raises InputError if there are not two dates with games.
    """
    played, forfeits, empty = results.played()
    dates = played.date
    if dates is None:
        raise InputError("the results have no dates. Add a date column.")
    dated = ~np.isnat(dates)
    days = len(np.unique(dates[dated]))
    if days < 2:
        raise InputError(
            "the results have games on {n_days} date{what}. Give at least two in the date "
            "column, so that earlier dates can predict later ones.",
            n_days=days,
            what="s" * (days != 1),
        )
    season = played.select(dated)
    season = season.select(np.argsort(dates[dated], kind="stable"))
    return season, {
        "undated": int((~dated).sum()),
        "forfeits": forfeits,
        "empty": empty,
        "unscored": len(results) - len(played) - forfeits - empty,
    }


def _forecasts(
    season: Results, date_of: Ints, difference: Floats, sd: Floats, *, form: float, **rest: Any
) -> Forecasts:
    race_a, race_b, won = even_races(season)
    raced = race_a > 0
    p_game = expit(difference)
    # Where there is no race any will do: the result is not used.
    needs = np.maximum(race_a, 1), np.maximum(race_b, 1)
    p_match = np.where(raced, race_win_probability(p_game, *needs), np.nan)
    p_game_integrated, p_match_integrated = np.zeros(len(season)), np.zeros(len(season))
    center, spread = center_of_form(difference, sd, form), np.hypot(sd, form)
    for point, weight in zip(*normal_nodes(), strict=True):
        p = expit(center + spread * point)
        p_game_integrated += weight * p
        p_match_integrated += weight * race_win_probability(p, *needs)
    known_a, known_b = _known_before(season, date_of)
    return Forecasts(
        results=season,
        date_of=date_of,
        difference=difference,
        sd=sd,
        known_a=known_a,
        known_b=known_b,
        p_game=p_game,
        p_game_integrated=p_game_integrated,
        race_a=race_a,
        race_b=race_b,
        p_match=p_match,
        # Rounding of the weights may take a sum above 1.
        p_match_integrated=np.where(raced, np.minimum(p_match_integrated, 1.0), np.nan),
        won=won,
        form=form,
        **rest,
    )


def _known_before(season: Results, date_of: Ints) -> tuple[Floats, Floats]:
    """Return the games that a and b of each match had played before its date."""
    so_far = np.zeros(len(season.players))
    before = np.zeros((2, len(season)))
    games = (season.score_a + season.score_b).astype(float)
    starts = np.searchsorted(date_of, np.arange(int(date_of[-1]) + 2))
    for start, end in pairwise(starts):
        rows = slice(start, end)
        for side, players in enumerate((season.player_a[rows], season.player_b[rows])):
            before[side, rows] = so_far[players]
        for players in (season.player_a[rows], season.player_b[rows]):
            so_far += np.bincount(players, games[rows], len(so_far))
    return before[0], before[1]
