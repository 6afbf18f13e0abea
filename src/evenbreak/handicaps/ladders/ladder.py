"""The ladder: how far a rating strays from the skill that it stands for, match by match.

The rating error is the rating minus the skill, in points. The chart gives the race for a rating
difference, the race and the two skills give the chance of each final score, and the system's rule
moves the rating. That is a chain of rating errors; its stochastic limit is how far ratings wander
in the long run.

Source: the National Pool League's ladder, between Table 5.6 and P5.27, with the natural and the
autocorrelated model and the improvements suggested there.
"""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from evenbreak.arrays import Floats, Ints
from evenbreak.chains.ways import Way, way_of_limit
from evenbreak.checks import number, whole
from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.charts.chart_of import chart_of
from evenbreak.handicaps.ladders.error_law import LongRun, NightModel, long_run
from evenbreak.handicaps.ladders.error_walk import ErrorWalk
from evenbreak.handicaps.ladders.form import deviation_grid, deviations, difference_law
from evenbreak.handicaps.ladders.opponents import NATURAL, Opponents
from evenbreak.handicaps.ladders.pairing import pairing_of
from evenbreak.handicaps.systems.by_match import StepSystem
from evenbreak.handicaps.systems.catalog import steps_of
from evenbreak.handicaps.systems.match_table import known_table
from evenbreak.stats.summary import Distribution
from evenbreak.words import Parameter

_DOUBLINGS = (2.0, 4.0, 8.0)
_AT_AN_END = 1e-9
_MOST_HELD = 0.1
_MOST_SD = 4.0
_MOST_SPREAD = 20.0


