"""`evenbreak simulate --compare`: handicap systems side by side in one league."""

from __future__ import annotations

from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import numpy as np

from evenbreak import files, handicaps, league
from evenbreak.answers.kit.systems import SAY_WHICH, stated_pace
from evenbreak.cli.kit.cluster import cluster_at
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.kit.said import refuse
from evenbreak.cli.kit.terminal import write_folder
from evenbreak.files.csv_writer import to_csv
from evenbreak.handicaps.systems.level_review import nearest_level
from evenbreak.questions.league import WEEKS
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.words import Parameter, Sentence, say, say_count

if TYPE_CHECKING:
    from evenbreak.answers.kit.answer import Answer
    from evenbreak.questions.league import Simulate


def by_any_system(asked: Simulate, file: files.SeasonPlayers) -> bool:
    """Return whether a season is played by the simulation that knows every system.

    Singles under a system of steps have a faster one, which follows each player too.
    """
    steps = isinstance(asked.system or _usual(asked, file), handicaps.StepSystem)
    here = ("compare", "seasons", "newcomers", "sandbaggers", "discipline", "minutes_per_game")
    more = any(name in asked.given for name in here)
    return more or not steps or file.levels or file.teams is not None


def _usual(asked: Simulate, file: files.SeasonPlayers) -> handicaps.System:
    """Return the system of a league that names none: by its levels, or by its scale."""
    if file.levels or (asked.chart is not None and _is_by_levels(files.find_chart(asked.chart))):
        return handicaps.system_of("level-review")
    scale = file.scale if asked.scale is None else None
    names = {"fargo": "fargo-like", "elo": "elo"}
    return handicaps.system_of(names.get(scale.name if scale else "", "npl"))


def _is_by_levels(chart: Any) -> bool:
    return isinstance(chart, handicaps.LevelChart | handicaps.PointsChart)


def compared(asked: Simulate, file: files.SeasonPlayers) -> Answer:
    """Return the comparison that is asked for, and write its files."""
    from evenbreak.answers.league import compare
    from evenbreak.answers.league.captains import SealedCaptains

    _refuse_without_teams(asked, file)
    systems, warnings = _systems(asked, file)
    world, assumed = _world(asked, file, systems[0])
    with cluster_at(asked.dask) as client, Progress("seasons") as progress:
        contest = league.play_systems(
            world,
            systems,
            replicas=asked.replicas,
            seed=asked.seed,
            captains=SealedCaptains(asked.sets, asked.cap) if asked.best_line_ups else None,
            executor=client,
            jobs=asked.jobs,
            progress=progress,
        )
    comparison = compare.Comparison(contest, world, systems)
    answer = compare.comparison_answer(
        comparison,
        {"roster_file": PurePath(file.source).name, "seed": asked.seed, "day_sd": asked.day_sd},
        assumed=assumed,
        pace=stated_pace(asked.discipline, asked.minutes_per_game),
        warnings=[*file.warnings, *warnings],
    )
    if asked.out is not None:
        write_folder(asked.out, _files(comparison))
    return answer


def _refuse_without_teams(asked: Simulate, file: files.SeasonPlayers) -> None:
    """Refuse options that only leagues of teams have, or that those do not have."""
    of_teams = [name for name in ("sets", "cap", "best_line_ups") if name in asked.given]
    if file.teams is None and of_teams:
        asked.refuse(
            "{part} is for teams. Add a team column to {file}.", part=Parameter(of_teams[0]),
            file=file.source,
        )  # fmt: skip
    if file.teams is not None and asked.random:
        asked.refuse("{random} is for individual players; teams meet in turn, or by {schedule}")
    if file.teams is not None and asked.players_file is not None:
        asked.refuse("{players_file} can't be used with teams. List everyone with their team.")


def _files(comparison: Any) -> dict[str, bytes]:
    from evenbreak.answers.league import compare
    from evenbreak.plots.league import draw_errors_compared, draw_even
    from evenbreak.plots.picture import image_files

    frames = {
        "measures": compare.measures_frame(comparison),
        "deciles": compare.deciles_frame(comparison),
        "nights": compare.nights_frame(comparison),
        "players": compare.players_frame(comparison),
    }
    figures = {
        "even_by_decile": draw_even(frames["deciles"]),
        "errors_by_night": draw_errors_compared(frames["nights"]),
    }
    content = {f"{name}.csv": to_csv(frame) for name, frame in frames.items()}
    return content | image_files(figures)


def _systems(
    asked: Simulate, file: files.SeasonPlayers
) -> tuple[list[handicaps.System], list[Sentence]]:
    """Return the systems on the charts that are asked for, and warnings."""
    chart = None if asked.chart is None else files.find_chart(asked.chart)
    if isinstance(chart, handicaps.PointsChart):
        refuse(
            f"--chart {asked.chart} counts points, not games, so its matches can't "
            "be simulated yet. Give a chart of races, such as apa_8ball."
        )
    every = list(asked.compared)
    if not every or (asked.system is None and len(every) == 1):
        usual = _usual(asked, file)
        every = list({system.name: system for system in (usual, *every)}.values())
    if chart is None:
        return every, []
    # A chart of differences holds for ratings of one scale.
    fitting = [
        type(system.chart) is type(chart) and (system.scale == every[0].scale) for system in every
    ]
    if not fitting[0]:
        refuse(
            f"the system {every[0].name} can't be used with the chart {chart.name}. Give "
            "the league's own system first, or leave --chart out."
        )
    others = [
        system.name
        for system, fits in zip(every, fitting, strict=True)
        if not fits and system.chart
    ]
    notes = [
        say_count("{names} uses its own chart.", "{names} use their own charts.",
                  len(others), names=", ".join(others))
    ] if others else []  # fmt: skip
    return [
        system.on_chart(chart) if fits else system
        for system, fits in zip(every, fitting, strict=True)
    ], notes


