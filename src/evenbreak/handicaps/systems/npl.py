"""The National Pool League: one point per match, with longer steps for newcomers.

Source: the text before Table 5.6.
"""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.checks import whole
from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.systems.by_match import PlayedMatch, StepSystem
from evenbreak.ratings.scale import SCALES

# Longer steps for newcomers, so that a first guess of their rating is soon corrected.


NEWCOMER_STEPS = ((10, 3), (20, 2))
"""National Pool League steps: 3 points per match for 10 matches, 2 for the next 20, then 1.

The league published them; they are not in the source text.
"""


def step_after(played: int | None, steps: Sequence[tuple[int, int]] = NEWCOMER_STEPS) -> int:
    """Return the factor for a player's steps in the next match; 1 for an established player.

    Parameters
    ----------
    played
        number of earlier matches; None: an established player.
    steps
        (matches, factor) for each stage, as in `System.newcomer_steps`.

    Raises
    ------
    InputError
        if `played` is not a whole number from 0 on.

    >>> [step_after(played) for played in (0, 9, 10, 29, 30, None)]
    [3, 3, 2, 2, 1, 1]
    """
    if played is None:
        return 1
    left = whole(played, "played")
    for matches, factor in steps:
        if left < matches:
            return factor
        left -= matches
    return 1


def _a_point_a_match(match: PlayedMatch) -> tuple[int, int]:
    winner, loser = match.played
    return step_after(winner), -step_after(loser)


NPL = StepSystem(
    "npl",
    SCALES["npl"],
    ("npl_8", "npl_10", "npl_12", "npl_20"),
    _a_point_a_match,
    "up 1 point for each match won, down 1 for each match lost",
    own_chart=chart("npl_10"),
    newcomer_steps=NEWCOMER_STEPS,
)
"""The system of the National Pool League; its regular chart is npl_10."""
