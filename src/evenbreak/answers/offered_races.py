"""Which races players are offered, and the fairest of them."""

from dataclasses import dataclass

from numpy.typing import ArrayLike

from evenbreak.answers.wording import count_of
from evenbreak.arrays import Ints
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.given_ratings import fair_races_given_ratings
from evenbreak.ratings.scale import Scale


@dataclass(frozen=True)
class OfferedRaces:
    """The races on offer: limited by their longest match, or by what the stronger player needs.

    Parameters
    ----------
    games
        the races m:n with games[0] <= m + n - 1 <= games[1].
    race_to
        instead: the races in which the stronger player needs this many games.

    Raises
    ------
    InputError
        if both are given, or neither.

    >>> OfferedRaces(race_to=7).in_words
    'The fairest races in which the stronger player needs 7 games.'
    """

    games: tuple[int, int] | None = None
    race_to: int | None = None

    def __post_init__(self) -> None:
        if (self.games is None) == (self.race_to is None):
            raise InputError(
                f"games is {self.games!r} and race_to is {self.race_to!r}; give exactly one of them"
            )

    def fairest(
        self, gap: ArrayLike, error: ArrayLike, scale: Scale, form: float = 0.0
    ) -> tuple[Ints, Ints]:
        """Return (m, n), the races nearest to even for these rating differences.

        Chances are averaged over how far each difference may be off, `error` being its
        standard error; 0 takes the ratings as right. They are averaged over form of the day too.
        """
        return fair_races_given_ratings(
            gap, error, games=self.games, race_to=self.race_to, scale=scale, form=form
        )

    @property
    def in_words(self) -> str:
        """What was chosen from, in a sentence."""
        if self.games is None:
            needs = count_of(self.race_to or 0, "game")
            return f"The fairest races in which the stronger player needs {needs}."
        low, high = self.games
        span = f"{low:,} to " if low < high else ""
        text = f"The fairest races whose longest match has {span}{count_of(high, 'game')}"
        return f"{text}; each pair gets the most even one." if low < high else f"{text}."
