"""What the figures of sections 1 to 4 are drawn for.

The copy of the text that was read has lost the legends of its plots, and with them the values
of most of their curves. The values here are chosen; only the half-ball cut is the text's.
"""

from __future__ import annotations

import math
from fractions import Fraction

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
