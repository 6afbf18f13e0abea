"""Challonge tournaments: version 1 of its API, with participants and matches."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from evenbreak.files.foreign.saved import (
    ExportError,
    From,
    Played,
    Remark,
    SavedMatch,
    SavedTournament,
    match_of,
    name_of,
    player_of,
    text_of,
)

_SET = re.compile(r"(-?\d{1,7})-(-?\d{1,7})", re.ASCII)


def is_one(data: Any) -> bool:
    """Return whether this is a Challonge tournament, or a list of its matches."""
    if isinstance(data, list):
        return bool(data) and all(isinstance(one, Mapping) and "match" in one for one in data)
    inside = data.get("tournament") if isinstance(data, Mapping) else None
    return isinstance(inside, Mapping) and bool({"matches", "participants"} & set(inside))


def tournament(data: Any) -> SavedTournament:
    """Return the tournament."""
    if isinstance(data, list) or not data["tournament"].get("participants"):
        raise ExportError(
            "holds no participants. Save the tournament with its participants and matches."
        )
    inside = data["tournament"]
    if "matches" not in inside:
        raise ExportError("holds no matches. Save the tournament with its matches.")
    people = [one.get("participant", one) for one in inside["participants"]]
    # In groups players have other numbers.
    names = {
        number: _name(person)
        for person in people
        for number in (person["id"], *(person.get("group_player_ids") or ()))
    }
    event = inside["name"] if isinstance(inside.get("name"), str) else ""
    raw = [match.get("match", match) for match in inside["matches"]]

    def saved(match: Mapping[str, Any]) -> SavedMatch:
        times = match.get("completed_at"), match.get("started_at")
        return match_of(match.get("id"), lambda: _played(match, names, event), *times)

    unplaced = SavedTournament(tuple(map(saved, raw)), text_of(inside.get("name")))
    return unplaced.placed(lambda saved: _placed(saved, inside, raw, people))


def _name(person: Mapping[str, Any]) -> str:
    keys = ("name", "display_name", "challonge_username", "username")
    return next(filter(None, (name_of(person.get(key), "a participant") for key in keys)), "")


def _played(
    match: Mapping[str, Any], names: Mapping[Any, str], event: str
) -> tuple[Played, ...] | Remark:
    numbers = match.get("player1_id"), match.get("player2_id")
    if match.get("state") != "complete":
        return Remark.UNFINISHED
    if None in numbers:
        return Remark.BYE
    a, b = (player_of(names, number) for number in numbers)
    text = match.get("scores_csv") or ""
    sets = [_SET.fullmatch(part.strip()) for part in text.split(",")] if text.strip() else []
    if None in sets:
        raise ExportError(
            "({a}, {b}) has the score {score!r}, which can't be read", a=a, b=b, score=text
        )
    scores = [
        (int(score_of_set[1]), int(score_of_set[2]))
        for score_of_set in sets
        if score_of_set is not None
    ]
    if match.get("forfeited") or any(min(score) < 0 for score in scores):
        return (Played(a, b, event=event, forfeit=True, remarks=(Remark.FORFEIT,)),)
    played = [score for score in scores if any(score)]
    if not played:
        return Remark.NO_SCORE
    if len(played) > 1:  # each set is a race of its own
        remarks = (Remark.SETS,)
        return tuple(Played(a, b, *score, event=event, remarks=remarks) for score in played)
    return (Played(a, b, *played[0], event=event).won_by(" ab"[_winner(match)].strip()),)


def _winner(match: Mapping[str, Any]) -> int:
    """Return who won a match, 1 or 2; 0 if no one has yet."""
    numbers = match.get("player1_id"), match.get("player2_id")
    over = match.get("state") == "complete" and None not in numbers
    winner = match.get("winner_id")
    return numbers.index(winner) + 1 if over and winner in numbers else 0


def _placed(
    saved: SavedTournament,
    inside: Mapping[str, Any],
    raw: Sequence[Mapping[str, Any]],
    people: Sequence[Mapping[str, Any]],
) -> SavedTournament:
    """Return the tournament with its bracket: each match names the matches that feed it."""
    if any(match.get("group_id") for match in raw):
        raise ExportError("has groups before its bracket, which can't be imported")
    names = {
        person["id"]: _name(person)
        for person in sorted(people, key=lambda person: person.get("seed") or 0)
    }
    if not all(names.values()):
        raise ExportError("has a participant without a name")
    kind = text_of(inside.get("tournament_type"))
    matches = []
    for before, match in zip(saved.matches, raw, strict=True):
        number = int(match.get("round") or 0)
        placed = before._replace(
            key=match["id"],
            side="losers" if number < 0 else "winners",
            round=abs(number),
            slots=tuple(_slot(match, side, names) for side in (1, 2)),
            winner=_winner(match),
            started=text_of(match.get("started_at")),
            ended=text_of(match.get("completed_at")),
        )
        matches.append(placed)
    if kind == "double elimination" and not inside.get("grand_finals_modifier"):
        matches += _second_final(matches)
    return saved._replace(
        matches=tuple(matches),
        players=tuple(names.values()),
        everybody=kind == "round robin",
        discipline=text_of(inside.get("game_name")),
    )


def _slot(match: Mapping[str, Any], side: int, names: Mapping[Any, str]) -> str | From | None:
    before = match.get(f"player{side}_prereq_match_id")
    if before is None:
        return names.get(match.get(f"player{side}_id"))
    lost = match.get(f"player{side}_is_prereq_match_loser")
    return before, "loser" if lost else "winner"


def _second_final(matches: Sequence[SavedMatch]) -> list[SavedMatch]:
    """Return the second final, which Challonge adds only when it is needed."""
    taken = {slot[0] for match in matches for slot in match.slots if isinstance(slot, tuple)}
    again = [match for match in matches if len({slot[0] for slot in match.slots if slot}) == 1]
    finals = [match for match in matches if match.key not in taken]
    if len(finals) != 1 or any(match in again for match in finals):
        return []
    (final,) = finals
    slots = (final.key, "winner"), (final.key, "loser")
    return [SavedMatch(None, side="winners", round=final.round + 1, slots=slots)]
