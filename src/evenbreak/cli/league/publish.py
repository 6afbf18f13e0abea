"""`evenbreak publish`: a league as a static site."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from evenbreak import answers, files
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import quantities_of
from evenbreak.answers.kit.parts import Part, Quantities
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.league import league_in
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.kit.terminal import say, write_folder
from evenbreak.errors import DataError
from evenbreak.questions.publish import Publish
from evenbreak.words import FilePath

if TYPE_CHECKING:
    from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
    from evenbreak.league.tables.fixtures import Fixture
    from evenbreak.ratings.fitted import Ratings
    from evenbreak.ratings.results import Results
    from evenbreak.ratings.roster import Roster
    from evenbreak.ratings.scale import Scale
    from evenbreak.site.league import PublishedLeague
    from evenbreak.site.names import PublicNames
    from evenbreak.site.races import LeagueRaces
    from evenbreak.site.tournaments import Tournament


@command_of(Publish, "publish", page=False, always_text=True)
def command(asked: Publish) -> Answer:
    """Publish a league."""
    from evenbreak.files.charts import find_chart_file
    from evenbreak.files.store.folder import check_folder
    from evenbreak.ratings.usual import usual_ratings
    from evenbreak.site.league import PublishedLeague
    from evenbreak.site.look import accent
    from evenbreak.site.names import PublicNames, by_appearance
    from evenbreak.site.pages import site_files

    check_folder(asked.out)
    file = _read(asked)
    listed = None if asked.roster is None else files.read_roster(asked.roster)
    everyone = by_appearance(file.results)
    everyone += sorted(listed.roster.players if listed else ())
    of_file = league_in(click.get_current_context())
    names = PublicNames.of(
        everyone,
        asked.naming,
        of_file.publish.players if of_file else {},  # type: ignore[arg-type]
        aliases={} if asked.aliases is None else files.read_aliases(asked.aliases).means,
        where=f"{of_file.path}: [publish.players]" if of_file else "",
    )
    results = names.results(file.results)
    side = _sides(results, names)
    head_start: dict[str, float] = {}
    extra: Sequence[str] = ()
    if asked.teams is not None:
        besides, points, extra = files.read_teams(asked.teams)
        head_start = dict(zip(map(side, besides.names), points.tolist(), strict=True))
    chart: Any = None if asked.chart is None else find_chart_file(asked.chart).chart
    scale = _scale(asked, chart, listed)
    say(f"Rating {len(results.players):,} players")
    with Progress("steps") as progress:
        ratings, _ = usual_ratings(results, scale=scale, progress=progress)
    if not ratings.matches:
        raise DataError(
            [f"{file.source}: none of its matches were played. Add matches with games."]
        )
    league = PublishedLeague(
        asked.title,
        results,
        ratings,
        _races(asked, chart, ratings, results, names, listed),
        names,
        accent(asked.color) if asked.color else None,
        logo=_logo(asked.logo),
        rules=replace(asked.table_points, ties=asked.ties),
        head_start=head_start,
        count_games=asked.count == "games",
    )
    say("Writing the pages")
    fixtures, warnings = _fixtures(asked.schedule, league, side)
    made = site_files(league, _tournaments(asked.tournaments, names), fixtures)
    earlier = _earlier(asked.out)
    foreign = [name for name in made if name not in earlier and Path(asked.out, name).exists()]
    if foreign:
        asked.refuse(
            "{file} wasn't made by an earlier run and would be replaced. Choose another "
            "folder with {out}, or move it away.",
            file=FilePath(Path(asked.out, foreign[0])),
        )
    write_folder(asked.out, {**made, **dict.fromkeys(earlier - {*made})})
    return _answer(asked, league, made, [*file.warnings, *file.ties, *extra, *warnings])


def _read(asked: Publish) -> files.ResultsFile:
    """Return the results; the chart says who won where they state levels, but no races."""
    reading = {**asked.reading, "chart": None, "unplayed": True}
    file = files.read_seasons(asked.results, **reading)
    if asked.chart is None or file.results.level_a is None:
        return file
    return files.read_seasons(asked.results, **{**reading, "chart": asked.chart})


def _scale(asked: Publish, chart: Any, listed: files.RosterFile | None) -> Scale:
    """Return the scale of the ratings, or refuse a chart of differences on an unknown one."""
    from evenbreak.handicaps.charts.chart_of import scale_of_chart
    from evenbreak.ratings.scale import DEFAULT_SCALE, SCALES

    stated = None if listed is None else listed.scale
    if asked.scale is not None and stated is not None and not stated.same_points(asked.scale):
        asked.refuse(
            "{roster} has ratings on the scale {stated}, not the one in {scale}. Leave {scale} "
            "out.",
            stated=stated.text,
        )
    if (scale := asked.scale or stated) is not None:
        return scale
    scale = SCALES[DEFAULT_SCALE] if chart is None else scale_of_chart(chart)
    if scale is None:
        asked.refuse("{scale} is missing. Name the scale of the differences in {chart}.")
    return scale


def _answer(
    asked: Publish, league: PublishedLeague, made: dict[str, bytes], warnings: Sequence[str]
) -> Answer:
    pages = sum(name.endswith(".html") for name in made)
    ways = [*league.names.ways.values()]
    said: list[Part] = [
        f"The site is in {asked.out}. Open {Path(asked.out, 'index.html')} to see it.",
        Quantities(
            quantities_of({"players": len(ways), "matches": league.ratings.matches, "pages": pages})
        ),
    ]
    if league.names.private:
        less = len(ways) - ways.count("full")
        are = "player is" if less == 1 else "players are"
        said.append(f"{less:,} {are} not named in full.")
    else:
        said.append(
            "Every player is named in full. Ask them first: the page About this site says why, and "
            "--names initials or --names hidden shows less."
        )
    if league.accent and league.accent.changed:
        said.append(
            f"The color {asked.color} is too light for text on white, so the site uses "
            f"{league.accent.light} on light screens."
        )
    data = {"folder": asked.out, "files": sorted(made)}
    return Answer(league.title, said, warnings=warnings, data=data)


def _races(
    asked: Publish,
    chart: Any,
    ratings: Ratings,
    results: Results,
    names: PublicNames,
    listed: files.RosterFile | None,
) -> LeagueRaces:
    """Return how races are set: by the chart or the fairest, for the league's list or the ratings.

    A DataError if the chart has skill levels, and neither the list nor the results state them.
    """
    import numpy as np

    from evenbreak.answers.league.by_level import levels_of
    from evenbreak.answers.league.sheet import as_listed
    from evenbreak.handicaps.charts.chart import Chart, ChartRow
    from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
    from evenbreak.handicaps.charts.level_skills import level_skills
    from evenbreak.ratings.roster import Roster
    from evenbreak.site.races import LeagueRaces

    form = ratings.match_form
    by_level = isinstance(chart, (LevelChart, PointsChart))
    if listed is None:
        roster = _last_levels(results, chart) if by_level else as_listed(ratings)
    else:
        of = listed.roster
        public = [names[name] for name in of.players]
        values = of.rating
        if by_level:
            values = np.where(np.isnan(of.level), levels_of(public, None, results), of.level)
        known = ~np.isnan(values)
        known &= [name not in public[:k] for k, name in enumerate(public)]  # aliases
        kept = np.flatnonzero(known)
        errors = None if by_level else of.standard_error[kept]
        roster = Roster([public[k] for k in kept], values[kept], errors, of.games[kept])
    if asked.race is not None:
        chart = Chart("even races", [ChartRow(0, None, asked.race, asked.race)])
    if chart is None:
        return LeagueRaces(roster, ratings.scale, answers.OfferedRaces(**asked.lengths), form=form)
    skills = level_skills(chart, results) if isinstance(chart, LevelChart) else None
    return LeagueRaces(roster, ratings.scale, chart, skills, 0.0 if by_level else form)


def _last_levels(results: Results, chart: LevelChart | PointsChart) -> Roster:
    """Return each player's skill level in the last match that states one (DataError: none does)."""
    import numpy as np

    from evenbreak.handicaps.charts.played_chart import last_levels
    from evenbreak.ratings.roster import Roster

    levels = last_levels(results)
    known = np.flatnonzero(np.isin(levels, chart.levels))
    if not len(known):
        raise DataError(
            [
                f"--chart {chart.name}: the results state no skill levels. Add the "
                "columns level_a and level_b, or give a list with --roster."
            ]
        )
    return Roster([results.players[k] for k in known], levels[known])


