"""Leagues in the long run: whole seasons simulated, and what gaming a system pays.

`players` and `season` say what is played, `play` plays many replicas of it at once, `tally`
keeps what came of them.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
