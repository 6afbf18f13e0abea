"""Watching a league for sandbagging: each player's evidence, match by match, with its alarm."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints, array_values
from evenbreak.checks import number, one_of
from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.systems.by_match import StepSystem
from evenbreak.handicaps.systems.night_table import SeasonSoFar, published
from evenbreak.handicaps.systems.rating_changes import RatingChanges, apply_results, night_problems
from evenbreak.handicaps.systems.system import System
from evenbreak.league.sandbag_evidence import (
    DEPTHS,
    FARTHEST,
    GAINS,
    HONEST,
    SHARES,
    SHARES_MARKED,
    WIDEST,
    Likelihood,
    Result,
    SandbagEvidence,
    units,
)
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import SCALES
from evenbreak.stats.summary import Distribution


@array_values
@dataclass(frozen=True, eq=False)
class Watched:
    """Evidence against one player.

    Parameters
    ----------
    rows
        row numbers of the player's matches in the results, in the order in which they were played.
    won
        whether the player won each.
    any, established
        the logarithm of the evidence e after each match, against honest players of any skill,
        and against established ones.
    honest
        which of the two raises the alarm.
    alpha
        the largest acceptable chance that an honest player is ever flagged.
    tried
        `log_e` if matches were dumped only in one of the events tried, by the event's name; under
        the key None, in any event. Empty if no event was tried.
    """

    player: str
    rows: Ints
    won: Bools
    any: Floats
    established: Floats
    honest: str
    alpha: float
    tried: Mapping[str | None, Floats] = field(default_factory=dict)

    @property
    def log_e(self) -> Floats:
        """The logarithm of the e that raises the alarm, after each match."""
        return self.any if self.honest == "any" else self.established

    @property
    def alarm(self) -> int | None:
        """The position in `rows` of the match that first raised the alarm; None if none did."""
        over = np.flatnonzero(self.log_e >= -math.log(self.alpha))
        return int(over[0]) if over.size else None

    @property
    def event(self) -> str | None:
        """The tried event that raised the alarm; None if no single event did."""
        place = self.alarm
        if place is None or not self.tried:
            return None
        return max(self.tried, key=lambda event: float(self.tried[event][place]))

    @property
    def e_value(self) -> float:
        """The value of e after the last match."""
        return _e(float(self.log_e[-1]))

    @property
    def largest_e(self) -> float:
        """The largest e after any match; the alarm was raised if it is at least 1 / alpha."""
        return _e(float(self.log_e.max()))

    @property
    def p_value(self) -> float:
        """The smallest alpha at which the player would have been flagged: 1 / the largest e."""
        return min(1.0, 1.0 / self.largest_e)


def watch(
    nights: Iterable[PlayedNight],
    system: System,
    error: Distribution,
    *,
    alpha: float = 0.01,
    honest: str = "any",
    marked: Bools | None = None,
    tried: Mapping[str, Bools] | None = None,
    day_sd: float = 0.0,
) -> list[Watched]:
    """Return the evidence against each player of a season, by name.

    Parameters
    ----------
    nights
        the season, as `played_nights` returns it.
    error
        the distribution of rating errors (rating minus skill), such as `Ladder(...).law()`; on the
        Fargo scale for a system that does not move points match by match (`errors_played`).
    alpha
        the largest acceptable chance that an honest player is ever flagged.
    honest
        'any': the bound holds for every constant skill within 180 points of the rating at the
        start, and for skills that change steadily by -1/4, 1/4 or 1/2 point per match (where 30
        points double the odds). 'established': it holds on average over the ladder's rating errors
        at the start, and sandbaggers are flagged sooner; but honest players who improve, or whose
        rating is far off, are flagged too.
    marked
        for each match, whether it may have been dumped; None: any match may.
    tried
        for each event to try, which matches belong to it. The evidence is the average over dumping
        in each single event and dumping as given by `marked`.
    day_sd
        standard deviation of every player's form, in points. Honest players whose form varies
        more are flagged too often.

    Raises
    ------
    InputError
        if alpha is not above 0 and below 1, honest is neither, or `day_sd` is out of range.
    AccuracyError
        if a result is all but impossible given the ratings.

    Notes
    -----
    The bound holds for each player separately, on average over form and over the errors of the
    opponents' ratings, which are assumed to be independent from match to match with the
    distribution `error`. Among N honest players, at most N · alpha are flagged on average; at alpha
    / N the chance that any of them is flagged stays below alpha.

    The bound needs no further correction for the events in `tried`: an average of e-values that
    were fixed before the results is an e-value.

    >>> from evenbreak.handicaps import Ladder, chart, system_of
    >>> from evenbreak.league import played_nights
    >>> from evenbreak.ratings import Results, Roster
    >>> club = Roster(["Ann", "Bo"], [80, 80])
    >>> season = Results.from_names(["Ann"] * 4, ["Bo"] * 4, [5, 0, 5, 0], [0, 5, 1, 5])
    >>> npl, ten = system_of("npl"), chart("npl_10")
    >>> season = played_nights(npl, club, season, chart=ten)
    >>> for one in watch(season, npl, Ladder("npl", ten).law()):
    ...     print(one.player, one.won.tolist(), one.alarm)
    Ann [True, False, True, False] None
    Bo [False, True, False, True] None
    """
    number(alpha, "alpha", above=0.0, below=1.0)
    one_of(honest, "honest", HONEST)
    by_match = isinstance(system, StepSystem)
    scale = system.scale if isinstance(system, StepSystem) else SCALES["fargo"]
    number(day_sd, "day_sd", low=0.0, high=4.0 * scale.points_per_doubling)
    tries: list[tuple[str | None, Bools | None]] = [(None, marked), *(tried or {}).items()]
    results: dict[int, list[Result]] = {}
    rows: dict[int, list[int]] = {}
    start: dict[int, int] = {}
    names: tuple[str, ...] = ()
    for night in nights:
        names = night.changes.before.players
        before = night.changes.before
        rating = before.rating if by_match else system.strength(published(system, before))
        for match in night.changes.matches:
            row = int(night.rows[match.row])
            sides = ((match.winner, match.loser, 1), (match.loser, match.winner, -1))
            for player, opponent, turn in sides:
                start.setdefault(player, units(float(rating[player]), scale))
                rows.setdefault(player, []).append(row)
                results.setdefault(player, []).append(
                    Result(
                        units(float(rating[opponent]), scale),
                        _turned(match.games, turn),
                        _turned(match.race, turn),
                        turn == 1,
                    )
                )
    likelihood = Likelihood(scale, error, day_sd)
    watched = []
    for player in sorted(results, key=lambda place: names[place]):
        try:
            log_e = {
                name: _if_dumped(start[player], results[player], likelihood, rows[player], may)
                for name, may in tries
            }
        except AccuracyError as why:
            raise AccuracyError("{name!r}: {why}", name=names[player], why=why) from why
        won = np.array([result.won for result in results[player]])
        place = np.array(rows[player])
        of_any, established = np.logaddexp.reduce(list(log_e.values())) - math.log(len(log_e))
        kind = HONEST.index(honest)
        by_event = {name: pair[kind] for name, pair in log_e.items()} if tried else {}
        watched.append(
            Watched(names[player], place, won, of_any, established, honest, alpha, by_event)
        )
    return watched


def _if_dumped(
    rating: int,
    results: Sequence[Result],
    likelihood: Likelihood,
    rows: Sequence[int],
    marked: Bools | None,
) -> tuple[Floats, Floats]:
    """Return the evidence of `watch_player` if only matches in marked rows may be dumped."""
    if marked is None:
        return watch_player(rating, results, likelihood)
    seen = [
        result._replace(marked=bool(marked[row])) for result, row in zip(results, rows, strict=True)
    ]
    return watch_player(rating, seen, likelihood, shares=SHARES_MARKED)


def _turned(pair: tuple[int, int] | None, turn: int) -> tuple[int, int] | None:
    return pair if pair is None or turn == 1 else (pair[1], pair[0])


def watch_player(
    rating: int,
    results: Sequence[Result],
    likelihood: Likelihood,
    *,
    shares: Sequence[float] = SHARES,
) -> tuple[Floats, Floats]:
    """Return the logarithm of e after each match of a player, in the order played.

    The rating at the start is in whole points, 30 of which double the odds; the shares of marked
    matches that a sandbagger may dump are averaged over. There are two arrays of shape (results,):
    one against honest players of any skill, and one against established players, whose rating
    errors at the start are those of `likelihood`.
    """
    evidence = SandbagEvidence(skill_prior(likelihood), shares, len(DEPTHS) + 1)
    log_e = np.empty((2, len(results)))
    for place, result in enumerate(results):
        shift, (up, down) = rating - result.opponent, drift_room(place)
        chances = likelihood.of(
            result.games,
            result.race,
            won=result.won,
            first=shift - FARTHEST - down,
            last=shift + FARTHEST + up,
        )
        drifting, kinds = at_skills(*chances, place)
        evidence.add(drifting[None], kinds[None], marked=result.marked)
        log_e[:, place] = [evidence.log_e(honest)[0] for honest in HONEST]
    return log_e[0], log_e[1]


def skill_prior(likelihood: Likelihood) -> Floats:
    """Return the distribution of skill minus rating, shape (1, skills)."""
    prior = np.zeros((1, 2 * WIDEST + 1))
    for place, weight in enumerate(likelihood.error):
        skill = -(place + likelihood.lowest)
        prior[0, min(max(skill, -WIDEST), WIDEST) + WIDEST] += weight
    return prior


def drift_room(place: int) -> tuple[int, int]:
    """Return how far an honest player's skill can have risen and fallen before a match."""
    gained = [round(gain * place) for gain in GAINS]
    return max(*gained, 0), -min(*gained, 0)