def _sides(results: Results, names: PublicNames) -> Callable[[str], str]:
    """Return what tells the public name of a player or a team.

    Who is no team of the results is taken for a player, so that no name slips through.
    """
    from evenbreak.files.tables.names import same_name

    columns = [column for column in (results.team_a, results.team_b) if column is not None]
    teams = {same_name(str(name)): str(name) for column in columns for name in column if name}
    return lambda name: teams.get(same_name(name)) or names[name]


def _fixtures(
    path: str | None, league: PublishedLeague, side: Callable[[str], str]
) -> tuple[list[Fixture], Sequence[str]]:
    """Return the fixtures to be played under public names, and what to check in the file.

    What is due after the last result is to be played, whoever has met before; of the others, what
    the results do not have is postponed. Where they have none at all, such as of matches of teams
    that are known by their players, those up to the last result are taken for played.
    """
    from evenbreak.files.lists.fixtures import read_fixture_list, without_played

    if path is None:
        return [], []
    every, warnings = read_fixture_list(path)
    every = [replace(one, home=side(one.home), away=side(one.away)) for one in every]
    last = league.days[-1].astype(object) if league.days else None
    due = [one for one in every if last is None or one.date is None or one.date <= last]
    left, _, _ = without_played(due, league.results)
    if len(left) == len(due):
        left = [one for one in left if last is None or one.date is None]
    return [*left, *(one for one in every if one not in due)], warnings


def _logo(path: str | None) -> tuple[str, bytes] | None:
    from evenbreak.files.tables.rows import content_of
    from evenbreak.site.look import logo_name

    if path is None:
        return None
    source, content = content_of(path)
    return logo_name(content, source), content


def _tournaments(folder: str | None, names: PublicNames) -> list[Tournament]:
    """Return the tournaments of a folder that are over, the last one first, under public names."""
    from evenbreak.files.store.tournament import tournaments_in
    from evenbreak.site.tournaments import tournament_of

    if folder is None:
        return []
    found = [tournament_of(name, state, names) for name, state in tournaments_in(folder)]
    over = [one for one in found if one is not None]
    return sorted(over, key=lambda one: (one.day, one.file), reverse=True)


def _earlier(out: str) -> set[str]:
    """Return the files that an earlier run has made, and is known to have made, in a folder."""
    from evenbreak.site.bundle import MANIFEST, files_of

    try:
        manifest = Path(out, MANIFEST)
        return {MANIFEST, *files_of(manifest.read_bytes())}
    except (OSError, ValueError):
        return set()
