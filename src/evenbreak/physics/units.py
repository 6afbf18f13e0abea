"""The units that players use, in SI units.

Multiply to convert to SI, divide to convert back: `9 * INCH` is in metres, `length / INCH` in
inches.
"""

import math

INCH = 0.0254
"""Metres in an inch."""

FOOT = 12.0 * INCH
"""Metres in a foot."""

CENTIMETRE = 0.01
"""Metres in a centimetre."""

OUNCE = 0.028349523125
"""Kilograms in an ounce (avoirdupois)."""

GRAM = 0.001
"""Kilograms in a gram."""

DEGREE = math.pi / 180.0
"""Radians in a degree."""

GRAVITY = 386.0 * INCH
"""The acceleration of gravity in m/s^2: 386 in/s^2 = 9.8044 m/s^2, the value of the source text."""
