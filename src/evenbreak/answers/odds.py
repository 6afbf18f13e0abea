"""The chances of a match, and its length."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak.answers.answer import Answer, Quantities, Quantity
from evenbreak.answers.wording import chance, decimals, games, percent
from evenbreak.games.ahead import Ahead
from evenbreak.games.rack import Rack
from evenbreak.matches.odds import match_odds

if TYPE_CHECKING:
    from evenbreak.answers.two_players import TwoPlayers
    from evenbreak.games.match import Match
    from evenbreak.matches.odds import MatchOdds


def odds_answer(players: TwoPlayers, match: Match) -> Answer:
    """Return the chances of a match between two players, and its length.

    >>> from evenbreak.answers.two_players import TwoPlayers
    >>> from evenbreak.games import Race
    >>> answer = odds_answer(TwoPlayers(Rack(0.6)), Race(7, 5, Rack(0.6)))
    >>> print(answer.sentences[0])
    A wins the match 53 % of the time.
    It lasts 9.3 games on average, and 9 of 10 such matches end within 11.
    """
    odds = match_odds(match)
    a, b = players.names
    from_now = " from now on" if any(match.score) else ""
    by_break = players.p_game_a is None
    quantities = [
        Quantity("p_game_a", players.p_game_a, f"{a} wins a game", chance),
        Quantity("p1", players.rack.p1 if by_break else None),
        Quantity("p2", players.rack.p2),
        Quantity("p_win_a", odds.p_win_1, f"{a} wins the match", chance),
        Quantity("p_win_b", odds.p_win_2, f"{b} wins the match", chance),
        Quantity(
            "p_never_ends",
            odds.p_never_ends,
            "the match never ends" if odds.p_never_ends else None,
            chance,
        ),
        Quantity("mean_games", odds.mean_games, "games, on average", games),
        Quantity("sd_games", odds.sd_games, "games, standard deviation", games, detail=True),
        Quantity("games_p50", odds.games_p50, "half of the matches end within", games),
        Quantity("games_p90", odds.games_p90, "9 of 10 matches end within", games),
        Quantity(
            "p_hill_hill", odds.p_hill_hill, "hill-hill: the last possible game decides", chance
        ),
        Quantity(
            "p_shutout_a", odds.p_shutout_1, f"{a} wins without losing a game{from_now}", chance
        ),
        Quantity(
            "p_shutout_b", odds.p_shutout_2, f"{b} wins without losing a game{from_now}", chance
        ),
        Quantity("scale", None if players.scale is None else players.scale.name),
    ]
    return Answer(
        f"{players.description}\n{match_words(match, players.names)}",
        [_in_words(odds, match, players), Quantities(quantities)],
        warnings=players.doubts,
    )


def _in_words(odds: MatchOdds, match: Match, players: TwoPlayers) -> str:
    a, b = players.names
    if (winner := match.decided(*match.score)) is not None:
        return f"{players.names[winner - 1]} has won the match."
    if odds.p_never_ends:
        if odds.p_never_ends == 1.0:
            return "The match never ends."
        return f"The match may never end; the chance of that is {chance(odds.p_never_ends)}."
    name, p = (a, odds.p_win_1) if odds.p_win_1 >= odds.p_win_2 else (b, odds.p_win_2)
    text = f"{name} wins the match {percent(p)} of the time."
    if odds.mean_games is None or odds.games_p90 is None:
        return text
    length = decimals(1)(odds.mean_games) if odds.mean_games < 1e6 else games(odds.mean_games)
    more = " more" if any(match.score) else ""
    return (
        f"{text}\nIt lasts {length}{more} games on average, and 9 of 10 such matches end within "
        f"{odds.games_p90:,}."
    )


def match_words(match: Match, names: tuple[str, str] = ("A", "B")) -> str:
    """Return what is played.

    >>> from evenbreak.games import Race
    >>> match_words(Race(3, 1, Race(3, 3, Rack(0.6)), score=(1, 0)))
    'Race 3:1 in sets of 3:3, score 1:0'
    """
    if isinstance(match, Ahead):
        a, b = names
        by = f"{match.m} ({a}) or {match.n} ({b})" if match.m != match.n else str(match.m)
        text = f"First to lead by {by}"
    else:
        text = f"Race {match.m}:{match.n}"
    if (win_by := getattr(match, "win_by", 1)) > 1:
        text += f", win by {win_by}"
    if not isinstance(match.rack, Rack):
        text += f" in sets of {match.rack.m}:{match.rack.n}"
    if any(match.score):
        text += f", score {match.score[0]}:{match.score[1]}"
    if (winner := match.decided(*match.score)) is not None:
        text += f": {names[winner - 1]} has won"
    return text
