"""A tournament saved by another program, as an evening's events."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from typing import Any

from evenbreak.errors import EvenbreakError, InputError
from evenbreak.files.foreign.results import PROGRAMS, match_problem, saved_in
from evenbreak.files.foreign.saved import (
    MISSHAPEN,
    Played,
    Remark,
    SavedMatch,
    SavedTournament,
    misshapen,
)
from evenbreak.files.tables.problems import refusal
from evenbreak.files.tables.rows import content_of
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.brackets.drafts import Draft
from evenbreak.tournaments.evening.events import (
    KINDS,
    Called,
    Drawn,
    Entrant,
    Event,
    Opened,
    Plan,
    Result,
    Scored,
    What,
)
from evenbreak.tournaments.evening.fold import evening
from evenbreak.tournaments.evening.plan import bracket_of
from evenbreak.words import Parameter, listed, say

_DISCIPLINES = {"8": "8-ball", "9": "9-ball", "10": "10-ball"}


def read_saved_tournament(
    path: str | Path, plan: Plan, entrants: Mapping[str, Entrant], at: str
) -> list[Event]:
    """Return the events of a tournament saved by CueScore, Challonge or brackets-manager.

    Each match is checked: its players must be the ones sent there by earlier results. The plan
    fills in what the file lacks, and a race of 0 means the file's race; players not in `entrants`
    are new; `at` is the time for events without a time. Raises DataError if the file isn't such a
    tournament, or contradicts itself.
    """
    source, content = content_of(path)
    parsed = saved_in(content, source)
    if parsed is None:
        raise refusal(source, "isn't a tournament saved from {programs}", programs=PROGRAMS)
    saved, _ = parsed
    wrong = (
        match_problem(number, match.problem)
        for number, match in enumerate(saved.matches, 1)
        if match.problem
    )
    if problem := saved.refusal or next(wrong, ""):
        raise refusal(source, problem)
    try:
        return _events(saved, plan, entrants, at)
    except InputError as error:
        raise refusal(source, error.sentence) from None
    except EvenbreakError:
        raise
    except MISSHAPEN:
        raise refusal(source, misshapen()) from None


def _events(
    saved: SavedTournament, plan: Plan, rated: Mapping[str, Entrant], at: str
) -> list[Event]:
    players = saved.players
    if len(players) < 2:
        raise InputError("has fewer than two players with names")
    entrants = tuple(rated.get(name, plan.newcomer(name)) for name in players)
    plan = _with_races(_planned(saved, plan), saved, names := _names(saved))
    happened = _happened(saved, names, _tables(saved, plan.tables))
    times = [time for time in (_moment(event[0]) for event in happened) if time]
    first = min(times, default=at)
    events = [Event(first, Opened(plan, entrants)), Event(first, Drawn(players, None))]
    now = first
    for stated, what in happened:
        now = max(now, _moment(stated) or now)
        events.append(Event(now, what))
    _check(events)
    return events


def _planned(saved: SavedTournament, plan: Plan) -> Plan:
    game = plan.discipline or next(
        (name for key, name in _DISCIPLINES.items() if saved.discipline.startswith(key)), "9-ball"
    )
    tables = plan.tables or max(1, len({match.table for match in saved.matches} - {""}))
    plan = replace(plan, discipline=game, tables=tables)
    if saved.everybody:
        return replace(plan, form="round-robin")
    names = _names(saved)
    sides = _sides(saved.matches)
    seat = {name: k for k, name in enumerate(saved.players)}
    layout = []
    for match in saved.matches:
        slots = [
            Source(names[slot[0]], slot[1])
            if isinstance(slot, tuple)
            else None
            if slot is None
            else seat[slot]
            for slot in match.slots
        ]
        layout.append(Draft(names[match.key], sides[match.key], match.round, (slots[0], slots[1])))
    double = any(match.side == "losers" for match in saved.matches)
    form = f"{'double' if double else 'single'} elimination, imported"
    return replace(plan, form=form, layout=tuple(layout))


def _sides(matches: Sequence[SavedMatch]) -> dict[Any, str]:
    """Return each match's side, identifying the finals and the match for third place."""
    sides = {match.key: match.side for match in matches}
    sources = {
        match.key: [slot for slot in match.slots if isinstance(slot, tuple)] for match in matches
    }
    won = {slot[0] for slots in sources.values() for slot in slots if slot[1] == "winner"}
    for match in matches:
        if match.key in won:
            continue
        came = sources[match.key]
        if len(came) == 2 and came[0][0] == came[1][0]:
            sides[match.key], sides[came[0][0]] = "second final", "final"
        elif len(came) == 2 and {outcome for _, outcome in came} == {"loser"}:
            sides[match.key] = "third place"
        elif match.side == "winners":
            sides[match.key] = "final"
    return sides


def _names(saved: SavedTournament) -> dict[Any, str]:
    """Return the names of the matches, such as W1.1, L2.1 and F."""
    if saved.everybody:
        return _pair_names(saved)
    special = {"final": "F", "second final": "F2", "third place": "T"}
    sides, count, names = _sides(saved.matches), Counter[tuple[str, int]](), {}
    for match in saved.matches:
        side = sides[match.key]
        if side in special:
            names[match.key] = special[side]
            continue
        count[side, match.round] += 1
        letter = "L" if side == "losers" else "W"
        names[match.key] = f"{letter}{match.round}.{count[side, match.round]}"
    return names


