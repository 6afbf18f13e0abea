"""Challonge's tournaments: version 1 of its interface, with participants and matches."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import partial
from typing import Any

from evenbreak.files.foreign.match import (
    BYE,
    FORFEIT,
    NO_SCORE,
    SETS,
    UNFINISHED,
    ExportError,
    Found,
    Match,
    Matches,
    dated,
    name_of,
    player_of,
    with_winner,
)

_SET = re.compile(r"(-?\d{1,7})-(-?\d{1,7})", re.ASCII)
_PEOPLE = "holds no participants; save the tournament with its participants and matches"


def is_one(data: Any) -> bool:
    """Return whether this is a tournament of Challonge, or a list of its matches."""
    if isinstance(data, list):
        return bool(data) and all(isinstance(one, Mapping) and "match" in one for one in data)
    tournament = data.get("tournament") if isinstance(data, Mapping) else None
    return isinstance(tournament, Mapping) and bool({"matches", "participants"} & set(tournament))


def matches(data: Any) -> Matches:
    """Yield the matches, in the order of the file."""
    if isinstance(data, list) or not data["tournament"].get("participants"):
        raise ExportError(_PEOPLE)
    tournament = data["tournament"]
    if "matches" not in tournament:
        raise ExportError("holds no matches; save the tournament with its matches")
    names = _names(tournament["participants"])
    event = tournament.get("name")
    for match in tournament["matches"]:
        inside = match.get("match", match)
        yield partial(_dated, inside, names, event if isinstance(event, str) else "")


def _dated(match: Mapping[str, Any], names: Mapping[Any, str], event: str) -> list[Found]:
    times = match.get("completed_at"), match.get("started_at")
    return dated(_match(match, names, event), *times)


def _names(participants: list[Mapping[str, Any]]) -> dict[Any, str]:
    """Return the name of each number of a player; in groups players have others."""
    names = {}
    for participant in participants:
        one = participant.get("participant", participant)
        for key in ("name", "display_name", "challonge_username", "username"):
            name = name_of(one.get(key), "a participant")
            if name:
                break
        for number in (one["id"], *(one.get("group_player_ids") or ())):
            names[number] = name
    return names


def _match(match: Mapping[str, Any], names: Mapping[Any, str], event: str) -> list[Found]:
    numbers = match.get("player1_id"), match.get("player2_id")
    if match.get("state") != "complete":
        return [UNFINISHED]
    if None in numbers:
        return [BYE]
    a, b = (player_of(names, number) for number in numbers)
    winner = (
        " ab"[1 + numbers.index(match.get("winner_id"))]
        if match.get("winner_id") in numbers
        else ""
    )
    text = match.get("scores_csv") or ""
    sets = [_SET.fullmatch(part.strip()) for part in text.split(",")] if text.strip() else []
    if None in sets:
        raise ExportError(f"({a}, {b}) has the score {text!r}, which cannot be read")
    scores = [(int(one[1]), int(one[2])) for one in sets if one is not None]
    if match.get("forfeited") or any(min(score) < 0 for score in scores):
        return [Match(a, b, event=event, forfeit=True, remarks=(FORFEIT,))]
    played = [score for score in scores if any(score)]
    if not played:
        return [NO_SCORE]
    if len(played) > 1:  # each set is a race of its own
        return [Match(a, b, *score, event=event, remarks=(SETS,)) for score in played]
    (score,) = played
    return [with_winner(Match(a, b, *score, event=event), winner)]
