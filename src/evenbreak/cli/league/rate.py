"""`evenbreak rate`: ratings with their uncertainty, from a results file."""

from __future__ import annotations

import math
import sys
import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import NUMBER, refuse, wants_aliases, wants_json
from evenbreak.cli.kit.output import SCHEMA_VERSION, aligned, print_json, say, to_terminal
from evenbreak.cli.league.rate_options import how_to_rate, points, rated

if TYPE_CHECKING:
    import pandas as pd

    from evenbreak.files.results import ResultsFile
    from evenbreak.ratings.fitted import Ratings
    from evenbreak.ratings.prior import PriorChoice

FIT_ONLY = {
    "anchors": "--anchor",
    "prior": "--prior",
    "half_life": "--half-life",
    "as_of": "--as-of",
    "break_advantage": "--break-advantage",
    "pairs": "--pair",
}
"""Options that mean nothing to a league's own update rule."""

WIDTH = 80
"""Columns of a person's terminal: longer lines of words are broken."""

EXAMPLES = """\b
Examples:
  evenbreak rate season.csv --scale fargo
  evenbreak rate season.csv --prior best --half-life 180
  evenbreak rate season.csv --anchor "Ann Lee=95" --pair "Ann Lee" "Bo Diaz"
  evenbreak rate --system npl --roster last.csv tonight.csv
"""


@click.command("rate", epilog=EXAMPLES)
@click.argument("results", metavar="RESULTS.csv")
@click.option(
    "--scale",
    "scale_name",
    metavar="npl|fargo|elo|POINTS",
    help="The scale of the ratings: POINTS of difference double the odds of a game.  "
    "[default: npl]",
)
@click.option(
    "--anchor",
    "anchors",
    multiple=True,
    metavar="POINTS|NAME=POINTS",
    help="The mean rating; or the rating of a named player, and may be given again: the named "
    "have these ratings on average.  [default: the scale's middle]",
)
@how_to_rate
@click.option(
    "--break-advantage",
    metavar="POINTS|fit",
    callback=points,
    help="By how much the breaker of a rack plays better; fit: estimate it, where the file says "
    "who broke.  [default: the break does not matter]",
)
@click.option(
    "--pair",
    "pairs",
    nargs=2,
    multiple=True,
    metavar="A B",
    help="Print how far apart two players are, and how surely; may be given again.",
)
@click.option(
    "--system",
    metavar="NAME",
    help="Apply a league's own update rule instead, such as npl or 'step 2', to --roster.",
)
@click.option(
    "--roster",
    metavar="LAST.csv",
    help="With --system: the list of ratings before these results.",
)
@click.option(
    "--chart",
    metavar="NAME|FILE.csv",
    help="With --system: by which chart they played, where the file states neither race nor "
    "winner.  [default: the system's chart that all scores fit, if only one does]",
)
@wants_aliases
@wants_json
def command(
    results: str,
    scale_name: str | None,
    system: str | None,
    roster: str | None,
    chart: str | None,
    aliases: str | None,
    as_json: bool,
    **asked: Any,
) -> None:
    """Rate players from their results, and say how sure each rating is.

    RESULTS.csv has a match in each row, with the columns player_a, player_b, score_a and
    score_b; or race_a, race_b and winner where no more is known; or racks. Other columns
    are those of `evenbreak report`; - reads standard input.
    """
    if system is not None:
        given = [FIT_ONLY[name] for name, value in asked.items() if value not in (None, ())]
        given += ["--scale"] if scale_name is not None else []
        if given:
            refuse(f"--system moves ratings by its own rule; leave out {', '.join(given)}")
        if roster is None:
            refuse("--system needs the ratings before these results; give --roster LAST.csv")
        from evenbreak.cli.league.rate_system import rate_by_system

        rate_by_system(
            results, system=system, roster=roster, chart=chart, aliases=aliases, as_json=as_json
        )
        return
    if roster is not None:
        refuse("--roster is for --system; give --system npl too, or leave it out")
    if chart is not None:
        refuse("--chart is for --system; give --system npl too, or leave it out")
    _rate(results, scale_name or "npl", aliases, as_json, **asked)


