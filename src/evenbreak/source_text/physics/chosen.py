"""The values for which the figures of sections 1 to 4 are drawn.

The copy of the text that was read has lost the legends of its plots, and with them the values
of most curves. The values here are our choice; only the half-ball cut is the text's.
"""

from __future__ import annotations

import math
from fractions import Fraction

SIDES_AFTER_TIP = tuple(quarter / 4 for quarter in range(-5, 6))
"""Fig. 3.1a: the sidespins J_z just after the tip."""

SIDES_IN_ROLL = tuple(half / 2 for half in range(-7, 8))
"""Fig. 3.1b: the sidespins J_z in natural roll."""

MINIMAL_SIDE = 2.0
"""Fig. 3.2: the sidespin J_z in natural roll of the line drawn."""

MASS_RATIOS = (Fraction(1), Fraction(1, 2), Fraction(1, 3), Fraction(1, 4))
"""Figs. 3.3 and 3.4: mass of the ball over mass of the stick; the text works with the last two."""

LARGEST_OFFSET = 0.7
"""Figs. 3.3 and 3.4: the largest offset b/R, where even a tip of friction 1 slips."""

HALF_BALL = math.pi / 6.0
"""Figs. 4.4 and 4.5: the half-ball cut, as in the text."""

TOPSPINS = (0.0, 0.1, 0.25, 0.5, 1.0)
"""Fig. 4.4: the topspins or draws `|J_y|`; stun and natural roll are named in the text."""

LARGEST_SPIN = 2.0
"""Figs. 4.4 and 4.5: both spins run from minus this value to plus this value."""

LEVELS = tuple(2.0**power for power in range(-4, 7))
"""Fig. 4.5: the sensitivities of the contours; each is twice the one before."""

INSET = 0.1
"""Fig. 4.5: how far the inset reaches from the point where nothing slips."""

TIP_LINE_CUT = math.pi / 6.0
"""Fig. 4.8: the cut angle, chosen as that of a half-ball hit."""
