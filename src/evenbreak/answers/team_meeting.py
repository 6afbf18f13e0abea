"""What is played in a team match, in words."""

from __future__ import annotations

from evenbreak.handicaps.charts.race_of_pair import Fairest, Race


def race_words(race: Race) -> str:
    """Return what is played in a set.

    >>> race_words(5), race_words(Fairest(7))
    ('races to 5', 'the fairest races to 7')
    """
    if isinstance(race, Fairest):
        return f"the fairest races to {race.race_to}"
    return f"races to {race}" if isinstance(race, int) else f"races by {race.name}"


def cost_words(cost: float) -> str:
    """Return a difference of chances.

    >>> cost_words(0.041), cost_words(0.0)
    ('4.1%', '')
    """
    return f"{100.0 * cost:.1f}%" if cost >= 5e-4 else ""
