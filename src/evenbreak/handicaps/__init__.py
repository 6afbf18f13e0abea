"""Handicaps: what makes an uneven game even, and what it does to ratings in the long run.

`fair` finds the races that come nearest to a chance that was asked for, `chart` looks races
up by rating difference, `level_chart` by skill levels, `ladder` says how far ratings wander
that each match moves by a point; a system of `systems` moves a list's ratings, `moves` by how
much after a night.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
