"""The number of each match, as on printed sheets: 1, 2, 3, ... in the order of play."""

from __future__ import annotations

import re
from collections.abc import Mapping

from evenbreak.tournaments.brackets.bracket import Bracket, Match, Source

_OWN = re.compile(r"R?(\d+)")
"""A match whose name is its number, such as the racks in a chip tournament."""

_LAST = {"pod final": 1, "knock-out": 2, "third place": 3, "final": 4, "second final": 5}
"""What is played after both sides of a bracket, and after its groups."""

_Time = tuple[int, int, int]


def match_numbers(bracket: Bracket, first: Mapping[str, int] | None = None) -> dict[str, int]:
    """Return each match's number by name, in the order in which rounds can be played.

    Rounds of the winners' side alternate with those of the losers' side: W1, W2, L1, L2, W3, L3,
    L4, W4, ... A match has a higher number than the matches that feed it. Byes aren't matches and
    have no number; a second final has the last number. Numbers in `first` are kept, and the others
    follow.

    >>> from evenbreak.tournaments import double_elimination
    >>> match_numbers(double_elimination(5))
    {'W1.2': 1, 'W2.1': 2, 'W2.2': 3, 'L2.1': 4, 'W3.1': 5, 'L3.1': 6, 'L4.1': 7, 'F': 8, 'F2': 9}
    """
    own = {match.name: _OWN.fullmatch(match.name) for match in bracket.matches}
    if own and all(own.values()):
        return {name: int(number[1]) for name, number in own.items() if number}
    times: dict[str, _Time] = {}
    for match in bracket.matches:  # each comes after those that feed it
        fed = [times[s.match] for s in match.slots if isinstance(s, Source) and s.match in times]
        times[match.name] = max([_time(match), *fed])
    numbers = dict(first or {})
    begin = max(numbers.values(), default=0) + 1
    new = [name for name in sorted(times, key=lambda name: times[name]) if name not in numbers]
    return numbers | {name: number for number, name in enumerate(new, begin)}


def _time(match: Match) -> _Time:
    """Return a sort key for when a match's round is played."""
    if match.side in _LAST:
        return _LAST[match.side], match.round, 0
    if match.side == "losers":
        return 0, (match.round + 3) // 2, match.round
    if match.side == "consolation":
        return 0, match.round + 1, match.round
    return 0, match.round, 0
