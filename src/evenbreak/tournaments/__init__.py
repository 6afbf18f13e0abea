"""Tournaments: brackets, exact title odds, chips, how long the evening takes, prizes."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
