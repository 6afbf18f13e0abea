"""The National Pool League: a point a match, and longer steps for newcomers.

Source: the text before Table 5.6.
"""

from __future__ import annotations

from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.systems.newcomers import NEWCOMER_STEPS, step_after
from evenbreak.handicaps.systems.system import PlayedMatch, System
from evenbreak.ratings.scale import SCALES


def _a_point_a_match(match: PlayedMatch) -> tuple[int, int]:
    winner, loser = match.played
    return step_after(winner), -step_after(loser)


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
