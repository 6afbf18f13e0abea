"""`evenbreak compare`: match formats side by side, for the same two players."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations, zip_longest
from textwrap import fill, wrap
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from evenbreak.cli.kit.options import NUMBER, PlainCommand, refuse, wants_json
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

if TYPE_CHECKING:
    from evenbreak.matches.crossings import Crossing, Crossings
    from evenbreak.matches.formats import MatchFormat
    from evenbreak.matches.odds import Odds

COLUMNS = (
    "format",
    "p_win_a",
    "from_even",
    "mean_games",
    "games_p90",
    "even_p1",
    "even_places",
)
HEADINGS = ("format", "A wins", "from even", "games", "9 of 10 in", "even at")

MOST_FORMATS = 7
"""Formats side by side: as many as a picture has lines for."""

MOST_SCORES = {"race": 10_000, "break": 900, "": 2_500}
"""Scores that a match may have: a race where the break matters, another match where it does,
and another match where it does not. Each answer then takes seconds."""

WIDTH = 80
"""Of a terminal, in characters."""

NARROWEST = 14
"""Room for the name of a format, in characters."""

SAME = 1e-12
"""Two chances that differ by less are the same but for rounding."""

EXAMPLES = """\b
Examples:
  evenbreak compare --p 0.6667 9:5 "3:1 of 3:3" "ahead 5:3"
  evenbreak compare 612 521 --scale fargo 7:5 "7:7 win by 2" --plot formats.png
  evenbreak compare --p1 0.6 --p2 0.55 --breaks winner 9:7 "9:7 alternate breaks"
"""


class CompareCommand(PlainCommand):
    """A command whose words are ratings, which are numbers, and formats, which are not."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Read the arguments, and part the words."""
        ctx.ignore_unknown_options = any(
            word.startswith("-") and NUMBER.fullmatch(word) for word in args
        )
        rest = click.Command.parse_args(self, ctx, args)
        words: Sequence[str] = ctx.params["ratings"]
        ctx.params["ratings"] = tuple(word for word in words if NUMBER.fullmatch(word))
        ctx.params["formats"] = [word for word in words if not NUMBER.fullmatch(word)]
        for word in ctx.params["formats"]:
            if word.startswith("-"):
                raise click.NoSuchOption(word.split("=")[0], ctx=ctx)
        return rest

    def collect_usage_pieces(self, ctx: click.Context) -> list[str]:
        """Name the two kinds of words apart."""
        return [*super().collect_usage_pieces(ctx), "FORMAT..."]


class Compared(NamedTuple):
    """A format with what it means for the two players."""

    format: MatchFormat
    odds: Odds
    even: tuple[Crossing, ...]


@click.command("compare", cls=CompareCommand, epilog=EXAMPLES)
@player_options
@click.option(
    "--hold",
    type=click.Choice(["p2", "break"]),
    help="What stays as P1 varies: P2, or the advantage of the break.  [default: p2]",
)
@wants_json
@plot_option
def command(
    formats: list[str], hold: str | None, as_json: bool, plot: str | None, **who: Any
) -> None:
    """Compare match formats for two players: who gains by which, and where they cross.

    A FORMAT is 9:5 (A needs 9 games, B needs 5), "7:7 win by 2", "ahead 5:3" or
    "3:1 of 3:3" (sets), and may end in who breaks, such as "winner breaks". Who plays:
    two ratings A B; or --p; or --p1, --p2 and --breaks.
    """
    from evenbreak.matches.crossings import crossings, even_probability
    from evenbreak.matches.odds import match_odds

    _refuse_numbers(**who)
    players = Players.of(**who)
    read = _read(formats, players)
    line = _line(players, hold)
    compared = []
    for played in read:
        match = played.match(
            players.rack, breaks=players.breaks, first_breaker=players.first_breaker
        )
        compared.append(Compared(played, match_odds(match), even_probability(played, **line)))
    pairs = {
        (i, j): crossings(read[i], read[j], **line) for i, j in combinations(range(len(read)), 2)
    }
    if plot is not None:
        from evenbreak.plots.formats import plot_formats

        write_plot(plot_formats(read, line, pairs.values(), p1=float(players.rack.p1)), plot)
    if as_json:
        print_json(_answer(compared, pairs))
    elif not to_terminal():
        click.echo(csv_text(COLUMNS, [_row(one) for one in compared]), nl=False)
    else:
        click.echo(f"{players.description}\n\n{_text(players, compared, pairs, hold)}", nl=False)


def _refuse_numbers(
    *, ratings: Sequence[str], p: float | None, p1: float | None, p2: float | None, **_: Any
) -> None:
    """Refuse a number that was meant for a race."""
    said = not (p is None and p1 is None and p2 is None)
    if ratings and (said or len(ratings) > 2):
        word = ratings[0 if said else 2]
        race = word if word.isdecimal() else "7"
        refuse(f"{word} was read as a rating; write {race}:{race} for a race to {race}")


def _read(texts: Sequence[str], players: Players) -> list[MatchFormat]:
    """Return the formats, or refuse those that cannot be compared here."""
    from evenbreak.matches.formats import match_format

    if not texts:
        refuse('what is compared is missing; give formats such as 9:5 "3:1 of 3:3" "ahead 5:3"')
    if len(texts) > MOST_FORMATS:
        refuse(f"{len(texts)} formats are given; compare {MOST_FORMATS} at the most")
    read = [match_format(text) for text in texts]
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
                    f"{str(played)!r} has a part with about {scores:,} scores; compare such "
                    f"matches with {most:,} at the most, or ask evenbreak odds for one"
                )
    return read


