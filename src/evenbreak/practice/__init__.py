"""Practice: drills and their logs, the choice of a shot, break formats in the long run.

This package joins games, chains and statistics; it reads no files.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
