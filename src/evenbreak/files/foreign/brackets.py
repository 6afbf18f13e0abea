"""The bracket in a tournament saved from another program: who comes to which match from where."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

from evenbreak.files.foreign.match import ExportError, count_of, name_of

From: TypeAlias = tuple[Any, str]
"""The key of another match, and its outcome: winner or loser."""


_RUNNING = 3  # the status of a match in play in brackets-manager


class SavedMatch(NamedTuple):
    """A match of a saved bracket.

    Parameters
    ----------
    key
        its number in the file; None for a second final that the file leaves out.
    side
        winners, losers, final, second final or third place.
    round
        its round.
    slots
        who is in it: a name, the outcome of another match, or a bye (None).
    winner
        1 or 2 if it has been won, else 0.
    race, table, started, ended
        what the file says of it; 0 or '' where it says nothing.
    pair, score
        the players and the score of a match in play.
    """

    key: Any
    side: str
    round: int
    slots: tuple[str | From | None, ...]
    winner: int = 0
    race: int = 0
    table: str = ""
    started: str = ""
    ended: str = ""
    pair: tuple[str, str] = ("", "")
    score: tuple[int, int] | None = None


class SavedBracket(NamedTuple):
    """A saved tournament, its matches in the order of the file.

    Parameters
    ----------
    name
        its name.
    players
        the names in seed order.
    matches
        the matches.
    everybody
        whether everybody plays everybody.
    discipline
        8-ball, 9-ball or 10-ball; '' where not stated.
    """

    name: str
    players: tuple[str, ...]
    matches: Sequence[SavedMatch]
    everybody: bool = False
    discipline: str = ""


def of_cuescore(data: Mapping[str, Any]) -> SavedBracket:
    """Return the bracket of CueScore."""
    raw = data["matches"]
    pairs = [tuple(name_of(one.get(f"player{s}"), f"player {s}") for s in "AB") for one in raw]
    everybody = data.get("format") == 8
    keys = [str(one.get("matchno") or one.get("matchId")) for one in raw]
    key_of = dict(zip([str(one.get("matchId")) for one in raw], keys, strict=True))
    key_of |= {key: key for key in keys}
    coming: dict[Any, list[From]] = {}
    for one, key in zip(raw, keys, strict=True):
        for field, outcome in (("winnerNext", "winner"), ("loserNext", "loser")):
            if (there := key_of.get(str(one.get(field)))) is not None:
                coming.setdefault(there, []).append((key, outcome))
    people = dict(zip(keys, pairs, strict=True))
    matches = []
    for one, key, pair in zip(raw, keys, pairs, strict=True):
        number = int(one.get("round") or 0)
        status = str(one.get("matchstatus") or "").lower()
        a, b = (count_of(one.get(f"score{side}"), "score") or 0 for side in "AB")
        matches.append(
            SavedMatch(
                key,
                "losers" if number < 0 else "winners",
                abs(number),
                pair if everybody else _seats(pair, coming.get(key, []), people),
                (1 if a > b else 2 if b > a else 0) if status == "finished" else 0,
                int(one.get("raceTo") or data.get("defaultRaceTo") or 0),
                str((one.get("table") or {}).get("name") or ""),
                str(one.get("starttime") or ""),
                str(one.get("stoptime") or ""),
                (pair[0], pair[1]),
                (a, b) if status == "playing" and all(pair) else None,
            )
        )
    players = tuple(dict.fromkeys(name for pair in pairs for name in pair if name))
    game = str(data.get("discipline") or "")
    return SavedBracket(str(data.get("name") or ""), players, matches, everybody, game)


def _seats(
    pair: Sequence[str], coming: Sequence[From], people: Mapping[Any, Sequence[str]]
) -> tuple[str | From | None, ...]:
    """Return who comes from where: CueScore names the next match but not the seat in it."""
    if len(coming) > 2:
        raise ExportError("sends three players to one match")
    slots: list[str | From | None] = [name or None for name in pair]
    open_ = [0, 1]
    for source in coming:
        theirs = [k for k in open_ if pair[k] and pair[k] in people[source[0]]]
        seat = (theirs or [k for k in open_ if not pair[k]] or open_)[0]
        slots[seat] = source
        open_.remove(seat)
    return tuple(slots)


def of_challonge(data: Mapping[str, Any]) -> SavedBracket:
    """Return the bracket of Challonge."""
    tournament = data["tournament"]
    people = [one.get("participant", one) for one in tournament["participants"]]
    people.sort(key=lambda one: one.get("seed") or 0)
    names = {}
    for one in people:
        keys = ("name", "display_name", "challonge_username", "username")
        names[one["id"]] = next(filter(None, (name_of(one.get(k), "a participant") for k in keys)))
    raw = [one.get("match", one) for one in tournament["matches"]]
    if any(one.get("group_id") for one in raw):
        raise ExportError("has groups before its bracket, which cannot be imported")
    kind = str(tournament.get("tournament_type") or "")
    matches = []
    for one in raw:
        number = int(one.get("round") or 0)
        slots: list[str | From | None] = []
        for side in (1, 2):
            before = one.get(f"player{side}_prereq_match_id")
            lost = one.get(f"player{side}_is_prereq_match_loser")
            if before is None:
                slots.append(names.get(one.get(f"player{side}_id")))
            else:
                slots.append((before, "loser" if lost else "winner"))
        where = "losers" if number < 0 else "winners"
        ids = one.get("player1_id"), one.get("player2_id")
        over = one.get("state") == "complete" and None not in ids
        won = ids.index(one["winner_id"]) + 1 if over and one.get("winner_id") in ids else 0
        began, ended = (str(one.get(key) or "") for key in ("started_at", "completed_at"))
        matches.append(
            SavedMatch(one["id"], where, abs(number), tuple(slots), won, started=began, ended=ended)
        )
    if kind == "double elimination" and not tournament.get("grand_finals_modifier"):
        matches += _second_final(matches)
    everybody = kind == "round robin"
    game = str(tournament.get("game_name") or "")
    title = str(tournament.get("name") or "")
    return SavedBracket(title, tuple(names.values()), matches, everybody, game)


def of_brackets_manager(data: Mapping[str, Any]) -> SavedBracket:
    """Return the bracket of brackets-manager: its rounds say who comes from where."""

    def rows(name: str) -> list[Any]:
        return list(data.get(name, data.get("matches" if name == "match" else f"{name}s")) or ())

    stages, raw = rows("stage"), rows("match")
    if len(stages) != 1:
        raise ExportError(f"has {len(stages)} stages; give a tournament of one stage")
    names = {one["id"]: name_of(one, "a participant") for one in rows("participant")}
    numbers = {
        name: {one["id"]: int(one["number"]) for one in rows(name)} for name in ("group", "round")
    }
    spots = {}
    for one in raw:
        group, number = numbers["group"][one["group_id"]], numbers["round"][one["round_id"]]
        spots[group, number, int(one["number"])] = one
    kind = stages[0].get("type")
    double = kind == "double_elimination"
    if double and not any(group == 3 for group, _, _ in spots):
        raise ExportError("has no grand final, so nobody wins it; add one in brackets-manager")
    matches = []
    for (group, number, place), one in spots.items():
        sides: list[Any] = [one.get("opponent1"), one.get("opponent2")]
        if kind == "round_robin":
            slots: list[str | From | None] = [names.get((side or {}).get("id")) for side in sides]
        else:
            slots = [
                _came(spots, (group, number, place), k, side, names, double=double)
                for k, side in enumerate(sides)
            ]
        side = {1: "winners", 2: "losers" if double else "third place"}.get(group, "final")
        if group == 3 and number == 2:
            side = "second final"
        match = SavedMatch(one["id"], side, number, tuple(slots), _winner(sides))
        matches.append(match._replace(**_running(one, sides, names)))
    players = [name for name in names.values() if name]
    return SavedBracket(
        str(stages[0].get("name") or ""), tuple(players), matches, kind == "round_robin"
    )


def _running(one: Mapping[str, Any], sides: Sequence[Any], names: Mapping[Any, str]) -> Any:
    """Return the players and the score of a match in play."""
    if one.get("status") != _RUNNING or any((side or {}).get("id") is None for side in sides):
        return {}
    a, b = (count_of(side.get("score"), "score") or 0 for side in sides)
    return {"pair": tuple(names[side["id"]] for side in sides), "score": (a, b)}


def _second_final(matches: Sequence[SavedMatch]) -> list[SavedMatch]:
    """Return the second final that Challonge adds only when it is needed."""
    taken = {slot[0] for one in matches for slot in one.slots if isinstance(slot, tuple)}
    again = [one for one in matches if len({slot[0] for slot in one.slots if slot}) == 1]
    finals = [one for one in matches if one.key not in taken]
    if len(finals) != 1 or any(one in again for one in finals):
        return []
    (final,) = finals
    slots = (final.key, "winner"), (final.key, "loser")
    return [SavedMatch(None, "winners", final.round + 1, slots)]


def _winner(sides: Sequence[Any]) -> int:
    for k, side in enumerate(sides):
        if side and side.get("result") == "win" and None not in sides:
            return k + 1
        if side and side.get("forfeit"):
            return 2 - k
    return 0


def _came(
    spots: Mapping[tuple[int, int, int], Any],
    where: tuple[int, int, int],
    k: int,
    side: Any,
    names: Mapping[Any, str],
    *,
    double: bool,
) -> str | From | None:
    """Return who comes to slot k of a match: round 1 of group 2 takes two losers, then by turns."""
    group, number, place = where

    def source(group: int, number: int, place: int, outcome: str) -> From:
        return spots[group, number, place]["id"], outcome

    if group == 1:
        if number == 1:
            return names.get((side or {}).get("id"))
        return source(1, number - 1, 2 * place - 1 + k, "winner")
    last = max(spot[1] for spot in spots if spot[0] == 1)
    if group == 3 and number == 2:
        return source(3, 1, 1, ("winner", "loser")[k])
    if group == 3:
        under = max(spot[1] for spot in spots if spot[0] == 2)
        return source(1, last, 1, "winner") if k == 0 else source(2, under, 1, "winner")
    if side is None:
        return None  # a bye drops out of the winners' side
    if not double:
        return source(1, last - 1, k + 1, "loser")
    stated = side.get("position")
    if number == 1:
        return source(1, 1, stated or 2 * place - 1 + k, "loser")
    if number % 2 == 0 and k == 0:
        return source(1, number // 2 + 1, stated or place, "loser")
    if number % 2 == 0:
        return source(2, number - 1, place, "winner")
    return source(2, number - 1, 2 * place - 1 + k, "winner")