def _pair_names(saved: SavedTournament) -> dict[Any, str]:
    """Return the match name for each pair of players in a round robin."""
    bracket = bracket_of(Plan("round-robin", 1), saved.players, None)
    name_of = {}
    for match in bracket.matches:
        pair = frozenset(bracket.players[int(slot)] for slot in match.slots)  # type: ignore[arg-type]
        name_of[pair] = match.name
    pairs = [frozenset(filter(None, one.slots)) for one in saved.matches]
    if len(set(pairs)) < len(pairs):
        raise InputError("has two matches between the same two players in a round robin")
    return {
        one.key: name_of[pair]  # type: ignore[index]
        for one, pair in zip(saved.matches, pairs, strict=True)
        if len(pair) == 2
    }


def _with_races(plan: Plan, saved: SavedTournament, names: Mapping[Any, str]) -> Plan:
    """Return the plan with the file's races, if the file states any."""
    stated = {
        names[match.key]: match.race for match in saved.matches if match.race and match.key in names
    }
    if plan.race:
        return plan
    if not stated:
        raise InputError("doesn't say how long the races are. Give {race}.", race=Parameter("race"))
    usual = Counter(stated.values()).most_common(1)[0][0]
    inside = bracket_of(replace(plan, race=usual), saved.players, None).by_name
    others = {name: race for name, race in stated.items() if race != usual and name in inside}
    return replace(plan, race=usual, by_match=others)


def _tables(saved: SavedTournament, tables: int) -> dict[str, int]:
    """Return each table's number; tables without a number come last."""
    texts = sorted(
        {match.table for match in saved.matches} - {""}, key=lambda text: (len(text), text)
    )
    numbers = {text: int(text) for text in texts if text.isdigit() and 1 <= int(text) <= tables}
    free = (k for k in range(1, tables + len(texts) + 1) if k not in numbers.values())
    return {text: numbers[text] if text in numbers else next(free) for text in texts}


def _happened(
    saved: SavedTournament, names: Mapping[Any, str], tables: Mapping[str, int]
) -> list[tuple[str, What]]:
    """Return what happened in the matches, in file order, with the file's times."""
    happened: list[tuple[str, str, int, What]] = []
    order = _order(saved)
    for match in saved.matches:
        played = match.played
        if match.key is None or (not played and match.score is None):
            continue
        name, place = names.get(match.key, ""), order[match.key]
        pair = match.pair if not played else (played[0].player_a, played[0].player_b)
        if match.table and match.started:
            call = Called(name, tables[match.table], pair)
            happened.append((match.started, match.started, place, call))
        if not played:
            score = Scored(name, pair, match.score or (0, 0))
            happened.append((match.started, match.started, place, score))
            continue
        result = _result(name, pair, played, match.winner)
        happened.append((match.ended or match.started, match.ended or match.started, place, result))
    if all(time for time, *_ in happened):
        happened.sort(key=lambda row: (_moment(row[0]) or "", row[2], isinstance(row[3], Result)))
    else:
        happened.sort(key=lambda row: (row[2], isinstance(row[3], Result)))
    return [(time, what) for time, _, _, what in happened]


def _order(saved: SavedTournament) -> dict[Any, int]:
    """Return the least number of matches that come before each match."""
    came = {
        match.key: [s[0] for s in match.slots if isinstance(s, tuple)] for match in saved.matches
    }
    depth: dict[Any, int] = {}
    for _ in saved.matches:
        for key, before in came.items():
            depth[key] = 1 + max((depth.get(earlier, 0) for earlier in before), default=0)
    return depth


def _result(name: str, pair: tuple[str, str], played: Sequence[Played], winner: int) -> Result:
    score = sum(part.score_a for part in played), sum(part.score_b for part in played)
    if not winner:
        fewer = any(Remark.FEWER_GAMES in part.remarks for part in played)
        winner = 1 if (score[0] > score[1]) != fewer else 2
    forfeit = any(part.forfeit for part in played)
    first = played[0]
    uneven = not forfeit and len(played) == 1 and first.race_a != first.race_b
    return Result(
        name,
        pair,
        (0, 0) if forfeit else score,
        pair[winner - 1],
        forfeit=forfeit,
        race=(first.race_a, first.race_b) if uneven else None,
    )


def _moment(text: str) -> str:
    """Return a time such as 2025-03-01T19:30:00, or '' if there is none."""
    try:
        return datetime.fromisoformat(text).replace(tzinfo=None, microsecond=0).isoformat()
    except ValueError:
        return ""


def _check(events: Sequence[Event]) -> None:
    """Check that all numbers are possible and that the results fit together, match by match."""
    for event in events:
        try:
            KINDS.read(KINDS.name(event.what), KINDS.text(event.what))
        except InputError as error:
            match = getattr(event.what, "match", say("tournament"))
            raise InputError("{match}: {why}", match=match, why=error.sentence) from None
    state = evening(events)
    for aside in state.aside:
        seats = state.standing.seats.get(aside.result.match)
        if seats is None:
            raise InputError("{match} is a bye, but it has a result", match=aside.result.match)
        now = [say("no one yet") if k is None else state.order[k] for k in seats]
        raise InputError(
            "{players} played {match}, but the matches before it send {others} there",
            players=listed(aside.result.players),
            match=aside.result.match,
            others=listed(now),
        )
