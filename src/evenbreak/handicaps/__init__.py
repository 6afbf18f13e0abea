"""Handicaps: what makes an uneven game even, and what it does to ratings in the long run.

`fair` finds the races closest to a given chance, `chart` looks up races by rating difference,
`level_chart` looks them up by skill level, `ladder` calculates how far ratings wander when each
match moves them by a point, and the systems in `systems` move a list's ratings after a night.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
