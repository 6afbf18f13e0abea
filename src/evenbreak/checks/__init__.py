"""Checks of parameters: each returns the value it was given, or says how to correct it."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
