"""From match results to ratings with uncertainty.

`scale` defines what a rating difference means, `results` holds the matches and checks them for
contradictions, and `fit` estimates Bradley-Terry ratings from them.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
