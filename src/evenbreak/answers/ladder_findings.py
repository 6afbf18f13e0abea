"""What one ladder says, each quantity worked out once, when it is first needed."""

from collections.abc import Callable
from functools import cached_property
from typing import NamedTuple, TypeVar

from evenbreak.chains.ways import Way
from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps.ladders.inflation import NewcomerInflation, inflation, newcomer_inflation
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.mixing import ladder_gap, ladder_mixing
from evenbreak.handicaps.ladders.settling import Settling, settling
from evenbreak.handicaps.ladders.unfairness import better_off, unfairness
from evenbreak.stats.summary import Distribution

Part = TypeVar("Part")


class LadderQuestion(NamedTuple):
    """What is asked of a ladder besides its distribution of rating errors.

    Parameters
    ----------
    start
        the rating error of the player whose settling is followed, in points.
    within
        an error of at most this many points counts as settled.
    newcomer
        whether that player moves by the system's newcomer steps.
    opponents
        who the opponents are: natural, autocorrelated, equal skill or league.
    via
        the way to the distribution, as for `Ladder.law`.
    """

    start: int
    within: int
    newcomer: bool
    opponents: str
    via: Way | None = None


class LadderFindings:
    """What a ladder says.

    Parameters
    ----------
    ladder
        the ladder.
    question
        what is asked of it.

    Attributes
    ----------
    missing
        why parts that are None could not be worked out, a sentence each.
    """

    def __init__(self, ladder: Ladder, question: LadderQuestion) -> None:
        self.ladder, self.question = ladder, question
        self.missing: list[str] = []

    @cached_property
    def law(self) -> Distribution:
        """The distribution of the rating error in the long run, in points."""
        return self.ladder.law(via=self.question.via)

    @cached_property
    def off(self) -> Distribution:
        """The distribution of the size of the error."""
        return Distribution.of(map(abs, self.law.values), self.law.probability)

    @cached_property
    def natural(self) -> Distribution | None:
        """The same with correctly rated opponents and skills that stay; None where it is `law`."""
        ladder = self.ladder
        steady = not (ladder.day_sd or ladder.match_sd or ladder.drift)
        if steady and self.question.opponents == "natural":
            return None
        return Ladder(ladder.system, ladder.chart, widest=ladder.widest).law()

    @cached_property
    def favourite(self) -> Distribution:
        """The distribution of the favourite's chance to win a match of the player."""
        return better_off(unfairness(self.ladder))

    @cached_property
    def inflation(self) -> float:
        """How much a match raises the sum of the two ratings, in points."""
        return inflation(self.ladder)

    @cached_property
    def newcomer_inflation(self) -> NewcomerInflation:
        """What a newcomer with the error `start` does to the sum of the league's errors."""
        return newcomer_inflation(self.ladder, self.question.start)

    @cached_property
    def settling(self) -> Settling | None:
        """How long a player takes whose rating starts wrong."""
        asked = self.question
        return self._unless_missing(
            lambda: settling(self.ladder, asked.start, asked.within, newcomer=asked.newcomer)
        )

    @cached_property
    def gap(self) -> float | None:
        """1 less the largest eigenvalue below 1; -1 is set aside."""
        slow = "how fast old errors fade is not shown: they fade too slowly to be calculated"
        return self._unless_missing(lambda: ladder_gap(self.ladder), slow)

    @cached_property
    def mixing_matches(self) -> int | None:
        """The matches until an error that began at `start` is within 1/4 of the long run."""
        slow = "how long the start matters is not shown: it is more than 100,000 matches"
        return self._unless_missing(lambda: ladder_mixing(self.ladder, self.question.start), slow)

    def _unless_missing(self, part: Callable[[], Part], why: str = "") -> Part | None:
        """Return a part, or None after noting why there is none (`why`, or the error's words)."""
        try:
            return part()
        except (AccuracyError, InputError) as error:
            self.missing.append(why or f"how soon a rating settles is not shown: {error}")
        return None
