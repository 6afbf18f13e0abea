"""The table side: ball, cloth, cue and what happens when they meet (sections 1 to 4).

Everything is computed in SI units and radians (`units` has the players' units). Frames are
right-handed: x ahead, y to the left, z up. Along the shot, x' points where the cue ball goes;
at a collision, x points along the line of centres, from the cue ball to the object ball, and
the cue ball comes in at the cut angle to the left of it, so that a cut angle above 0 sends
the object ball to the right. A spin is J = R omega / V, one number for each axis: J_y = 1 is
natural roll, J_z above 0 is counterclockwise from above (right english), and outside english
on a cut to the right is negative.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
