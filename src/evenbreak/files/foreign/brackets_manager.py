"""Tournaments from brackets-manager, as saved by its database or its viewer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from evenbreak.files.foreign.saved import (
    ExportError,
    From,
    Played,
    Remark,
    SavedMatch,
    SavedTournament,
    count_of,
    match_of,
    name_of,
    player_of,
    text_of,
)

_DONE = (4, 5, "completed", "archived")
_RUNNING = 3  # the status of a match in play

_Spot = tuple[int, int, int]
"""A match's group (1 winners, 2 losers, 3 finals), its round, and its number in the round."""


def is_one(data: Any) -> bool:
    """Return whether this is a brackets-manager tournament."""
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


def tournament(data: Mapping[str, Any]) -> SavedTournament:
    """Return the tournament."""
    names = {row["id"]: name_of(row, "a participant") for row in _rows(data, "participant")}
    stages = {row.get("id"): row.get("name") for row in _rows(data, "stage") or ()}

    def saved(match: Mapping[str, Any]) -> SavedMatch:
        event = stages.get(match.get("stage_id"))
        event = event if isinstance(event, str) else ""
        return match_of(match.get("id"), lambda: _played(match, names, event))

    unplaced = SavedTournament(tuple(map(saved, _rows(data, "match"))))
    return unplaced.placed(lambda saved: _placed(saved, data, names))


def _played(
    match: Mapping[str, Any], names: Mapping[Any, str], event: str
) -> tuple[Played, ...] | Remark:
    sides = match.get("opponent1"), match.get("opponent2")
    if None in sides:
        return Remark.BYE
    first, second = ({"id": None, **side} for side in sides if side is not None)
    if first["id"] is None or second["id"] is None:
        return Remark.UNFINISHED
    a, b = (player_of(names, side["id"]) for side in (first, second))
    if first.get("forfeit") or second.get("forfeit"):
        return (Played(a, b, event=event, forfeit=True, remarks=(Remark.FORFEIT,)),)
    status = match.get("status")
    if (status.lower() if isinstance(status, str) else status) not in _DONE:
        return Remark.UNFINISHED
    score_a, score_b = (count_of(side.get("score"), "score") for side in (first, second))
    if score_a is None or score_b is None or not (score_a or score_b):
        return Remark.NO_SCORE
    winner = "a" if first.get("result") == "win" else "b" if second.get("result") == "win" else ""
    return (Played(a, b, score_a, score_b, event=event).won_by(winner),)


def _placed(
    saved: SavedTournament, data: Mapping[str, Any], names: Mapping[Any, str]
) -> SavedTournament:
    """Return the tournament with its bracket: its rounds show where players come from."""
    stages: list[Any] = _rows(data, "stage") or []
    if len(stages) != 1:
        raise ExportError("has {n} stages. Give a tournament with one stage.", n=len(stages))
    group_of, round_of = (
        {row["id"]: int(row["number"]) for row in _rows(data, name) or ()}
        for name in ("group", "round")
    )
    spots: dict[_Spot, tuple[SavedMatch, Any]] = {
        (group_of[match["group_id"]], round_of[match["round_id"]], int(match["number"])): (
            before,
            match,
        )
        for before, match in zip(saved.matches, _rows(data, "match"), strict=True)
    }
    if len(spots) < len(saved.matches):
        raise ExportError("has two matches in the same place in its bracket")
    kind = stages[0].get("type")
    double = kind == "double_elimination"
    if double and not any(group == 3 for group, _, _ in spots):
        raise ExportError("has no grand final, so no one wins it. Add one in brackets-manager.")
    bracket = _Bracket(spots, names, double=double)
    matches = []
    for spot, (before, match) in spots.items():
        group, number, _ = spot
        sides: list[Any] = [match.get("opponent1"), match.get("opponent2")]
        if kind == "round_robin":
            slots: list[str | From | None] = [names.get((side or {}).get("id")) for side in sides]
        else:
            slots = [bracket.comes(spot, k, side) for k, side in enumerate(sides)]
        side = {1: "winners", 2: "losers" if double else "third place"}.get(group, "final")
        placed = before._replace(
            key=match["id"],
            side="second final" if group == 3 and number == 2 else side,
            round=number,
            slots=tuple(slots),
            winner=_winner(sides),
        )
        running = match.get("status") == _RUNNING
        if running and all((side or {}).get("id") is not None for side in sides):
            a, b = (count_of(side.get("score"), "score") or 0 for side in sides)
            first, second = (names[side["id"]] for side in sides)
            placed = placed._replace(pair=(first, second), score=(a, b))
        matches.append(placed)
    return saved._replace(
        matches=tuple(matches),
        name=text_of(stages[0].get("name")),
        players=tuple(filter(None, names.values())),
        everybody=kind == "round_robin",
    )


def _winner(sides: Sequence[Any]) -> int:
    for k, side in enumerate(sides):
        if side and side.get("result") == "win" and None not in sides:
            return k + 1
        if side and side.get("forfeit"):
            return 2 - k
    return 0


class _Bracket:
    """Who goes to which match: round 1 of group 2 takes two losers, the others take turns."""

    def __init__(
        self,
        spots: Mapping[_Spot, tuple[SavedMatch, Any]],
        names: Mapping[Any, str],
        *,
        double: bool,
    ) -> None:
        self.spots, self.names, self.double = spots, names, double
        self.last = max(number for group, number, _ in spots if group == 1)

    def came(self, group: int, number: int, place: int, outcome: str) -> From:
        """Return the winner or the loser of a match."""
        return self.spots[group, number, place][1]["id"], outcome

    def comes(self, spot: _Spot, k: int, side: Any) -> str | From | None:
        """Return the source of the player in slot k of a match."""
        group, number, place = spot
        if group == 1:
            if number == 1:
                return self.names.get((side or {}).get("id"))
            return self.came(1, number - 1, 2 * place - 1 + k, "winner")
        if group == 3 and number == 2:
            return self.came(3, 1, 1, ("winner", "loser")[k])
        if group == 3:
            under = max(spot[1] for spot in self.spots if spot[0] == 2)
            return self.came(*((1, self.last) if k == 0 else (2, under)), 1, "winner")
        if side is None:
            return None  # a bye drops out of the winners' side
        if not self.double:
            return self.came(1, self.last - 1, k + 1, "loser")
        stated = side.get("position")
        if number == 1:
            return self.came(1, 1, stated or 2 * place - 1 + k, "loser")
        if number % 2 == 0 and k == 0:
            return self.came(1, number // 2 + 1, stated or place, "loser")
        if number % 2 == 0:
            return self.came(2, number - 1, place, "winner")
        return self.came(2, number - 1, 2 * place - 1 + k, "winner")
