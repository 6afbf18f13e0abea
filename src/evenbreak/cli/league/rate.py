"""`evenbreak rate`: ratings with their uncertainty, from a results file."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from evenbreak import answers, files, handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit import completion
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import SAY_WHICH, chart_option, results_options, scale_option
from evenbreak.cli.kit.systems import read_system
from evenbreak.cli.kit.values import NUMBER, number_of, refuse
from evenbreak.cli.league.rate_options import NumberOr, how_to_rate, rated
from evenbreak.ratings.scale import Scale

if TYPE_CHECKING:
    from evenbreak.ratings.fitted import Ratings
    from evenbreak.ratings.results import Results


FIT_ONLY = {
    "anchors": "--anchor",
    "prior": "--prior",
    "half_life": "--half-life",
    "begin": "--begin",
    "save": "--save",
    "as_of": "--as-of",
    "break_advantage": "--break-advantage",
    "pairs": "--pair",
    "scale": "--scale",
}
"""Options that mean nothing to a league's own rule."""

EXAMPLES = """\b
Examples:
  evenbreak rate season.csv --scale fargo
  evenbreak rate last.csv this.csv --half-life 180
  evenbreak rate last.csv --save ratings.csv
  evenbreak rate this.csv --begin ratings.csv
  evenbreak rate season.csv --prior 20 --half-life 180
  evenbreak rate season.csv --anchor "Ann Lee=95" --pair "Ann Lee" "Bo Diaz"
  evenbreak rate --system npl --roster last.csv tonight.csv
"""


@click.command("rate", epilog=EXAMPLES)
@click.argument("results", metavar="RESULTS.csv...", nargs=-1, required=True)
@scale_option(fixed=False)
@click.option(
    "--anchor",
    "anchors",
    multiple=True,
    metavar="POINTS|NAME=POINTS",
    help="The mean rating, or the rating of a named player; can be repeated for several players, "
    "who then have these ratings on average.  [default: the middle of the scale]",
)
@how_to_rate
@click.option(
    "--save",
    metavar="RATINGS.csv",
    help="Also write the ratings to this file, with which the next season can --begin.",
)
@click.option(
    "--break-advantage",
    metavar="POINTS|fit",
    type=NumberOr("fit", -1e6),
    help="How many points better the breaker plays; fit: estimate this, where the file says who "
    "broke.  [default: the break does not matter]",
)
@click.option(
    "--pair",
    "pairs",
    nargs=2,
    multiple=True,
    metavar="A B",
    help="Show how far apart two players are, and how certain that is; can be repeated.",
)
@click.option(
    "--system",
    type=read_system,
    shell_complete=completion.systems,
    metavar="NAME",
    help="Apply a league's own rule to --roster instead, such as npl or 'step 2'.",
)
@click.option(
    "--roster",
    metavar="LAST.csv",
    help="With --system: the list of ratings before these results.",
)
@chart_option(
    "With --system: the chart that set the races, where the file states neither race nor winner.  "
    "[default: the system's chart, if only one fits all scores]"
)
@results_options
@faces()
def command(
    results: tuple[str, ...],
    system: handicaps.System | None,
    roster: str | None,
    chart: str | None,
    reading: dict[str, Any],
    **options: Any,
) -> Answer:
    """Rate players from their results, and show how certain each rating is.

    RESULTS.csv has one match a row, with the columns player_a, player_b, score_a and
    score_b; or winner, loser and score, such as 7-5. Where the score is not known, race and
    winner will do; racks (who won each rack, such as abba) can replace the score. It may
    also be a workbook (.xlsx, .ods) or a tournament saved from CueScore, Challonge or
    brackets-manager. - reads standard input. Several files, such as one for each season, are
    rated as one.
    """
    if system is not None:
        given = [FIT_ONLY[name] for name, value in options.items() if value not in (None, ())]
        if given:
            refuse(f"--system has its own rule; leave out {', '.join(given)}")
        if roster is None:
            refuse("--system needs the ratings before these results; give --roster LAST.csv")
        from evenbreak.cli.league.rate_system import rate_by_system

        if len(results) > 1:
            refuse(f"--system takes one file of results; leave out {results[1]}")
        return rate_by_system(
            results[0], system=system, roster=roster, chart=chart, reading=reading
        )
    for name, value in (("--roster", roster), ("--chart", chart)):
        if value is not None:
            refuse(f"{name} is for --system; give --system npl too, or leave it out")
    return _rate(results, reading, **options)


def _rate(
    paths: Sequence[str],
    reading: dict[str, Any],
    *,
    scale: Scale | None,
    anchors: Sequence[str],
    pairs: Sequence[tuple[str, str]],
    break_advantage: float | str | None,
    save: str | None,
    **how: Any,
) -> Answer:
    from evenbreak.ratings.scale import unstated_scale

    file = files.read_seasons(paths, **reading)
    anchor = _anchor(file, anchors)
    points = anchor if isinstance(anchor, dict) else {"the mean": anchor or math.nan}
    ratings, choice = rated(
        file,
        scale or unstated_scale(points.values(), list(points), SAY_WHICH, "--anchor"),
        anchor=anchor,
        break_advantage=break_advantage,
        **how,
    )
    warnings = []
    if break_advantage is not None and ratings.break_advantage is None:
        warnings.append(
            f"{file.source}: does not say who broke in any game, so --break-advantage changes "
            "nothing; add break_format and first_break, with races or racks"
        )
    chosen = [_pair(ratings, pair) for pair in pairs]
    if save is not None:
        _save(save, file, ratings)
    return answers.rate_answer(file, ratings, choice, pairs=chosen, warnings=warnings)


def _save(path: str, file: files.ResultsFile, ratings: Ratings) -> None:
    """Write the ratings, with which the next season can begin."""
    from evenbreak.cli.kit.terminal import write_file
    from evenbreak.files.lists.saved_ratings import saved_csv
    from evenbreak.ratings.decay import last_day

    day = ratings.as_of or last_day(file.results)
    content = saved_csv(ratings, "" if day is None else str(day), ratings.levels.beginning)
    write_file(path, content)


def _anchor(file: files.ResultsFile, texts: Sequence[str]) -> float | dict[str, float] | None:
    """Return the mean, or the ratings of named players, that --anchor gives."""
    means, named = [], {}
    for text in texts:
        name, _, number = text.rpartition("=")
        if not NUMBER.fullmatch(number.strip()) or not math.isfinite(float(number)):
            refuse(f"--anchor is {text!r}; give points, such as 80, or NAME=POINTS")
        if name.strip():
            (place,) = _places(file.results, [name], "--anchor")
            named[file.results.players[place]] = number_of(number)
        else:
            means.append(number_of(number))
    if len(means) + bool(named) > 1:
        refuse("--anchor gives either one mean or the ratings of named players, not both")
    return named or (means[0] if means else None)


def _pair(ratings: Ratings, names: tuple[str, str]) -> tuple[int, int]:
    found = _places(ratings, names, "--pair")
    if len(found) < 2:
        refuse(f"--pair names the same player twice, {names[0]!r}; name two players")
    return found[0], found[1]


def _places(players: Ratings | Results, names: Sequence[str], option: str) -> list[int]:
    return answers.find_players(players, names, said=option)
