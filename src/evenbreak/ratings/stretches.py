"""How well rating methods predict a season, stretch by stretch, from earlier days alone.

The season is divided into stretches of whole days. Each stretch but the first is predicted
from the ratings of all days before it, and from their uncertainty. Nothing is predicted from
itself. The criterion is the chance of each match's score, averaged over the difference between its
players (see `evenbreak.ratings.integrated`).

The skills by each rating method are those of `evenbreak.ratings.fit`. While `fit` goes through the
matches again for each method, here the likelihood is built once for each half-life, the knowledge
about players once for each set of levels, and the modes are found together or, if there are many
players, each from the previous one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Floats, Places
from evenbreak.errors import InputError
from evenbreak.ratings.beginning import PriorMeans
from evenbreak.ratings.drawn_differences import DrawnDifferences
from evenbreak.ratings.first_evenings import FirstEvenings
from evenbreak.ratings.fit import BREAK_SD, PRIOR_SD, checked_prior, known_advantage, weights_of
from evenbreak.ratings.integrated import Scores
from evenbreak.ratings.levels import (
    SIZES,
    Levels,
    StatedStrength,
    first_evenings,
    has_handicaps,
    means_of,
)
from evenbreak.ratings.likelihood_terms import LikelihoodTerms, likelihood_terms
from evenbreak.ratings.players_behind import PlayersBehind
from evenbreak.ratings.posterior import (
    GRADIENT,
    WayToRate,
    difference_variances,
    find_mixed_mode,
    find_modes,
)
from evenbreak.ratings.results import Results
from evenbreak.ratings.scale import DEFAULT_SCALE, scale_of
from evenbreak.workers import Share

STRETCHES = 30
"""Number of stretches in a season, if it has as many days."""

KEPT_UP_TO = 5_000
"""Matches up to which a divided season is kept: it uses about the memory of 100 of them."""


class StretchLosses(NamedTuple):
    """Losses in predicting each stretch.

    `losses`, shape (stretches, ways), is the sum of -ln P(score | earlier days) over matches, and
    `of_match` is the same by match; `predicted` counts games, and matches known only by their
    winner.
    """

    losses: Floats
    predicted: Floats
    of_match: Floats
    players: PlayersBehind

    @property
    def means(self) -> Floats:
        """Each method's loss per game (or per such match)."""
        return np.asarray(self.losses.sum(0) / self.predicted.sum())


def stretch_losses(
    results: Results,
    ways: Sequence[Mapping[str, Any]],
    *,
    progress: Callable[[int, int], None] = lambda _done, _all: None,
    share: Share | None = None,
) -> StretchLosses:
    """Predict each stretch of a season from the days before it, by several methods.

    Matches are on at least two days; forfeits and 0-0 may lack a date. Methods are options of
    `fit`, all with a break advantage or none. `share` gives stretches of a large season to other
    processes (see `evenbreak.workers`), for the same answer. Raises InputError if a date is
    missing, all matches are on one day, or an option is out of range.
    """
    return Stretches(results).losses(ways, progress=progress, share=share)


_OfStretch: TypeAlias = tuple[float, Floats, tuple[Places, Places]]