@dataclass(frozen=True)
class Ladder(ErrorWalk):
    """A player's rating error under a handicap system, as a chain with its long run.

    This is a game without an end: a state is the rating error in whole points, from -widest to
    widest, and it starts at 0. An error that a match would take beyond an end stays the same.

    Parameters
    ----------
    system
        the system whose rule moves the ratings: a `System` or its name. A `Chart` stands for the
        National Pool League's rule on that chart.
    chart
        the chart that sets the races; None: the system's own.
    opponents
        the opponents whom the player meets, regardless of the player's rating.
    day_sd
        standard deviation, in points, of a player's form on a night: one deviation from the
        skill for all matches of the night, normal, rounded to whole points. It holds for every
        player.
    match_sd
        the same for the part of form that changes with each match.
    matches_a_night
        how many matches a player has on a night, each against a new opponent; ratings move after
        each match. It matters only with a `day_sd`.
    drift
        the mean number of points by which the player's skill rises with each match, from -1 to 1:
        after each match, it rises by one point with this probability. Opponents' skills do not
        change.
    widest
        errors are cut off at -widest and widest points. None: 2, 4 or 8 doublings of the odds,
        the first with a chance below 1e-9 at each end, for one match a night against these
        opponents (or against correctly rated ones, if all opponents have the player's own skill
        or rating).

    Raises
    ------
    InputError
        if a parameter has an invalid value.
    AccuracyError
        if no width is given and none is wide enough: the rating cannot keep up with the skill,
        the opponents are too far from it, or the chart has one race for all differences.

    Notes
    -----
    With matches_a_night above 1 and a day_sd the error alone is not a chain, since a night's
    matches share their form. `kernel` is then an average over the matches of all nights, and the
    long run is exact for that average; how fast a rating settles follows from it only
    approximately. Such nights take a fraction of a second if there are few different moves. With
    moves as varied as Elo's on a line of 960 errors, and opponents who err as the player does,
    nights of three matches can take 20 seconds, of six a minute, and of more far longer.

    Source: the natural and the autocorrelated distributions of Fig. 5.9 and after it. The limit
    of a +-1 ladder is that of the powers of M, since an error is occasionally held at the two ends.
    But that is extremely rare: over any real season, the error is odd after an odd number of
    matches and even after an even one, as on a ladder without ends, whose period is 2. The long run
    is then the average of the two.

    >>> from evenbreak.handicaps import AUTOCORRELATED, EQUAL_SKILL, chart
    >>> regular = chart("npl_10")
    >>> round(Ladder(regular).law().sd, 3)
    4.634
    >>> round(Ladder(regular, opponents=AUTOCORRELATED).law().sd, 3)
    4.654
    >>> round(Ladder(regular, opponents=EQUAL_SKILL).law().sd, 3)
    4.417
    """

    system: StepSystem
    chart: Chart
    opponents: Opponents = NATURAL
    day_sd: float = 0.0
    match_sd: float = 0.0
    matches_a_night: int = 1
    drift: float = 0.0
    widest: int = 0

    def __init__(
        self,
        system: StepSystem | str | Chart,
        chart: Chart | str | None = None,
        *,
        opponents: Opponents = NATURAL,
        day_sd: float = 0.0,
        match_sd: float = 0.0,
        matches_a_night: int = 1,
        drift: float = 0.0,
        widest: int | None = None,
    ) -> None:
        by, chart = _system_and_chart(system, chart)
        if not isinstance(opponents, Opponents):
            raise InputError(
                "opponents must be Opponents, such as NATURAL; you gave {opponents!r}",
                opponents=opponents,
            )
        doubling = by.scale.points_per_doubling
        if doubling < 1.0:
            raise InputError(
                "points_per_doubling must be 1 or more on the system's scale, because ratings "
                "are whole points; it is {doubling:g}",
                doubling=doubling,
            )
        if opponents.farthest > _MOST_SPREAD * doubling:
            raise InputError(
                "the opponents' spread goes up to {farthest} points. Make it {most_spread:.0f} "
                "or less.",
                farthest=opponents.farthest,
                most_spread=_MOST_SPREAD * doubling,
            )
        values = {
            "system": by,
            "chart": chart,
            "opponents": opponents,
            "day_sd": number(day_sd, "day_sd", low=0.0, high=_MOST_SD * doubling),
            "match_sd": number(match_sd, "match_sd", low=0.0, high=_MOST_SD * doubling),
            "matches_a_night": whole(matches_a_night, "matches_a_night", at_least=1),
            "drift": number(drift, "drift", low=-1.0, high=1.0),
        }
        values["widest"] = (
            _usual_width(
                by,
                chart,
                opponents if opponents.farthest else NATURAL,
                values["day_sd"],
                values["match_sd"],
                values["drift"],
            )
            if widest is None
            else whole(widest, "widest", at_least=1)
        )
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def steps(self) -> Ints:
        """The moves that a match can cause, in points, in increasing order."""
        return self._long_run.steps

    @property
    def kernel(self) -> Floats:
        """P(move | error before the match), shape (errors, steps), the ends not yet applied."""
        return self._long_run.kernel

    @property
    def wins(self) -> Floats:
        """P(the player wins the match | error before it), shape (errors,)."""
        return self._long_run.wins

    @property
    def opponent_law(self) -> Distribution:
        """The distribution of the opponents' rating error, averaged over a night's matches."""
        return self._distribution(self._long_run.opponents)

    @property
    def changes(self) -> tuple[float, ...]:
        """The largest change of a probability in each round of the iteration."""
        return self._long_run.changes

    def law(self, *, via: Way | None = None) -> Distribution:
        """Return the distribution of the rating error in the long run: the stochastic limit.

        The player's skill stays the same except for the drift. If all moves are multiples of g
        points, no match takes an error from one remainder modulo g to another. The skill is
        unrelated to g, so each remainder is equally likely at the start; the result is the average
        of the g limits.

        Parameters
        ----------
        via
            the default ('kernel', or None) is the closed form or banded elimination; 'elimination'
            and 'eigen' take the limit of the ladder as a game (see `evenbreak.chains.limit_of`).

        Raises
        ------
        AccuracyError
            if the opponents' self-consistent distribution does not converge, or if more than a
            tenth of the ratings are at the ends of the line, so that only the width limits them.
        """
        way = way_of_limit(via)
        law = self._long_run.law if way is None else self._law_by_limit(way)
        held = _at_the_ends(law)
        if held > _MOST_HELD:
            raise AccuracyError(
                "with probability {held:.2g}, the rating error is at the ladder's ends, {widest} "
                "points off: either the steps don't keep up with what drives it there, or "
                "the ladder is too narrow. Give {self}.",
                widest=self.widest,
                held=held,
                self=_remedy(self),
            )
        return self._distribution(law)

    @cached_property
    def _long_run(self) -> LongRun:
        shared = self.matches_a_night > 1 and self.day_sd > 0.0
        doubling = self.system.scale.points_per_doubling
        days, weights = deviation_grid(deviations(self.day_sd if shared else 0.0), doubling)
        blur = difference_law(self.match_sd, 0.0 if shared else self.day_sd)
        pairing = pairing_of(self.system, self.chart, self.widest, self.opponents, blur, days)
        matches = self.matches_a_night if shared else 1
        night = NightModel(pairing, weights, matches)
        return long_run(night, self._given_error(), self.drift, conserving=self.system.conserving)

    def _given_error(self) -> Floats | None:
        """Return the opponents' error on the line, with everything beyond it moved to its ends."""
        law = self.opponents.error
        if law is None:
            return None
        values = np.array(law.values, dtype=np.int64)
        places = np.clip(values, -self.widest, self.widest) + self.widest
        weights = np.array(law.probability, dtype=float)
        return np.bincount(places, weights, 2 * self.widest + 1).astype(float)

    def _distribution(self, chances: Floats) -> Distribution:
        return Distribution(tuple(self.errors.tolist()), tuple(chances.tolist()))


