"""`evenbreak live`: a match under way, rack by rack."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.options import LONGEST, PlainCommand, pair, refuse, score, wants_json
from evenbreak.cli.kit.output import (
    SCHEMA_VERSION,
    aligned,
    chance_text,
    csv_text,
    print_json,
    to_terminal,
)
from evenbreak.cli.kit.players import Players, player_options
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.match.odds import MOST_SCORES, match_of, match_text

if TYPE_CHECKING:
    from evenbreak.games.match import Match
    from evenbreak.matches.live import LiveOdds, Standing

COLUMNS = (
    "rack",
    "won_by",
    "score_a",
    "score_b",
    "set_a",
    "set_b",
    "next_break",
    "p_win_a",
    "p_win_b",
    "swing_a",
    "p_win_a_if_a",
    "p_win_a_if_b",
    "leverage",
    "mean_racks_left",
    "racks_left_p90",
)
"""Of the course of a match; a row is a moment."""

OF_THE_TABLE = ("score_a", "score_b", "set_a", "set_b", "next_break", "p_win_a", "leverage")
"""Columns of the comeback table."""

WORDS = {
    "p_win_a": "A wins the match",
    "p_win_b": "B wins the match",
    "p_win_a_if_a": "A wins the match if A wins the next rack",
    "p_win_a_if_b": "A wins the match if B wins the next rack",
    "leverage": "leverage: what the next rack moves",
    "mean_racks_left": "racks left, mean",
    "racks_left_p90": "racks left, 9 of 10 matches within",
}
"""What each quantity is called on a terminal."""

EXAMPLES = """\b
Examples:
  evenbreak live 612 521 --scale fargo --race 7:5 --racks abbab
  evenbreak live --p 0.6 --race 9:7 --score 4:6
  evenbreak live --p 0.6 --race 7:5 --table
  evenbreak live --p 0.6 --race 3:3 --set 4:3 --score 1:0 --set-score 2:2