def _rate(
    path: str,
    scale_name: str,
    aliases: str | None,
    as_json: bool,
    *,
    anchors: Sequence[str],
    prior: float | str | None,
    half_life: float | None,
    as_of: str | None,
    break_advantage: float | str | None,
    pairs: Sequence[tuple[str, str]],
) -> None:
    from evenbreak.answers.rate_frames import pairs_frame, rate_frame
    from evenbreak.answers.rate_words import connection_words, pair_rows, rate_rows, rate_words
    from evenbreak.ratings.scale import scale_of

    scale = scale_of(scale_name)
    file = _read(path, aliases)
    ratings, choice = rated(
        file,
        scale,
        prior=prior,
        half_life=half_life,
        as_of=as_of,
        anchor=_anchor(file, anchors),
        break_advantage=break_advantage,
    )
    if break_advantage is not None and ratings.break_advantage is None:
        say(
            "Warning: of no game the file says who broke, so --break-advantage changes nothing; "
            "give break_format and first_break, with races or racks"
        )
    chosen = [_pair(ratings, pair) for pair in pairs]
    frame = pairs_frame(ratings, chosen) if pairs else rate_frame(ratings)
    if as_json:
        print_json(_as_json(ratings, choice, frame, "pairs" if pairs else "players"))
        return
    words = [*rate_words(ratings, choice), *connection_words(ratings)]
    if to_terminal():
        shown = pair_rows(frame) if pairs else rate_rows(frame)
        told = "\n".join(textwrap.fill(line, WIDTH) for line in words)
        _show(told + "\n\n" + aligned(shown, left=2 if pairs else 1))
        return
    from evenbreak.files.csv_writer import to_csv

    for line in words:
        say(line)
    click.echo(to_csv(frame), nl=False)


def _read(path: str, aliases: str | None) -> ResultsFile:
    from evenbreak.files.results import read_results

    file = read_results(path, aliases=aliases)
    for warning in file.warnings:
        say(f"Warning: {warning}")
    return file


def _anchor(file: ResultsFile, texts: Sequence[str]) -> float | dict[str, float] | None:
    """Return the mean, or the ratings of named players, that --anchor gives."""
    from evenbreak.answers.chosen_players import find_players

    means, named = [], {}
    for text in texts:
        name, _, number = text.rpartition("=")
        if not NUMBER.fullmatch(number.strip()) or not math.isfinite(float(number)):
            refuse(f"--anchor is {text!r}; give points, such as 80, or NAME=POINTS")
        if name.strip():
            (place,) = find_players(file.results, [name], said="--anchor")
            named[file.results.players[place]] = float(number)
        else:
            means.append(float(number))
    if len(means) + bool(named) > 1:
        refuse("--anchor gives the mean once, or ratings of named players; not both")
    return named or (means[0] if means else None)


def _pair(ratings: Ratings, names: tuple[str, str]) -> tuple[int, int]:
    from evenbreak.answers.chosen_players import find_players

    found = find_players(ratings, names, said="--pair")
    if len(found) < 2:
        refuse(f"--pair names one player twice, {names[0]!r}; name two")
    return found[0], found[1]


def _as_json(
    ratings: Ratings, choice: PriorChoice | None, frame: pd.DataFrame, what: str
) -> dict[str, Any]:
    scale = ratings.scale
    return {
        "scale": scale.name,
        "points_per_doubling": scale.points_per_doubling,
        "anchor": ratings.anchor,
        "anchored_at": dict(ratings.named),
        "prior_sd_points": float(scale.points(ratings.prior_sd)),
        "prior_sd_log_odds": ratings.prior_sd,
        "priors_tried": None
        if choice is None
        else [
            {"prior_sd_points": float(scale.points(width)), "log_loss": loss}
            for width, loss in zip(choice.tried, choice.log_loss, strict=True)
        ],
        "half_life_days": ratings.half_life,
        "played_by_weight": ratings.weight,
        "as_of": None if ratings.as_of is None else str(ratings.as_of),
        "break_advantage": ratings.break_advantage,
        "break_advantage_standard_error": ratings.break_error,
        "matches": ratings.matches,
        "forfeits_left_out": ratings.forfeits,
        "empty_left_out": ratings.empty,
        "later_left_out": ratings.later,
        what: frame.astype(object).where(frame.notna(), None).to_dict("records"),
        "schema_version": SCHEMA_VERSION,
    }


def _show(text: str) -> None:
    # Names may have letters that the terminal's encoding lacks.
    click.echo(text.encode(sys.stdout.encoding or "utf-8", "replace"), nl=False)
