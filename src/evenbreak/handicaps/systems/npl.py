"""The National Pool League: a point a match, and longer steps for newcomers.

Source: the text before Table 5.6 (a point up, a point down); the steps of newcomers are those
that the league published, and are not in the text.
"""

from __future__ import annotations

from evenbreak.handicaps.chart import chart
from evenbreak.handicaps.systems.system import PlayedMatch, System, step_after
from evenbreak.ratings.scale import SCALES

__all__ = ["NEWCOMER_STEPS", "NPL"]

NEWCOMER_STEPS = ((10, 3), (20, 2))
"""A newcomer's steps: 3 points a match for 10 matches, 2 for the next 20, then 1."""


def _a_point_a_match(match: PlayedMatch) -> tuple[int, int]:
    winner, loser = match.played
    return step_after(winner, NEWCOMER_STEPS), -step_after(loser, NEWCOMER_STEPS)


NPL = System(
    "npl",
    SCALES["npl"],
    ("npl_8", "npl_10", "npl_12", "npl_20"),
    _a_point_a_match,
    "up 1 point for each match won, down 1 for each match lost",
    own_chart=chart("npl_10"),
    newcomer_steps=NEWCOMER_STEPS,
)
"""The system of the National Pool League; its regular chart is npl_10."""
