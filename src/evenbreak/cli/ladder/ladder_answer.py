"""All that `evenbreak ladder` reads off one ladder, and how it stands in JSON."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from evenbreak.cli.kit.output import SCHEMA_VERSION
from evenbreak.handicaps.ladders.unfairness import CLEAR_FAVOURITE

if TYPE_CHECKING:
    from collections.abc import Callable

    from evenbreak.handicaps.ladders.inflation import NewcomerInflation
    from evenbreak.handicaps.ladders.ladder import Ladder
    from evenbreak.handicaps.ladders.settling import Settling
    from evenbreak.stats.summary import Distribution

Part = TypeVar("Part")

COLUMNS = ("error", "probability", "cumulative", "p_win")

QUANTILES = (0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99)
AFTER = (10, 20, 50, 100, 200)
"""The numbers of matches after which it is told how many have settled."""


OPPONENTS = {
    "natural": "Opponents are as good as the player, and rated rightly.",
    "autocorrelated": "Opponents are rated at the player's skill, and off by what he is off by.",
    "equal skill": "Opponents are as good as the player, and rated as wrongly as he is.",
    "league": "Opponents are drawn from the league, their ratings as wrong as the player's.",
}
"""Who the opponents are, by the word for it."""


class Question(NamedTuple):
    """What is asked of a ladder besides its law.

    Parameters
    ----------
    start
        the rating error of the player whose settling is told, in points.
    within
        settled is an error of at most so many points.
    newcomer
        whether he moves by the system's newcomer schedule.
    opponents
        who they are, in a word: natural, autocorrelated, equal skill or league.
    """

    start: int
    within: int
    newcomer: bool
    opponents: str


class LadderAnswer:
    """What a ladder says, each quantity worked out when it is first asked for."""

    def __init__(self, ladder: Ladder, question: Question) -> None:
        self.ladder, self.question = ladder, question
        self.not_told: list[str] = []

    @cached_property
    def law(self) -> Distribution:
        """The law of the rating error in the long run, in points."""
        return self.ladder.law()

    @cached_property
    def off(self) -> Distribution:
        """The law of the size of the error."""
        from evenbreak.stats.summary import Distribution

        return Distribution.of(map(abs, self.law.values), self.law.probability)

    @cached_property
    def natural(self) -> Distribution | None:
        """The law with opponents rated rightly and skill that stays; None where it is this one."""
        from evenbreak.handicaps.ladders.ladder import Ladder

        ladder = self.ladder
        steady = not (ladder.day_sd or ladder.match_sd or ladder.drift)
        if steady and self.question.opponents == "natural":
            return None
        return Ladder(ladder.system, ladder.chart, widest=ladder.widest).law()

    @cached_property
    def favourite(self) -> Distribution:
        """The law of the favourite's chance to win a match of the player."""
        from evenbreak.handicaps.ladders.unfairness import better_off, unfairness

        return better_off(unfairness(self.ladder))

    @cached_property
    def inflation(self) -> float:
        """By how much a match raises the sum of the two ratings, in points."""
        from evenbreak.handicaps.ladders.inflation import inflation

        return inflation(self.ladder)

    @cached_property
    def newcomer_inflation(self) -> NewcomerInflation:
        """What a newcomer with the error `start` does to the sum of the league's errors."""
        from evenbreak.handicaps.ladders.inflation import newcomer_inflation

        return newcomer_inflation(self.ladder, self.question.start)

    @cached_property
    def settling(self) -> Settling | None:
        """How long a player takes whose rating begins wrong; None where `not_told` says why."""
        from evenbreak.handicaps.ladders.settling import settling

        asked = self.question
        return self._or_not_told(
            lambda: settling(self.ladder, asked.start, asked.within, newcomer=asked.newcomer)
        )

    @cached_property
    def gap(self) -> float | None:
        """1 less the largest eigenvalue below 1; -1 is set aside."""
        from evenbreak.handicaps.ladders.mixing import ladder_gap

        slow = "old errors fade so slowly that rounding hides how slowly"
        return self._or_not_told(lambda: ladder_gap(self.ladder), slow)

    @cached_property
    def mixing_matches(self) -> int | None:
        """The matches after which an error begun at `start` is within 1/4 of its limit law."""
        from evenbreak.handicaps.ladders.mixing import ladder_mixing

        slow = "a rating can still be told from any other after more than 100,000 matches"
        return self._or_not_told(lambda: ladder_mixing(self.ladder, self.question.start), slow)

    def _or_not_told(self, part: Callable[[], Part], why: str = "") -> Part | None:
        """Return a part of the answer, or note why it cannot be had and let the rest be told.

        `why` is said in place of the function's own words, which would name functions.
        """
        from evenbreak.errors import AccuracyError, InputError

        try:
            return part()
        except (AccuracyError, InputError) as error:
            self.not_told.append(why or str(error))
        return None


def rows(found: LadderAnswer) -> list[tuple[int, float, float, float]]:
    """Return a row for each rating error, with the `COLUMNS`."""
    law = found.law
    chance = dict(zip(law.values, zip(law.probability, law.cumulative, strict=True), strict=True))
    wins = zip(found.ladder.errors.tolist(), found.ladder.wins.tolist(), strict=True)
    return [(error, *map(float, chance[error]), win) for error, win in wins]


def as_json(found: LadderAnswer) -> dict[str, Any]:
    """Return what --json prints of a ladder."""
    ladder, law, asked, favourite = found.ladder, found.law, found.question, found.favourite
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
        "distribution": [
            {"error": error, "probability": float(chance)}
            for error, chance in zip(law.values, law.probability, strict=True)
        ],
        "quantiles": {f"{q:g}": law.quantile(q) for q in QUANTILES},
        "off_by_quantiles": {f"{q:g}": found.off.quantile(q) for q in QUANTILES},
        "off_by_more": {
            str(many): found.off.at_least(many + 1) for many in (asked.within, 2 * asked.within)
        },
        "natural_sd": law.sd if found.natural is None else found.natural.sd,
        "unfairness": {
            "mean_off_even": favourite.mean - 0.5,
            "favourite_mean": favourite.mean,
            "favourite_over_60": favourite.at_least(CLEAR_FAVOURITE),
            "favourite_quantiles": {f"{q:g}": favourite.quantile(q) for q in QUANTILES},
        },
        "inflation": found.inflation,
        "newcomer_leaves": found.newcomer_inflation.left,
        "gap": found.gap,
        "mixing_matches": found.mixing_matches,
        "settling": _settling(found.settling),
        "schema_version": SCHEMA_VERSION,
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
        "quantiles": {f"{q:g}": settled.matches.quantile(q) for q in QUANTILES},
        "after": {str(many): settled.after(many) for many in AFTER},
    }
