"""Handicap systems side by side for one league: fairness, differences and costs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from evenbreak import __version__
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import columns_of, frame_table
from evenbreak.answers.kit.parts import Table
from evenbreak.answers.kit.wording import count_of
from evenbreak.arrays import Bools, Ints
from evenbreak.handicaps.systems.system import System
from evenbreak.league.contest import EVEN, Contest, Doublings
from evenbreak.league.judged import MEASURES, PARTS, RIGHT, Estimate, estimate
from evenbreak.league.race_tables import CLOSE
from evenbreak.league.world import World
from evenbreak.matches.pace import Pace, pace_of
from evenbreak.words import Sentence, joined, listed, say

CONFIDENCE = 0.9


@dataclass(frozen=True, eq=False)
class Comparison:
    """A contest with its measures; differences are from the first system."""

    contest: Contest
    world: World
    systems: Sequence[System]

    def estimate(self, measure: Any, confidence: float = CONFIDENCE) -> Estimate:
        """Return a measure for all systems, with intervals at a confidence level."""
        cycle = math.lcm(*(getattr(system, "cycle", 1) for system in self.systems))
        free = np.array([not Doublings(system, self.world).fixed for system in self.systems])
        return estimate(
            self.contest, measure, self.world, cycle=cycle, calibrated=free, confidence=confidence
        )

    @cached_property
    def measures(self) -> Mapping[str, Estimate]:
        """All measures that are a single number."""
        return {name: self.estimate(measure) for name, measure in MEASURES.items()}

    @property
    def names(self) -> list[str]:
        """The systems' names."""
        return [system.name for system in self.systems]

    @cached_property
    def signs(self) -> tuple[Ints, Bools]:
        """Whether others have clearly more (1) or fewer (-1) even matches, beyond luck.

        Because the best of several systems is picked, each has to pass a stricter interval.
        """
        strict = 1.0 - (1.0 - CONFIDENCE) / max(len(self.systems) - 1, 1)
        even, right, worth = (
            self.estimate(MEASURES[name], strict).clear[1:].astype(int)
            for name in ("p_even", "p_right", "p_doubling_wins")
        )
        return even, (even != 0) & (right * even <= 0) & (worth == -even)

    @cached_property
    def best(self) -> int:
        """The fairer system with the most even matches; None if none is fairer than the first."""
        even, by_luck = self.signs
        share = self.measures["p_even"].value[1:]
        fairer = (even > 0) & ~by_luck
        return 1 + int(np.argmax(np.where(fairer, share, -1.0) if fairer.any() else share))


def comparison_answer(
    comparison: Comparison,
    settings: Mapping[str, Any],
    *,
    assumed: Sequence[str] = (),
    pace: Pace | str | None = None,
    warnings: Sequence[str] = (),
) -> Answer:
    """Return systems side by side; in files, one row per system and measure.

    `settings` are other facts for the reader, such as the seed; `assumed` has sentences; without a
    pace, lengths are in games only.
    """
    world, contest = comparison.world, comparison.contest
    replicas = int(contest.replicas.sum())
    matches = contest.matches[0, :, 0].sum() / replicas / world.seasons
    heading = say(
        "{players}, {weeks}, {matches:,.0f} matches a season\n{seasons} simulated with each system",
        players=count_of(len(world.players), "player"),
        weeks=count_of(world.weeks, "week"),
        matches=matches,
        seasons=count_of(replicas * world.seasons, "season"),
    )
    frame = measures_frame(comparison)
    data = {
        **settings,
        "systems": comparison.names,
        "player_count": len(world.players),
        "weeks": world.weeks,
        "seasons": world.seasons,
        "replicas": replicas,
        "newcomers": world.newcomers,
        "sandbaggers": world.sandbaggers,
        "matches_a_season": float(matches),
        "evenbreak_version": __version__,
        "measures": frame_table("", frame).to_dicts(),
        "deciles": frame_table("", deciles_frame(comparison)).to_dicts(),
    }
    if not matches:
        nobody = say("No match was played: the two players in a match were never there together.")
        return Answer(heading, [nobody], warnings=warnings, data=data)
    several = len(comparison.systems) > 1
    return Answer(
        heading,
        [
            joined(_verdict(comparison) if several else _alone(comparison), " "),
            _FAIRER,
            *_tables(comparison, _SHOWN),
            *([] if pace is None else [_minutes(comparison, pace)]),
            *([_SAME] if several else []),
            _READ,
            *assumed,
        ],
        details=[
            *(table for shown in _DETAILS for table in _tables(comparison, shown)),
            _READ_DETAILS,
        ],
        warnings=warnings,
        data=data,
        csv=frame_table("measures", frame),
    )


