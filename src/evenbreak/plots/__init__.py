"""Plots: `draw_...` returns the axes of one plot, `..._figure` a figure of several."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
