"""How fast a table is, from the time of a lag."""

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Quantities
from evenbreak.answers.shot_units import Units
from evenbreak.answers.worded import worded
from evenbreak.answers.wording import decimals
from evenbreak.physics.table_speed import TABLE_SPEEDS, lag_speed, table_speed

_WORDS = {"table_speed": ("table speed", 1)}
_DETAILS = {"mu_roll": ("effective rolling friction, 1 / table speed", 4)}
_LEAST, _MOST = 40.0, 250.0
"""Outside these speeds a wrong time or unit is likelier than such a table."""


def table_speed_answer(lag_time: float, distance: float, units: Units) -> Answer:
    """Return the speed of a table, from seconds and the metres that the ball's centre rolls.

    >>> from evenbreak.answers.shot_units import IMPERIAL
    >>> table_speed_answer(7.0, 2.48285, IMPERIAL).sentences
    ['The table speed is 97: normal.']
    """
    speed = table_speed(lag_time, distance=distance)
    cloth = cloth_class(speed)
    values = {"table_speed": speed, "mu_roll": 1.0 / speed, "cloth": cloth}
    pace = lag_speed(lag_time, distance=distance)
    quantities = [
        *worded(values, _WORDS, _DETAILS),
        units.speed.quantity("first_speed", pace, "speed of the ball off the cushion"),
        units.length.quantity("roll", distance, "distance that its centre rolls", detail=True),
    ]
    doubts = []
    if not _LEAST <= speed <= _MOST:
        doubts.append(
            f"hardly any table has a speed of {decimals(0)(speed)}; check the time, and that "
            f"lengths are in {units.length.words}"
        )
    return Answer(
        f"A lag of {lag_time:g} seconds over {units.length.text(distance, 2)}",
        [f"The table speed is {decimals(0)(speed)}: {cloth}.", Quantities(quantities)],
        warnings=doubts,
    )


def cloth_class(speed: float) -> str:
    """Return what a table of this speed is called.

    >>> [cloth_class(speed) for speed in (40.0, 75.0, 100.0, 110.0, 130.0, 160.0)]
    ... # doctest: +NORMALIZE_WHITESPACE
    ['slower than very slow', 'between very slow and normal', 'normal',
     'between normal and very fast', 'very fast', 'fast billiard']
    """
    below = None
    for name, (low, high) in TABLE_SPEEDS.items():
        if speed < low:
            return f"slower than {name}" if below is None else f"between {below} and {name}"
        if speed <= high:
            return name
        below = name
    return str(below)
