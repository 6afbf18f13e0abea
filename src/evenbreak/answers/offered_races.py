"""Which races players are offered, and the fairest of them."""

from __future__ import annotations

from dataclasses import dataclass

from evenbreak.answers.wording import count_of
from evenbreak.errors import InputError
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.fair import FairRace, fair_races


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

    def fairest(self, p: float) -> FairRace:
        """Return the race nearest to even, given P(player 1 wins a game)."""
        return fair_races(Rack(p), games=self.games, race_to=self.race_to, top=1)[0]

    @property
    def in_words(self) -> str:
        """What was chosen from, in a sentence."""
        if self.games is None:
            needs = count_of(self.race_to or 0, "game")
            return f"The fairest races in which the stronger player needs {needs}."
        low, high = self.games
        span = f"{low:,} to " if low < high else ""
        text = f"The fairest races whose longest possible match has {span}{count_of(high, 'game')}"
        return f"{text}; each pair gets the most even of them." if low < high else f"{text}."
