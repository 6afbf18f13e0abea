"""Games as directed graphs, one family of games in each module.

This package only describes games; `evenbreak.chains` and `evenbreak.matches` solve them.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
