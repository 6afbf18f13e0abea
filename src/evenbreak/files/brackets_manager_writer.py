"""A tournament as brackets-manager keeps it, for its viewer and for other programs.

Byes have no opponent (None), and a player who is not known yet has no id.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

from evenbreak.errors import InputError
from evenbreak.files.foreign.brackets import of_brackets_manager
from evenbreak.files.foreign.match import ExportError
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.brackets.double import to_the_end
from evenbreak.tournaments.brackets.drafts import Draft, DraftSlot
from evenbreak.tournaments.brackets.knockout import knockout
from evenbreak.tournaments.brackets.seeding import seeded_lines
from evenbreak.tournaments.evening.fold import Evening

Opponent: TypeAlias = dict[str, Any] | None
"""Who is on one side of a match; None: a bye."""

_LOCKED, _WAITING, _READY, _RUNNING, _COMPLETED, _ARCHIVED = range(6)
_CANNOT = "brackets-manager cannot hold this bracket; export the matches or --events instead"
_ORDERINGS: dict[str, Callable[[list[int]], list[int]]] = {
    "natural": lambda x: x,
    "reverse": lambda x: x[::-1],
    "half_shift": lambda x: x[len(x) // 2 :] + x[: len(x) // 2],
    "reverse_half_shift": lambda x: x[len(x) // 2 - 1 :: -1] + x[: len(x) // 2 - 1 : -1],
    "pair_flip": lambda x: [k for pair in zip(x[1::2], x[::2], strict=True) for k in pair],
}


class _Spot(NamedTuple):
    """Where a match is: its group, its round in the group and its number in the round, from 1."""

    group: int
    round: int
    number: int


def brackets_manager_file(state: Evening, name: str) -> tuple[bytes, list[str]]:
    """Return a tournament as JSON of brackets-manager, and warnings.

    Parameters
    ----------
    state
        the tournament: single or double elimination or a round robin, drawn.
    name
        its name.

    Raises
    ------
    InputError
        if brackets-manager cannot hold it.

    >>> from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> both = Entrant("Ann", 80.0), Entrant("Bo", 70.0)
    >>> happened = Opened(Plan("single", 5), both), Drawn(("Ann", "Bo"), (0, 1))
    >>> state = evening([Event("2025-03-01T19:30:00", what) for what in happened])
    >>> content, warnings = brackets_manager_file(state, "Cup")
    >>> json.loads(content)["match"][0]["opponent2"]
    {'id': 1, 'position': 2}
    """
    drafts = _grid(state)
    if state.bracket.format == "round robin":
        kind, spots = "round_robin", {d.name: _Spot(1, d.round, _number(d)) for d in drafts}
    else:
        double = any(draft.side == "losers" for draft in drafts)
        kind = "double_elimination" if double else "single_elimination"
        spots = {draft.name: _spot(draft, double=double) for draft in drafts}
    settings, warnings = _settings(state, drafts, kind)
    stage = {"id": 0, "tournament_id": 0, "name": name, "type": kind, "number": 1}
    data = {
        "participant": [
            {"id": k, "tournament_id": 0, "name": player} for k, player in enumerate(state.order)
        ],
        "stage": [{**stage, "settings": settings}],
        **_places_of_matches(spots),
        "match_game": [],
    }
    slots, begun = _resolved(drafts), _begun_after(state, drafts)
    in_order = sorted(drafts, key=lambda draft: spots[draft.name])
    for draft, match in zip(in_order, data["match"], strict=True):
        one, other = _opponents(state, draft, slots[draft.name])
        match["status"] = _status(state, draft.name, one, other, over=draft.name in begun)
        match["opponent1"], match["opponent2"] = one, other
    _check(data, in_order, slots, state.order)
    return json.dumps(data, indent=1, ensure_ascii=False).encode() + b"\n", warnings


def _grid(state: Evening) -> Sequence[Draft]:
    """Return all matches, the byes among them."""
    plan = state.plan
    lines: list[DraftSlot] = [*(state.lines or ())]
    if plan.layout:  # which does not say who of the first final is undefeated
        again = {m.name: m.slots for m in state.bracket.matches if m.side == "second final"}
        return [one._replace(slots=again.get(one.name, one.slots)) for one in plan.layout]
    if state.bracket.format == "round robin":
        return [Draft(m.name, m.side, m.round, m.slots) for m in state.bracket.matches]
    drops: Any = plan.drops
    if plan.form == "double" and plan.qualifiers is None and len(lines) > 2:
        return to_the_end(lines, drops, true_final=plan.final == "true")[0]
    if plan.form == "single":
        return knockout(lines, "W", "winners", third_place=plan.third_place)[0]
    raise InputError(_CANNOT)


def _number(draft: Draft) -> int:
    return int(draft.name.partition(".")[2] or 1)


def _spot(draft: Draft, *, double: bool) -> _Spot:
    match draft.side:
        case "losers":
            return _Spot(2, draft.round, _number(draft))
        case "third place":
            return _Spot(2, 1, 1)
        case "second final":
            return _Spot(3, 2, 1)
        case "final" if double:
            return _Spot(3, 1, 1)
    return _Spot(1, draft.round, _number(draft))


def _places_of_matches(spots: Mapping[str, _Spot]) -> dict[str, list[dict[str, Any]]]:
    """Return the groups, the rounds and the matches, without their players."""
    in_order = sorted(spots.values())
    groups = {group: k for k, group in enumerate(dict.fromkeys(spot.group for spot in in_order))}
    rounds = {one: k for k, one in enumerate(dict.fromkeys(spot[:2] for spot in in_order))}
    return {
        "group": [{"id": k, "stage_id": 0, "number": n} for n, k in groups.items()],
        "round": [
            {"id": k, "number": number, "stage_id": 0, "group_id": groups[group]}
            for (group, number), k in rounds.items()
        ],
        "match": [
            {
                "id": k,
                "number": spot.number,
                "stage_id": 0,
                "group_id": groups[spot.group],
                "round_id": rounds[spot[:2]],
                "child_count": 0,
            }
            for k, spot in enumerate(in_order)
        ],
    }


def _resolved(drafts: Sequence[Draft]) -> dict[str, tuple[DraftSlot, DraftSlot]]:
    """Return the slots of each match, with byes (None) sent on."""
    sent: dict[Source, DraftSlot] = {}
    slots = {}
    for draft in drafts:
        one, other = (
            sent.get(slot, slot) if isinstance(slot, Source) else slot for slot in draft.slots
        )
        slots[draft.name] = one, other
        if one is None or other is None:
            sent[Source(draft.name, "winner")] = other if one is None else one
            sent[Source(draft.name, "loser")] = None
    return slots


def _opponents(
    state: Evening, draft: Draft, slots: tuple[DraftSlot, DraftSlot]
) -> tuple[Opponent, Opponent]:
    """Return both sides of a match, with its score and result."""
    found: list[Opponent] = []
    for side, (drawn, slot) in enumerate(zip(draft.slots, slots, strict=True), 1):
        if slot is None:
            found.append(None)
            continue
        seat = slot if isinstance(slot, int) else state.standing.sent.get(slot)
        there: dict[str, Any] = {"id": None if seat is None or seat < 0 else seat}
        if (position := _position(draft, side, drawn)) is not None:
            there["position"] = position
        found.append(there)
    one, other = found
    if one is None or other is None:
        alone = one or other
        if alone and alone["id"] is not None:
            alone["result"] = "win"
    elif (result := state.counted.get(draft.name)) is not None:
        for there in (one, other):
            name = state.order[there["id"]]
            if not result.forfeit:
                there["score"] = result.games[name]
            if name == result.winner:
                there["result"] = "win"
            else:
                there |= {"forfeit": True} if result.forfeit else {"result": "loss"}
    elif (live := state.live.get(draft.name)) is not None:
        games = dict(zip(live.what.players, live.what.score, strict=True))
        for there in (one, other):
            there["score"] = games[state.order[there["id"]]]
    return one, other


def _position(draft: Draft, side: int, slot: DraftSlot) -> int | None:
    """Return where a side comes from: a seed, or the number of a match in its round."""
    if isinstance(slot, int):
        return slot + 1
    if draft.side == "third place":
        return side
    if draft.side == "losers" and isinstance(slot, Source) and slot.outcome == "loser":
        return int(slot.match.partition(".")[2])
    return 1 if draft.side == "final" and side == 2 and _from_losers(slot) else None


def _from_losers(slot: DraftSlot) -> bool:
    return isinstance(slot, Source) and slot.match.startswith("L")


def _begun_after(state: Evening, drafts: Sequence[Draft]) -> set[str]:
    """Return the matches whose winner or loser has begun the next one."""
    return {
        slot.match
        for draft in drafts
        if draft.name in state.counted or draft.name in state.on_tables
        for slot in draft.slots
        if isinstance(slot, Source)
    }


def _status(state: Evening, name: str, one: Opponent, other: Opponent, *, over: bool) -> int:
    if one is None or other is None:
        alone = one or other
        known = alone is not None and alone["id"] is not None
        return (_ARCHIVED if over else _COMPLETED) if known else _LOCKED
    if name in state.counted:
        return _ARCHIVED if over else _COMPLETED
    if None in (ids := (one["id"], other["id"])):
        return _LOCKED if ids == (None, None) else _WAITING
    return _RUNNING if name in state.on_tables or name in state.live else _READY


def _settings(
    state: Evening, drafts: Sequence[Draft], kind: str
) -> tuple[dict[str, Any], list[str]]:
    """Return the settings of the stage, and warnings about them."""
    usual: dict[str, Any] = {"matchesChildCount": 0}
    if kind == "round_robin":
        ordering = ["groups.effort_balanced"]
        usual |= {"size": len(state.order), "seedOrdering": ordering}
        return {**usual, "groupCount": 1, "roundRobinMode": "simple"}, []
    first = [draft for draft in drafts if draft.side != "losers" and draft.round == 1]
    first = [draft for draft in first if not any(isinstance(s, Source) for s in draft.slots)]
    lines = [slot for draft in sorted(first, key=_number) for slot in draft.slots]
    usual["size"] = len(lines)
    orders = ["inner_outer"]
    warnings = []
    if kind == "single_elimination":
        usual["consolationFinal"] = any(draft.side == "third place" for draft in drafts)
    else:
        again = any(draft.side == "second final" for draft in drafts)
        usual["grandFinal"] = "double" if again else "simple"
        names = [_ordering(order) for order in _drops(drafts)]
        orders += [name or "natural" for name in names]
        if None in names:
            warnings.append(
                "brackets-manager has no name for the order in which the losers drop here: its "
                "viewer shows the bracket, but go on with the tournament here"
            )
    usual["seedOrdering"] = orders
    if lines != seeded_lines(len(state.order)):
        byes = iter(range(len(state.order) + 1, len(lines) + 1))
        seeds = [slot + 1 if isinstance(slot, int) else next(byes) for slot in lines]
        usual["manualOrdering"] = [seeds]
    return usual, warnings


def _drops(drafts: Sequence[Draft]) -> list[list[int]]:
    """Return the matches whose losers drop into each round of more than one match, in its order."""
    rounds: dict[int, list[int]] = {}
    for draft in sorted(drafts, key=_number):
        if draft.side == "losers":
            for slot in draft.slots:
                if isinstance(slot, Source) and slot.outcome == "loser":
                    number = int(slot.match.partition(".")[2])
                    rounds.setdefault(draft.round, []).append(number)
    return [rounds[number] for number in sorted(rounds) if len(rounds[number]) > 1]


def _ordering(order: list[int]) -> str | None:
    """Return the name of an order of drops; None if brackets-manager has none.

    >>> _ordering([4, 3, 2, 1]), _ordering([2, 1, 4, 3]), _ordering([1, 3, 2, 4])
    ('reverse', 'reverse_half_shift', None)
    """
    straight = sorted(order)
    return next((name for name, make in _ORDERINGS.items() if make(straight) == order), None)


def _check(
    data: Mapping[str, Any],
    drafts: Sequence[Draft],
    slots: Mapping[str, tuple[DraftSlot, DraftSlot]],
    players: Sequence[str],
) -> None:
    """Check that whoever reads the file finds the same way from match to match.

    The file itself does not say who goes where: the places of the matches do.
    """
    try:
        read = of_brackets_manager(data).matches
    except (ExportError, LookupError):
        raise InputError(_CANNOT) from None
    number = {draft.name: k for k, draft in enumerate(drafts)}
    for draft, match in zip(drafts, read, strict=True):
        if draft.side == "second final":
            continue
        wanted = [
            None
            if slot is None
            else players[slot]
            if isinstance(slot, int)
            else (number[slot.match], slot.outcome)
            for slot in draft.slots
        ]
        sides = zip(wanted, match.slots, slots[draft.name], strict=True)
        if any(
            want != there and not (there is None is resolved) for want, there, resolved in sides
        ):
            raise InputError(_CANNOT)
