"""What all matches share: racks are played, a score is kept, the break passes on.

A match can itself be the rack of a longer match: a race whose rack is a race is a match of
sets, and so on to any depth.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass
from typing import Any, Generic, TypeAlias

from evenbreak.checks import one_of, whole
from evenbreak.errors import InputError
from evenbreak.games.breaks import BreakFormat, checked_format
from evenbreak.games.rack import ChanceT, Rack

Score: TypeAlias = tuple[int, int]


@dataclass(frozen=True)
class Match(ABC, Generic[ChanceT]):
    """Base of `Race` and `Ahead`: a score a:b that grows rack by rack until one player wins.

    Parameters
    ----------
    m, n
        what player 1 and player 2 need.
    rack
        what is played for one point of the score: a `Rack`, or another match (a set).
    breaks
        who breaks next (see `evenbreak.games.breaks`); needed if the break matters. In a
        match of sets it decides who breaks first in the next set, given who broke first in
        the last one and who won it; with None the set's own format carries on across sets.
    first_breaker
        who breaks the first rack to be played, 1 or 2.
    score
        the score to begin with: games on the wire, or a match under way.

    Notes
    -----
    A state is (a, b) if the break does not matter, (a, b, breaker) if it does, and (a, b,
    state of the set) in a match of sets, with the set's first breaker before the set's state
    if the match has its own break format. Scores that differ only in racks that no longer
    matter are one state, so even a match without a longest length has a finite graph.
    """

    m: int
    n: int
    rack: Rack[ChanceT] | Match[ChanceT]
    _: KW_ONLY
    breaks: BreakFormat | None = None
    first_breaker: int = 1
    score: Score = (0, 0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "m", whole(self.m, "m", at_least=1))
        object.__setattr__(self, "n", whole(self.n, "n", at_least=1))
        if not isinstance(self.rack, (Rack, Match)):
            raise InputError(f"rack is {self.rack!r}; give a Rack(p), a Rack(p1, p2) or a match")
        if isinstance(self.rack, Match) and self.rack.decided(*self.rack.score) is not None:
            raise InputError(
                "rack is a set that is over at its start score; give a set that is not"
            )
        if isinstance(self.rack, Rack) and self.rack.break_matters and self.breaks is None:
            raise InputError(
                "breaks is missing, and in Rack(p1, p2) the break matters; "
                "give one such as breaks=winner_breaks"
            )
        if self.breaks is not None:
            checked_format(self.breaks)
        first = one_of(self.first_breaker, "first_breaker", (1, 2))
        object.__setattr__(self, "first_breaker", first)
        try:
            a, b = self.score
        except (TypeError, ValueError):
            raise InputError(
                f"score is {self.score!r}; give the games of both players, as (2, 1)"
            ) from None
        self._check_score(whole(a, "score of player 1"), whole(b, "score of player 2"))

    def _check_score(self, a: int, b: int) -> None:
        object.__setattr__(self, "score", (a, b))
        before = self._played_from(a, b)
        last_winner = self.decided(a, b)
        if last_winner is not None:
            only = (a - 1, b) if last_winner == 1 else (a, b - 1)
            before = [x for x in before if x == only and (x == (0, 0) or self._played_from(*x))]
        if not before and (a, b) != (0, 0):
            raise InputError(
                f"score is {a}:{b}, which cannot be reached: {type(self).__name__} "
                f"{self.m}:{self.n} is over before it"
            )

    def _played_from(self, a: int, b: int) -> list[Score]:
        """Return the scores one rack before a:b at which the match goes on."""
        return [
            (x, y)
            for x, y in ((a - 1, b), (a, b - 1))
            if min(x, y) >= 0 and self.decided(x, y) is None
        ]

    @abstractmethod
    def decided(self, a: int, b: int) -> int | None:
        """Return who has won at the score a:b: 1, 2, or None while the match goes on."""

    @abstractmethod
    def fold(self, a: int, b: int) -> Score:
        """Return the first score from which the match goes on as it does from a:b."""

    @property
    def break_matters(self) -> bool:
        """Whether the chances depend on who breaks."""
        return self.rack.break_matters

    @property
    def innermost_rack(self) -> Rack[ChanceT]:
        """The rack at the bottom of a match of sets, or of sets of sets."""
        return self.rack if isinstance(self.rack, Rack) else self.rack.innermost_rack

    @property
    def start(self) -> Any:
        """The state before the first rack."""
        self.innermost_rack.of_numbers()
        return self.open(self.first_breaker)

    def open(self, breaker: int) -> Any:
        """Return the state before the first rack, given that `breaker` breaks it."""
        return self._state(self.score, breaker)

    def moves(self, state: Any) -> Mapping[Any, float]:
        """Return the probability of each next state, given `state`; one rack is played."""
        a, b, *rest = state
        if self.decided(a, b) is not None:
            return {}
        if isinstance(self.rack, Rack):
            return self._after_rack(a, b, rest[0] if rest else 1, self.rack)
        return self._after_rack_of_set(a, b, rest, self.rack)

    def winner(self, state: Any) -> int | None:
        """Return who has won in `state`: 1, 2, or None while the match goes on."""
        return self.decided(state[0], state[1])

    def next_breaker(self, state: Any) -> int:
        """Return who would break the rack after a finished match: the last entry of its state."""
        return int(state[2]) if self.break_matters else 1

    def _after_rack(self, a: int, b: int, breaker: int, rack: Rack) -> dict[Any, float]:
        return {
            self._state(
                (a + 1, b) if winner == 1 else (a, b + 1),
                self.breaks(breaker, winner) if self.breaks else breaker,
            ): chance
            for winner in (1, 2)
            if (chance := rack.chance(winner, breaker)) > 0.0
        }

    def _after_rack_of_set(self, a: int, b: int, rest: list[Any], rack: Match) -> dict[Any, float]:
        *opener, inner = rest
        result: dict[Any, float] = {}
        for after, chance in rack.moves(inner).items():
            winner = rack.winner(after)
            if winner is None:
                target: Any = (a, b, *opener, after)
            else:
                score = (a + 1, b) if winner == 1 else (a, b + 1)
                carried = rack.next_breaker(after)
                target = self._state(
                    score, self.breaks(opener[0], winner) if opener and self.breaks else carried
                )
            result[target] = result.get(target, 0.0) + chance
        return result

    def _state(self, score: Score, breaker: int) -> Any:
        folded = self.fold(*score)
        if isinstance(self.rack, Rack) or self.decided(*folded) is not None:
            return (*folded, breaker) if self.break_matters else folded
        opener = (breaker,) if self.breaks and self.break_matters else ()
        return (*folded, *opener, self.rack.open(breaker))
