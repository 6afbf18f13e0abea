"""One module a question: what it is answered with, in numbers, tables and sentences."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
