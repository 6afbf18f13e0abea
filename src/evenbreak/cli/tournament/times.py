"""Times of day as options."""

from evenbreak.cli.kit.asked import Typed
from evenbreak.questions.tournament import TIME_OF_DAY


def TimeOfDay() -> Typed:  # noqa: N802
    """Return the type of a time of day such as 19:30; its value is in minutes after midnight."""
    return Typed(TIME_OF_DAY)
