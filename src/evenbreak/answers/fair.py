"""The races that are nearest to an even chance."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from evenbreak.answers.answer import Answer, Column, Table
from evenbreak.answers.wording import chance, games, percent

if TYPE_CHECKING:
    from evenbreak.answers.two_players import TwoPlayers
    from evenbreak.handicaps.charts.fair import FairRace


def fair_answer(players: TwoPlayers, races: Sequence[FairRace], *, target: float = 0.5) -> Answer:
    """Return races as found by `fair_races`, the nearest to the target first.

    >>> from evenbreak.answers.two_players import TwoPlayers
    >>> from evenbreak.games import Rack
    >>> from evenbreak.handicaps import fair_races
    >>> races = fair_races(Rack(0.6), race_to=7, top=2)
    >>> print(fair_answer(TwoPlayers(Rack(0.6)), races).sentences[0])
    The fairest race is 7:5. A wins it 53 % of the time, and it lasts 9.3 games on average.
    """
    a, b = players.names
    rows = [
        (race.race_1, race.race_2, race.p_win_1, race.mean_games, race.games_p90) for race in races
    ]
    m, n, p_win, mean, _ = rows[0]
    wish = "fairest race" if target == 0.5 else f"race nearest to a {target:g} chance for {a}"
    return Answer(
        players.description,
        [
            f"The {wish} is {m}:{n}. {a} wins it {percent(p_win)} of the time, and it lasts "
            f"{mean:.1f} games on average.",
            Table(
                "races",
                [
                    Column("race_a", f"{a} needs"),
                    Column("race_b", f"{b} needs"),
                    Column("p_win_a", f"{a} wins", chance),
                    Column("mean_games", "games, on average", games),
                    Column("games_p90", "9 of 10 end within"),
                ],
                rows,
            ),
        ],
        warnings=players.doubts,
        data={"target": target},
    )
