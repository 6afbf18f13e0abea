"""Exact answers for matches: who wins, how long it takes, with what score.

`win_probability`, `match_length` and `final_scores` take arrays of chances;
`evenbreak.matches.odds` answers for plain numbers without numpy.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
