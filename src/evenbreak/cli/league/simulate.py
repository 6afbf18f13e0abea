"""`evenbreak simulate`: whole seasons of a league, many times."""

from __future__ import annotations

import sys
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import click

from evenbreak.cli.kit.callbacks import Whole, number, wants_json
from evenbreak.cli.kit.output import (
    SCHEMA_VERSION,
    aligned,
    paragraphs,
    print_json,
    say,
    to_terminal,
)
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.league.simulate_season import (
    WEEKS,
    refuse_contradictions,
    remarks,
    season_of_options,
)

if TYPE_CHECKING:
    import pandas as pd

    from evenbreak.league.season import Season
    from evenbreak.league.tally import Tally

MOST_WEEKS, MOST_REPLICAS, MOST_JOBS, MOST_MATCHES = 10_000, 10_000_000, 512, 100
LARGEST_SD = 1_000.0

MANY = 100_000
"""Players times weeks from which one season in full takes seconds."""

EXAMPLES = """\b
Examples:
  evenbreak simulate roster.csv --chart npl_10 --weeks 30 --out season
  evenbreak simulate roster.csv --schedule fixtures.csv --replicas 10000 --out season
  evenbreak simulate roster.csv --random --day-sd 5 --system "step 2" --out step2
"""


def _day_sd(ctx: click.Context, param: click.Parameter, value: str) -> float:
    wanted = f"; give points from 0 to {LARGEST_SD:,.0f}"
    return number(value, 0.0, LARGEST_SD, wanted, ctx=ctx, param=param)


@click.command("simulate", epilog=EXAMPLES)
@click.argument("roster", metavar="ROSTER.csv")
@click.option(
    "--out",
    required=True,
    metavar="DIR",
    type=click.Path(file_okay=False),
    help="Where the tables and pictures go; made if it is not there.",
)
@click.option(
    "--system",
    "system_name",
    default="npl",
    show_default=True,
    metavar="NAME",
    help="The league's system: how ratings move, and on which scale.",
)
@click.option(
    "--scale",
    "scale_name",
    metavar="npl|fargo|elo|POINTS",
    help="What ratings mean: POINTS of difference double the odds.  [default: the system's]",
)
@click.option(
    "--chart",
    "chart_name",
    metavar="NAME|CHART.csv",
    help="The chart by which races are given.  [default: the system's]",
)
@click.option(
    "--weeks",
    type=Whole(1, MOST_WEEKS),
    metavar="W",
    help=f"How many weeks are played.  [default: those of the schedule, or {WEEKS}]",
)
@click.option(
    "--schedule",
    "schedule_path",
    metavar="FILE",
    help="Who meets whom: a file with the columns week, player_a and player_b.",
)
@click.option(
    "--round-robin", is_flag=True, help="Everybody meets everybody, again and again: the default."
)
@click.option("--random", "by_lot", is_flag=True, help="Opponents are drawn by lot each week.")
@click.option(
    "--matches",
    type=Whole(1, MOST_MATCHES),
    metavar="N",
    help="Matches of each player in a week, without a schedule.  [default: 1]",
)
@click.option(
    "--day-sd",
    callback=_day_sd,
    default="0",
    show_default=True,
    metavar="POINTS",
    help="How far skills vary from day to day, where the roster does not say.",
)
@click.option("--racks", is_flag=True, help="Play rack by rack, not by the chance of the match.")
@click.option(
    "--replicas",
    type=Whole(1, MOST_REPLICAS),
    default=1000,
    show_default=True,
    metavar="R",
    help="How many seasons are simulated.",
)
@click.option(
    "--seed",
    type=Whole(0, 2**32 - 1),
    default=1,
    show_default=True,
    metavar="S",
    help="Seed of all that is drawn; the same one gives the same files.",
)
@click.option(
    "--jobs",
    type=Whole(1, MOST_JOBS),
    default=1,
    show_default=True,
    metavar="J",
    help="Processes that work at a time; the answer does not depend on it.",
)
@click.option(
    "--dask",
    "cluster",
    metavar="ADDRESS",
    help="Work on the dask cluster whose scheduler is at ADDRESS, such as tcp://10.0.0.5:8786.",
)
@click.option("--no-matches", is_flag=True, help="Do without matches.csv and truth.csv.")
@wants_json
def command(
    roster: str,
    out: str,
    replicas: int,
    seed: int,
    jobs: int,
    cluster: str | None,
    no_matches: bool,
    as_json: bool,
    **played: Any,
) -> None:
    """Simulate the season of a league many times: how wrong, how fair, who profits.

    ROSTER.csv has a player in each row, with the columns player, rating and, if you like,
    standard_error, matches, skill, day_sd, drift, joins, leaves and absence; - reads standard
    input. Without a skill the true one is drawn for each season, by rating and standard error.
    matches.csv is one season in full, which `rate` and `validate` read.
    """
    from evenbreak.answers.season_frames import season_frame
    from evenbreak.files.folder import check_folder, write_files
    from evenbreak.files.league import read_league

    refuse_contradictions(roster, out, jobs, cluster, played)
    file = read_league(roster, day_sd=played["day_sd"])
    season = season_of_options(file, played)
    check_folder(out)
    for remark in remarks(file, season, replicas, alone=jobs == 1 and cluster is None):
        say(remark)
    tally = _simulated(season, replicas, seed, jobs, cluster)
    settings = {"roster_file": PurePath(file.source).name, "seed": seed, "day_sd": played["day_sd"]}
    told = season_frame(season, tally, settings)
    files = _tables(season, tally, told)
    if not no_matches:
        files |= _one_season(season, seed)
    files |= _pictures(season, tally)
    write_files(out, files)
    say(f"Wrote {', '.join(files)} to {out}")
    _print(season, tally, told, as_json)


