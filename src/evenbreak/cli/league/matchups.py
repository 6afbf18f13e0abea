"""`evenbreak matchups`: the round's races from a list of rated players."""

from __future__ import annotations

import math
import sys
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import NUMBER, refuse, refuse_both, wants_json, which_races
from evenbreak.cli.kit.old_players import scale_note
from evenbreak.cli.kit.output import SCHEMA_VERSION, print_json, say, to_terminal
from evenbreak.cli.league.matchups_html import html_option, refuse_page, write_page

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.answers.roster_matchups import RosterMatchups
    from evenbreak.cli.league.matchups_words import Told
    from evenbreak.handicaps.charts.chart import Chart
    from evenbreak.handicaps.charts.level_chart import LevelChart
    from evenbreak.ratings.roster import Roster
    from evenbreak.ratings.scale import Scale

MOST_PAIRS = 1_000_000
"""The most pairs that are written to a file: about a minute and 200 MB."""

MOST_SHOWN = 20_000
"""The most pairs that are shown on a terminal or as JSON."""

MOST_MATCHES = 1_000
"""The most matches of one evening."""

MOST_NAMED = 8
FEW_GAMES = 20
FAR_APART = 8.0  # doublings of the odds; from beginners to professionals it is some four
AT_A_TIME = 20_000
LONGEST_GAME = 1440.0  # minutes: a day

EXAMPLES = """\b
Examples:
  evenbreak matchups roster.csv --chart npl_10
  evenbreak matchups roster.csv --games 7..13 --pairs tonight.csv --html tonight.html
  evenbreak matchups roster.csv --race-to 7 --minutes-per-game 8 --tables 4
"""