"""


def _racks(ctx: click.Context, param: click.Parameter, value: str | None) -> list[int]:
    """Return who won each rack, 1 or 2."""
    letters = "".join((value or "").lower().replace(",", " ").split())
    for letter in letters:
        if letter not in "ab":
            message = f"{letter!r} is nobody; write a letter a rack, a or b, such as abbab"
            raise click.BadParameter(message, ctx=ctx, param=param)
    return ["ab".index(letter) + 1 for letter in letters]


@click.command("live", cls=PlainCommand, epilog=EXAMPLES)
@player_options
@click.option("--race", metavar="M:N", callback=pair, help="A needs M games, B needs N.")
@click.option("--ahead", metavar="M:N", callback=pair, help="A needs to lead by M games, B by N.")
@click.option(
    "--set",
    "set_",
    metavar="M:N",
    callback=pair,
    help="Play sets, each a race M:N; --race then counts sets.",
)
@click.option(
    "--win-by",
    type=click.IntRange(1, LONGEST),
    metavar="K",
    help="The race goes on until one leads by K, counted from what each needs.",
)
@click.option("--score", metavar="I:J", callback=score, help="The score before the racks.")
@click.option(
    "--set-score",
    metavar="I:J",
    callback=score,
    help="The score of the set under way before the racks.",
)
@click.option(
    "--racks", metavar="abbab...", callback=_racks, help="Who won each rack since that score."
)
@click.option("--table", is_flag=True, help="Add the comeback table: every score to come.")
@wants_json
@plot_option
def command(
    race: tuple[int, int] | None,
    ahead: tuple[int, int] | None,
    set_: tuple[int, int] | None,
    win_by: int | None,
    score: tuple[int, int] | None,
    set_score: tuple[int, int] | None,
    racks: list[int],
    table: bool,
    as_json: bool,
    plot: str | None,
    **who: Any,
) -> None:
    """Tell the odds of a match under way, what the next rack is worth, and how it went.

    Who plays and what is played: as for odds. Where it stands: --racks, or --score, or
    both, the racks then being those after that score.
    """
    from evenbreak.matches.live import live_odds

    players = Players.of(**who)
    match = match_of(players, race=race, ahead=ahead, set_=set_, score=score, win_by=win_by)
    if set_score is not None and set_ is None:
        refuse("--set-score is the score of a set, and there is no --set; leave it out")
    if plot is not None and not racks:
        refuse("--plot draws the match as it went; give --racks, such as abbab")
    _refuse_giants(match)
    odds = live_odds(match, racks, set_score=set_score)
    course = list(_course(odds))
    if plot is not None:
        from evenbreak.plots.live_match import plot_course

        write_plot(plot_course(odds), plot)
    if as_json:
        print_json(
            {
                "now": dict(zip(COLUMNS, course[-1], strict=True)),
                "course": [dict(zip(COLUMNS, row, strict=True)) for row in course],
                "comebacks": [
                    dict(zip(OF_THE_TABLE, _table_row(moment), strict=True))
                    for moment in odds.comebacks()
                ],
                "schema_version": SCHEMA_VERSION,
            }
        )
    elif not to_terminal():
        rows = [_table_row(moment) for moment in odds.comebacks()] if table else course
        click.echo(csv_text(OF_THE_TABLE if table else COLUMNS, rows), nl=False)
    else:
        heading = f"{players.description}\n{_standing_text(match, odds.now)}\n\n"
        text = heading + _text(course, odds)
        if table:
            from evenbreak.cli.match.live_table import comeback_text

            text = f"{text.rstrip()}\n\n{comeback_text(match, odds)}"
        click.echo(text, nl=False)


def _refuse_giants(match: Match) -> None:
    """Refuse a match that would take minutes."""
    win_by = getattr(match, "win_by", 0)
    left = [
        max(need - has, win_by, 1)
        for need, has in zip((match.m, match.n), match.score, strict=True)
    ]
    scores = left[0] * left[1] if win_by else match.m + match.n
    scores *= getattr(match.rack, "m", 1) * getattr(match.rack, "n", 1)
    if scores > MOST_SCORES:
        refuse(
            f"the {match_text(match)} can still come to about {scores:,} scores; "
            f"ask for one with {MOST_SCORES:,} at the most, or see evenbreak odds"
        )


def _course(odds: LiveOdds) -> Iterator[tuple[Any, ...]]:
    """Yield the rows of the course."""
    swings = (None, *odds.swings)
    winners = (None, *odds.winners)
    moments = zip(odds.course, winners, swings, strict=True)
    for rack, (moment, winner, swing) in enumerate(moments):
        after = moment.p_win_1_after or (None, None)
        yield (
            rack,
            _name(winner),
            *_scores(moment),
            _name(moment.breaker),
            moment.p_win_1,
            moment.p_win_2,
            swing,
            *after,
            moment.leverage,
            moment.mean_racks,
            moment.racks_p90,
        )


def _table_row(moment: Standing) -> tuple[Any, ...]:
    return (*_scores(moment), _name(moment.breaker), moment.p_win_1, moment.leverage)


def _name(player: int | None) -> str | None:
    return None if player is None else " ab"[player]


def _scores(moment: Standing) -> tuple[int | None, ...]:
    inside = moment.scores[1] if len(moment.scores) > 1 else (None, None)
    return (*moment.scores[0], *inside)


def _standing_text(match: Match, now: Standing) -> str:
    """Return what is played and how it stands, in words."""
    from dataclasses import replace

    text = f"{match_text(replace(match, score=(0, 0)))}, the score is {_score_text(now)}"
    if now.leverage is None:
        return text + f": {'A' if now.p_win_1 else 'B'} has won"
    return text + (f", {' AB'[now.breaker]} breaks" if now.breaker else "")


def _score_text(moment: Standing) -> str:
    """Return a score, with that of the set under way: 1:0 (2:2)."""
    (a, b), *inside = moment.scores
    return f"{a}:{b}" + "".join(f" ({c}:{d})" for c, d in inside)


def _text(course: list[tuple[Any, ...]], odds: LiveOdds) -> str:
    """Return what a terminal shows: the moment now, and the match as it went."""
    now = dict(zip(COLUMNS, course[-1], strict=True))
    shown = [[words, _value(key, now[key])] for key, words in WORDS.items() if now[key] is not None]
    quantities = aligned(shown) if odds.now.leverage is not None else ""
    if not odds.winners:
        return quantities
    rows = [["rack", "won by", "score", "A wins", "swing", "leverage"]]
    for moment, winner, swing, before in zip(
        odds.course[1:], odds.winners, odds.swings, odds.course, strict=False
    ):
        rows.append(
            [
                str(len(rows)),
                " AB"[winner],
                _score_text(moment),
                chance_text(moment.p_win_1),
                f"{swing:+.4f}",
                _value("leverage", before.leverage),
            ]
        )
    most = max(range(len(odds.swings)), key=lambda i: abs(odds.swings[i]))
    swing, gap = odds.swings[most], "\n" if quantities else ""
    text = quantities + gap + aligned(rows)
    if not swing:
        return text
    gained = f"{' AB'[odds.winners[most]]} gained {chance_text(abs(swing))} with it"
    return f"{text}\nRack {most + 1} moved the match most: {gained}.\n"


def _value(key: str, value: Any) -> str:
    if key in ("mean_racks_left", "racks_left_p90"):
        return str(value) if isinstance(value, int) else f"{value:.2f}"
    return chance_text(value)
