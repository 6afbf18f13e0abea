"""Who plays a match: two players by their ratings, or by their chances in a game."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from evenbreak.answers.kit.scales import decimals_of, scale_words, two_ratings_doubts
from evenbreak.games.breaks import BREAK_FORMATS, BreakFormat
from evenbreak.games.rack import Rack
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    from evenbreak.handicaps.charts.gap import Gap

FORMATS = {
    "winner": BREAK_FORMATS["winner"],
    "loser": BREAK_FORMATS["loser"],
    "alternate": BREAK_FORMATS["alternate"],
    "a": BREAK_FORMATS["player 1"],
    "b": BREAK_FORMATS["player 2"],
}
"""Break formats as people name them; A is player 1."""


@dataclass(frozen=True)
class TwoPlayers:
    """Two players, A and B, and how a game between them goes.

    Parameters
    ----------
    rack
        their chances in a game.
    breaks, first_breaker
        who breaks, where that matters: the name of a format (`FORMATS`), and 1 or 2.
    ratings, scale
        what the chances come from, if they come from ratings.
    names
        what the two are called.
    errors
        how far each rating may be off (standard errors), if they come from a list.
    form
        how much the log-odds of a game vary from match to match (standard deviation).

    >>> from evenbreak.ratings import scale_of
    >>> print(TwoPlayers.rated(612, 521, scale_of("fargo")).description)
    A rated 612, B rated 521, on the Fargo scale (100 points double the odds)
    >>> print(TwoPlayers(Rack(0.6, 0.5), "winner", 2).description)
    The breaker wins a game with probability 0.6 (A) or 0.5 (B); winner breaks, B breaks first
    """

    rack: Rack[float]
    breaks: str | None = None
    first_breaker: int = 1
    ratings: tuple[float, float] | None = None
    scale: Scale | None = None
    names: tuple[str, str] = ("A", "B")
    errors: tuple[float, float] | None = None
    form: float = 0.0

    @classmethod
    def rated(
        cls,
        rating_a: float,
        rating_b: float,
        scale: Scale,
        names: tuple[str, str] = ("A", "B"),
        errors: tuple[float, float] | None = None,
    ) -> TwoPlayers:
        """Return two players of whom the ratings are known."""
        rack = scale.rack(rating_a - rating_b)
        return cls(rack, ratings=(rating_a, rating_b), scale=scale, names=names, errors=errors)

    @property
    def break_format(self) -> BreakFormat | None:
        """Who breaks the next game, or None where it does not matter."""
        return None if self.breaks is None else FORMATS[self.breaks]

    @property
    def p_game_a(self) -> float | None:
        """P(A wins a game), or None where that depends on who breaks."""
        return None if self.rack.break_matters else float(self.rack.p1)

    @property
    def difference(self) -> float:
        """The rating of A minus that of B, 0 where there are none."""
        first, second = self.ratings or (0.0, 0.0)
        return first - second

    @property
    def error(self) -> float:
        """The standard error of the difference of the ratings, 0 where they are taken as right."""
        return math.hypot(*self.errors) if self.errors else 0.0

    @property
    def gap(self) -> Gap:
        """By how much A is rated above B; without ratings, the log-odds of a game."""
        from evenbreak.handicaps.charts.gap import Gap

        if self.scale is not None:
            return Gap(self.difference, self.error, self.scale, self.form)
        p = self.rack.p1
        return Gap(math.log(p) - math.log1p(-p), 0.0, Scale("log-odds", math.log(2.0)), self.form)

    @property
    def named(self) -> dict[str, Any]:
        """The names and the form, for JSON, where there are any."""
        a, b = self.names
        names = {} if (a, b) == ("A", "B") else {"player_a": a, "player_b": b}
        return {**names, **({"form": self.form} if self.form else {})}

    @property
    def averaged(self) -> str:
        """The sentence that chances are averaged over errors, '' where there are none."""
        if not self.error:
            return ""
        return "All of this is averaged over how far the ratings may be off (\N{PLUS-MINUS SIGN})."

    @property
    def by_form(self) -> str:
        """The sentence that form of the day is allowed for, '' where it is not."""
        if not self.form:
            return ""
        from evenbreak.answers.kit.scales import form_used_words

        return form_used_words(self.form, self.scale)

    @property
    def taken_as_right(self) -> str:
        """The sentence that the ratings are taken as right, '' where they are not in doubt."""
        if not self.error:
            return ""
        return (
            "Both ratings are taken as right here; evenbreak odds averages over how far they may "
            "be off."
        )

    @property
    def doubts(self) -> list[str]:
        """What is unusual in the ratings."""
        if self.ratings is None or self.scale is None:
            return []
        return two_ratings_doubts(self.scale, *self.ratings)

    @property
    def description(self) -> str:
        """Who they are, in a line."""
        a, b = self.names
        if self.ratings is not None and self.scale is not None:
            first, second = (self._rating(k) for k in (0, 1))
            return f"{a} rated {first}, {b} rated {second}, {scale_words(self.scale)}"
        if self.breaks is None:
            return f"{a} wins a game with probability {self.rack.p1:g}"
        p1, p2 = self.rack.p1, self.rack.p2
        text = f"The breaker wins a game with probability {p1:g} ({a}) or {p2:g} ({b})"
        usual = 2 if self.breaks == "b" else 1
        always = self.breaks in ("a", "b")
        who = self.names["ab".index(self.breaks)] if always else self.breaks
        text += f"; {who} {'always breaks' if always else 'breaks'}"
        if self.first_breaker != usual or not always:
            text += f", {self.names[self.first_breaker - 1]} breaks first"
        return text

    def _rating(self, k: int) -> str:
        """Return a rating as text, with its error if it has one."""
        if self.ratings is None or self.scale is None or self.errors is None:
            return f"{(self.ratings or (0.0, 0.0))[k]:g}"
        decimals = decimals_of(self.scale)
        error = f" \N{PLUS-MINUS SIGN} {self.errors[k]:.{decimals}f}" if self.errors[k] else ""
        return f"{self.ratings[k]:.{decimals}f}{error}"
