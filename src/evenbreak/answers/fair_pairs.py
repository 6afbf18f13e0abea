"""Who meets whom, and the race that is fair between them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.errors import InputError
from evenbreak.files.player_names import clean_name
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.fair import FairRace, fair_races
from evenbreak.ratings.fitted import Ratings
from evenbreak.ratings.results import Results

if TYPE_CHECKING:
    import pandas as pd

NOT_LINKED = "no race: no chain of opponents links the two"


@dataclass(frozen=True)
class RaceLimits:
    """Which races may be offered: the longest they can last, or what the stronger player needs.

    Parameters
    ----------
    games
        the races m:n with games[0] <= m + n - 1 <= games[1].
    race_to
        instead: the stronger player needs so many games.

    Raises
    ------
    InputError
        if both are given, or neither.
    """

    games: tuple[int, int] | None = None
    race_to: int | None = None

    def __post_init__(self) -> None:
        if (self.games is None) == (self.race_to is None):
            raise InputError(
                f"games is {self.games!r} and race_to is {self.race_to!r}; give just one of them"
            )

    def fairest(self, p: float) -> FairRace:
        """Return the race nearest to even, given P(player 1 wins a game)."""
        return fair_races(Rack(p), games=self.games, race_to=self.race_to, top=1)[0]


def most_active(ratings: Ratings, top: int) -> list[int]:
    """Return the players with the most games (positions in `ratings.players`), the most first.

    Of players with equally many games those come first with the most matches known by their
    winner alone, then the first in the order of names.
    """
    races = ratings.races_won + ratings.races_lost
    order = sorted(range(len(ratings.players)), key=lambda k: (-ratings.games[k], -races[k], k))
    return order[:top]


def by_strength(ratings: Ratings, players: Iterable[int]) -> list[int]:
    """Return players (positions in `ratings.players`), the strongest first, equals by name."""
    # Rounded in log-odds, so that neither the scale nor the last bits decide.
    strength = np.round(ratings.scale.log_odds(ratings.rating - ratings.anchor), 9)
    return sorted(players, key=lambda k: (-strength[k], k))


def find_players(
    ratings: Ratings | Results, names: Sequence[str], *, said: str = "players"
) -> list[int]:
    """Return the positions of the named players, each once; upper and lower case may differ.

    Parameters
    ----------
    ratings
        those among whom they are looked for.
    names
        as a person typed them.
    said
        the parameter or option that named them, for the error.

    Raises
    ------
    InputError
        if names are not in the results; it lists all of them, each with the names that are
        most like it.
    """
    exact = {name: place for place, name in enumerate(ratings.players)}
    folded: dict[str, list[int]] = {}
    for name, place in exact.items():
        folded.setdefault(name.casefold(), []).append(place)
    found: dict[int, None] = {}
    unknown: dict[str, None] = {}
    for name in map(clean_name, names):
        places = [exact[name]] if name in exact else folded.get(name.casefold(), [])
        if len(places) == 1:
            found[places[0]] = None
        else:
            near = [ratings.players[k] for k in places] or _like(name, ratings.players)
            hint = f" (did you mean {' or '.join(map(repr, near))}?)" if near else ""
            unknown[f"{name!r}{hint}"] = None
    if unknown:
        raise InputError(
            f"{said}: not in the results: {', '.join(unknown)}; write names as the results do"
        )
    return list(found)


def _like(name: str, players: Sequence[str]) -> list[str]:
    folded = {player.casefold(): player for player in reversed(players)}
    wanted = name.casefold()
    parts = [player for key, player in folded.items() if wanted and wanted in key]
    close = [folded[key] for key in get_close_matches(wanted, folded, n=3)]
    return list(dict.fromkeys([*close, *sorted(parts)]))[:3]


def matchups_frame(ratings: Ratings, players: Sequence[int], limits: RaceLimits) -> pd.DataFrame:
    """Return the fairest race of each pair of players, the stronger of the two first.

    Parameters
    ----------
    ratings
        how strong everybody is.
    players
        whom to pair: positions in `ratings.players`.
    limits
        which races may be offered.

    Returns
    -------
    pandas.DataFrame
        player_a, player_b; p_game_a = P(a wins a game | the ratings are right); race_a,
        race_b, the games that each needs; p_win_a = P(a wins that race); mean_games and
        games_p90, its mean length and the games within which 90 % of such races end;
        note. Where no chain of opponents links the two, their ratings cannot be
        compared: no numbers then, and the note says so.
    """
    import pandas as pd

    rows = [_row(ratings, a, b, limits) for a, b in combinations(by_strength(ratings, players), 2)]
    columns = {
        "player_a": "object",
        "player_b": "object",
        "p_game_a": "float64",
        "race_a": "Int64",
        "race_b": "Int64",
        "p_win_a": "float64",
        "mean_games": "float64",
        "games_p90": "Int64",
        "note": "object",
    }
    return pd.DataFrame(rows, columns=list(columns)).astype(columns)


def _row(ratings: Ratings, a: int, b: int, limits: RaceLimits) -> tuple[object, ...]:
    names = ratings.players[a], ratings.players[b]
    if ratings.component[a] != ratings.component[b]:
        return (*names, None, None, None, None, None, None, NOT_LINKED)
    p = ratings.scale.win_probability(float(ratings.rating[a] - ratings.rating[b]))
    race = limits.fairest(p)
    return (
        *names,
        p,
        race.race_1,
        race.race_2,
        race.p_win_1,
        race.mean_games,
        race.games_p90,
        "",
    )
