"""Markov chains and their stochastic limits; nothing here knows what a game is about."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
