"""The physics of the table: ball, cloth and cue, and their contacts (sections 1 to 4).

All quantities are in SI units and radians (`units` converts from inches and ounces). Frames are
right-handed: x ahead, y to the left, z up. In the frame of the shot, x' points where the cue ball
is going. In the frame of a collision, x points along the line of centers, from the cue ball to
the object ball; the cue ball moves at the cut angle to the left of it, so a cut angle above 0
sends the object ball to the right. Spin is J = R omega / V, one number for each axis:
J_y = 1 is natural roll, J_z above 0 is counterclockwise from above (right english), and outside
english on a cut to the right is negative.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
