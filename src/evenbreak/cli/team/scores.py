"""Whether the score of a team night can be: refused in one line where it cannot."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak.cli.kit.values import refuse
from evenbreak.handicaps.charts.race_of_pair import games_needed
from evenbreak.teams.set_laws import brought

if TYPE_CHECKING:
    from evenbreak.teams.meeting import Meeting

Score = tuple[int, int]


def check_score(meeting: Meeting, score: Score, over: int, last: str | None) -> None:
    """Refuse a score that so many sets cannot bring, or that contradicts who won the last one."""
    each = _of_a_set(meeting)
    if score not in _after(each, over):
        sets = "1 set is over" if over == 1 else f"{over} sets are over"
        counted = meeting.count if isinstance(meeting.count, str) else "points"
        refuse(
            f"--score {score[0]}:{score[1]} cannot be: by the players used {sets}, and {counted} "
            f"count{_hint(over, meeting)}"
        )
    if last is not None and not over:
        refuse(f"--last {last}: by the players used no set is over")
    if last is not None and meeting.count == "sets" and not score[last == "lost"]:
        refuse(f"--last {last} contradicts --score {score[0]}:{score[1]}")


def _hint(over: int, meeting: Meeting) -> str:
    if over or meeting.count != "sets":
        return ""
    return "; name those who have played with --used"


def _after(each: set[Score], sets: int) -> set[Score]:
    """Return the scores that are possible after so many sets."""
    found = {(0, 0)}
    for _ in range(sets):
        found = {(a + x, b + y) for a, b in found for x, y in each}
    return found


def _of_a_set(meeting: Meeting) -> set[Score]:
    """Return what a set can bring to both teams, whoever plays it."""
    if meeting.count == "sets":
        return {(1, 0), (0, 1)}
    points = meeting.ours.rating[:, None] - meeting.theirs.rating
    first, second = games_needed(points, meeting.race, meeting.scale)
    found: set[Score] = set()
    for m, n in set(zip(first.ravel().tolist(), second.ravel().tolist(), strict=True)):
        ends = [(m, lost) for lost in range(n)] + [(won, n) for won in range(m)]
        found |= {brought((m, n), end, meeting.count) for end in ends}
    return found
