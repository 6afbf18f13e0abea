"""Team nights: whom to put up, the value of a lineup, and a season's table."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
