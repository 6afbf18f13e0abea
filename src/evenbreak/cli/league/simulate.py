"""`evenbreak simulate`: whole seasons of a league, many times."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING

from evenbreak import files, handicaps, league
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.systems import SAY_WHICH, chart_for, on_scale, refuse_other_scale
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.cluster import cluster_at
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.kit.terminal import say, write_folder
from evenbreak.cli.league.compare import by_any_system, compared, schedule_of
from evenbreak.files.csv_writer import to_csv
from evenbreak.questions.league import Simulate
from evenbreak.ratings.scale import SCALES

if TYPE_CHECKING:
    from evenbreak.answers.league.season_tables import SeasonTables

LONG = 500_000_000
"""Matches that take one process ten seconds or more."""

MANY = 100_000
"""Players times weeks for which one season in full takes seconds."""


@command_of(Simulate, "simulate")
def command(asked: Simulate) -> Answer:
    """Simulate a season many times."""
    from evenbreak.answers.faces.to_csv import to_csv
    from evenbreak.answers.league.season import season_answer
    from evenbreak.answers.league.season_tables import season_tables
    from evenbreak.files.lists.season import read_season_players
    from evenbreak.files.store.folder import check_folder

    file = read_season_players(asked.roster, day_sd=asked.day_sd)
    if asked.players_file is not None:
        file = _with_entrants(file, asked.players_file, asked)
    if asked.out is not None:
        check_folder(asked.out)
    if by_any_system(asked, file):
        return compared(asked, file)
    season, warnings = season_of(file, asked)
    if (many := matches_to_play(season) * asked.replicas) >= LONG:
        remedy = "; --jobs shares the work" if asked.jobs == 1 and asked.dask is None else ""
        say(f"{many:,} matches will be played{remedy}")
    tally = _simulated(season, asked)
    tables = season_tables(season, tally)
    answer = season_answer(
        season,
        tally,
        tables,
        {"roster_file": PurePath(file.source).name, "seed": asked.seed, "day_sd": asked.day_sd},
        drawn=file.drawn,
        exact=file.exact,
        warnings=warnings,
    )
    if asked.out is not None:
        content = _tables(tables) | {"summary.csv": "".join(to_csv(answer)).encode()}
        if not asked.no_matches:
            content |= _one_season(season, asked.seed)
        content |= _pictures(tables)
        write_folder(asked.out, content)
    return answer


def _simulated(season: league.Season, asked: Simulate) -> league.Tally:
    with cluster_at(asked.dask) as client, Progress("seasons") as progress:
        return league.simulate(
            season,
            replicas=asked.replicas,
            seed=asked.seed,
            executor=client,
            jobs=asked.jobs,
            progress=progress,
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
    from evenbreak.plots.picture import image_files

    return image_files(
        {
            "errors_by_week": draw_errors(tables.weeks),
            "wins_by_gap": draw_gaps(tables.fairness),
            "standings": draw_standings(tables.standings),
        }
    )


# The season that is asked for.


def _with_entrants(file: files.SeasonPlayers, path: str, asked: Simulate) -> files.SeasonPlayers:
    """Return the league with those players who have entered.

    New ones start in the middle of the scale, or of the league if the scale has none.
    """
    scale = file.scale or asked.scale or (asked.system or handicaps.system_of("npl")).scale
    of_league = sorted(file.players.rating.tolist())[len(file.players) // 2]
    return files.league_of_entrants(
        file,
        files.read_entrants(path),
        starter=scale.center if scale is not None and scale.name in SCALES else of_league,
        starter_sd=1.0 if scale is None or file.levels else scale.points_per_doubling,
    )


def _system(asked: Simulate) -> handicaps.StepSystem:
    return on_scale(handicaps.steps_of(asked.system or "npl"), asked.scale)


def season_of(file: files.SeasonPlayers, asked: Simulate) -> tuple[league.Season, list[str]]:
    """Return the season that is asked for, and warnings about roster, chart and schedule."""
    from evenbreak.answers.kit.scales import league_doubts

    system = _system(asked)
    refuse_other_scale(
        file, system.scale, f"the system {system.name}", SAY_WHICH, stated=asked.scale is not None
    )
    chart, of_chart = chart_for(system, asked.chart)
    schedule, weeks, of_schedule = schedule_of(file, asked, len(file.players))
    play = "racks" if asked.rack_by_rack else "matches"
    doubts = league_doubts(system.scale, file.players.rating, SAY_WHICH)
    warnings = [*file.warnings, *of_chart, *of_schedule, *doubts]
    return league.Season(file.players, system, chart, schedule, weeks, play), warnings


def matches_to_play(season: league.Season) -> int:
    """Return how many matches one season has, if everyone is always there."""
    match season.schedule:
        case league.FixedSchedule(week=week):
            return int((week <= season.weeks).sum())
        case league.RandomPairing(matches_a_week=many) | league.RoundRobin(matches_a_week=many):
            return season.weeks * many * (len(season.players) // 2)
    return 0