class Stretches:
    """Season to be predicted several times over, stretch by stretch."""

    def __init__(self, results: Results) -> None:
        self._played, self._date = _played(results)
        self._ends = _stretches(self._date)
        self._ready: dict[tuple[int, bool], tuple[SeasonSoFar, Scores]] = {}

    @property
    def is_small(self) -> bool:
        """Whether several methods take little longer than one."""
        return len(self._played.players) <= SOLVED_AT_ONCE

    def losses(
        self,
        ways: Sequence[Mapping[str, Any]],
        *,
        progress: Callable[[int, int], None] = lambda _done, _all: None,
        share: Share | None = None,
    ) -> StretchLosses:
        """Predict each stretch by several methods; the parameters are those of `stretch_losses`."""
        losses = np.zeros((len(self._ends), len(ways)))
        predicted = np.zeros(len(self._ends))
        of_match, players = [], []
        rows = range(len(self._ends))
        # What is kept of a small season begins where the last search ended, so it stays here.
        apart = share if len(self._played) > KEPT_UP_TO else None
        found = (
            map(partial(_one, (self, ways)), rows)
            if apart is None
            else apart(_one, (self, ways), rows)
        )
        for row, (many, lost, sides_of) in enumerate(found):
            predicted[row], losses[row] = many, lost.sum(0)
            of_match.append(lost)
            players.append(sides_of)
            progress(row + 1, len(self._ends))
        sides = (np.concatenate(side) for side in zip(*players, strict=True))
        return StretchLosses(losses, predicted, np.concatenate(of_match), PlayersBehind(*sides))

    def one(self, row: int, ways: Sequence[Mapping[str, Any]]) -> _OfStretch:
        """Return how much a stretch has to predict, the losses of each match, and its players.

        The losses have the shape (matches, ways).
        """
        breaks = any(way.get("break_advantage") is not None for way in ways)
        season, scores = self._prepared(row, breaks=breaks)
        sides = scores.player_a, scores.player_b
        return scores.predicted, -scores.log_chances(*season.differences(ways, *sides)).T, sides

    def _prepared(self, row: int, *, breaks: bool) -> tuple[SeasonSoFar, Scores]:
        """Return the season before a stretch, and the scores in the stretch."""
        if (row, breaks) in self._ready:
            return self._ready[row, breaks]
        first, last = self._ends[row]
        coming = self._played.select((self._date >= first) & (self._date <= last))
        before = _with_schedule(self._played.select(self._date < first), coming)
        scores = Scores.of(coming.played().results, coming.won_only(), breaks=breaks)
        made = SeasonSoFar(before), scores
        if len(self._played) <= KEPT_UP_TO:
            self._ready[row, breaks] = made
        return made


def _one(asked: tuple[Stretches, Sequence[Mapping[str, Any]]], row: int) -> _OfStretch:
    stretches, ways = asked
    return stretches.one(row, ways)


def can_be_predicted(results: Results) -> bool:
    """Return whether all matches that count have a date, on at least two days.

    >>> can_be_predicted(Results.from_names(["A"], ["B"], [7], [5], date=["2026-01-31"]))
    False
    """
    played = results.select(results.counted)
    return played.date is not None and len(np.unique(played.date)) > 1 and not _undated(played)


def _undated(played: Results) -> int:
    return len(played) if played.date is None else int(np.isnat(played.date).sum())


def _with_schedule(before: Results, coming: Results) -> Results:
    """Return played matches together with others as they are before play: at 0-0, without a winner.

    A league may set a race from the results of earlier days, so an upcoming match keeps its race
    only if neither of its players has played on an earlier upcoming day.
    """
    unplayed = coming.unplayed()
    if coming.date is not None and has_handicaps(coming):
        scheduled = _first_days(coming, coming.date)
        race_a, race_b = (np.where(scheduled, race, 0) for race in coming.races)
        unplayed = replace(unplayed, race_a=race_a, race_b=race_b)
    return before.joined(unplayed)


def _first_days(results: Results, date: NDArray[np.datetime64]) -> Bools:
    """Return which matches are on the first day of both players."""
    first = np.full(len(results.players), date.max())
    for players in (results.player_a, results.player_b):
        np.minimum.at(first, players, date)
    at_first = [date == first[k] for k in (results.player_a, results.player_b)]
    return np.asarray(at_first[0] & at_first[1])


def _played(results: Results) -> tuple[Results, NDArray[np.datetime64]]:
    """Return the matches that count and their dates, or raise an error for those without one."""
    played = results.select(results.counted)
    undated = _undated(played)
    if undated:
        raise InputError(
            "{undated:,} of {n_played:,} matches have no date, but a prior is chosen by "
            "how well it predicts later days. Add the dates, or give the prior's width.",
            undated=undated,
            n_played=len(played),
        )
    if len(played) == 0 or played.date is None or played.date.min() == played.date.max():
        raise InputError(
            "a prior is chosen by how well it predicts later days, so there must be matches on "
            "at least two days. Give the prior's width."
        )
    return played, played.date


