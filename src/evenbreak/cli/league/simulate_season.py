"""What the options of `evenbreak simulate` stand for: a season of these players."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from evenbreak.cli.kit.callbacks import refuse
from evenbreak.cli.kit.output import say
from evenbreak.cli.kit.scale_doubts import scale_doubts

if TYPE_CHECKING:
    from evenbreak.files.league import LeagueFile
    from evenbreak.league.season import Season

WEEKS = 30
"""How long a season is where neither --weeks nor a schedule says it."""

LONG = 500_000_000
"""Matches that take one process some ten seconds or more."""


def refuse_contradictions(
    roster: str, out: str, jobs: int, cluster: str | None, played: dict[str, Any]
) -> None:
    """Refuse options that exclude each other or say nothing."""
    ways = {
        "--schedule": played["schedule_path"] is not None,
        "--round-robin": played["round_robin"],
        "--random": played["by_lot"],
    }
    chosen = [name for name, given in ways.items() if given]
    if len(chosen) > 1:
        refuse(f"{' and '.join(chosen)} exclude each other; leave all but one out")
    if ways["--schedule"] and played["matches"] is not None:
        refuse("--schedule and --matches exclude each other; the schedule says who has how many")
    if cluster is not None and jobs > 1:
        refuse("--dask and --jobs exclude each other; a cluster has as many workers as it has")
    if cluster is not None and not cluster.strip():
        refuse("--dask is empty; give the scheduler's address, such as tcp://10.0.0.5:8786")
    if not out.strip():
        refuse("--out is empty; name a folder, or . for this one")
    if [roster, played["schedule_path"]].count("-") > 1:
        refuse("- stands for standard input, which only one file can be; name the others")


def season_of_options(file: LeagueFile, played: dict[str, Any]) -> Season:
    """Return the season that is asked for: its system, chart, schedule and weeks."""
    from evenbreak.cli.ladder.ladder_options import chart_of_option, system_of_options
    from evenbreak.files.schedule import read_schedule
    from evenbreak.league.schedule import RandomPairing, RoundRobin, Schedule
    from evenbreak.league.season import Season

    system = system_of_options({**played, "step": None})
    chart = chart_of_option(played["chart_name"], system)
    matches = played["matches"] or 1
    weeks = played["weeks"]
    schedule: Schedule
    if played["schedule_path"] is not None:
        fixtures = read_schedule(played["schedule_path"], file.roster)
        for warning in fixtures.warnings:
            say(f"Warning: {warning}")
        schedule, last = fixtures.schedule, fixtures.schedule.weeks
        if weeks is not None and weeks < last:
            say(f"Warning: {fixtures.source}: what is after week {weeks} is not played")
        if weeks is not None and weeks > last:
            say(f"Warning: {fixtures.source}: ends with week {last}; after it nobody plays")
        weeks = weeks or last
    elif played["by_lot"]:
        schedule = RandomPairing(matches)
    else:
        schedule = RoundRobin(len(file.players), matches)
    play = "racks" if played["racks"] else "matches"
    return Season(file.players, system, chart, schedule, weeks or WEEKS, play)


def remarks(file: LeagueFile, season: Season, replicas: int, *, alone: bool) -> list[str]:
    """Return what is assumed of the players, what looks odd in their list, and what takes long.

    `alone` is whether this process does all the work.
    """
    told = [f"Warning: {warning}" for warning in file.warnings]
    many = len(file.players)
    if file.guessed:
        told.append(
            f"The true skill of {file.guessed:,} of {many:,} players is drawn anew for each "
            "season, by rating and standard error"
        )
    if file.exact:
        told.append(
            f"{file.exact:,} of {many:,} players are taken to be rated rightly at the start: "
            "neither skill nor standard_error is stated"
        )
    doubts = scale_doubts(season.system.scale, file.players.rating, "--scale says what they mean")
    return [*told, *doubts, *_much(season, replicas, alone=alone)]


def _much(season: Season, replicas: int, *, alone: bool) -> list[str]:
    """Return a word on how much there is to play, where it takes more than some seconds."""
    from evenbreak.league.schedule import FixedSchedule, RandomPairing, RoundRobin

    match season.schedule:
        case FixedSchedule(week=week):
            a_season = int((week <= season.weeks).sum())
        case RandomPairing(matches_a_week=many) | RoundRobin(matches_a_week=many):
            a_season = season.weeks * many * (len(season.players) // 2)
    if a_season * replicas < LONG:
        return []
    remedy = "; --jobs shares them out" if alone else ""
    return [f"About {a_season * replicas:,} matches are played{remedy}"]
