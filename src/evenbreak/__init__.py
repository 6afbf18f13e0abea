"""Match and handicap analytics for pool, from Markov chains.

A game is a directed graph; the graph is a transition matrix; the matrix has a
stochastic limit; every answer is read off that limit.

The public names load on first use, so importing the package is nearly free.
"""

import lazy_loader

__version__ = "0.2.0"

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