def _stretches(date: NDArray[np.datetime64]) -> list[tuple[np.datetime64, np.datetime64]]:
    """Return the first and last day of each stretch but the first; all are about equally long."""
    days, matches = np.unique(date, return_counts=True)
    done = np.cumsum(matches) - matches
    number = done // max(math.ceil(len(date) / STRETCHES), 1)
    first = np.flatnonzero(np.diff(number, prepend=-1))
    last = np.append(first[1:], len(days)) - 1
    return [(days[a], days[b]) for a, b in zip(first[1:], last[1:], strict=True)]


DRAWS, ACCURACY = 16, 0.03
"""Number of draws, and accuracy, used to find variances if there are more players.

In a league of 1,000 players and 10,000 matches, the variances are then off by 2%, at the width that
suits it.
"""


class Differences(NamedTuple):
    """Differences between players (first minus second) by several rating methods, in log-odds.

    Shape (ways, differences); the break advantage has shape (ways,).
    """

    mean: Floats
    variance: Floats
    advantage: Floats


SOLVED_AT_ONCE = 80
"""Players up to which all methods are solved together, which is then faster than in turn."""


MOST_AHEAD = 2.0
"""How far beyond two solved methods the line through them may be extrapolated for a third."""


def _place(
    *,
    prior_sd: float = PRIOR_SD,
    half_life: float | None = None,
    levels: Levels | None = None,
    **_other: Any,
) -> Floats:
    """Return a method's coordinates, which put methods with similar modes near each other."""
    sizes = [getattr(levels or Levels(), name) for name in SIZES]
    return np.array([math.log(prior_sd), 200.0 / half_life if half_life else 0.0, *sizes])


