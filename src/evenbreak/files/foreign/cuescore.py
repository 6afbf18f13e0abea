"""CueScore tournaments. A head start counts toward both the score and the race."""

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
    Slots,
    count_of,
    match_of,
    name_of,
    text_of,
)

_ROUND_ROBIN = 8


def is_one(data: Any) -> bool:
    """Return whether this is a CueScore tournament."""
    if not isinstance(data, Mapping) or not isinstance(data.get("matches"), list):
        return False
    first: Any = next(iter(data["matches"]), {})
    return "tournamentId" in data or (isinstance(first, Mapping) and "playerA" in first)


def tournament(data: Mapping[str, Any]) -> SavedTournament:
    """Return the tournament."""
    event = data["name"] if isinstance(data.get("name"), str) else ""
    default = data.get("defaultRaceTo")

    def saved(match: Mapping[str, Any]) -> SavedMatch:
        key = str(match.get("matchno") or match.get("matchId"))
        times = match.get("starttime"), match.get("stoptime")
        return match_of(key, lambda: _played(match, event, default), *times)

    matches = tuple(map(saved, data["matches"]))
    return SavedTournament(matches, text_of(data.get("name"))).placed(
        lambda unplaced: _placed(unplaced, data)
    )


def _played(match: Mapping[str, Any], event: str, default: Any) -> tuple[Played, ...] | Remark:
    a, b = _pair(match)
    if not a or not b:
        return Remark.BYE if a or b else Remark.UNFINISHED
    if _status(match) != "finished":
        return Remark.UNFINISHED
    scores = [count_of(match.get(f"score{side}"), f"score{side}") for side in "AB"]
    score_a, score_b = scores
    if score_a is None or score_b is None:
        return Remark.NO_SCORE
    start_a, start_b = (_head_start(match.get(f"handicap{side}"), side) for side in "AB")
    race = count_of(match.get("raceTo") or default, "raceTo") or 0
    played = Played(a, b, score_a - start_a, score_b - start_b, event=event)
    if race:
        played = played._replace(race_a=race - start_a, race_b=race - start_b)
    lost = min((score_a, start_a), (score_b, start_b))
    if (played.score_a == played.score_b == 0) or (lost[0] == 0 < lost[1] and race in scores):
        # Nothing was played: a score below the head start is a walkover's.
        return (played._replace(forfeit=True, remarks=(Remark.FORFEIT,)),)
    if min(played.score_a, played.score_b) < 0 or (race and race <= max(start_a, start_b)):
        raise ExportError(
            "({a}, {b}) has a head start of {start_a}-{start_b}, which doesn't fit its "
            "score {score_a}-{score_b} in a race to {race}",
            a=a,
            b=b,
            start_a=start_a,
            start_b=start_b,
            score_a=score_a,
            score_b=score_b,
            race=race,
        )
    if start_a or start_b:
        played = played._replace(remarks=(Remark.HEAD_START,))
    return (played.fitting_race(),)


def _pair(match: Mapping[str, Any]) -> tuple[str, str]:
    a, b = (name_of(match.get(f"player{side}"), f"player {side}") for side in "AB")
    return a, b


def _status(match: Mapping[str, Any]) -> str:
    return text_of(match.get("matchstatus")).lower()


def _head_start(value: Any, side: str) -> int:
    """Return a player's head start in games; negative if they start behind."""
    text = str(value).strip()
    if text.startswith("-"):
        return -(count_of(text[1:], f"handicap{side}") or 0)
    return count_of(value, f"handicap{side}") or 0


def _placed(saved: SavedTournament, data: Mapping[str, Any]) -> SavedTournament:
    """Return the tournament with its bracket: each match names the matches it feeds."""
    raw = data["matches"]
    everybody = data.get("format") == _ROUND_ROBIN
    keys = [match.key for match in saved.matches]
    key_of = dict(zip([str(match.get("matchId")) for match in raw], keys, strict=True))
    key_of |= {key: key for key in keys}
    coming: dict[Any, list[From]] = {}
    for match, key in zip(raw, keys, strict=True):
        for field, outcome in (("winnerNext", "winner"), ("loserNext", "loser")):
            if (there := key_of.get(str(match.get(field)))) is not None:
                coming.setdefault(there, []).append((key, outcome))
    pairs = [_pair(match) for match in raw]
    people = dict(zip(keys, pairs, strict=True))
    matches = []
    for before, match, pair in zip(saved.matches, raw, pairs, strict=True):
        number = int(match.get("round") or 0)
        a, b = (count_of(match.get(f"score{side}"), "score") or 0 for side in "AB")
        placed = before._replace(
            side="losers" if number < 0 else "winners",
            round=abs(number),
            slots=pair if everybody else _seats(pair, coming.get(before.key, []), people),
            winner=(1 if a > b else 2 if b > a else 0) if _status(match) == "finished" else 0,
            race=int(match.get("raceTo") or data.get("defaultRaceTo") or 0),
            table=text_of((match.get("table") or {}).get("name")),
            started=text_of(match.get("starttime")),
            ended=text_of(match.get("stoptime")),
            pair=pair,
            score=(a, b) if _status(match) == "playing" and all(pair) else None,
        )
        matches.append(placed)
    return saved._replace(
        matches=tuple(matches),
        players=tuple(dict.fromkeys(name for pair in pairs for name in pair if name)),
        everybody=everybody,
        discipline=text_of(data.get("discipline")),
    )


def _seats(
    pair: Sequence[str], coming: Sequence[From], people: Mapping[Any, Sequence[str]]
) -> Slots:
    """Return where players come from: CueScore names the next match but not the slot in it."""
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
