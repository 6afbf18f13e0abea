"""What the figures of sections 1 to 4 are drawn for.

The copy of the text that was read has lost the legends of its plots, and with them the values
of most of their curves. The values here are chosen; only the half-ball cut is the text's.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from types import MappingProxyType

SIDES_AFTER_TIP = tuple(quarter / 4 for quarter in range(-5, 6))
"""Fig. 3.1a: the sidespins J_z just after the tip."""

SIDES_IN_ROLL = tuple(half / 2 for half in range(-7, 8))
"""Fig. 3.1b: the sidespins J_z in natural roll."""

MINIMAL_SIDE = 2.0
"""Fig. 3.2: the sidespin J_z in natural roll of the line that is shown."""

MASS_RATIOS = (Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(1, 4))
"""Figs. 3.3 and 3.4: mass of the ball over mass of the stick; the text works with the last two."""

LARGEST_OFFSET = 0.7
"""Figs. 3.3 and 3.4: the largest offset b/R, where even a tip of friction 1 slips."""

HALF_BALL = math.pi / 6.0
"""Figs. 4.4 and 4.5: the half-ball cut, of the text."""

TOPSPINS = (0.0, 0.1, 0.25, 0.5, 1.0)
"""Fig. 4.4: the topspins or draws `|J_y|`; stun and natural roll are named in the text."""

LARGEST_SPIN = 2.0
"""Figs. 4.4 and 4.5: both spins run from minus this to this."""

LEVELS = tuple(2.0**power for power in range(-4, 7))
"""Fig. 4.5: the sensitivities of the contours; each is twice the one before."""

INSET = 0.1
"""Fig. 4.5: the inset reaches so far from the point where nothing slips."""

TIP_LINE_CUT = math.pi / 6.0
"""Fig. 4.8: the cut angle, chosen as that of a half-ball hit."""

CAPTIONS: Mapping[str, str] = MappingProxyType(
    {
        "figure_1_1": (
            "Two balls that touch, from above: the normal force, the friction across it, the two "
            "together, and the turn that friction gives, the same way round for both. A sketch."
        ),
        "figure_1_2": (
            "The force of the tip, from above: one part goes to the centre of the ball, the "
            "other one is friction, which holds up to the miscue. A sketch, with b = R/2."
        ),
        "figure_2_1": (
            "A draw shot from the side: the ball slides to the right and spins back, and the "
            "cloth slows both. Clockwise is positive. A sketch."
        ),
        "figure_3_1": (
            "The cue ball from behind, with the contact points of equal sidespin: upright lines "
            "just after the tip (a), lines from the point that stands on the cloth in natural "
            "roll (b). The sidespins are chosen: quarters up to 1¼ (a), halves up to 3½ (b)."
        ),
        "figure_3_2": (
            "The small circle: of all contact points with the same sidespin in natural roll, the "
            "nearest to the centre lies on it. The line shown is chosen, for a sidespin of 2."
        ),
        "figure_3_3": (
            "Speed of the ball over that of the stick, by the offset of the tip. The mass ratios "
            "are chosen: the ball has 1, 1/2, 1/3 and 1/4 of the mass of the stick."
        ),
        "figure_3_4": (
            "Speed of natural roll over that of the stick, by the height of the tip, with the "
            "best height for a lag marked. The mass ratios are chosen, as in Fig. 3.3."
        ),
        "figure_4_1": (
            "The velocities of object ball and cue ball after a hit add up to that before it; C "
            "and the departure angle D add up to 180 degrees. A sketch: a cut of 45 degrees, "
            "with more friction between the balls than there is."
        ),
        "figure_4_2": (
            "A hit from above, in the frame of the shot (x', y') and in that of the line of "
            "centres (x, y), with what friction gives the object ball and takes from the cue "
            "ball. A sketch, with more friction than there is."
        ),
        "figure_4_3": (
            "Which way friction pushes the object ball, as the cue ball sees it, for a half-ball "
            "cut with topspin or draw, without english and with more outside english than "
            "takes the throw away. A sketch, for natural roll and as much draw."
        ),
        "figure_4_4": (
            "The throw factor of a half-ball cut, by sidespin. The topspins are chosen: stun, "
            "0.1, 0.25, 0.5 and natural roll, or as much draw."
        ),
        "figure_4_5": (
            "The sensitivity of the throw factor to the spin, for a half-ball cut. Each contour "
            "stands for twice the sensitivity of the one before. The spins, up to 2, and the "
            "part that the inset enlarges are chosen."
        ),
        "figure_4_6": (
            "A thrown ball that rolls away, from behind: its axis is tilted by about 7/2 of the "
            "throw, and the equator with it. A sketch, for a throw of 5.7 degrees."
        ),
        "figure_4_7": (
            "The deflection of the cue ball by the cut angle, for natural roll, stun and reverse "
            "natural roll; dashed with a scale of its own, how fast that of natural roll changes."
        ),
        "figure_4_8": (
            "The cue ball from behind, with the contact points from which a ball in natural roll "
            "throws nothing. The cut angle is chosen: 30 degrees."
        ),
    }
)
"""What each figure shows, and for which values where these are not the text's."""
