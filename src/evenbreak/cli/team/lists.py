"""What the commands about two teams share: the scale of both lists, and what is played."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from evenbreak import handicaps
from evenbreak.cli.kit.systems import chart_by_difference, refuse_levels, refuse_other_scale
from evenbreak.cli.kit.values import refuse
from evenbreak.ratings.scale import SCALES

if TYPE_CHECKING:
    from evenbreak.files.team_list import TeamList
    from evenbreak.ratings.scale import Scale


def scale_of_teams(
    lists: tuple[TeamList, TeamList], stated: Scale | None
) -> tuple[Scale, list[str]]:
    """Return the scale of two teams' ratings, and the warnings about both files."""
    import numpy as np

    from evenbreak.answers.scale_doubts import league_doubts

    for each in lists:
        if stated is not None:
            refuse_other_scale(
                each.file, stated, "--scale", "leave --scale out, or correct the file", stated=True
            )
        else:
            refuse_levels(each.file, "say with --scale how many levels double the odds")
    scales = [each.file.scale for each in lists if each.file.scale is not None]
    if len(scales) == 2 and not scales[0].same_points(scales[1]):
        refuse(
            f"{lists[0].file.source} and {lists[1].file.source} state different scales; put all "
            "ratings on one"
        )
    points = stated or next(iter(scales), SCALES["npl"])
    warnings = [line for each in lists for line in each.file.warnings]
    if not scales and stated is None:
        rated = np.concatenate([each.file.roster.rating for each in lists])
        warnings += league_doubts(points, rated, "name the scale with --scale")
    return points, warnings


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
