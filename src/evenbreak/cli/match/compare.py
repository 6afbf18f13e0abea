"""`evenbreak compare`: match formats side by side, for the same two players."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from typing import Any

import click

from evenbreak import matches
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.match.two_players import TwoPlayers
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import PlainCommand
from evenbreak.cli.kit.players import player_options, players_of
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.values import NUMBER, refuse
from evenbreak.matches.formats import MatchFormat

MOST_FORMATS = 7
"""As many formats as a picture has lines for."""

MOST_SCORES = {"race": 10_000, "break": 900, "": 2_500}
"""The most scores of a race where the break matters, of another match where it does, and of
another match where it does not, so that every answer takes seconds."""

EXAMPLES = """\b
Examples:
  evenbreak compare --p 0.6667 9:5 "3:1 of 3:3" "ahead 5:3"
  evenbreak compare 612 521 --scale fargo 7:5 "7:7 win by 2" --plot formats.png
  evenbreak compare "Ann Lee" "Bo Diaz" --from ratings.csv 7:5 "ahead 5:3"
  evenbreak compare --p1 0.6 --p2 0.55 --breaks winner 9:7 "9:7 alternate breaks"
"""


class CompareCommand(PlainCommand):
    """A command whose words are ratings, which are numbers, and formats, which are not."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments, and separate ratings from formats."""
        ctx.ignore_unknown_options = any(
            word.startswith("-") and NUMBER.fullmatch(word) for word in args
        )
        rest = click.Command.parse_args(self, ctx, args)
        words: Sequence[str] = ctx.params["ratings"]
        if ctx.params["from_file"] is not None:
            who, formats = words[:2], words[2:]
        else:
            who = [word for word in words if NUMBER.fullmatch(word)]
            formats = [word for word in words if not NUMBER.fullmatch(word)]
        ctx.params["ratings"], ctx.params["formats"] = tuple(who), list(formats)
        if ctx.resilient_parsing:
            return rest
        for word in ctx.params["formats"]:
            if word.startswith("-"):
                raise click.NoSuchOption(word.split("=")[0], ctx=ctx)
        return rest

    def collect_usage_pieces(self, ctx: click.Context) -> list[str]:
        """Name ratings and formats separately."""
        return [*super().collect_usage_pieces(ctx), "FORMAT..."]


@click.command("compare", cls=CompareCommand, epilog=EXAMPLES)
@player_options
@click.option(
    "--hold",
    type=click.Choice(["p2", "break"]),
    help="What stays fixed as P1 varies: P2, or the advantage of the break.  [default: p2]",
)
@plot_option
@faces()
def command(formats: list[str], hold: str | None, plot: str | None, **who: Any) -> Answer:
    """Compare match formats for two players: which is better for whom.

    A FORMAT is 9:5 (A needs 9 games, B needs 5), "7:7 win by 2", "ahead 5:3" or
    "3:1 of 3:3" (sets), and may end in a break format, such as "winner breaks".
    Describe the players by two ratings A B, by two names with --from, by --p, or by --p1, --p2 and
    --breaks.
    """
    from evenbreak.answers.match.compare import Compared, compare_answer

    _refuse_numbers(**who)
    players = players_of(**who, form=0.0)
    read = _read(formats, players)
    line = _line(players, hold)
    compared = []
    for played in read:
        match = played.match(
            players.rack, breaks=players.break_format, first_breaker=players.first_breaker
        )
        compared.append(
            Compared(played, matches.match_odds(match), matches.even_probability(played, **line))
        )
    pairs = {
        (i, j): matches.crossings(read[i], read[j], **line)
        for i, j in combinations(range(len(read)), 2)
    }
    answer = compare_answer(players, compared, pairs, hold=hold)
    if plot is not None:
        from evenbreak.plots.formats import plot_formats

        figure = plot_formats(
            read,
            line,
            pairs.values(),
            p1=float(players.rack.p1),
            title=answer.heading,
            names=players.names,
        )
        write_plot(figure, plot)
    return answer


def _refuse_numbers(
    *,
    ratings: Sequence[str],
    from_file: str | None,
    p: float | None,
    p1: float | None,
    p2: float | None,
    **_: Any,
) -> None:
    """Refuse a number that was meant for a race."""
    said = not (p is None and p1 is None and p2 is None)
    if ratings and from_file is None and (said or len(ratings) > 2):
        word = ratings[0 if said else 2]
        race = word if word.isdecimal() else "7"
        refuse(f"{word} was read as a rating; write {race}:{race} for a race to {race}")


def _read(texts: Sequence[str], players: TwoPlayers) -> list[MatchFormat]:
    """Return the formats, or refuse those that cannot be compared here."""
    if not texts:
        refuse('the formats are missing; give some, such as 9:5 "3:1 of 3:3" "ahead 5:3"')
    if len(texts) > MOST_FORMATS:
        refuse(f"{len(texts)} formats are given; compare {MOST_FORMATS} at most")
    read = [matches.match_format(text) for text in texts]
    for played in read:
        kinds = [played]
        while kinds[-1].set_ is not None:
            kinds.append(kinds[-1].set_)
        if kinds[-1].breaks is not None and not players.rack.break_matters:
            refuse(
                f"{str(played)!r} says who breaks, which matters only with --p1 and --p2; "
                "leave it out"
            )
        for kind in kinds:
            race = len(kinds) == 1 and not kind.ahead and kind.win_by == 1
            if race and not players.rack.break_matters:
                continue
            most = MOST_SCORES["race" if race else "break" if players.rack.break_matters else ""]
            scores = kind.scores // (kind.set_.scores if kind.set_ else 1)
            if scores > most:
                refuse(
                    f"{str(played)!r} has a part with about {scores:,} scores, and {most:,} are "
                    "the most that can be compared here; use evenbreak odds for such a match"
                )
    return read


def _line(players: TwoPlayers, hold: str | None) -> dict[str, Any]:
    """Return the pairs of players that the formats are compared for, as options of `crossings`."""
    p1, p2 = players.rack.p1, players.rack.p2
    if p2 is None:
        if hold is not None:
            refuse("--hold goes with --p1 and --p2, which are not given; leave it out")
        return {}
    line: dict[str, Any] = {"breaks": players.break_format, "first_breaker": players.first_breaker}
    if hold != "break":
        return line | {"p2": p2}
    if not (0.0 < p1 < 1.0 and 0.0 < p2 < 1.0):
        refuse("--hold break needs --p1 and --p2 above 0 and below 1; use --hold p2")
    return line | {"break_odds": p1 / (1.0 - p1) * p2 / (1.0 - p2)}
