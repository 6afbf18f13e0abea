"""`evenbreak odds`: the chances of a match, and how long it lasts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.options import LONGEST, PlainCommand, Whole, pair, refuse, score, wants_json
from evenbreak.cli.kit.output import chance_text, print_quantities
from evenbreak.cli.kit.players import Players, player_options
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack

if TYPE_CHECKING:
    from evenbreak.games.match import Match

WORDS = {
    "p_game_a": "A wins a game",
    "p_win_a": "A wins the match",
    "p_win_b": "B wins the match",
    "p_never_ends": "the match never ends",
    "mean_games": "games, mean",
    "sd_games": "games, standard deviation",
    "games_p50": "games, half of the matches within",
    "games_p90": "games, 9 of 10 matches within",
    "p_hill_hill": "hill-hill: the last possible game decides",
    "p_shutout_a": "A wins without losing a game",
    "p_shutout_b": "B wins without losing a game",
}
"""What each quantity is called on a terminal."""

MOST_SCORES = 10_000
"""Scores that a match other than the plain race may have, so that each answer takes seconds."""

MANY_GAMES = 10**9
"""From here on a terminal shows three digits of a number of games."""

EXAMPLES = """\b
Examples:
  evenbreak odds 612 521 --scale fargo --race 7:5
  evenbreak odds --p 0.6 --ahead 5:3
  evenbreak odds --p1 0.6 --p2 0.5 --breaks winner --race 9:9 --score 4:6
  evenbreak odds --p 0.66 --race 3:1 --set 3:3
"""


@click.command("odds", cls=PlainCommand, epilog=EXAMPLES)
@player_options
@click.option(
    "--race", metavar="N|M:N", callback=pair, help="A needs M games, B needs N; 7 means 7:7."
)
@click.option("--ahead", metavar="N|M:N", callback=pair, help="A needs to lead by M games, B by N.")
@click.option(
    "--set",
    "set_",
    metavar="N|M:N",
    callback=pair,
    help="Play sets, each a race M:N; --race then counts sets.",
)
@click.option("--score", metavar="I:J", callback=score, help="The score already: I for A, J for B.")
@click.option(
    "--win-by",
    type=Whole(1, LONGEST),
    metavar="K",
    help="The race goes on until one leads by K, counted from what each needs.",
)
@wants_json
def command(
    race: tuple[int, int] | None,
    ahead: tuple[int, int] | None,
    set_: tuple[int, int] | None,
    score: tuple[int, int] | None,
    win_by: int | None,
    as_json: bool,
    **who: Any,
) -> None:
    """Answer what the chances of a match are, and how long it lasts.

    Who plays: two ratings A B; or --p; or --p1, --p2 and --breaks. What is played:
    --race or --ahead, perhaps in sets.
    """
    from evenbreak.matches.odds import match_odds

    players = Players.of(**who)
    match = match_of(players, race=race, ahead=ahead, set_=set_, score=score, win_by=win_by)
    _refuse_giants(match)
    result = match_odds(match)
    answer = {
        "p_game_a": players.p_game_a,
        "p1": None if players.p_game_a is not None else players.rack.p1,
        "p2": players.rack.p2,
        "p_win_a": result.p_win_1,
        "p_win_b": result.p_win_2,
        "p_never_ends": result.p_never_ends,
        "mean_games": result.mean_games,
        "sd_games": result.sd_games,
        "games_p50": result.games_p50,
        "games_p90": result.games_p90,
        "p_hill_hill": result.p_hill_hill,
        "p_shutout_a": result.p_shutout_1,
        "p_shutout_b": result.p_shutout_2,
    }
    begun = any(match.score)
    shown = {
        key: f"{name} from now on" if begun and key.startswith("p_shutout") else name
        for key, name in WORDS.items()
        if key != "p_never_ends" or answer[key]
    }
    print_quantities(
        {**answer, "scale": players.scale.name if players.scale else None},
        words=shown,
        heading=f"{players.description}\n{match_text(match)}",
        text=_text,
        as_json=as_json,
    )


def match_of(
    players: Players,
    *,
    race: tuple[int, int] | None,
    ahead: tuple[int, int] | None,
    set_: tuple[int, int] | None,
    score: tuple[int, int] | None,
    win_by: int | None,
) -> Match:
    """Return the match that the options describe, or refuse what contradicts itself."""
    if race is not None and ahead is not None:
        refuse("--race and --ahead exclude each other; leave one out")
    if win_by is not None and (ahead or set_):
        refuse(f"--win-by does not combine with {'--ahead' if ahead else '--set'}; leave it out")
    rack: Any = players.rack
    breaks, first = players.breaks, players.first_breaker
    start = score or (0, 0)
    if set_ is not None:  # the break format goes on across the sets: only the set has to know it
        rack = Race(set_[0], set_[1], rack, breaks=breaks, first_breaker=first)
        breaks = None
    if ahead is not None:
        from evenbreak.games.ahead import Ahead

        return Ahead(ahead[0], ahead[1], rack, breaks=breaks, first_breaker=first, score=start)
    if race is None:
        refuse("what is played is missing; give --race M:N or --ahead M:N")
    m, n = race
    return Race(m, n, rack, breaks=breaks, first_breaker=first, score=start, win_by=win_by or 1)


def _refuse_giants(match: Match) -> None:
    """Refuse a match that would take minutes."""
    win_by, inner = getattr(match, "win_by", None), match.rack
    if win_by == 1 and isinstance(inner, Rack):
        return
    scores = match.m + match.n if win_by is None else max(match.m, win_by) * max(match.n, win_by)
    if not isinstance(inner, Rack):
        scores *= inner.m * inner.n
    if scores > MOST_SCORES:
        refuse(
            f"the {match_text(match)} is too long to work out here, with about {scores:,} scores; "
            f"ask for one with {MOST_SCORES:,} at the most"
        )


def match_text(match: Match) -> str:
    """Return what is played, in words.

    >>> from evenbreak.games import Race, Rack
    >>> match_text(Race(3, 1, Race(3, 3, Rack(0.6)), score=(1, 0)))
    'race 3:1 in sets of 3:3, the score is 1:0'
    """
    text = f"{type(match).__name__.lower()} {match.m}:{match.n}"
    if (win_by := getattr(match, "win_by", 1)) > 1:
        text += f", win by {win_by}"
    if not isinstance(match.rack, Rack):
        text += f" in sets of {match.rack.m}:{match.rack.n}"
    if any(match.score):
        text += f", the score is {match.score[0]}:{match.score[1]}"
    if (winner := match.decided(*match.score)) is not None:
        text += f": {'AB'[winner - 1]} has won"
    return text


def _text(key: str, value: float) -> str:
    if key.startswith("p_"):
        return chance_text(value)
    if value >= MANY_GAMES:
        return f"{value:.3g}"
    return f"{value:.2f}" if isinstance(value, float) else str(value)