def _simulated(season: Season, replicas: int, seed: int, jobs: int, cluster: str | None) -> Tally:
    from evenbreak.league.simulate import simulate as simulated

    executor: Any = None
    if cluster is not None:
        from evenbreak.league.on_dask import DaskExecutor

        executor = DaskExecutor(cluster)
    try:
        with Progress("seasons") as progress:
            return simulated(
                season,
                replicas=replicas,
                seed=seed,
                executor=executor,
                jobs=jobs,
                progress=progress,
            )
    finally:
        if executor is not None:
            executor.shutdown()


def _tables(season: Season, tally: Tally, told: pd.DataFrame) -> dict[str, bytes]:
    from evenbreak.answers.season_frames import fairness_frame, standings_frame, weeks_frame
    from evenbreak.files.csv_writer import to_csv

    return {
        "standings.csv": to_csv(standings_frame(season, tally)),
        "ratings_by_week.csv": to_csv(weeks_frame(tally)),
        "fairness.csv": to_csv(fairness_frame(season, tally)),
        "summary.csv": to_csv(told),
    }


def _one_season(season: Season, seed: int) -> dict[str, bytes]:
    from evenbreak.answers.one_season_frames import matches_frame, truth_frame
    from evenbreak.files.csv_writer import to_csv
    from evenbreak.league.one_season import season_matches

    if len(season.players) * season.weeks > MANY:
        say("Playing one season rack by rack; --no-matches does without it")
    played = season_matches(season, seed)
    return {
        "matches.csv": to_csv(matches_frame(played)),
        "truth.csv": to_csv(truth_frame(season, played)),
    }


def _pictures(season: Season, tally: Tally) -> dict[str, bytes]:
    from evenbreak.plots.diagram import image_bytes
    from evenbreak.plots.seasons import errors_figure, gaps_figure, standings_figure

    figures = {
        "errors_by_week": errors_figure(tally),
        "wins_by_gap": gaps_figure(season, tally),
        "standings": standings_figure(season, tally),
    }
    return {
        f"{name}.{kind}": image_bytes(figure, kind)
        for name, figure in figures.items()
        for kind in ("png", "svg")
    }


def _print(season: Season, tally: Tally, told: pd.DataFrame, as_json: bool) -> None:
    """Print what the season says: as words on a terminal, the summary in CSV into a pipe."""
    if as_json:
        print_json(_as_json(told))
    elif to_terminal():
        from evenbreak.answers.season_words import season_words, standings_rows

        words = "\n\n".join(paragraphs(text) for text in season_words(season, tally))
        text = f"{words}\n\n{aligned(standings_rows(season, tally), left=2)}"
        # Names may have letters that the terminal's encoding lacks.
        click.echo(text.encode(sys.stdout.encoding or "utf-8", "replace"), nl=False)
    else:
        from evenbreak.files.csv_writer import to_csv

        click.echo(to_csv(told), nl=False)


def _as_json(told: pd.DataFrame) -> dict[str, Any]:
    import math

    def plain(value: Any) -> Any:
        return None if isinstance(value, float) and not math.isfinite(value) else value

    rows = told.to_dict("records")
    return {
        **{row["quantity"]: plain(row["value"]) for row in rows},
        "standard_errors": {
            row["quantity"]: row["standard_error"]
            for row in rows
            if math.isfinite(row["standard_error"])
        },
        "schema_version": SCHEMA_VERSION,
    }
