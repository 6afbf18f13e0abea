"""`evenbreak rate`, `why` and `validate`: ratings, what made them, and whether to trust them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

import click

from evenbreak import answers, files, handicaps
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.systems import SAY_WHICH, chart_by_difference, refuse_for_system
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.cluster import cluster_at
from evenbreak.cli.kit.league import league_in
from evenbreak.cli.kit.progress import Progress
from evenbreak.cli.kit.said import number_of, refuse
from evenbreak.cli.kit.terminal import say, write_file, write_plot
from evenbreak.errors import DataError, InputError
from evenbreak.fields.kinds import NUMBER
from evenbreak.questions.ratings import Assumed, HowToRate, Rate, Report, Validate, Why
from evenbreak.ratings.scale import DEFAULT_SCALE, SCALES, Scale

if TYPE_CHECKING:
    from evenbreak.ratings.beginning import Beginning
    from evenbreak.ratings.fitted import Ratings
    from evenbreak.ratings.prior import PriorChoice
    from evenbreak.ratings.results import Results
    from evenbreak.ratings.roster import Roster

MANY = 2_000_000
"""Matches in all refits together that take so long that a person wonders."""


@command_of(Rate, "rate")
def rate(asked: Rate) -> Answer:
    """Rate players from their results."""
    if asked.system is not None:
        return _by_system(asked, asked.system, asked.roster or "")
    from evenbreak.ratings.scale import unstated_scale

    file = files.read_seasons(asked.results, **asked.reading)
    anchor = _anchor(file, asked.anchor)
    points = anchor if isinstance(anchor, dict) else {"the mean": anchor or math.nan}
    scale = asked.scale
    if scale is None and anchor is not None:
        scale = unstated_scale(points.values(), list(points), SAY_WHICH, "--anchor")
    scale = scale or scale_by_chart(asked)
    ratings, choice = rated(
        asked,
        file,
        scale,
        anchor=anchor,
        break_advantage=asked.break_advantage,
        provisional=asked.provisional,
    )
    warnings = []
    if asked.break_advantage is not None and ratings.break_advantage is None:
        warnings.append(
            f"{file.source}: doesn't say who broke in any game, so --break-advantage "
            "changes nothing. Add break_format and first_break, with races or racks."
        )
    pairs = [_pair(ratings, pair) for pair in asked.pair]
    if asked.save is not None:
        _save(asked.save, file, ratings)
    return answers.rate_answer(file, ratings, choice, pairs=pairs, warnings=warnings)


def _save(path: str, file: files.ResultsFile, ratings: Ratings) -> None:
    """Write the ratings, with which the next season can start."""
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
            refuse(f"--anchor must be points, such as 80, or NAME=POINTS; you gave {text!r}")
        if name.strip():
            (place,) = answers.find_players(file.results, [name], said="--anchor")
            named[file.results.players[place]] = number_of(number)
        else:
            means.append(number_of(number))
    if len(means) + bool(named) > 1:
        refuse("--anchor gives either one mean or the ratings of named players, not both")
    return named or (means[0] if means else None)


def _pair(ratings: Ratings, names: tuple[str, str]) -> tuple[int, int]:
    places = answers.find_players(ratings, names, said="--pair")
    if len(places) < 2:
        refuse(f"--pair names the same player twice, {names[0]!r}. Name two players.")
    return places[0], places[1]


# A league's own rule.


def _by_system(asked: Rate, system: handicaps.System, roster: str) -> Answer:
    """Return the list of ratings after a night, or after several, night by night.

    Without a chart the results say who won, or else the only one of the system's charts that fits
    all scores is used.
    """
    from evenbreak.answers.kit.scales import league_doubts

    if not isinstance(system, handicaps.StepSystem):
        return _by_all_results(asked, system, roster)
    by_chart = None if asked.chart is None else chart_by_difference(asked.chart)
    last = files.read_roster(roster)
    refuse_for_system(last, system)
    tonight = files.read_seasons(asked.results, **asked.reading)
    if by_chart is None:
        by_chart = handicaps.chart_of_night(system, last.roster, _first_night(tonight.results))
    try:
        moves = answers.rating_changes_of_season(system, last, tonight, chart=by_chart)
    except DataError:
        for warning in (*last.warnings, *tonight.warnings):  # they may explain it
            say(f"Warning: {warning}")
        raise
    answer = answers.rating_changes_answer(
        moves, last, tonight, chart=by_chart, found_chart=asked.chart is None
    )
    if last.scale is not None:
        return answer
    remedy = f"The system {system.name} uses them as they are."
    doubts = league_doubts(system.scale, last.roster.rating, remedy)
    return replace(answer, warnings=[*answer.warnings, *doubts])


def _by_all_results(asked: Rate, system: handicaps.System, roster: str) -> Answer:
    """Return the list after all nights of a file by a system that looks at all its results."""
    import numpy as np

    if asked.chart is not None:
        system = system.on_chart(files.find_chart(asked.chart))
    last = files.read_roster(roster)
    refuse_for_system(last, system)
    season = files.read_seasons(asked.results, **asked.reading)
    moves = answers.rating_changes_of_season(system, last, season, chart=system)
    answer = answers.rating_changes_answer(moves, last, season)
    stated, begun = last.roster.rating, moves.before.rating
    other = np.flatnonzero(~np.isnan(stated) & (stated != begun))
    if not other.size:
        return answer
    first = int(other[0])
    doubt = (
        f"{last.source}: {len(other)} of the ratings can't be ratings in the system "
        f"{system.name}, such as {stated[first]:g}; these players start at {begun[first]:g}"
    )
    return replace(answer, warnings=[*answer.warnings, doubt])


def _first_night(results: Results) -> Results:
    """Return the matches of the first date, whose races the ratings of the list have set."""
    import numpy as np

    if results.date is None or np.isnat(results.date).all():
        return results
    return results.select(np.flatnonzero(results.date == np.nanmin(results.date)))


@command_of(Why, "why")
def why(asked: Why) -> Answer:
    """Explain two ratings."""
    from evenbreak.ratings.usual import rated_alike

    file = files.read_seasons(asked.results, **asked.reading)
    names = (asked.player_a, asked.player_b)
    pair = answers.find_players(file.results, names, said="why", where=file.source)
    if len(pair) < 2:
        refuse(f"{names[0]!r} and {names[1]!r} are the same player. Name two different ones.")
    ratings, choice = rated(asked, file, scale_by_chart(asked))
    played = int(ratings.games[pair].sum())
    if played * len(file.results) > MANY:
        say("Rating the league again without each of their matches")
    chart = None if asked.chart is None else files.find_chart(asked.chart)
    return answers.why_answer(
        file,
        ratings,
        (pair[0], pair[1]),
        answers.OfferedRaces(**asked.lengths),
        rated_alike(ratings, file.results),
        choice,
        None if isinstance(chart, handicaps.PointsChart) else chart,
        _levels_listed(),
    )


def _levels_listed() -> Roster | None:
    """Return the list of the league in whose folder the command runs, if it has one."""
    league = league_in(click.get_current_context())
    if league is None or league.files.roster is None:
        return None
    return files.read_roster(league.place(league.files.roster)).roster


@command_of(Validate, "validate")
def validate(asked: Validate) -> Answer:
    """Find out whether ratings can be trusted."""
    from evenbreak.ratings import validate as validated

    scale = scale_by_chart(asked)
    prior_sd = prior_in_log_odds(asked, scale) if isinstance(asked.prior, float) else None
    file = files.read_seasons(asked.results, **asked.reading)
    try:
        with cluster_at(asked.dask) as client, Progress("steps") as progress:
            validation = validated(
                file.results,
                prior_sd=prior_sd,
                half_life=_half_life(asked),
                beginning=_beginning(asked, file, scale),
                seed=asked.seed,
                executor=client,
                jobs=asked.jobs,
                progress=progress,
            )
    except InputError as error:  # the options have been checked, so it is the data
        raise DataError([f"{file.source}: {error}"]) from None
    if asked.plot is not None:
        from evenbreak.plots.league import draw_calibration

        write_plot(draw_calibration(validation), asked.plot)
    chart = handicaps.league_chart(file.results)
    return answers.validate_answer(file, validation, scale, seed=asked.seed, chart=chart)


# How to rate, as `report` does too.


def scale_by_chart(asked: Rate | Why | Validate | Report) -> Scale:
    """Return the scale that is asked for, or else the one that goes with the chart."""
    if asked.scale is not None:
        return asked.scale
    chart = None if asked.chart is None else files.find_chart(asked.chart)
    return handicaps.scale_of_chart(chart) or SCALES[DEFAULT_SCALE]


def rated(
    asked: HowToRate, file: files.ResultsFile, scale: Scale, **more: Any
) -> tuple[Ratings, PriorChoice | None]:
    """Return the ratings of results, with day-to-day form, and how their prior was chosen.

    `more` is for `usual_ratings`. A DataError if no match counts.
    """
    from evenbreak.ratings.usual import usual_ratings

    day = asked.day("as_of")
    beginning = _beginning(asked, file, scale)
    with Progress("steps") as progress:
        ratings, choice = usual_ratings(
            file.results,
            scale=scale,
            prior=prior_in_log_odds(asked, scale)
            if isinstance(asked.prior, float)
            else asked.prior,
            half_life=_half_life(asked),
            as_of=day,
            beginning=beginning,
            progress=progress,
            **more,
        )
    if not ratings.matches:
        why_none = "were played. Add matches with games."
        if ratings.later:
            why_none = f"were played by {day}. Give a later day to --as-of."
        raise DataError([f"{file.source}: none of its matches {why_none}"])
    return ratings, choice


def prior_in_log_odds(asked: Assumed, scale: Scale) -> float:
    """Return the standard deviation that --prior gives, in log-odds, or refuse it."""
    from evenbreak.ratings.fit import NARROWEST, WIDEST

    points = float(asked.prior or 0.0)
    width: float = scale.log_odds(points)
    if not NARROWEST <= width <= WIDEST:
        asked.refuse(
            "{prior} is {points:g} points; on this scale give {least:.2g} to {most:.4g}",
            points=points,
            least=scale.points(NARROWEST),
            most=scale.points(WIDEST),
        )
    return width


def _half_life(asked: Assumed) -> float | Literal["best"] | None:
    """Return the half-life as `best_prior` takes it: what is asked for, or the best."""
    if asked.half_life is None:
        return "best"
    return None if asked.half_life == "none" else float(asked.half_life)


def _beginning(asked: Assumed, file: files.ResultsFile, scale: Scale) -> Beginning | None:
    """Return the ratings that --start names, in the spelling of the results, or refuse them."""
    from evenbreak.answers.kit.scales import league_doubts
    from evenbreak.files.lists.saved_ratings import read_saved
    from evenbreak.ratings.scale import refuse_contradicted

    path = asked.begin
    if path is None:
        return None
    saved = read_saved(path, scale, file.results.players)
    if not saved.found:
        refuse(f"--begin {path}: none of its players is in {file.source}. Check the names.")
    beginning, day = saved.beginning, saved.beginning.as_of
    if not saved.scale_stated:
        remedy = "Name the scale with --scale, or add a column scale."
        listed = beginning.rating.tolist(), beginning.players
        try:
            refuse_contradicted(scale, *listed, whose="the new ratings", remedy=remedy)
        except InputError as error:
            refuse(f"--begin {path}: {error}")
        for doubt in league_doubts(scale, beginning.rating, remedy):
            refuse(f"--begin {path}: {doubt}")
    if day is not None and file.results.date is not None:
        earlier = int((file.results.date[file.results.counted] <= day).sum())
        if earlier:
            refuse(
                f"--begin {path}: its ratings are as of {day}, and {earlier:,} of the "
                f"matches in {file.source} are from that day or earlier, so they would "
                "count twice. Give only the later matches."
            )
    return beginning
