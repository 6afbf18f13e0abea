"""Exact answers for matches: who wins, how long the match takes, and the final score.

`win_probability`, `match_length` and `final_scores` take arrays of probabilities.
`match_odds` and `race_odds` take plain numbers and need no numpy.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
