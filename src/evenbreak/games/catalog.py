"""One example of each kind of game, by name; the contract tests run over all of them."""

from __future__ import annotations

import re
from dataclasses import replace
from difflib import get_close_matches
from typing import Any

from evenbreak.errors import InputError
from evenbreak.game import Game
from evenbreak.games.ahead import Ahead
from evenbreak.games.breaks import alternate_breaks, loser_breaks, winner_breaks
from evenbreak.games.drill import Drill
from evenbreak.games.one_ball import OneBall, OneBallLookAhead
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.games.series import Series

_BREAKING = Rack(0.6, 0.55)

CATALOG: dict[str, Game] = {
    "race 9:5": Race(9, 5, Rack(2 / 3)),
    "race 5:4, winner breaks, player 2 first": Race(
        5, 4, _BREAKING, breaks=winner_breaks, first_breaker=2
    ),
    "race 5:5, win by 2, alternate breaks": Race(
        5, 5, _BREAKING, breaks=alternate_breaks, win_by=2
    ),
    "race 7:7 from 2:1, loser breaks": Race(7, 7, _BREAKING, breaks=loser_breaks, score=(2, 1)),
    "3:1 match of 3:3 sets": Race(3, 1, Race(3, 3, Rack(2 / 3))),
    "2:2 match of 3:3 sets, breaks carried": Race(
        2, 2, Race(3, 3, _BREAKING, breaks=alternate_breaks)
    ),
    "2:2 match of 3:3 sets, set winner breaks": Race(
        2, 2, Race(3, 3, _BREAKING, breaks=alternate_breaks), breaks=winner_breaks
    ),
    "race 3:2 of one-ball": Race(3, 2, OneBall(0.4, 0.8)),
    "ahead 5:3": Ahead(5, 3, Rack(0.6)),
    "ahead 2:2, alternate breaks": Ahead(2, 2, _BREAKING, breaks=alternate_breaks),
    "one-ball": OneBall(0.4, 0.8),
    "one-ball, two shots ahead": OneBallLookAhead([0.4, 0.8]),
    "series, winner breaks": Series(_BREAKING, breaks=winner_breaks),
    "series, loser breaks": Series(_BREAKING, breaks=loser_breaks),
    "series, alternate breaks": Series(_BREAKING, breaks=alternate_breaks),
    "drill, progressive 9-ball": Drill.progressive(0.8),
    "drill, progressive 8-ball": Drill.eight_ball(0.8),
}


def game_of_catalog(name: str, *chances: float) -> tuple[str, Game]:
    """Return a game from the catalog with its full name, optionally with other chances.

    Parameters
    ----------
    name
        its name, or words in it that no other game has; or the name of an installed package's game.
    chances
        p1 and p2 of its racks or shots, or a single chance: for its racks, regardless of who
        breaks, or for a shot in a drill; for a package's game, what its documentation says. None:
        the catalog's chances.

    Raises
    ------
    InputError
        if no game, or more than one, has this name, or the game takes a different number of
        chances.

    >>> game_of_catalog("One-ball", 0.3, 0.6)
    ('one-ball', OneBall(p1=0.3, p2=0.6))
    >>> game_of_catalog("drill 9-ball")[0]
    'drill, progressive 9-ball'
    """
    words = _words(name)
    joined = {"".join(_words(entry)): entry for entry in CATALOG}
    matching = [entry for text, entry in joined.items() if text == "".join(words)]
    if not matching:
        from evenbreak.games.laws import lawful_game
        from evenbreak.plugins import added, plugin

        if (theirs := plugin("game", name, lawful_game, *chances)) is not None:
            return name.strip().lower(), theirs
        matching = [entry for entry in CATALOG if words and set(words) <= set(_words(entry))]
    if len(matching) != 1:
        close = get_close_matches("".join(words), joined, n=3)
        near = matching or [joined[text] for text in close] or [*CATALOG, *added("game")]
        which = "could mean several games" if matching else "isn't in the catalog of games"
        raise InputError(
            "{name!r} {which}. Choose one of: {near}", name=name, which=which, near="; ".join(near)
        )
    game = CATALOG[matching[0]]
    try:
        return matching[0], _with_chances(game, chances) if chances else game
    except TypeError:
        wanted = "one chance" if isinstance(game, Drill) else "two chances, p1 and p2"
        raise InputError(
            "{matching} takes {wanted}, not {n_chances}",
            matching=matching[0],
            wanted=wanted,
            n_chances=len(chances),
        ) from None


def _words(name: str) -> list[str]:
    """Return the words and numbers in a name, however they are joined.

    >>> _words("Drill, progressive 9_ball"), _words("race 9:5")
    (['drill', 'progressive', '9', 'ball'], ['race', '9:5'])
    """
    return re.findall(r"\d+(?::\d+)?|[^\W\d_]+", name.lower())


def _with_chances(game: Any, chances: tuple[float, ...]) -> Any:
    match game:
        case OneBall():
            return OneBall(*chances)
        case OneBallLookAhead():
            return replace(game, shots=chances)
        case Drill(success=(first, *_)):
            base = Drill.progressive if first == 1.0 else Drill.eight_ball
            return base(*chances, levels=len(game.success))  # type: ignore[arg-type, misc]
        case Rack():
            return Rack(*chances)
    return replace(game, rack=_with_chances(game.rack, chances))
