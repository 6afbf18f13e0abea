"""How the replicas of a season are divided: into batches, and these into chunks.

The replicas of a *batch* share the draw of opponents. Standard errors come from the differences
between batches, so there must be many of them; but numpy is fast with long arrays. So a *chunk*,
which is played at a time, has several batches if these are small.
"""

from __future__ import annotations

from typing import NamedTuple

from evenbreak.league.counting import ALONE
from evenbreak.league.season import Season

_CHUNK = 1 << 16
"""Players times replicas in a chunk, unless the league alone is larger."""

_BATCHES = 20
"""The fewest batches, if there are as many replicas: standard errors come from them."""

_CELLS = 1 << 22
"""The most cells of the tables in which the batches of a chunk count their matches."""

_MATCHES = 1 << 24
"""The most matches of a chunk with several batches, so that long seasons can use all workers."""


class Batching(NamedTuple):
    """How replicas are divided: `replicas` in a batch, `batches` in a chunk."""

    replicas: int
    batches: int


def batching_of(season: Season, replicas: int) -> Batching:
    """Return how to divide replicas, so that a chunk fits the processor's cache.

    There are 20 batches or more, if there are as many replicas.

    >>> from evenbreak.league import LeaguePlayers, Season
    >>> season = Season(LeaguePlayers.of([50] * 64), "npl")
    >>> batching_of(season, 100_000), batching_of(season, 2000)
    (Batching(replicas=1024, batches=1), Batching(replicas=100, batches=10))
    """
    at_once = 1 if len(season.players) > ALONE else _CHUNK // len(season.players)
    batch = max(1, min(at_once, replicas // _BATCHES))
    matches = batch * season.weeks * len(season.players) // 2
    most = at_once // batch, _CELLS // len(season.lookup.wins), _MATCHES // max(matches, 1)
    return Batching(batch, max(1, min(most)))
