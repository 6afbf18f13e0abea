"""The limits within which a number is accepted, and their wording."""

from __future__ import annotations

import math
from typing import NamedTuple


class Limits(NamedTuple):
    """The allowed range: from `low` to `high`, and between `above` and `below`."""

    low: float
    high: float
    above: float
    below: float

    def hold(self, least: float, most: float) -> bool:
        """Return whether `least` and `most` are within the limits; NaN never is."""
        return bool(
            self.above < least and most < self.below and self.low <= least and most <= self.high
        )

    def numbers(self, *, many: bool = False) -> str:
        """Return the wording for the numbers within the limits.

        >>> Limits(-math.inf, 2, 0, math.inf).numbers()
        'a number above 0, at most 2'
        >>> Limits(0, math.inf, -math.inf, math.inf).numbers(many=True)
        'finite numbers, 0 or more'
        """
        finite = "finite " if math.isinf(self.high) and math.isinf(self.below) else ""
        what = f"{finite}numbers" if many else f"a {finite}number"
        if math.isfinite(self.low) and math.isfinite(self.high):
            return f"{what} from {self.low:g} to {self.high:g}"
        if math.isfinite(self.above) and math.isfinite(self.below):
            return f"{what} between {self.above:g} and {self.below:g}"
        limits = (
            (self.above, " above {:g}"),
            (self.low, ", {:g} or more"),
            (self.below, " below {:g}"),
            (self.high, ", at most {:g}"),
        )
        return what + "".join(text.format(limit) for limit, text in limits if math.isfinite(limit))