_FAIRER = say(
    "A system is fairer if it makes more matches even without leaving more to luck. A match is "
    "even if neither player's chance of winning it is above {even:.0%}, given how good the two "
    "really are.",
    even=EVEN,
)

_SAME = say("All systems had the same players, nights and luck.")

_READ = say(
    "'Ratings off by': how far off ratings typically are (root mean square), in doublings of "
    "the odds of a game, over the last quarter of the nights. 'Newcomers right': how many "
    "nights it takes until newcomers' ratings are off by less than {right:g} doublings. "
    "'Dumping pays': how much a player's share of wins in the matches that count goes up if "
    "they hold back in the weeks before. 'Titles': the titles won by the strongest fifth; 1 is "
    "an equal share.",
    right=RIGHT,
)


_READ_DETAILS = say(
    "'Right races': the races that make up for the difference in skill to within {close:g} "
    "doublings, however long they are. 'Doubling wins': how often a player wins if they're a "
    "doubling better than their race assumes; if a coin flip decided matches, it would be 50%. "
    "'Better wins': how often the better player wins. 'Titles, weakest': the titles won by the "
    "weakest fifth. 'Games of the last': the most games that any player (or team) plays on a "
    "night. 'Changes a season': how often a player's number changes. 'Drift': how much all "
    "numbers rise compared with the skills, in doublings.",
    close=CLOSE,
)


def _minutes(comparison: Comparison, pace: Pace | str) -> Sentence:
    at = pace_of(pace) if isinstance(pace, str) else pace
    means = at.mean_minutes(comparison.measures["mean_games"].value)
    each = [say("{minutes:.0f} minutes with {name}", minutes=float(mean), name=name)
            for name, mean in zip(comparison.names, means, strict=True)]  # fmt: skip
    return say("At {game:.2g} minutes a game plus {more:.2g} a match, a match takes {each}.",
               game=at.per_game, more=at.overhead, each=listed(each))  # fmt: skip


def _verdict(comparison: Comparison) -> Iterator[Sentence]:
    """Yield which system is fairer, by how much, and at what cost."""
    names, best = comparison.names, comparison.best
    even, right = comparison.measures["p_even"], comparison.measures["p_right"]
    more_even, by_luck = comparison.signs
    change, half = even.change[best], even.change_margin[best]
    sign = int(more_even[best - 1])
    values = {
        "best": names[best],
        "own": names[0],
        "more": 100.0 * abs(change),
        "low": 100.0 * (abs(change) - half),
        "high": 100.0 * (abs(change) + half),
        "share": float(even.value[best]),
        "of_own": float(even.value[0]),
    }
    if math.isnan(half):
        yield say("One season can't show which is fairer. Simulate more seasons.")
    elif by_luck[best - 1]:
        one, other = (best, 0) if sign > 0 else (0, best)
        worth = comparison.measures["p_doubling_wins"].value
        yield say(
            "{one} makes {more:.1f} more matches in 100 even than {other} ({low:.1f} to "
            "{high:.1f}), but it is not fairer: luck decides more of its matches. Its races are "
            "right no more often ({right:.1%} compared with {of_other:.1%}), and a player a "
            "doubling better than expected wins {worth:.1%} of them, compared with "
            "{worth_of_other:.1%}.",
            one=names[one],
            other=names[other],
            right=float(right.value[one]),
            of_other=float(right.value[other]),
            worth=float(worth[one]),
            worth_of_other=float(worth[other]),
            **{name: values[name] for name in ("more", "low", "high")},
        )
        yield _costs(comparison, best)
    elif sign > 0:
        yield say(
            "{best} is fairer than {own}: {more:.1f} more matches in 100 are even ({low:.1f} to "
            "{high:.1f}), {share:.1%} compared with {of_own:.1%}.",
            **values,
        )
        yield _costs(comparison, best)
    elif sign < 0:
        if len(names) == 2 or (more_even >= 0).any() or by_luck.any():
            yield say(
                "{own} is fairer than {best}: {more:.1f} more matches in 100 are even ({low:.1f} "
                "to {high:.1f}), {of_own:.1%} compared with {share:.1%}.",
                **values,
            )
        else:
            yield say(
                "{own} is the fairest: {of_own:.1%} of its matches are even. That's {more:.1f} "
                "more in 100 than with {best}, the runner-up ({low:.1f} to {high:.1f}).",
                **values,
            )
        yield _gains(comparison, best)
    else:
        yield say(
            "No difference in fairness was found: with {best} instead of {own}, the number of "
            "even matches in 100 changes by {change:+.1f} ({low:+.1f} to {high:+.1f}).",
            best=names[best],
            own=names[0],
            change=100.0 * change,
            low=100.0 * (change - half),
            high=100.0 * (change + half),
        )
        yield _costs(comparison, best)