def _points(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    if value is None:
        return None
    number = float(value) if NUMBER.fullmatch(value.strip()) else math.nan
    if not abs(number) <= 1e6:
        message = f"{value!r} is not a number of rating points; give one such as 80"
        raise click.BadParameter(message, ctx=ctx, param=param)
    return number


def _spread(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    number = _points(ctx, param, value)
    if number is not None and number < 0.0:
        message = f"{value!r} is negative; give 0 or more points, such as 30"
        raise click.BadParameter(message, ctx=ctx, param=param)
    return number


def _minutes(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    if value is None:
        return None
    number = float(value) if NUMBER.fullmatch(value.strip()) else math.nan
    if not 0.0 < number <= LONGEST_GAME:
        message = f"{value!r} is not a number of minutes; give one such as 8 or 7.5"
        raise click.BadParameter(message, ctx=ctx, param=param)
    return number


@click.command("matchups", epilog=EXAMPLES)
@click.argument("roster", metavar="ROSTER.csv")
@click.option("--chart", metavar="NAME|FILE", help="The league's chart, by name or in a file.")
@which_races
@click.option("--pairs", metavar="PAIRS.csv", help="Who meets whom.  [default: all pairs]")
@click.option(
    "--scale",
    metavar="npl|fargo|elo|POINTS",
    help="What the ratings mean: POINTS of difference double the odds.  [default: the "
    "scale of the chart, else npl]",
)
@click.option(
    "--starter",
    metavar="RATING",
    callback=_points,
    help="The rating of a new player.  [default: the scale's middle]",
)
@click.option(
    "--starter-sd",
    metavar="POINTS",
    callback=_spread,
    help="How far it may be off, one standard deviation.  [default: what doubles the odds]",
)
@click.option(
    "--minutes-per-game",
    metavar="MINUTES",
    callback=_minutes,
    help="Tell the length of matches in minutes.",
)
@click.option(
    "--tables", type=click.IntRange(1, 1000), metavar="T", help="Tell when T tables are done."
)
@click.option(
    "--seed",
    type=click.IntRange(0),
    default=0,
    show_default=True,
    metavar="N",
    help="For an evening that has to be played out by pseudo-random numbers.",
)
@html_option
@wants_json
def command(
    roster: str,
    chart: str | None,
    games: tuple[int, int] | None,
    race_to: int | None,
    pairs: str | None,
    scale: str | None,
    starter: float | None,
    starter_sd: float | None,
    minutes_per_game: float | None,
    tables: int | None,
    seed: int,
    html: str | None,
    as_json: bool,
) -> None:
    """Tell which race each pair of players has tonight, and what it is worth.

    ROSTER.csv has a row for each player, with the columns player and rating and, if you
    like, standard_error and games; - is stdin. Races are those of --chart, the fairest
    ones with --games or --race-to, or both. Where errors are stated, chances are averaged
    over what the ratings may be.
    """
    refuse_both(games, race_to)
    if chart is None and games is None and race_to is None:
        refuse("say which races; give --chart NAME, --games LO..HI or --race-to N")
    if tables is not None and minutes_per_game is None:
        refuse("--tables needs to know how long a game takes; add --minutes-per-game, such as 8")
    if [roster, pairs, chart].count("-") > 1:
        refuse("only one list can be on stdin; name a file for the other")
    from evenbreak.answers.fair_pairs import RaceLimits
    from evenbreak.answers.roster_matchups import all_pairs, check_roster
    from evenbreak.cli.league.matchups_words import Told
    from evenbreak.files.roster import read_roster

    table = None if chart is None else _chart(chart)
    points = _scale(scale, chart, table)
    file = read_roster(roster)
    for warning in file.warnings:
        say(f"Warning: {warning}")
    players = _started(file.roster, points, starter, starter_sd)
    check_roster(file, players, table, points)
    if scale is None:
        _doubt_scale(file.roster, points)
    if pairs is None:
        many = len(players) * (len(players) - 1) // 2
        if not many:
            refuse(f"{file.source} has one player; it takes two for a match")
        _refuse_too_many(f"{len(players):,} players make {many:,} pairs", many, tables, as_json)
        if html is not None:
            refuse_page(len(players), None)
        meets = all_pairs(players)
    else:
        meets = _read_pairs(pairs, players)
        _refuse_too_many(f"{pairs} has {len(meets):,} pairs", len(meets), tables, as_json)
        if html is not None:
            refuse_page(len(players), len(meets))
    limits = None if games is None and race_to is None else RaceLimits(games, race_to)
    told = Told(players, points, table, limits, minutes_per_game)
    answer, ends = _print(told, meets, tables, seed, as_json)
    if html is not None:  # of so few pairs that all of them were told at a time
        write_page(html, file, told, answer, ends, listed=pairs is not None)


def _print(
    told: Told, meets: NDArray[Any], tables: int | None, seed: int, as_json: bool
) -> tuple[RosterMatchups, list[dict[str, Any]]]:
    """Print the table, and when the evening ends; return those that were told last."""
    if not as_json and not to_terminal():
        return _stream(told, meets, tables, seed)
    answer = told.matchups(meets)
    ends = [] if tables is None else told.evening(answer, meets, tables, seed)
    if as_json:
        frame = answer.frame.astype(object)  # so that a missing number can be None
        rows = frame.where(frame.notna(), None).to_dict("records")
        print_json({"pairs": rows, "evening": ends, "schema_version": SCHEMA_VERSION})
        return answer, ends
    text = "\n".join([told.text(answer), *told.evening_lines(ends)]).rstrip("\n")
    # Names may have letters that the terminal's encoding lacks.
    click.echo(f"{text}\n".encode(sys.stdout.encoding or "utf-8", "replace"), nl=False)
    return answer, ends


def _stream(
    told: Told, meets: NDArray[Any], tables: int | None, seed: int
) -> tuple[RosterMatchups, list[dict[str, Any]]]:
    """Write the table as CSV, so many pairs at a time that memory is no concern."""
    from evenbreak.files.csv_writer import to_csv

    for line in told.heading.split("\n"):
        say(line)
    for first in range(0, len(meets), AT_A_TIME):
        answer = told.matchups(meets[first : first + AT_A_TIME])
        rows = to_csv(answer.frame)
        click.echo(rows.partition(b"\n")[2] if first else rows, nl=False)
        # An evening is never more pairs than are told at a time.
        ends = [] if tables is None else told.evening(answer, meets, tables, seed)
        for text in told.evening_lines(ends):
            for line in text.split("\n"):
                say(line)
    return answer, ends


def _chart(name: str) -> Chart | LevelChart:
    from evenbreak.files.chart import find_chart_file

    file = find_chart_file(name)
    for warning in file.warnings:
        say(f"Warning: {warning}")
    return file.chart


def _scale(scale: str | None, name: str | None, chart: Chart | LevelChart | None) -> Scale:
    """Return the scale asked for, else that of the chart, else the NPL's."""
    from evenbreak.handicaps.charts.level_chart import LevelChart
    from evenbreak.ratings.scale import SCALES, scale_of

    if scale is not None:
        return scale_of(scale)
    if isinstance(chart, LevelChart):
        refuse(
            f"{name} is a chart of skill levels, which have no scale of their own; say how many "
            "levels double the odds of a game, such as --scale 2"
        )
    of_chart = "" if chart is None else chart.name.partition("_")[0]
    return SCALES.get(of_chart, SCALES["npl"])


def _started(roster: Roster, scale: Scale, starter: float | None, sd: float | None) -> Roster:
    """Return the roster with new players filled in, and say how."""
    import numpy as np

    from evenbreak.handicaps.charts.given_ratings import MOST_DOUBLINGS
    from evenbreak.ratings.scale import SCALES

    unrated = np.isnan(roster.rating)
    if unrated.any() and starter is None and scale.name not in SCALES:
        name = roster.players[int(unrated.argmax())]
        refuse(f"{name!r} has no rating; say with --starter RATING what a new player starts with")
    start = scale.centre if starter is None else starter
    spread = scale.points_per_doubling if sd is None else sd
    most = MOST_DOUBLINGS * scale.points_per_doubling / 2.0
    if spread > most:
        refuse(f"--starter-sd is {spread:g}, which says nothing of a player; give {most:g} at most")
    started = roster.with_starters(start, spread)
    unstated = np.isnan(roster.standard_error)
    _say_of(roster, unrated & unstated, f"No rating yet, taken as {start:g} ± {spread:g}")
    _say_of(roster, unrated & ~unstated, f"No rating yet, taken as {start:g}")
    _say_of(
        roster,
        (roster.games == 0) & ~unrated & unstated,
        f"No games yet, rating taken as right to ± {spread:g}",
    )
    if starter is None and unrated.any() and not unrated.all():
        _doubt_starter(start, roster.rating[~unrated], scale)
    silent = np.isnan(started.standard_error)
    if silent.all():
        say("Nobody's standard_error is stated: all ratings are taken as exact")
    else:
        _say_of(roster, silent, "No standard_error, rating taken as exact")
    few = (roster.games > 0) & (roster.games < FEW_GAMES)
    _say_of(
        roster, silent & few, f"Fewer than {FEW_GAMES} games, rating taken as exact all the same"
    )
    return started


def _doubt_starter(start: float, rated: NDArray[Any], scale: Scale) -> None:
    """Warn of a starter that nobody asked for, a doubling of the odds from all who are rated."""
    least, most = float(rated.min()), float(rated.max())
    if not least - scale.points_per_doubling <= start <= most + scale.points_per_doubling:
        say(
            f"Warning: {start:g} is the middle of the {scale.name} scale, and the ratings here go "
            f"from {least:g} to {most:g}; say with --starter what a new player starts with, or "
            "with --scale what the ratings mean"
        )


def _doubt_scale(roster: Roster, scale: Scale) -> None:
    """Warn of ratings that do not look like those of a scale that was not asked for."""
    import numpy as np

    rated = roster.rating[~np.isnan(roster.rating)]
    if not len(rated):
        return
    apart = float(rated.max() - rated.min()) / scale.points_per_doubling
    if note := scale_note(scale, float(np.median(rated))):  # one slip makes no other scale
        say(note)
    elif apart > FAR_APART:
        say(
            f"Warning: from the weakest to the strongest the odds double {apart:.0f} times on the "
            f"{scale.name} scale; if the ratings are others, say which with --scale"
        )


def _say_of(roster: Roster, which: NDArray[Any], message: str) -> None:
    """Say something of the players that a mask picks, naming the first of them."""
    import numpy as np

    names = [roster.players[place] for place in np.flatnonzero(which)]
    if names:
        more = f" and {len(names) - MOST_NAMED:,} more" if len(names) > MOST_NAMED else ""
        say(f"{message}: {', '.join(names[:MOST_NAMED])}{more}")


def _read_pairs(path: str, roster: Roster) -> NDArray[Any]:
    from evenbreak.files.pairs import read_pairs

    file = read_pairs(path, roster)
    for warning in file.warnings:
        say(f"Warning: {warning}")
    return file.pairs


def _refuse_too_many(found: str, many: int, tables: int | None, as_json: bool) -> None:
    meet = "name those who meet with --pairs PAIRS.csv"
    if tables is not None and many > MOST_MATCHES:
        refuse(f"{found}, and {MOST_MATCHES:,} are the most for one evening; {meet}")
    if many > MOST_PAIRS:
        refuse(f"{found}, and {MOST_PAIRS:,} are the most; {meet}")
    if many > MOST_SHOWN and (as_json or to_terminal()):
        remedy = ["leave out --json"] if as_json else []
        if to_terminal():
            remedy.append("write them to a file, as in > pairs.csv")
        kind = "for --json" if as_json else "to show"
        refuse(f"{found}, too many {kind}; {' and '.join(remedy)}, or {meet}")
