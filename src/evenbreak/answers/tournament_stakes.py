"""What the matches that can be played decide: title odds, prize money, and when it ends."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from evenbreak.tournaments.evening.outlook import Outlook


class Stake(NamedTuple):
    """What a match decides.

    Parameters
    ----------
    title
        the title odds that its result moves from some players to others, on average.
    prize
        the prize money that it moves; None without prizes.
    """

    title: float
    prize: float | None = None


def stakes(outlook: Outlook, prizes: Sequence[float] = ()) -> dict[str, Stake]:
    """Return what the matches that can be played decide, those that decide most first.

    It is empty where that takes too long: in a very large bracket, a Swiss, and before a redraw.

    Parameters
    ----------
    outlook
        the tournament.
    prizes
        the money for each place.

    >>> from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> both = Entrant("Ann", 80.0), Entrant("Bo", 80.0)
    >>> happened = Opened(Plan("single", 5), both), Drawn(("Ann", "Bo"), (0, 1))
    >>> state = evening([Event("2025-03-01T19:30:00", what) for what in happened])
    >>> stakes(Outlook(state, "2025-03-01T19:30:00"), [100.0])
    {'F': Stake(title=0.5, prize=50.0)}
    """
    ready = set(outlook.state.standing.to_play)
    money = {lever.match: lever.swing for lever in outlook.leverages(prizes)} if prizes else {}
    found = {
        lever.match: Stake(
            float(lever.swing.sum()) / 2.0,
            float(money[lever.match].sum()) / 2.0 if lever.match in money else None,
        )
        for lever in outlook.leverages()
        if lever.match in ready
    }
    return dict(sorted(found.items(), key=lambda one: -one[1].title))
