"""The limit of a game by a way of one's choice: the road from the game to its limit, in one call.

    kernel          game -> states in a line -> closed form
    elimination     game -> sparse matrix -> elimination without subtraction
    eigen           game -> networkx.DiGraph -> sparse matrix -> eigenvectors of eigenvalue 1

Every function that answers for a game, and has a faster kernel of its own, is held against this.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from evenbreak.chains.explore import chain_of
from evenbreak.chains.limits import Limit, stochastic_limit
from evenbreak.chains.ways import WAYS, Way
from evenbreak.checks import one_of
from evenbreak.game import Game, graph_of

if TYPE_CHECKING:
    from collections.abc import Hashable

    import networkx as nx


def limit_of(
    game: Game | nx.DiGraph[Any], *, start: Hashable | None = None, via: Way | None = None
) -> Limit:
    """Return the stochastic limit of a game: where it ends, or its long-run average.

    Parameters
    ----------
    game
        any game (see `evenbreak.game`), or a `networkx.DiGraph` as `chain_of` takes it.
    start
        the state in which it begins; None: its own start.
    via
        the way, as in `stochastic_limit`. With 'eigen' the game becomes a `networkx.DiGraph`
        first. None: the closed form where there is one, otherwise elimination.

    Raises
    ------
    AccuracyError, ChainError, InputError
        as `stochastic_limit` does; each names a way that answers.
    GameError
        as `chain_of` does.

    Notes
    -----
    The matrix of a race is defective: it has fewer independent eigenvectors than states. Those of
    eigenvalue 1 are never too few, and the limit needs only them.

    >>> from evenbreak.games import OneBall, Rack, Race
    >>> [round(limit_of(OneBall(0.4, 0.8), via=via)["W"], 12) for via in ("elimination", "eigen")]
    [0.454545454545, 0.454545454545]
    >>> limit_of(Race(2, 1, Rack(0.5)), via="eigen")[2, 0]
    0.25
    """
    if via is not None:
        one_of(via, "via", WAYS)
    if via == "eigen" and isinstance(game, Game):
        start = game.start if start is None else start
        game = graph_of(game, start=start)
    return stochastic_limit(chain_of(game, start=start), via=via)
