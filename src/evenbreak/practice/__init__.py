"""Practice: what a drill log, a choice of shots or a break format tells a player.

This room joins games, chains and statistics; it reads no files.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(__name__, {})
