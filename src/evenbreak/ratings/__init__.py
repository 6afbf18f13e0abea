"""From match results to ratings with uncertainty.

`scale` says what a rating difference means, `results` holds what was played and whether
it can be true, and `fit` estimates Bradley-Terry ratings from it.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
