"""Handicaps: what makes an uneven game even.

`fair` finds the races that come nearest to a chance that was asked for.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, {"fair": ["FairRace", "fair_races"]})