def schedule_of(
    file: files.SeasonPlayers, asked: Simulate, sides: int
) -> tuple[league.Schedule, int, list[str]]:
    """Return which players (or teams) meet, for how many weeks, and warnings."""
    matches, weeks = asked.matches or 1, asked.weeks
    if asked.schedule is None:
        if asked.random:
            return league.RandomPairing(matches), weeks or WEEKS, []
        return league.RoundRobin(sides, matches), weeks or WEEKS, []
    who = Roster(file.team_names, np.zeros(sides)) if file.team_names else file.roster
    fixtures = files.read_schedule(asked.schedule, who)
    last, warnings = fixtures.schedule.weeks, list(fixtures.warnings)
    if weeks is not None and weeks < last:
        warnings.append(f"{fixtures.source}: matches after week {weeks} aren't played")
    if weeks is not None and weeks > last:
        warnings.append(f"{fixtures.source}: ends with week {last}; no one plays after it")
    return fixtures.schedule, weeks or last, warnings


def _world(
    asked: Simulate, file: files.SeasonPlayers, own: handicaps.System
) -> tuple[league.World, list[Sentence]]:
    """Return the league of a roster, and what is assumed of its players."""
    players, scale, notes = file.players, asked.scale or file.scale, []
    if file.levels:
        players, scale, note = _strengths(file, own)
        notes.append(note)
    elif scale is None:
        from evenbreak.answers.kit.systems import refuse_other_scale

        scale = own.scale or SCALES["npl"]
        refuse_other_scale(file, scale, f"the system {own.name}", SAY_WHICH)
    sides = len(players) if file.teams is None else int(file.teams.max()) + 1
    schedule, weeks, warnings = schedule_of(file, asked, sides)
    notes += [say("{text}.", text=text) for text in warnings]
    if file.drawn and not file.levels:
        notes.append(
            say(
                "The true skill of {drawn:,} of {many:,} players is drawn again for each league, "
                "from their rating and its standard error.",
                drawn=file.drawn,
                many=len(players),
            )
        )
    elif not file.levels:
        notes.append(
            say(
                "Ratings are treated as true skills at the start, since the roster has neither "
                "standard_error nor skill."
            )
        )
    if own.publishes == "levels" and np.isnan(file.roster.level).all():
        notes.append(say("The roster states no skill levels; everyone gets the one nearest to "
                         "their rating, and the middle rating is the middle level."))  # fmt: skip
    level = file.players.rating.astype(float) if file.levels else file.roster.level
    return league.World(
        players,
        scale,
        level=None if np.isnan(level).all() else level,
        games=file.roster.games,
        schedule=schedule,
        weeks=weeks,
        seasons=asked.seasons,
        newcomers=asked.newcomers,
        sandbaggers=asked.sandbaggers,
        teams=file.teams,
        sets=asked.sets,
        cap=asked.cap,
    ), notes


def _strengths(
    file: files.SeasonPlayers, own: handicaps.System
) -> tuple[league.LeaguePlayers, Scale, Sentence]:
    """Return the players of a list of levels, in points of strength around the middle level."""
    chart: Any = own.chart
    if not isinstance(chart, handicaps.LevelChart):
        refuse(
            f"{file.source} has skill levels, which the system {own.name} doesn't use. "
            "Give the league's own system first, such as --chart apa_8ball --system level-review."
        )
    skills = handicaps.level_skills(chart)
    scale = SCALES["fargo"]
    of, step = file.players, float(np.diff(skills.points).mean())
    wrong = ~np.isnan(file.roster.level) & ~np.isin(file.roster.level, chart.levels)
    if wrong.any():
        place = int(wrong.argmax())
        refuse(
            f"{file.source}: {file.roster.players[place]!r} has skill level "
            f"{file.roster.level[place]:g}; the levels of {chart.name} are "
            f"{chart.levels[0]} to {chart.levels[-1]}"
        )
    level = nearest_level(chart, of.rating)
    points = scale.center + skills.strength(level) - skills.points.mean()
    # Players of a level are spread at least as evenly as the levels are apart.
    width = skills.spread or step / np.sqrt(12.0)
    players = league.LeaguePlayers.of(
        np.rint(points).astype(np.int64),
        skill=points,
        skill_sd=np.hypot(width, step * of.skill_sd),
        day_sd=of.day_sd,
        drift=of.drift,
        joins=of.joins,
        leaves=of.leaves,
        absence=of.absence,
        played=of.played,
        names=of.names,
    )
    return (
        players,
        scale,
        say(
            "{why} Players at the same level differ by {width:.0f} Fargo points (standard "
            "deviation).",
            why=skills.why,
            width=width,
        ),
    )
