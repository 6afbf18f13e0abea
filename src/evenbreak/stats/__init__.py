"""Statistics of scores: what to expect of games won, runs and innings, and what scores tell.

This room knows numbers only: no game, no chain, no file.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
