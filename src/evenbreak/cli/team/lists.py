"""What the commands about teams share: the scale of their lists, the caps, what is played."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import click

from evenbreak import handicaps, teams
from evenbreak.cli.kit.options import SAY_WHICH, Command, chart_option, with_options
from evenbreak.cli.kit.systems import chart_by_difference, refuse_levels, refuse_other_scale
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.files.lists.roster import refuse_to_read
from evenbreak.ratings.scale import unstated_scale
from evenbreak.tournaments.evening.format import LONGEST_RACE

if TYPE_CHECKING:
    from evenbreak.files.lists.teams import TeamList
    from evenbreak.ratings.scale import Scale

_AT_MOST = re.compile(r"\s*(\d+)\s*(?::|x|of)\s*(\d+(?:\.\d+)?)\s*\+?\s*", re.ASCII)


def scale_of_teams(lists: Sequence[TeamList], stated: Scale | None) -> tuple[Scale, list[str]]:
    """Return the scale of the teams' ratings, and the warnings about their files."""
    import numpy as np

    from evenbreak.answers.kit.scales import league_doubts

    for each in lists:
        if stated is not None:
            refuse_other_scale(
                each.file, stated, "--scale", "leave --scale out, or correct the file", stated=True
            )
        else:
            refuse_levels(each.file, "say with --scale how many levels double the odds")
    scales = [each.file.scale for each in lists if each.file.scale is not None]
    if any(not scales[0].same_points(other) for other in scales[1:]):
        files = " and ".join(dict.fromkeys(each.file.source for each in lists))
        refuse(f"{files}: different scales are stated; put all ratings on one")
    rated = np.concatenate([each.file.roster.rating for each in lists])
    names = [name for each in lists for name in each.file.roster.players]
    points = stated or next(iter(scales), None)
    if points is None:
        points = unstated_scale(rated.tolist(), names, SAY_WHICH)
    elif stated is None:
        for each in lists:
            refuse_to_read(each.file, points, "the other team's list", SAY_WHICH)
    warnings = list(dict.fromkeys(line for each in lists for line in each.file.warnings))
    if not scales:
        warnings += league_doubts(points, rated, "is it the right scale?")
    return points, warnings


def race_options(command: Command) -> Command:
    """Add the options that say what is raced to: --race, --race-to and --chart."""
    length: Any = {"type": Whole(1, LONGEST_RACE), "metavar": "N"}
    return with_options(
        command,
        chart_option("Races by this chart, instead of --race."),
        click.option(
            "--race-to",
            **length,
            help="Handicapped races, instead of --race: the stronger player needs N games, the "
            "weaker as many as is fairest.",
        ),
        click.option("--race", **length, help="Even races to N games."),
    )


def race_of(race: int | None, race_to: int | None, chart: str | None, *, or_else: str = "") -> Any:
    """Return the race that one of three options asks for.

    Parameters
    ----------
    race, race_to, chart
        the options' values.
    or_else
        what may be given instead, such as '--games K, '.
    """
    given = [value for value in (race, race_to, chart) if value is not None]
    if len(given) != 1:
        wanted = f"give one of {or_else}--race N, --race-to N and --chart NAME"
        refuse(f"{'the races are missing' if not given else 'the races are given twice'}; {wanted}")
    if chart is not None:
        return chart_by_difference("--chart", chart)
    return handicaps.Fairest(race_to) if race_to is not None else race


def caps_of(team: TeamList, cap: float | None, at_most: str | None) -> tuple[teams.Cap, ...]:
    """Return the caps that --cap and --at-most ask for, with a weight for each player."""
    if cap is None and at_most is None:
        return ()
    if name := team.without_weight:
        refuse(f"{team.file.source} has no level for {name!r}; the caps need one for everybody")
    high = None
    if at_most is not None:
        found = _AT_MOST.fullmatch(at_most)
        if found is None:
            refuse(f"--at-most {at_most!r}; give a number of players and a level, such as 2:6")
        high = int(found[1]), float(found[2])
    return teams.caps_of(team.weights.tolist(), cap, high)
