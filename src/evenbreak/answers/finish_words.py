"""When an evening ends: the times of those that were played out, and how exact they are."""

from evenbreak.answers.parts import Quantities, Quantity
from evenbreak.arrays import Floats
from evenbreak.tournaments.clock.finish import QUANTILES, bands_of


def finish_quantities(finishes: Floats, *more: Quantity) -> Quantities:
    """Return the times of the finish and their largest standard error, and more figures.

    >>> import numpy as np
    >>> [(one.name, round(one.value)) for one in finish_quantities(np.arange(101.0)).of]
    [('finish_p10', 10), ('finish_p50', 50), ('finish_p90', 90), ('finish_error', 5)]
    """
    bands, error = bands_of(finishes)
    times = [Quantity(f"finish_p{100 * q:.0f}", at) for q, at in zip(QUANTILES, bands, strict=True)]
    return Quantities([*times, Quantity("finish_error", error), *more])


def finish_luck(finishes: Floats) -> str:
    """Return by how much other luck would move the times of the finish.

    >>> import numpy as np
    >>> finish_luck(np.arange(101.0))
    '101 evenings were played out; other luck would move the times of the finish by no more than
    about 10 minutes.'
    """
    _, error = bands_of(finishes)
    return (
        f"{len(finishes):,} evenings were played out; other luck would move the times of the "
        f"finish by no more than about {2.0 * error:.0f} minutes."
    )
