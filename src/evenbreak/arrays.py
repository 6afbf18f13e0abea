"""The arrays that functions take and return, by what they hold."""

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Places = NDArray[np.intp]
"""Positions in other arrays."""

Bools = NDArray[np.bool_]
