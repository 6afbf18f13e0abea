"""Leagues over a season and longer: simulated seasons, and the gains and signs of sandbagging.

`players`, `schedule` and `season` describe a season, `many_seasons` plays many replicas of it at
once, and `tally` keeps the results.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
