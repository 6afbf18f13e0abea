"""`evenbreak simulate`: whole seasons of a league, many times."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import click

from evenbreak import league, plots
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import (
    chart_option,
    out_option,
    players_file_option,
    scale_option,
    seed_option,
)
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.kit.systems import system_option
from evenbreak.cli.kit.terminal import say, write_folder
from evenbreak.cli.kit.values import Number, Whole
from evenbreak.cli.league.simulate_season import (
    WEEKS,
    matches_to_play,
    refuse_contradictions,
    season_of_options,
    with_entrants,
)
from evenbreak.files.csv_writer import to_csv

if TYPE_CHECKING:
    from evenbreak.answers.league.season_tables import SeasonTables


MOST_WEEKS, MOST_REPLICAS, MOST_JOBS, MOST_MATCHES = 10_000, 10_000_000, 512, 100

LONG = 500_000_000
"""Matches that take one process ten seconds or more."""

MANY = 100_000
"""Players times weeks for which one season in full takes seconds."""

EXAMPLES = """\b
Examples:
  evenbreak simulate roster.csv --chart npl_10 --weeks 30 --out season
  evenbreak simulate roster.csv --schedule fixtures.csv --replicas 10000 --out season
  evenbreak simulate roster.csv --random --day-sd 5 --system "step 2" --out step2
"""


@click.command("simulate", epilog=EXAMPLES)
@click.argument("roster", metavar="ROSTER.csv")
@out_option("The folder for the tables and pictures; created if needed.")
@players_file_option
@system_option()
@scale_option("the system's", fixed=False)
@chart_option()
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
    help="Who plays whom: a file with the columns week, player_a and player_b.",
)
@click.option(
    "--round-robin",
    is_flag=True,
    help="Everybody plays everybody in turn, again and again: the default.",
)
@click.option("--random", "by_lot", is_flag=True, help="Draw opponents at random each week.")
@click.option(
    "--matches",
    type=Whole(1, MOST_MATCHES),
    metavar="N",
    help="Matches per player and week, without a schedule.  [default: 1]",
)
@click.option(
    "--day-sd",
    type=Number(0.0, 1000.0, "; give points from 0 to 1,000"),
    default="0",
    metavar="POINTS",
    help="How much a player's form varies from day to day (standard deviation), where the roster "
    "does not say.",
)
@click.option(
    "--racks", is_flag=True, help="Play rack by rack instead of drawing the winner of each match."
)
@click.option(
    "--replicas",
    type=Whole(1, MOST_REPLICAS),
    default=1000,
    metavar="R",
    help="How many seasons are simulated.",
)
@seed_option("Seed of all random draws; the same seed gives the same files.")
@click.option(
    "--jobs",
    type=Whole(1, MOST_JOBS),
    default=1,
    metavar="J",
    help="How many processes work at a time; the answer is the same.",
)
@click.option(
    "--dask",
    "cluster",
    metavar="ADDRESS",
    help="Use the dask cluster whose scheduler is at ADDRESS, such as tcp://10.0.0.5:8786.",
)
@click.option("--no-matches", is_flag=True, help="Do not write matches.csv and truth.csv.")
@faces()
def command(
    roster: str,
    out: str,
    replicas: int,
    seed: int,
    jobs: int,
    cluster: str | None,
    no_matches: bool,
    players_file: str | None,
    **played: Any,
) -> Answer:
    """Simulate a season many times: how accurate ratings are, how fair matches are, who gains.

    ROSTER.csv has one player per row, with the columns player and rating and, optionally,
    standard_error, matches, skill, day_sd, drift, joins, leaves and absence; - reads standard
    input. A player without a skill gets one drawn for each season from rating and standard
    error. --players-file says who plays, if not everybody; those not on the list are new players.
    matches.csv is one season in full, which `rate` and `validate` can read.
    """
    from evenbreak.answers.faces.to_csv import to_csv
    from evenbreak.answers.league.season import season_answer
    from evenbreak.answers.league.season_tables import season_tables
    from evenbreak.files.lists.season import read_league
    from evenbreak.files.store.folder import check_folder

    refuse_contradictions(roster, jobs, cluster, played)
    file = read_league(roster, day_sd=played["day_sd"])
    if players_file is not None:
        file = with_entrants(file, players_file, played)
    season, warnings = season_of_options(file, played)
    check_folder(out)
    if (many := matches_to_play(season) * replicas) >= LONG:
        remedy = "; --jobs shares the work" if jobs == 1 and cluster is None else ""
        say(f"{many:,} matches are to be played{remedy}")
    tally = _simulated(season, replicas, seed, jobs, cluster)
    tables = season_tables(season, tally)
    answer = season_answer(
        season,
        tally,
        tables,
        {"roster_file": PurePath(file.source).name, "seed": seed, "day_sd": played["day_sd"]},
        drawn=file.drawn,
        exact=file.exact,
        warnings=warnings,
    )
    files = _tables(tables) | {"summary.csv": "".join(to_csv(answer)).encode()}
    if not no_matches:
        files |= _one_season(season, seed)
    files |= _pictures(tables)
    write_folder(out, files)
    return answer


def _simulated(
    season: league.Season, replicas: int, seed: int, jobs: int, cluster: str | None
) -> league.Tally:
    from evenbreak.cli.league.cluster import cluster_at

    with (
        nullcontext() if cluster is None else cluster_at(cluster) as client,
        Progress("seasons") as progress,
    ):
        return league.simulate(
            season, replicas=replicas, seed=seed, executor=client, jobs=jobs, progress=progress
        )


def _tables(tables: SeasonTables) -> dict[str, bytes]:
    return {
        "standings.csv": to_csv(tables.standings),
        "ratings_by_week.csv": to_csv(tables.weeks),
        "fairness.csv": to_csv(tables.fairness),
    }


def _one_season(season: league.Season, seed: int) -> dict[str, bytes]:
    from evenbreak.answers.league.season_tables import matches_frame, truth_frame

    if len(season.players) * season.weeks > MANY:
        say("Playing one season rack by rack; --no-matches leaves it out")
    played = league.season_matches(season, seed)
    return {
        "matches.csv": to_csv(matches_frame(played)),
        "truth.csv": to_csv(truth_frame(season, played)),
    }


def _pictures(tables: SeasonTables) -> dict[str, bytes]:
    from evenbreak.plots.league import draw_errors, draw_gaps, draw_standings

    figures = {
        "errors_by_week": draw_errors(tables.weeks),
        "wins_by_gap": draw_gaps(tables.fairness),
        "standings": draw_standings(tables.standings),
    }
    return {
        f"{name}.{kind}": plots.image_bytes(figure, kind)
        for name, figure in figures.items()
        for kind in ("png", "svg")
    }
