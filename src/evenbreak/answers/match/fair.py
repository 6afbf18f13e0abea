"""The races that are nearest to an even chance."""

from collections.abc import Sequence
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.by_way import DEFECTIVE, by_way
from evenbreak.answers.kit.columns import columns_of
from evenbreak.answers.kit.parts import Part, Table
from evenbreak.answers.kit.wording import percent
from evenbreak.answers.match.two_players import TwoPlayers
from evenbreak.chains.ways import Way
from evenbreak.games.race import Race
from evenbreak.handicaps.charts.fair import FairRace


def fair_answer(
    players: TwoPlayers,
    races: Sequence[FairRace],
    *,
    target: float = 0.5,
    via: Way | None = None,
) -> Answer:
    """Return races as found by `fair_races`, the nearest to the target first.

    Parameters
    ----------
    players, races, target
        as for `fair_races`, and what it returns.
    via
        the way by which the chances of these races were found.

    >>> from evenbreak.answers.match.two_players import TwoPlayers
    >>> from evenbreak.games import Rack
    >>> from evenbreak.handicaps import fair_races
    >>> races = fair_races(Rack(0.6), race_to=7, top=2)
    >>> print(fair_answer(TwoPlayers(Rack(0.6)), races).sentences[0])
    The fairest race is 7:5. A wins it 53% of the time, and it lasts 9.3 games on average.
    """
    a, b = players.names
    rows = [
        (race.race_1, race.race_2, race.p_win_1, race.mean_games, race.games_p90) for race in races
    ]
    m, n, p_win, mean, _ = rows[0]
    wish = "fairest race" if target == 0.5 else f"race nearest to {percent(target)} for {a}"
    return Answer(
        players.description,
        [
            f"The {wish} is {m}:{n}. {a} wins it {percent(p_win)} of the time, and it lasts "
            f"{mean:.1f} games on average.",
            Table(
                "races",
                columns_of("race_a race_b wins_a mean_games games_p90", a=a, b=b),
                rows,
            ),
            *_way(via, players, races),
            *filter(None, [players.averaged, players.by_form]),
        ],
        warnings=players.doubts,
        data={"target": target, **players.named},
    )


def _way(via: Way | None, players: TwoPlayers, races: Sequence[FairRace]) -> list[Part]:
    if via is None:
        return []
    from evenbreak.matches.win import win_probability

    order: dict[str, Any] = {"breaks": players.break_format, "first_breaker": players.first_breaker}
    kernel = [
        win_probability(Race(race.race_1, race.race_2, players.rack, **order)) for race in races
    ]
    pairs = zip([race.p_win_1 for race in races], kernel, strict=True)
    long = any(race.race_1 + race.race_2 > 2 for race in races)
    return by_way(via, pairs, note=DEFECTIVE if via == "eigen" and long else "")
