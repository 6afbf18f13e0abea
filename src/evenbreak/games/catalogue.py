"""One example of each kind of game; the contract tests run over all of them."""

from __future__ import annotations

from evenbreak.game import Game
from evenbreak.games.ahead import Ahead
from evenbreak.games.breaks import alternate_breaks, loser_breaks, winner_breaks
from evenbreak.games.drill import Drill
from evenbreak.games.one_ball import OneBall, OneBallLookAhead
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.games.series import Series

_BREAKING = Rack(0.6, 0.55)

CATALOGUE: dict[str, Game] = {
    "race 9:5": Race(9, 5, Rack(2 / 3)),
    "race 5:4, winner breaks": Race(5, 4, _BREAKING, breaks=winner_breaks, first_breaker=2),
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
    "series, alternate breaks": Series(_BREAKING, breaks=alternate_breaks),
    "drill, progressive 9-ball": Drill.progressive(0.8),
}
