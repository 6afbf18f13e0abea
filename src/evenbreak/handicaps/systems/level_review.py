"""Level review: a player's last scores move their skill level, as in APA- and TAP-like leagues.

Both leagues' rules are unpublished except for their windows, so this is a system *like* theirs with
open parameters. After each night, a mean is taken of the last scores of each player who played:
over the best share of the window (APA-like), or over all but the best and the worst (TAP-like). A
level that differs from that mean moves, by at most `most_change` and never below the lowest
attainable level, the career's peak minus `lowest`.

Scores are of two kinds:

- 'games', which any results have: part performance, part result. The performance is the level of
  the opponent plus the log-odds of the games won (half a game added to each side) in steps of a
  level; the result is a level above one's own for a match won, and one below for a match lost. Both
  are level units, so the mean is read as a level, and rounded.
- 'innings', which needs the innings of each match: innings less defensive shots by games won, 10
  at most, the lower the better, and its mean is read in the table of levels of 2006. For a match
  won an *applied score*, by level and share of matches won, counts if it is better.

A level on the list counts as one score per match stated on the list, or as a full window if none
are stated; new scores replace these. So a newcomer moves immediately.

Source: windows and parts as TAP leagues publish them; the innings rule as told in 2006 (evidence of
2024 shows that today's rule differs); a maximum change and a lowest attainable level exist, their
values are unpublished. A level's step of 74 Fargo points is the mean of the measured ones.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import number, one_of, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.level_chart import LevelChart, level_chart
from evenbreak.handicaps.systems.history import Entries, History, Matches, column_of, positions
from evenbreak.handicaps.systems.system import System

STEP = 74.0
"""Fargo points per level: the mean of those measured in 40,000 APA matches."""

_CAP = 10.0
_INNINGS = np.array([2.0, 3.0, 4.0, 5.0, 7.0])
"""The largest mean for levels 7, 6, 5, 4 and 3."""

_USUAL = np.array([8.5, 6.0, 4.5, 3.5, 2.5, 1.5])
"""A mean in the middle of each level from 2 to 7."""


@dataclass(frozen=True)
class LevelReview(System):
    """Skill levels that are moved by a player's last scores.

    Parameters
    ----------
    window
        how many of the last scores count; leagues use 10 to 21.
    kept
        the best share of them to average, rounded up (.5 APA-like; 1: all).
    trim
        how many of the best, and of the worst, are left out first (1 TAP-like).
    result
        the weight of the result in the score; the rest is the performance (.2 TAP-like).
    hysteresis
        how far beyond the border between two levels the mean must be, in levels (or innings).
    most_change
        the most levels by which a review moves a player.
    lowest
        how many levels below the career's peak can be reached; None: any number.
    score
        'games' or 'innings'.
    applied
        whether applied scores count ('innings' only).
    newcomer
        the level of a player without one.
    own_chart
        the chart that sets the races; None: `apa_8ball`.
    """

    window: int = 20
    kept: float = 1.0
    trim: int = 0
    result: float = 0.0
    hysteresis: float = 0.0
    most_change: int = 1
    lowest: int | None = 2
    score: Literal["games", "innings"] = "games"
    applied: bool = True
    newcomer: int = 3
    own_chart: LevelChart | None = None
    name: str = "level-review"

    publishes = "levels"

    def __post_init__(self) -> None:
        whole(self.window, "window", at_least=1, at_most=200)
        number(self.kept, "kept", above=0.0, high=1.0)
        whole(self.trim, "trim", at_least=0)
        if self.window <= 2 * self.trim:
            raise InputError(
                "{trim} is {value}, which leaves none of the {window} scores. Give a smaller "
                "number.",
                value=self.trim,
                window=self.window,
            )
        number(self.result, "result", low=0.0, high=1.0)
        number(self.hysteresis, "hysteresis", low=0.0, high=0.5)
        whole(self.most_change, "most_change", at_least=1)
        whole(self.newcomer, "newcomer", at_least=0)
        if self.lowest is not None:
            whole(self.lowest, "lowest", at_least=0)
        one_of(self.score, "score", ("games", "innings"))

    @property
    def in_words(self) -> str:  # type: ignore[override]
        """The rule in words."""
        part = "" if self.kept == 1.0 else f"the best {self.kept:.0%} of "
        trimmed = " but the best and the worst" if self.trim else ""
        trimmed += f" {self.trim}" if self.trim > 1 else ""
        return (
            f"levels by {part}the last {self.window} scores{trimmed}, moving at most "
            f"{self.most_change} a night; real leagues' rules aren't published"
        )

    @property
    def asks(self) -> tuple[str, ...]:  # type: ignore[override]
        """The data that it needs about a match: games, and innings if they are its score."""
        return ("games", "innings") if self.score == "innings" else ("games",)

    @property
    def chart(self) -> LevelChart:
        """The chart that sets the races."""
        return self.own_chart or level_chart("apa_8ball")

    def initial(self, entries: Entries) -> Floats:
        """Return the stated levels, limited to the chart's, or else the newcomers' level."""
        levels = np.where(np.isnan(entries.level), self.newcomer, entries.level)
        return nearest_level(self.chart, levels)

    def update(self, history: History) -> Floats:
        """Return the levels after a review of the players who played."""
        levels = np.array(history.ratings)
        scores, count = self._scores(history)
        mean = self._mean(scores, count)
        goal = self._goal(mean, levels)
        new = np.clip(goal, levels - self.most_change, levels + self.most_change)
        if self.lowest is not None:
            new = np.maximum(new, np.minimum(_peaks(history) - self.lowest, levels))
        new = nearest_level(self.chart, new)
        return np.where(_who_played(history) & (count > 0), new, levels)

    def _scores(self, history: History) -> tuple[Floats, Any]:
        """Return the last scores, newest first, and their number."""
        if self.score == "games":
            scores = history.last(self.window, "scores", self._by_games)
        else:
            scores = history.last(self.window, "scores", _by_innings)
            if self.applied:
                won = history.last(self.window, "won", _won_in_innings)
                share = np.nanmean(np.where(np.isnan(won).all(axis=0), 0.0, won), axis=0)
                better = np.minimum(scores, applied_score(history.ratings, share))
                scores = np.where(won == 1.0, better, scores)
        new = (~np.isnan(scores)).sum(axis=0)
        stated = column_of(history.entries.matches, history.initial.shape)
        unrated = column_of(np.isnan(history.entries.level), history.initial.shape)
        past = np.where(unrated, 0, np.where(stated < 0, self.window, stated))
        count = np.minimum(new + past, self.window)
        place = np.arange(self.window).reshape(-1, *(1,) * (scores.ndim - 1))
        usual = (
            _USUAL[np.clip(history.initial, 2, 7).astype(np.int64) - 2]
            if self.score == "innings"
            else history.initial
        )
        return np.where((place >= new) & (place < count), usual, scores), count

    def _by_games(self, matches: Matches) -> Floats:
        won, lost = matches.score_a, matches.score_b
        performance = matches.rating_b + np.log2((won + 0.5) / (lost + 0.5)) * 100.0 / STEP
        result = matches.rating_a + np.where(matches.won_a, 1.0, -1.0)
        score: Floats = self.result * result + (1.0 - self.result) * performance
        return score

    def _mean(self, scores: Floats, count: Any) -> Floats:
        """Return the mean of the scores that count; unused for players who have none."""
        best_first = np.sort(scores if self.score == "innings" else -scores, axis=0)  # NaN last
        trim = np.where(count > 2 * self.trim, self.trim, 0)
        left = count - 2 * trim
        many = np.ceil(self.kept * left - 1e-9)
        many = np.where((self.kept < 1.0) & (left == 2), 2, many)  # as the table of 2006 has it
        place = np.arange(len(scores)).reshape(-1, *(1,) * (scores.ndim - 1))
        counted = (place >= trim) & (place < trim + many)
        mean = np.where(counted, best_first, 0.0).sum(axis=0) / np.maximum(many, 1)
        return np.asarray(mean if self.score == "innings" else -mean)

    def _goal(self, mean: Floats, levels: Floats) -> Floats:
        """Return the level that a mean calls for, or the current one within the hysteresis."""
        kinder, harder = (
            level_of_innings(mean + shift)
            if self.score == "innings"
            else np.floor(mean - shift + 0.5)
            for shift in (self.hysteresis, -self.hysteresis)
        )
        return np.where(kinder > levels, kinder, np.where(harder < levels, harder, levels))


def apa_like(**changes: Any) -> LevelReview:
    """Return a review of the best half of 20 innings scores, as reported for APA 8-ball in 2006."""
    usual: dict[str, Any] = {"window": 20, "kept": 0.5, "score": "innings", "name": "apa-like"}
    return LevelReview(**{**usual, **changes})


def tap_like(**changes: Any) -> LevelReview:
    """Return a review of 21 scores without the best and worst, with a fifth from the result."""
    usual: dict[str, Any] = {
        "window": 21,
        "trim": 1,
        "result": 0.2,
        "hysteresis": 0.33,
        "name": "tap-like",
    }
    return LevelReview(**{**usual, **changes})


def level_of_innings(mean: Any) -> Any:
    """Return the level for mean innings per game won, from the table of 2006.

    >>> level_of_innings([1.9, 2.0, 3.5, 6.0, 10.0]).tolist()
    [7, 7, 5, 3, 2]
    """
    return 7 - np.searchsorted(_INNINGS, mean, side="left")


def applied_score(level: Any, share: Any) -> Any:
    """Return the applied score for a match won, by level and share of matches won.

    >>> applied_score([7, 7, 5, 2], [1.0, 0.5, 0.3, 0.9]).round(1).tolist()
    [1.1, 1.5, 3.7, 7.0]
    """
    level, tenths = np.asarray(level), np.floor(10.0 * np.asarray(share) + 1e-9)
    within = 1.1 + 0.1 * np.clip(9.0 - tenths, 0.0, 8.0)
    return np.where(level <= 2, 7.0, within + np.maximum(7.0 - level, 0.0))


def nearest_level(chart: LevelChart, levels: Any) -> Floats:
    """Return the chart's level closest to each number; the lower one of a tie."""
    own = np.array(chart.levels, dtype=float)
    between = (own[1:] + own[:-1]) / 2.0
    return np.asarray(own[np.searchsorted(between, np.asarray(levels, dtype=float), side="left")])


def _by_innings(matches: Matches) -> Floats:
    if matches.innings_a is None:
        raise InputError(
            "this review goes by innings, but the results don't have them. Use level-review, "
            "which goes by games."
        )
    score = np.minimum(matches.innings_a / np.maximum(matches.score_a, 1), _CAP)
    return np.asarray(np.where(matches.score_a > 0, score, _CAP))


def _won_in_innings(matches: Matches) -> Floats:
    return matches.won_a.astype(float)


def _who_played(history: History) -> Any:
    there = np.zeros(history.initial.size, dtype=bool)
    night = history.tonight
    for who in (night.a, night.b):
        there[positions(who, history.initial.shape)[night.played]] = True
    return there.reshape(history.initial.shape)


def _peaks(history: History) -> Floats:
    """Return each player's highest level so far."""

    def add(peaks: Floats, matches: Matches) -> Floats:
        flat = peaks.reshape(-1)
        for who, level in ((matches.a, matches.rating_a), (matches.b, matches.rating_b)):
            np.maximum.at(flat, positions(who, peaks.shape)[matches.played], level[matches.played])
        return peaks

    peaks: Floats = np.maximum(history.fold("peaks", history.initial.copy, add), history.ratings)
    return peaks
