"""What the options of `evenbreak simulate` stand for: a season of these players."""

from __future__ import annotations

from typing import Any

from evenbreak import files, league
from evenbreak.cli.kit.options import SAY_WHICH
from evenbreak.cli.kit.systems import chart_for, on_scale, refuse_other_scale
from evenbreak.cli.kit.values import refuse
from evenbreak.ratings.scale import SCALES

WEEKS = 30
"""The length of a season where neither --weeks nor a schedule says it."""


def refuse_contradictions(
    roster: str, jobs: int, cluster: str | None, played: dict[str, Any]
) -> None:
    """Refuse options that exclude each other or are empty."""
    ways = {
        "--schedule": played["schedule_path"] is not None,
        "--round-robin": played["round_robin"],
        "--random": played["by_lot"],
    }
    chosen = [name for name, given in ways.items() if given]
    if len(chosen) > 1:
        refuse(f"{' and '.join(chosen)} cannot be combined; leave all but one out")
    if ways["--schedule"] and played["matches"] is not None:
        refuse("--schedule and --matches cannot be combined; the schedule sets the matches")
    if cluster is not None and jobs > 1:
        refuse("--dask and --jobs cannot be combined; the cluster has workers of its own")
    if cluster is not None and not cluster.strip():
        refuse("--dask is empty; give the scheduler's address, such as tcp://10.0.0.5:8786")
    if [roster, played["schedule_path"], played["chart"]].count("-") > 1:
        refuse("- stands for standard input, which only one file can be; name the others")


def with_entrants(file: files.LeagueFile, path: str, played: dict[str, Any]) -> files.LeagueFile:
    """Return the league with those players who have entered.

    New ones start in the middle of the scale, or of the league if the scale has none.
    """
    scale = on_scale(played["system"], played["scale"]).scale
    of_league = sorted(file.players.rating.tolist())[len(file.players) // 2]
    return files.league_of_entrants(
        file,
        files.read_entrants(path),
        starter=scale.centre if scale.name in SCALES else of_league,
        starter_sd=scale.points_per_doubling,
    )


def season_of_options(
    file: files.LeagueFile, played: dict[str, Any]
) -> tuple[league.Season, list[str]]:
    """Return the season that is asked for, and warnings about roster, chart and schedule."""
    from evenbreak.answers.kit.scales import league_doubts

    system = on_scale(played["system"], played["scale"])
    refuse_other_scale(
        file,
        system.scale,
        f"the system {system.name}",
        SAY_WHICH,
        stated=played["scale"] is not None,
    )
    chart, of_chart = chart_for(system, played["chart"])
    schedule, weeks, of_schedule = _schedule(file, played)
    play = "racks" if played["racks"] else "matches"
    doubts = league_doubts(system.scale, file.players.rating, SAY_WHICH)
    warnings = [*file.warnings, *of_chart, *of_schedule, *doubts]
    return league.Season(file.players, system, chart, schedule, weeks, play), warnings


def _schedule(
    file: files.LeagueFile, played: dict[str, Any]
) -> tuple[league.Schedule, int, list[str]]:
    """Return who plays whom, for how many weeks, and warnings."""
    matches, weeks = played["matches"] or 1, played["weeks"]
    if played["schedule_path"] is None:
        if played["by_lot"]:
            return league.RandomPairing(matches), weeks or WEEKS, []
        return league.RoundRobin(len(file.players), matches), weeks or WEEKS, []
    fixtures = files.read_schedule(played["schedule_path"], file.roster)
    last, warnings = fixtures.schedule.weeks, list(fixtures.warnings)
    if weeks is not None and weeks < last:
        warnings.append(f"{fixtures.source}: matches after week {weeks} are not played")
    if weeks is not None and weeks > last:
        warnings.append(f"{fixtures.source}: ends with week {last}; nobody plays after it")
    return fixtures.schedule, weeks or last, warnings


def matches_to_play(season: league.Season) -> int:
    """Return how many matches one season has, if everybody is always there."""
    match season.schedule:
        case league.FixedSchedule(week=week):
            return int((week <= season.weeks).sum())
        case league.RandomPairing(matches_a_week=many) | league.RoundRobin(matches_a_week=many):
            return season.weeks * many * (len(season.players) // 2)
    return 0
