"""Leagues over a season and longer: seasons simulated, and what sandbagging pays and shows.

`players`, `schedule` and `season` describe a season, `many_seasons` plays many replicas of it at
once, and `tally` keeps what came of them.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