def _alone(comparison: Comparison) -> Iterator[Sentence]:
    even, name = comparison.measures["p_even"], comparison.names[0]
    half = even.quantile * even.error[0]
    if math.isnan(half):
        yield say("{share:.1%} of the matches are even under {name}.",
                  share=float(even.value[0]), name=name)  # fmt: skip
        return
    yield say(
        "{share:.1%} of the matches are even under {name} (90% interval {low:.1%} to {high:.1%}).",
        share=float(even.value[0]),
        name=name,
        low=float(even.value[0] - half),
        high=float(even.value[0] + half),
    )


_LONGER: Mapping[str, tuple[float, Sentence, Sentence]] = {
    "mean_games": (
        0.1,
        say("matches are {by:.1f} games longer"),
        say("matches are {by:.1f} games shorter"),
    ),
    "games_a_night": (
        0.2,
        say("whoever finishes last plays {by:.1f} more games a night"),
        say("whoever finishes last plays {by:.1f} fewer games a night"),
    ),
    "changes_a_season": (
        0.5,
        say("a player's number changes {by:.1f} more times a season"),
        say("a player's number changes {by:.1f} fewer times a season"),
    ),
    "sandbagging_pays": (
        0.01,
        say("sandbaggers win {by:.1%} more of the matches that count"),
        say("sandbaggers win {by:.1%} fewer of the matches that count"),
    ),
    "nights_until_right": (
        0.5,
        say("newcomers' ratings settle {by:.1f} nights later"),
        say("newcomers' ratings settle {by:.1f} nights sooner"),
    ),
}
"""What a system costs or saves: the smallest difference that matters, and words for more and
less."""


def _changes(comparison: Comparison, system: int) -> tuple[list[Sentence], list[Sentence]]:
    """Return what there is clearly more of, and less of, with a system than with the first."""
    ways: tuple[list[Sentence], list[Sentence]] = [], []
    for name, (least, more, less) in _LONGER.items():
        of = comparison.measures[name]
        change, sign = float(of.change[system]), int(of.clear[system])
        if sign and abs(change) >= least:
            ways[0 if sign > 0 else 1].append(say(more if sign > 0 else less, by=abs(change)))
    return ways


def _costs(comparison: Comparison, best: int) -> Sentence:
    more, less = _changes(comparison, best)
    if more and less:
        return say("What it costs: {more}. What it saves: {less}.",
                   more=listed(more), less=listed(less))  # fmt: skip
    if more:
        return say("What it costs: {more}.", more=listed(more))
    if less:
        return say("These seasons show no cost, and {less}.", less=listed(less))
    return say("These seasons show no cost.")


def _gains(comparison: Comparison, other: int) -> Sentence:
    more, less = _changes(comparison, other)
    changes = [*less, *more]
    name = comparison.names[other]
    if not changes:
        return say("{name} offers nothing in return.", name=name)
    return say("With {name}, {changes}.", name=name, changes=listed(changes))


class _Shown(NamedTuple):
    """How a measure is shown."""

    places: int
    percent: bool = False

    def text(self, value: float) -> str | None:
        """Return a value in words; None if it has none."""
        if math.isnan(value):
            return None
        return f"{value:.{self.places}{'%' if self.percent else 'f'}}"

    def difference(self, of: Estimate, place: int) -> str | None:
        """Return a system's difference from the first, with its interval's half-width."""
        change, half = (
            float(x[place]) * (100.0 if self.percent else 1.0)
            for x in (of.change, of.change_margin)
        )
        if math.isnan(change) or math.isnan(half):
            return None
        places = self.places
        while half > 0.0 and places < 4 and not round(half, places):
            places += 1
        return f"{change:+.{places}f}\N{PLUS-MINUS SIGN}{half:.{places}f}"


_SHARE = _Shown(1, percent=True)

