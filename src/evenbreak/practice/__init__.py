"""Practice: what a drill log, a choice of shots or a break format tells a player.

This room joins games, chains and statistics; it reads no files.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
