"""Tournaments of brackets-manager, as its database or its viewer saves them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from evenbreak.files.foreign.match import (
    BYE,
    FORFEIT,
    NO_SCORE,
    UNFINISHED,
    Found,
    Match,
    Matches,
    count_of,
    name_of,
    player_of,
    with_winner,
)

_DONE = (4, 5, "completed", "archived")


def is_one(data: Any) -> bool:
    """Return whether this is a tournament of brackets-manager."""
    if not isinstance(data, Mapping):
        return False
    rows = _rows(data, "match")
    first: Any = next(iter(rows), {}) if isinstance(rows, list) else None
    return isinstance(_rows(data, "participant"), list) and (
        isinstance(_rows(data, "stage"), list)
        or (isinstance(first, Mapping) and "opponent1" in first)
    )


def _rows(data: Mapping[str, Any], name: str) -> Any:
    plural = "matches" if name == "match" else f"{name}s"
    return data.get(name, data.get(plural))


def matches(data: Mapping[str, Any]) -> Matches:
    """Yield the matches, in the order of the file."""
    names = {one["id"]: name_of(one, "a participant") for one in _rows(data, "participant")}
    stages = {one.get("id"): one.get("name") for one in _rows(data, "stage") or ()}
    for match in _rows(data, "match"):
        event = stages.get(match.get("stage_id"))
        yield partial(_match, match, names, event if isinstance(event, str) else "")


def _match(match: Mapping[str, Any], names: Mapping[Any, str], event: str) -> list[Found]:
    sides = match.get("opponent1"), match.get("opponent2")
    if None in sides:
        return [BYE]
    one, two = ({"id": None, **side} for side in sides if side is not None)
    if one["id"] is None or two["id"] is None:
        return [UNFINISHED]
    a, b = (player_of(names, side["id"]) for side in (one, two))
    if one.get("forfeit") or two.get("forfeit"):
        return [Match(a, b, event=event, forfeit=True, remarks=(FORFEIT,))]
    results = one.get("result"), two.get("result")
    status = match.get("status")
    if (status.lower() if isinstance(status, str) else status) not in _DONE:
        return [UNFINISHED]
    score_a, score_b = (count_of(side.get("score"), "score") for side in (one, two))
    if score_a is None or score_b is None or not (score_a or score_b):
        return [NO_SCORE]
    winner = "a" if results[0] == "win" else "b" if results[1] == "win" else ""
    return [with_winner(Match(a, b, score_a, score_b, event=event), winner)]