def _system_and_chart(system: Any, chart: Any) -> tuple[StepSystem, Chart]:
    if isinstance(system, Chart):
        if chart is not None:
            raise InputError(
                "chart is {chart!r}, but a Chart was already given as the system. Leave out one "
                "of the two.",
                chart=chart,
            )
        return steps_of("npl"), system
    by = steps_of(system)
    return by, by.usual_chart() if chart is None else chart_of(chart)


def _at_the_ends(law: Floats) -> float:
    """Return P(the error is at an end, or within one move of an end)."""
    near = max(1, len(law) // 40)
    return float(law[:near].sum() + law[-near:].sum())


def _remedy(ladder: Ladder) -> str:
    wider = f"a widest above {ladder.widest}"
    return (
        f"opponents closer to the player's skill, or {wider}"
        if ladder.opponents.farthest
        else wider
    )


def _same_everywhere(system: StepSystem, chart: Chart) -> bool:
    """Return whether a match is the same regardless of the two ratings."""
    table = known_table(system, chart)
    return all(bool((each == each[0]).all()) for each in (table.needs, table.moves))


@lru_cache(maxsize=64)
def _usual_width(
    system: StepSystem,
    chart: Chart,
    opponents: Opponents,
    day_sd: float,
    match_sd: float,
    drift: float,
) -> int:
    """Return the narrowest usual width with almost nothing at its ends."""
    if _same_everywhere(system, chart):
        raise AccuracyError(
            "chart {chart} has the same race at every difference, so nothing corrects a wrong "
            "rating. Give a chart whose races differ.",
            chart=chart.name,
        )
    for doublings in _DOUBLINGS:
        widest = round(doublings * system.scale.points_per_doubling)
        ladder = Ladder(
            system,
            chart,
            opponents=opponents,
            day_sd=day_sd,
            match_sd=match_sd,
            drift=drift,
            widest=widest,
        )
        # Against opponents far off a narrow ladder may have no long run, and a wider one may.
        with contextlib.suppress(AccuracyError):
            if _at_the_ends(np.array(ladder.law().probability)) <= _AT_AN_END:
                return widest
    if opponents.farthest:
        raise AccuracyError(
            "the rating error goes beyond {widest} points, or doesn't settle: the opponents are "
            "too far from the player's skill for the chart's races. Give a {skill} closer to "
            "theirs.",
            widest=widest,
            skill=Parameter("skill"),
        )
    raise AccuracyError(
        "the rating error goes beyond {widest} points: the steps are too long for the "
        "scale, form varies too much, or the skill drifts away from the rating. Give a "
        "smaller {step}, another {system}, or less {day_sd}, {match_sd} or {drift}.",
        widest=widest,
        step=Parameter("step"),
        system=Parameter("system"),
        day_sd=Parameter("day_sd"),
        match_sd=Parameter("match_sd"),
        drift=Parameter("drift"),
    )