_SHOWN: Mapping[str, _Shown] = {
    "p_even": _SHARE,
    "rating_error": _Shown(2),
    "nights_until_right": _Shown(1),
    "sandbagging_pays": _SHARE,
    "mean_games": _Shown(2),
    "titles_strongest": _Shown(2),
}
"""The table's measures in order, and how each is shown."""

_DETAILS: Sequence[Mapping[str, _Shown]] = (
    {"p_right": _SHARE, "p_doubling_wins": _SHARE, "p_better_wins": _SHARE,
     "titles_weakest": _Shown(2)},
    {"games_a_night": _Shown(1), "changes_a_season": _Shown(1), "drift": _Shown(3)},
)  # fmt: skip
"""The measures of additional tables, shown with the details."""


def _tables(comparison: Comparison, shown: Mapping[str, _Shown]) -> Iterator[Table]:
    """Yield a table with a row per system, and a table of differences from the first."""
    measures, names = comparison.measures, comparison.names
    columns = columns_of("system_compared " + " ".join(f"compared_{key}" for key in shown))
    rows: list[tuple[Any, ...]] = [
        (name, *(how.text(float(measures[key].value[place])) for key, how in shown.items()))
        for place, name in enumerate(names)
    ]
    if len(names) == 1:
        margins = (how.text(float(measures[key].margin[0])) for key, how in shown.items())
        rows.append(("\N{PLUS-MINUS SIGN}", *margins))
    yield Table("", columns, rows)
    if len(names) > 1:
        changes = [
            (name, *(how.difference(measures[key], place) for key, how in shown.items()))
            for place, name in enumerate(names[1:], 1)
        ]
        said = say("Difference from {own}, with a 90% interval:", own=names[0])
        yield Table("", columns, changes, said)


# The tables.


def measures_frame(comparison: Comparison) -> pd.DataFrame:
    """Return every measure for every system, with its difference from the first.

    `margin` and `difference_margin` are half-widths of a 90% interval; measures are the keys of
    `MEASURES`.
    """
    rows = []
    for place, name in enumerate(comparison.names):
        for measure, of in comparison.measures.items():
            row: dict[str, Any] = {
                "system": name,
                "measure": measure,
                "value": float(of.value[place]),
                "standard_error": float(of.error[place]),
                "margin": float(of.margin[place]),
                "difference": float(of.change[place]) if place else None,
                "difference_margin": float(of.change_margin[place]) if place else None,
            }
            rows.append(row)
    return pd.DataFrame(rows)


def deciles_frame(comparison: Comparison) -> pd.DataFrame:
    """Return the results of each part of a league under each system, weakest players first.

    The columns p_even and p_win are the share of their matches that are even and their mean chance
    of winning one; titles are multiples of an equal share, and in a team league go by team
    strength. Each has its standard error.
    """
    return _parts_frame(comparison, ("p_even", "p_win", "titles"), "part", 1)


def nights_frame(comparison: Comparison) -> pd.DataFrame:
    """Return the rating errors by night (0: before the first), and newcomers' since they joined.

    Errors are root mean squares in doublings of the odds, over the cycle of nights that ends with
    this one; each has its standard error.
    """
    return _parts_frame(comparison, ("error", "newcomer_error"), "night", 0)


def _parts_frame(
    comparison: Comparison, measures: Sequence[str], part: str, first: int
) -> pd.DataFrame:
    """Return the measures for parts: a row per system and part, numbered from `first`."""
    estimates = {name: comparison.estimate(PARTS[name]) for name in measures}
    rows = []
    for place, system in enumerate(comparison.names):
        for k in range(estimates[measures[0]].value.shape[1]):
            row: dict[str, Any] = {"system": system, part: k + first}
            for key, of in estimates.items():
                there = k < of.value.shape[1]
                row[key] = float(of.value[place, k]) if there else None
                row[f"{key}_se"] = float(of.error[place, k]) if there else None
            rows.append(row)
    return pd.DataFrame(rows)


def players_frame(comparison: Comparison) -> pd.DataFrame:
    """Return the share of their matches that each player wins under each system."""
    of = comparison.estimate(PARTS["player"])
    players, many = comparison.world.players, len(comparison.world.players)
    names = players.names or [f"player {k}" for k in range(1, many + 1)]
    return pd.DataFrame(
        [
            {"system": system, "player": names[k], "p_win": float(of.value[place, k]),
             "p_win_se": float(of.error[place, k])}
            for place, system in enumerate(comparison.names)
            for k in range(many)
        ]
    )  # fmt: skip
