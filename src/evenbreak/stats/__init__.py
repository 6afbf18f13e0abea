"""Statistics of scores: games won, runs, innings; intervals, trends and comparisons.

This package deals only with numbers: no games, no chains, no files.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
