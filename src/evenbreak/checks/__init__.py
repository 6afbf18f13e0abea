"""Parameter checks: each returns the value, or raises an error with a remedy."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