def at_skills(chance: Floats, feigned: Floats, place: int) -> tuple[Floats, Floats]:
    """Return a result's chance at each skill: for each honest gain, and for each way of dumping.

    Chances are by difference along the last axis, from -FARTHEST minus the room to fall; `place` is
    how many matches came before. Shapes (..., gains, 2 * FARTHEST + 1) and (..., ways, 2 * WIDEST +
    1).
    """
    middle = FARTHEST + drift_room(place)[1]

    def part(values: Floats, offset: int, widest: int) -> Floats:
        return values[..., middle + offset - widest : middle + offset + widest + 1]

    drifting = [part(chance, round(gain * place), FARTHEST) for gain in GAINS]
    kinds = [*(part(chance, -depth, WIDEST) for depth in DEPTHS), part(feigned, 0, WIDEST)]
    return np.stack(drifting, axis=-2), np.stack(kinds, axis=-2)


def _e(log_e: float) -> float:
    """Return e, limited to the range of a float."""
    return math.exp(min(log_e, 700.0))


# A season night by night, as its results changed the ratings.


class PlayedNight(NamedTuple):
    """A night in a season: its matches' rows in the results, and the resulting changes."""

    rows: Ints
    changes: RatingChanges


def played_nights(
    system: System,
    roster: Roster,
    results: Results,
    *,
    chart: Chart | System | str | None = None,
    apply: Callable[[Roster, Ints], RatingChanges] | None = None,
) -> list[PlayedNight]:
    """Return a season night by night, with the ratings after each night.

    Without dates, each match is its own night, in row order; matches without a date come last.

    Parameters
    ----------
    chart
        the chart that sets the races if the results don't state them.
    apply
        how a night's matches change a list of ratings; None: as `apply_results` does.

    Raises
    ------
    InputError
        if results cannot be used.
    """

    def by_results(list_: Roster, rows: Ints) -> RatingChanges:
        night = results.select(rows)
        for problem in night_problems(system, list_, night, chart=chart):
            raise InputError(
                "row {row} of the results: {message}",
                row=rows[problem.row],
                message=problem.message,
            )
        return apply_results(system, list_, night, chart=chart, so_far=so_far)

    nights, now = [], roster
    so_far = SeasonSoFar(system, roster)
    for rows in _nights(results):
        changes = (apply or by_results)(now, rows)
        nights.append(PlayedNight(rows, changes))
        now = changes.after
    return nights


def _nights(results: Results) -> list[Ints]:
    """Return the rows of each night's matches by date; without dates, each match is a night."""
    if results.date is None:
        return [np.array([row]) for row in range(len(results))]
    _, night = np.unique(results.date, return_inverse=True)
    return [np.flatnonzero(night == day) for day in range(night.max(initial=-1) + 1)]
