"""Rating errors in the long run, and their effect on matches and newcomers."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import Any, NamedTuple, TypeVar

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import by_way
from evenbreak.answers.kit.columns import columns_of, in_files, quantities_of, table_by_column
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.wording import count_of, percent
from evenbreak.chains.ways import Way
from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps.ladders.comparison import NewcomerInflation, inflation, newcomer_inflation
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.settling import Settling, ladder_gap, ladder_mixing, settling
from evenbreak.handicaps.ladders.unfairness import CLEAR_FAVORITE, better_off, unfairness
from evenbreak.stats.summary import Distribution

QUANTILES = (0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99)
AFTER = (10, 20, 50, 100, 200)
"""The numbers of matches for which JSON says how many players have settled."""

SHARES = (0.5, 0.75, 0.9, 0.95, 0.99)
"""The shares of ratings whose largest error is shown."""

OPPONENTS = {
    "natural": "Opponents are as good as the player, with correct ratings.",
    "autocorrelated": "Opponents are rated at the player's skill, with rating errors like the "
    "player's.",
    "equal skill": "Opponents are as good as the player, with rating errors like the player's.",
    "league": "Opponents are drawn from the league, with rating errors like the player's.",
}
"""A description of the opponents for each term."""

_FEW, _ALL = 0.1, 0.995
"""Chances below the first are written as one in N, and those above the second as nearly all."""


def ladder_answer(found: LadderFindings, warnings: Sequence[str] = ()) -> Answer:
    """Return how far off ratings are on a ladder; in files, one row per rating error."""
    said = [_how_far_off(found), _how_unfair(found.favorite), _how_soon(found)]
    if abs(found.inflation) >= 0.005:
        said.append(_inflation(found.inflation))
    shares = [(f"{100 * share:g}%", found.off.quantile(share)) for share in SHARES]
    columns = columns_of("of_ratings off_by")
    return Answer(
        _heading(found),
        [*filter(None, said), Table("", columns, shares), *_way(found)],
        details=[_statistics(found), *_how_soon_forgotten(found)],
        warnings=[*warnings, *found.missing],
        data=_data(found),
        csv=_errors(found),
    )


def _way(found: LadderFindings) -> list[Part]:
    via = found.question.via
    if via is None:
        return []
    kernel = found.ladder.law().probability
    return by_way(via, zip(found.law.probability, kernel, strict=True))


def ladder_title(ladder: Ladder) -> str:
    """Return the chart and system in short form."""
    return f"chart {ladder.chart.name}, system {ladder.system.name}"


def _heading(found: LadderFindings) -> str:
    ladder = found.ladder
    rule = ladder.system.in_words
    lines = [
        f"Ratings in the long run: {ladder_title(ladder)}",
        f"{rule[:1].upper()}{rule[1:]}.",
        OPPONENTS[found.question.opponents],
    ]
    if ladder.day_sd:
        many = count_of(ladder.matches_a_night, "match", "matches")
        lines.append(f"{_form('night', ladder.day_sd)}; {many} a night.")
    if ladder.match_sd:
        lines.append(f"{_form('match', ladder.match_sd)}.")
    if ladder.drift:
        way = "rises" if ladder.drift > 0.0 else "falls"
        chance = percent(abs(ladder.drift))
        lines.append(
            f"After each match there is a {chance} chance that the player's skill {way} by "
            f"one point: {abs(ladder.drift):g} points a match on average."
        )
    return "\n".join(lines)


def _form(when: str, sd: float) -> str:
    return (
        f"Everyone's form varies from {when} to {when}, by up to {sd:g} points two-thirds of the "
        f"time"
    )


def _how_far_off(found: LadderFindings) -> str:
    law, within = found.law, found.question.within
    most = "9 out of 10 ratings are"
    if abs(law.mean) >= 0.05:
        most = (
            f"a rating is {_too(law.mean, f'{abs(law.mean):.1f}')} on average, and 9 out of 10 are"
        )
    first, *more = [
        (of_100(found.off.at_least(many + 1)), many) for many in dict.fromkeys((within, 2 * within))
    ]
    farther = "".join(f", {often} by more than {many}" for often, many in more)
    return (
        f"In the long run, {most} within {found.off.quantile(0.9):g} points of the player's skill; "
        f"{first[0]} are off by more than {first[1]} points{farther}."
    )


def _how_unfair(favorite: Distribution) -> str:
    often = favorite.at_least(CLEAR_FAVORITE)
    return (
        "Because of these errors, matches that should be even have a favorite who wins "
        f"{100.0 * favorite.mean:.1f}% of the time on average, and {of_100(often)} of the matches "
        f"have a clear favorite, with a chance of {100 * CLEAR_FAVORITE:g}% or more."
    )


def _how_soon(found: LadderFindings) -> str:
    asked, settled = found.question, found.settling
    if settled is None:
        return ""
    if abs(asked.start) <= asked.within:
        off = count_of(abs(asked.start), "point")
        return f"A rating off by {off} counts as settled from the start."
    law = settled.matches
    wrong = _too(asked.start, str(abs(asked.start)))
    who = f"A player rated {wrong}"
    if asked.newcomer:
        who = f"A newcomer rated {wrong}, with the longer newcomer steps,"
    text = (
        f"{who} comes within {count_of(asked.within, 'point')} of their skill after "
        f"{settled.mean:.1f} matches "
        f"on average; half of such players need at most {law.quantile(0.5)} matches, and 9 "
        f"out of 10 at most {law.quantile(0.9)}."
    )
    return f"{text} {_who_pays(found)}" if asked.newcomer else text


def _who_pays(found: LadderFindings) -> str:
    left = found.newcomer_inflation.left
    return (
        "The longer steps correct only part of the error; the other players' ratings make up for "
        f"the rest: they {'fall' if left < 0 else 'rise'} by {abs(left):.1f} points in total."
    )


def _inflation(added: float) -> str:
    verb, what = ("raises", "inflate") if added > 0 else ("lowers", "deflate")
    return (
        f"Ratings {what}: each match {verb} the sum of the two ratings by {abs(added):.2f} points "
        "on average. The results do not show it, because everyone's rating moves together."
    )


def _statistics(found: LadderFindings) -> Quantities:
    natural = None if found.natural is None else found.natural.sd
    return Quantities(
        quantities_of(
            {"error_sd": found.law.sd, "error_mean": found.law.mean, "natural_sd": natural}
        ),
        in_json=False,
    )


def _how_soon_forgotten(found: LadderFindings) -> Iterator[str]:
    start = found.question.start
    if found.gap is not None and found.gap < 1.0:
        half = math.log(0.5) / math.log1p(-found.gap)
        every = "match" if half < 1.5 else f"{half:,.0f} matches"
        yield (
            f"In the long run, an old error halves every {every}: each match removes "
            f"{100 * found.gap:.2f}% of what is left (the spectral gap)."
        )
    if found.mixing_matches is not None:
        started = f"started {_too(start, str(abs(start)))}" if start else "started right"
        yield (
            f"After {count_of(found.mixing_matches, 'match', 'matches')} a rating that {started} "
            "is hardly distinguishable from any other: no probability differs from its long-run "
            "value by more than 0.25 (the total variation distance)."
        )


def _errors(found: LadderFindings) -> Table:
    law, ladder = found.law, found.ladder
    columns = in_files(("error", "probability", "cumulative", "p_win"))
    values = (ladder.errors, map(float, law.probability), map(float, law.cumulative), ladder.wins)
    return table_by_column("distribution", dict(zip(columns, values, strict=True)))


def _data(found: LadderFindings) -> dict[str, Any]:
    ladder, asked, law, favorite = found.ladder, found.question, found.law, found.favorite
    return {
        "system": ladder.system.name,
        "scale": ladder.system.scale.name,
        "points_per_doubling": ladder.system.scale.points_per_doubling,
        "chart": ladder.chart.name,
        "opponents": asked.opponents,
        "day_sd": ladder.day_sd,
        "matches_a_night": ladder.matches_a_night,
        "match_sd": ladder.match_sd,
        "drift": ladder.drift,
        "sd": law.sd,
        "mean": law.mean,
        "quantiles": _quantiles(law),
        "off_by_quantiles": _quantiles(found.off),
        "off_by_more": {
            str(many): found.off.at_least(many + 1) for many in (asked.within, 2 * asked.within)
        },
        "natural_sd": law.sd if found.natural is None else found.natural.sd,
        "unfairness": {
            "mean_off_even": favorite.mean - 0.5,
            "favorite_mean": favorite.mean,
            "favorite_over_60": favorite.at_least(CLEAR_FAVORITE),
            "favorite_quantiles": _quantiles(favorite),
        },
        "inflation": found.inflation,
        "newcomer_leaves": found.newcomer_inflation.left,
        "gap": found.gap,
        "mixing_matches": found.mixing_matches,
        "settling": _settling(found.settling),
    }


def _settling(settled: Settling | None) -> dict[str, Any] | None:
    if settled is None:
        return None
    return {
        "start": settled.start,
        "within": settled.within,
        "newcomer": settled.newcomer,
        "mean": settled.mean,
        "sd": settled.sd,
        "quantiles": _quantiles(settled.matches),
        "after": {str(many): settled.after(many) for many in AFTER},
    }


def _quantiles(law: Distribution) -> dict[str, Any]:
    return {f"{q:g}": law.quantile(q) for q in QUANTILES}


def _too(error: float, size: str) -> str:
    """Return in what direction a rating is wrong.

    >>> _too(-30.0, "30"), _too(1.0, "1")
    ('30 points too low', '1 point too high')
    """
    return f"{size} point{'s' * (size != '1')} too {'high' if error > 0 else 'low'}"


def of_100(chance: float) -> str:
    """Return a frequency, in words.

    >>> of_100(0.2513), of_100(0.0142), of_100(0.0)
    ('25%', '1 in 70', 'none')
    """
    if chance < 1e-9:
        return "none"
    if chance > _ALL:
        return "nearly all"
    return f"1 in {1.0 / chance:,.0f}" if chance < _FEW else f"{100.0 * chance:.0f}%"


Found = TypeVar("Found")


class LadderQuestion(NamedTuple):
    """What to calculate for a ladder besides its distribution of rating errors.

    `start` is the initial error, in points, of the player who is followed until they settle, with
    newcomer steps if `newcomer`; an error of at most `within` points counts as settled.
    """

    start: int
    within: int
    newcomer: bool
    opponents: str
    via: Way | None = None


class LadderFindings:
    """A ladder's results; `missing` says why those that are None couldn't be calculated."""

    def __init__(self, ladder: Ladder, question: LadderQuestion) -> None:
        self.ladder, self.question = ladder, question
        self.missing: list[str] = []

    @cached_property
    def law(self) -> Distribution:
        """The long-run distribution of the rating error, in points."""
        return self.ladder.law(via=self.question.via)

    @cached_property
    def off(self) -> Distribution:
        """The distribution of the error's size."""
        return Distribution.of(map(abs, self.law.values), self.law.probability)

    @cached_property
    def natural(self) -> Distribution | None:
        """The same with correctly rated opponents and constant skills; None if that is `law`."""
        ladder = self.ladder
        steady = not (ladder.day_sd or ladder.match_sd or ladder.drift)
        if steady and self.question.opponents == "natural":
            return None
        return Ladder(ladder.system, ladder.chart, widest=ladder.widest).law()

    @cached_property
    def favorite(self) -> Distribution:
        """The distribution of the favorite's chance of winning one of the player's matches."""
        return better_off(unfairness(self.ladder))

    @cached_property
    def inflation(self) -> float:
        """How much a match raises the sum of the two ratings, in points."""
        return inflation(self.ladder)

    @cached_property
    def newcomer_inflation(self) -> NewcomerInflation:
        """How a newcomer with the error `start` changes the sum of the league's errors."""
        return newcomer_inflation(self.ladder, self.question.start)

    @cached_property
    def settling(self) -> Settling | None:
        """How long it takes a player whose rating starts out wrong."""
        asked = self.question
        return self._unless_missing(
            lambda: settling(self.ladder, asked.start, asked.within, newcomer=asked.newcomer)
        )

    @cached_property
    def gap(self) -> float | None:
        """1 minus the largest eigenvalue below 1; -1 is set aside."""
        slow = "how fast old errors fade is not shown: they fade too slowly to be calculated"
        return self._unless_missing(lambda: ladder_gap(self.ladder), slow)

    @cached_property
    def mixing_matches(self) -> int | None:
        """The matches until an error that started at `start` is within 1/4 of the long run."""
        slow = "how long the start matters is not shown: it is more than 100,000 matches"
        return self._unless_missing(lambda: ladder_mixing(self.ladder, self.question.start), slow)

    def _unless_missing(self, part: Callable[[], Found], why: str = "") -> Found | None:
        """Return a part, or None after noting why it is missing (`why`, or the error's words)."""
        try:
            return part()
        except (AccuracyError, InputError) as error:
            self.missing.append(why or f"how soon a rating settles is not shown: {error}")
        return None
