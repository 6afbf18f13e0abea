"""Who can be put up now, and who cannot any more."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

from evenbreak.errors import InputError
from evenbreak.teams.evening.events import Pick
from evenbreak.teams.evening.fold import TeamEvening
from evenbreak.teams.squad import LineUps, Squad, line_ups

_line_ups = lru_cache(maxsize=8)(line_ups)


class CapNow(NamedTuple):
    """How far a cap is used up.

    Parameters
    ----------
    name
        what is limited.
    total, most
        what those count who have been put up, the other side having answered or not, and the
        largest sum allowed.
    """

    name: str
    total: float
    most: float


class Choices(NamedTuple):
    """Who can be put up for the next set that has no players yet.

    Parameters
    ----------
    picks
        the players, or pairs of them, that are allowed.
    used_up
        who has played as often as they may.
    barred
        who could still play, but the caps or the sets to fill keep them out now.
    caps
        how far each cap is used up.
    """

    picks: tuple[Pick, ...]
    used_up: tuple[str, ...]
    barred: tuple[str, ...]
    caps: tuple[CapNow, ...]


def choices(state: TeamEvening, team: int) -> Choices:
    """Return who can be put up for the next set without players.

    Parameters
    ----------
    state
        the state of the night.
    team
        whose players: 0 for A, 1 for B.
    """
    squad = state.meeting.squads[team]
    found = _of(squad, state.meeting.sizes)
    counts = _counts(squad, state.used(team))
    line = state.to_name
    picks: tuple[Pick, ...] = ()
    if line is not None:
        k = line.number - 1
        after = found.after[k][found.used[k].index(counts)]
        picks = tuple(
            tuple(squad.names[player] for player in pick)
            for pick, state_after in zip(found.picks[k], after, strict=True)
            if state_after >= 0
        )
    played = [name for name, many in zip(squad.names, counts, strict=True) if many >= squad.times]
    able = {name for pick in picks for name in pick}
    barred = [name for name in squad.names if line and name not in able and name not in played]
    so_far = _counts(squad, state.put_up(team))
    caps = tuple(CapNow(cap.name, cap.total(so_far), cap.most) for cap in squad.caps)
    return Choices(picks, tuple(played), tuple(barred), caps)


def check_line_up(state: TeamEvening, team: int, picks: Sequence[Pick]) -> None:
    """Refuse a whole line-up that does not fill its sets within the caps.

    Raises
    ------
    InputError
        if it does not.
    """
    squad = state.meeting.squads[team]
    named = [name for pick in picks for name in pick]
    for name in named:
        squad.place(name)
    counts = _counts(squad, named)
    often = [name for name, many in zip(squad.names, counts, strict=True) if many > squad.times]
    if often:
        raise InputError("{player} is named more often than they may play", player=often[0])
    for cap in squad.caps:
        if cap.total(counts) > cap.most:
            raise InputError(
                "{cap} is {total:g}; the limit is {most:g}",
                cap=cap.name,
                total=cap.total(counts),
                most=cap.most,
            )


def _of(squad: Squad, sizes: tuple[int, ...]) -> LineUps:
    found: LineUps = _line_ups(squad, sizes)
    return found


def _counts(squad: Squad, used: Sequence[str]) -> tuple[int, ...]:
    many = Counter(used)
    return tuple(many[name] for name in squad.names)