def _line(players: Players, hold: str | None) -> dict[str, Any]:
    """Return along which players the formats are compared, as options of `crossings`."""
    rack = players.rack
    if not rack.break_matters:
        if hold is not None:
            refuse("--hold says what stays of --p1 and --p2, which are not given; leave it out")
        return {}
    line: dict[str, Any] = {"breaks": players.breaks, "first_breaker": players.first_breaker}
    if hold != "break":
        return line | {"p2": rack.p2}
    if not (0.0 < rack.p1 < 1.0 and 0.0 < rack.p2 < 1.0):
        refuse("--hold break needs --p1 and --p2 between 0 and 1; take --hold p2")
    odds: float = rack.p1 / (1.0 - rack.p1) * rack.p2 / (1.0 - rack.p2)
    return line | {"break_odds": odds}


def _row(one: Compared) -> tuple[Any, ...]:
    text = str(one.format)
    return (
        # A bare 9:5 is a time of day to a spreadsheet.
        f"race {text}" if text[0].isdigit() else text,
        one.odds.p_win_1,
        one.odds.p_win_1 - 0.5,
        one.odds.mean_games,
        one.odds.games_p90,
        one.even[0].p1 if one.even else None,
        len(one.even),
    )


def _answer(
    compared: Sequence[Compared], pairs: dict[tuple[int, int], Crossings]
) -> dict[str, Any]:
    """Return what --json prints."""
    names = [str(one.format) for one in compared]
    formats = []
    for one in compared:
        row = dict(zip(COLUMNS[:5], _row(one), strict=False))
        even = [_point(point) for point in one.even]
        formats.append({**row, "format": str(one.format), "even": even})
    return {
        "formats": formats,
        "crossings": [
            {
                "format_1": names[i],
                "format_2": names[j],
                "points": [_point(point) for point in found.points],
                "better_for_a": [(None, names[i], names[j])[k] for k in found.better],
                "exact": found.exact,
            }
            for (i, j), found in pairs.items()
        ],
        "schema_version": SCHEMA_VERSION,
    }


def _point(point: Crossing) -> dict[str, float | None]:
    return {"p1": point.p1, "p2": point.p2, "p_win_a": point.p_win_1}


def _text(
    players: Players,
    compared: Sequence[Compared],
    pairs: dict[tuple[int, int], Crossings],
    hold: str | None,
) -> str:
    """Return what a terminal shows."""
    axis = "p1" if players.rack.break_matters else "p"
    names = [str(one.format) for one in compared]
    rows = [[*HEADINGS[:5], f"even at {axis}"]]
    for one in compared:
        _, wins, off, mean, within, *_ = _row(one)
        rows.append(
            [
                str(one.format),
                chance_text(wins),
                f"{off:+.4f}",
                "" if mean is None else f"{mean:.2f}",
                "" if within is None else str(within),
                ", ".join(chance_text(point.p1) for point in one.even) or "none",
            ]
        )
    text = _narrow(rows)
    if len(compared) == 1:
        return text
    stays = {None: "p2 as it is", "p2": "p2 as it is", "break": "the break's advantage as it is"}
    told = f", {stays[hold]}" if players.rack.break_matters else ""
    turns = [
        [f"{names[i]} or {names[j]}", _turns(found, names[i], names[j])]
        for (i, j), found in pairs.items()
    ]
    width = min(max(len(who) for who, _ in turns), WIDTH // 2)
    listed = ""
    for who, better in turns:
        beside = zip_longest(wrap(who, width), wrap(better, WIDTH - width - 4), fillvalue="")
        listed += "".join(f"  {one.ljust(width)}  {part}".rstrip() + "\n" for one, part in beside)
    advice = fill(_advice(compared), WIDTH)
    return f"{text}\nBetter for A as {axis} grows{told}:\n\n{listed}\n{advice}\n"


def _narrow(rows: Sequence[Sequence[str]]) -> str:
    """Return a table of formats, their names over several lines where it would be too wide."""
    text = aligned(rows, left=1)
    too_wide = max(map(len, text.splitlines())) - WIDTH
    if too_wide <= 0:
        return text
    width = max(max(len(row[0]) for row in rows) - too_wide, NARROWEST)
    lines = []
    for row in rows:
        first, *more = wrap(row[0], width)
        lines += [[first, *row[1:]], *([f"  {part}", *[""] * (len(row) - 1)] for part in more)]
    return aligned(lines, left=1)


def _advice(compared: Sequence[Compared]) -> str:
    """Return in words which format suits A, and which is nearest to even, as they play now."""
    wins = [one.odds.p_win_1 for one in compared]
    best = [str(one.format) for one in compared if one.odds.p_win_1 > max(wins) - SAME]
    if len(best) == len(compared):
        return "As they play now, all are worth the same to A."
    nearest = min(abs(win - 0.5) for win in wins)
    fair = [str(one.format) for one in compared if abs(one.odds.p_win_1 - 0.5) < nearest + SAME]
    return (
        f"As they play now, A is best off with {' and '.join(best)}; "
        f"nearest to even: {' and '.join(fair)}."
    )


def _turns(found: Crossings, one: str, two: str) -> str:
    """Return in words which format is better for A, from weak to strong."""
    names = {1: one, 2: two}
    if found.better == (0,):
        return "the same for all"
    if not found.points:
        return f"{names[found.better[0]]}, always"
    parts = [
        f"{names[better]} up to {chance_text(point.p1)}"
        for better, point in zip(found.better, found.points, strict=False)
    ]
    return ", ".join([*parts, f"then {names[found.better[-1]]}"])
