"""How the replicas of a season are parted: into batches, and these into chunks.

A *batch* is of replicas that share the draw of opponents. Standard errors come from how batches
differ, so there must be many; and numpy wants long arrays. So a *chunk*, what is played at a time,
has several batches where these are small.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from evenbreak.league.counting import ALONE

if TYPE_CHECKING:
    from evenbreak.league.season import Season

_CHUNK = 1 << 16
"""Players times replicas that a chunk has if the season is not larger by itself."""

_BATCHES = 20
"""Batches that there are at least where there are as many replicas: errors come from them."""

_CELLS = 1 << 22
"""Places of the tables in which the batches of a chunk count their matches, at most."""

_MATCHES = 1 << 24
"""Matches of a chunk of several batches at most: long seasons are for several workers too."""


class Batching(NamedTuple):
    """How replicas are parted: `replicas` in a batch, `batches` in a chunk."""

    replicas: int
    batches: int


def batching_of(season: Season, replicas: int) -> Batching:
    """Return how to part replicas: a chunk has as many of them as the cache holds.

    There are 20 batches or more where there are as many replicas, since standard errors come
    from how batches differ.

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
