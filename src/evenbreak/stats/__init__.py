"""Statistics of scores: what to expect of games won, runs and innings, and what scores tell.

This room knows numbers only: no game, no chain, no file.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "counts": ["CountLaw"],
        "exact": ["exact"],
    },
)
