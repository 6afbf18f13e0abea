"""CueScore's tournaments. A head start counts in both the score and the race."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from evenbreak.files.foreign.match import (
    BYE,
    FORFEIT,
    HEAD_START,
    NO_SCORE,
    UNFINISHED,
    ExportError,
    Found,
    Match,
    Matches,
    count_of,
    dated,
    fitting_race,
    name_of,
)


def is_one(data: Any) -> bool:
    """Return whether this is a tournament of CueScore."""
    if not isinstance(data, Mapping) or not isinstance(data.get("matches"), list):
        return False
    first: Any = next(iter(data["matches"]), {})
    return "tournamentId" in data or (isinstance(first, Mapping) and "playerA" in first)


def matches(data: Mapping[str, Any]) -> Matches:
    """Yield the matches, in the order of the file."""
    event = data.get("name") if isinstance(data.get("name"), str) else ""
    for match in data["matches"]:
        yield partial(_dated, match, str(event), data.get("defaultRaceTo"))


def _dated(match: Mapping[str, Any], event: str, default: Any) -> list[Found]:
    return dated(_match(match, event, default), match.get("starttime"), match.get("stoptime"))


def _match(match: Mapping[str, Any], event: str, default: Any) -> list[Found]:
    a, b = (name_of(match.get(f"player{side}"), f"player {side}") for side in "AB")
    if not a or not b:
        return [BYE if a or b else UNFINISHED]
    if str(match.get("matchstatus", "")).lower() != "finished":
        return [UNFINISHED]
    scores = [count_of(match.get(f"score{side}"), f"score{side}") for side in "AB"]
    score_a, score_b = scores
    if score_a is None or score_b is None:
        return [NO_SCORE]
    start_a, start_b = (_head_start(match.get(f"handicap{side}"), side) for side in "AB")
    race = count_of(match.get("raceTo") or default, "raceTo") or 0
    found = Match(a, b, score_a - start_a, score_b - start_b, event=event)
    if race:
        found = found._replace(race_a=race - start_a, race_b=race - start_b)
    lost = min((score_a, start_a), (score_b, start_b))
    if (found.score_a == found.score_b == 0) or (lost[0] == 0 < lost[1] and race in scores):
        # Nothing was played: a score below the head start is a walkover's.
        return [found._replace(forfeit=True, remarks=(FORFEIT,))]
    if min(found.score_a, found.score_b) < 0 or (race and race <= max(start_a, start_b)):
        raise ExportError(
            f"({a}, {b}) has a head start of {start_a}:{start_b}, which does not fit its score "
            f"{score_a}-{score_b} in a race to {race}"
        )
    if start_a or start_b:
        found = found._replace(remarks=(HEAD_START,))
    return [fitting_race(found)]


def _head_start(value: Any, side: str) -> int:
    """Return the games with which a player starts; below zero where they have to catch up."""
    text = str(value).strip()
    if text.startswith("-"):
        return -(count_of(text[1:], f"handicap{side}") or 0)
    return count_of(value, f"handicap{side}") or 0
