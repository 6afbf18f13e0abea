"""Games described as directed graphs: one family a file, each a small frozen dataclass.

Nothing here solves anything; `evenbreak.chains` and `evenbreak.matches` do.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
