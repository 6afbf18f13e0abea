"""Markov chains and their stochastic limits; nothing here knows what a game is about."""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "chain": ["Chain"],
        "symbolic": ["symbolic_limit"],
    },
)