class SeasonSoFar:
    """The matches before some day, rated by several methods; forfeits and 0-0 don't count."""

    def __init__(self, results: Results) -> None:
        self._results = results
        self._players = len(results.players)
        self._scored, _, _ = results.played()
        self._won_only = results.won_only()
        self._terms: dict[tuple[float | None, bool], LikelihoodTerms] = {}
        self._means: dict[Levels, PriorMeans | None] = {}
        self._stated = StatedStrength(results)
        self._evenings: FirstEvenings | None = None
        # Where ways are (see `_place`), and their modes.
        self._found: list[tuple[Floats, Floats]] = []

    def skills(self, ways: Sequence[Mapping[str, Any]]) -> tuple[Floats, Floats]:
        """Return the skills and the break advantages by each method, in natural log-odds.

        A method's options are those of `fit`: a prior, a half-life, a break advantage with its
        scale, and levels. All methods have a break advantage, or none.
        """
        return self._modes(ways, [self._asked(**way) for way in ways])

    def differences(
        self, ways: Sequence[Mapping[str, Any]], first: Places, second: Places
    ) -> Differences:
        """Return the differences between pairs of players by each method, as in `skills`."""
        asked = [self._asked(**way) for way in ways]
        skills, advantages = self._modes(ways, asked)
        if self._players <= SOLVED_AT_ONCE:
            variance = difference_variances(asked, skills, advantages, first, second)
        else:
            variance = self._drawn(asked, skills, advantages, first, second)
        return Differences(skills[:, first] - skills[:, second], variance, advantages)

    def _drawn(
        self,
        asked: Sequence[WayToRate],
        skills: Floats,
        advantages: Floats,
        first: Places,
        second: Places,
    ) -> Floats:
        """Return the approximate variance of each difference by each method."""
        terms = asked[0].terms
        pairs = self._players, terms.low, terms.high
        drawn = DrawnDifferences(*pairs, first, second, draws=DRAWS, accuracy=ACCURACY)
        curvatures = (
            way.terms.curvature(skill, float(advantage), way.precision, None, way.means)
            for way, skill, advantage in zip(asked, skills, advantages, strict=True)
        )
        return np.array([curvature.drawn(drawn) for curvature in curvatures])

    def _modes(
        self, ways: Sequence[Mapping[str, Any]], asked: Sequence[WayToRate]
    ) -> tuple[Floats, Floats]:
        places = [_place(**way) for way in ways]
        if self._players <= SOLVED_AT_ONCE:
            starts = [self._start(place) for place in places] if self._found else None
            skills, advantages = find_modes(asked, None if starts is None else np.array(starts))
            self._found += zip(places, skills, strict=True)
            return skills, advantages
        points = []
        for place, way in zip(places, asked, strict=True):
            points.append(self._mode(way, self._start(place)))
            self._found.append((place, points[-1][:-1]))
        found = np.array(points)
        return found[:, :-1], found[:, -1]

    def _start(self, place: Floats) -> Floats | None:
        """Return skills near a mode: on the line through those of two other methods, if any."""
        if not self._found:
            return None
        places, modes = zip(*self._found, strict=True)
        apart = place - np.array(places)
        size = np.square(apart).sum(1)
        nearest = int(size.argmin())
        start, wanted = modes[nearest], apart[nearest]
        steps = apart - wanted  # from the others to the nearest
        length = np.square(steps).sum(1)
        share = (steps @ wanted) / np.where(length > 0.0, length, 1.0)
        aside = np.square(wanted - share[:, None] * steps).sum(1)
        on_line = (length > 0.0) & (aside <= 1e-9 * size[nearest]) & (np.abs(share) <= MOST_AHEAD)
        if not on_line.any():
            return np.asarray(start)
        other = int(np.where(on_line, np.abs(share), np.inf).argmin())
        return np.asarray(start + share[other] * (start - modes[other]))

    def _asked(
        self,
        *,
        prior_sd: float = PRIOR_SD,
        half_life: float | None = None,
        break_advantage: float | str | None = None,
        scale: Any = DEFAULT_SCALE,
        levels: Levels | None = None,
    ) -> WayToRate:
        breaks = break_advantage is not None
        known_break = known_advantage(break_advantage, scale_of(scale)) if breaks else 0.0
        terms = self._terms_of(half_life, breaks=breaks)
        # Without such games there is nothing to estimate.
        some = bool(terms.games_with_breaker)
        return WayToRate(
            terms,
            checked_prior(prior_sd) ** -2,
            (known_break or 0.0) * some,
            BREAK_SD**-2 if known_break is None and some else None,
            self._means_of(levels or Levels(), half_life),
        )

    def _mode(self, way: WayToRate, start: Floats | None) -> Floats:
        """Return the skills and the break advantage by one method."""
        mode = find_mixed_mode(
            way.terms,
            way.precision,
            advantage=way.advantage,
            break_precision=way.break_precision,
            means=way.means,
            start=start,
            gradient=GRADIENT,
        )
        return np.append(mode.point[: self._players], mode.point[-1])

    def _terms_of(self, half_life: float | None, *, breaks: bool) -> LikelihoodTerms:
        if (half_life, breaks) not in self._terms:
            weights = weights_of(self._scored, self._won_only, half_life, None)
            self._terms[half_life, breaks] = likelihood_terms(
                self._scored, self._won_only, weights, breaks=breaks
            )
        return self._terms[half_life, breaks]

    def _means_of(self, levels: Levels, half_life: float | None) -> PriorMeans | None:
        if levels not in self._means:
            if levels.field and self._evenings is None:
                self._evenings = first_evenings(self._results, levels)
            seen = self._stated, self._evenings
            self._means[levels] = means_of(self._results, levels, *seen) if levels else None
        means = self._means[levels]
        if means is None or levels.beginning is None:
            return means
        return means.faded(levels.beginning.kept(half_life, self._results, None))
