"""A bracket for display: its parts, rounds and matches, by number.

A panel is a part of the bracket. Its columns are rounds; a match's winner goes to a later column.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

from evenbreak.tournaments.brackets.bracket import Bracket, Match, Source
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.words import Sentence, ordinal, say

_FINALS = ("final", "second final", "third place")
_LINKED = ("winners", "losers", "knock-out", "consolation")
"""The parts where lines connect matches; the others are lists of rounds."""

_THEN = {"knock-out", "pod final"}
"""Suffixes for the sides of a double elimination that isn't played to the end."""

_ACROSS = 6
"""How many matches are in a row if rounds mean nothing."""


class Line(NamedTuple):
    """One player in a match: a name if `known`, else where the player comes from.

    `score` includes matches in play; `needs` is None once the match is over or while a player is
    unknown.
    """

    text: str
    known: bool
    score: str = ""
    won: bool = False
    needs: int | None = None
    chance: float | None = None


@dataclass(frozen=True)
class Box:
    """A match, in its round's column (from 0).

    `to` is the winner's next match, '' for none. The state is 'waits', 'ready', 'called',
    'playing', 'hill', 'done' or 'forfeit'; pages also know 'sent' and 'two', for scores that phones
    have sent. `beside` is -1 above the final, 1 below it, both in its column, and 0 elsewhere.
    """

    match: str
    number: int
    column: int
    lines: tuple[Line, Line]
    to: str
    to_number: int
    state: str
    title: str = ""
    beside: int = 0
    table: str = ""


class Round(NamedTuple):
    """A round's full name, and its one-word or numeric name for tight spaces."""

    title: str
    short: str


@dataclass(frozen=True)
class Panel:
    """A part of a bracket, with its boxes from top to bottom.

    The kind is 'winners', 'losers', 'knock-out', 'consolation', or another part's name.
    """

    kind: str
    title: str
    rounds: tuple[Round, ...]
    boxes: tuple[Box, ...]

    @property
    def linked(self) -> bool:
        """Whether lines connect the matches."""
        return self.kind in _LINKED

    @property
    def columns(self) -> list[list[Box]]:
        """Each round's matches, from the top."""
        return [[box for box in self.boxes if box.column == k] for k in range(len(self.rounds))]

    def feeding(self, box: Box) -> list[Box]:
        """Return this part's matches whose winners go to a match."""
        return [one for one in self.boxes if one.to == box.match and one.column < box.column]


def bracket_panels(
    state: Evening,
    chances: Mapping[str, float] | None = None,
    states: Mapping[str, str] | None = None,
) -> tuple[Panel, ...]:
    """Return the parts of a tournament's bracket, with all their matches.

    `chances` are the first player's, `states` are more recent states from phones: 'sent', 'two'.
    """
    made = _panels(state)
    return tuple(
        replace(
            panel, boxes=tuple(_filled(state, b, chances or {}, states or {}) for b in panel.boxes)
        )
        for panel in made
    )


def _panels(state: Evening) -> list[Panel]:
    """Return the parts of the bracket, with matches that have no players yet."""
    parts: dict[str, list[Match]] = {}
    sides = {match.side for match in state.bracket.matches}
    main = "knock-out" if sides & _THEN else "winners"
    for match in state.bracket.matches:
        if NOBODY not in state.standing.seats[match.name]:
            final = match.side in (*_FINALS, "pod final")
            parts.setdefault(main if final else match.side, []).append(match)
    made = [_panel(state, kind, matches, sides) for kind, matches in parts.items()]
    made.sort(key=lambda panel: panel.kind == "knock-out")  # the sides that lead to it come first
    return made


_ALONE = {"final": say("Final"), "second final": say("Second final")}


@lru_cache(maxsize=4)
def round_names(state: Evening) -> dict[str, str]:
    """Return each match's round name outside the bracket, by match name."""
    found = {}
    for panel in _panels(state):
        for box in panel.boxes:
            match, title = state.bracket.match(box.match), panel.rounds[box.column]
            name = box.title or title.title
            if panel.kind == "winners" and title.short == str(match.round):
                name = say("Winners' round {n}", n=match.round)
            found[box.match] = _ALONE.get(match.side, name)
    return found


def _panel(state: Evening, kind: str, matches: list[Match], sides: set[str]) -> Panel:
    """Return a part of the bracket, with matches that have no players yet."""
    onward = {
        slot.match: match.name
        for match in state.bracket.matches
        for slot in match.slots
        if isinstance(slot, Source) and slot.outcome == "winner" and slot.via is None
    }
    if kind == "Chips" or state.plan.form == "king-of-the-hill":
        rows = -(-len(matches) // _ACROSS)
        boxes = [_empty(state, m, k // rows, "") for k, m in enumerate(matches)]
        return Panel(
            "list", title_of(kind), tuple([Round("", "")] * (boxes[-1].column + 1)), tuple(boxes)
        )
    columns = _columns(state.bracket, matches, kind)
    rounds = [Round("", "")] * (max(columns.values()) + 1)
    boxes = []
    for match in matches:
        column = columns[match.name]
        title = _titles(match, kind, matches, sides, column)
        own = ("losers" in sides and match.side == "final") or match.side in _FINALS[1:]
        if not own or not rounds[column].title:
            rounds[column] = title
        boxes.append(
            _empty(state, match, column, onward.get(match.name, ""), title.title if own else "")
        )
    order = {name: k for k, name in enumerate(_from_the_top(state.bracket, boxes))}
    boxes.sort(key=lambda box: order[box.match])
    return Panel(kind, title_of(kind), tuple(rounds), tuple(boxes))


def _columns(bracket: Bracket, matches: list[Match], kind: str) -> dict[str, int]:
    """Return each match's column; rounds without a match get none.

    The final between the two sides is above the losers' last round, so that its line goes up.
    """
    first = min(match.round for match in matches if match.side not in ("pod final", *_FINALS[1:]))
    times = {
        match.name: {"pod final": first - 1, "second final": match.round + 1000}.get(
            match.side, match.round
        )
        for match in matches
    }
    last = max((t for m in matches if m.side not in _FINALS for t in [times[m.name]]), default=0)
    for match in matches:
        if match.side in _FINALS:
            times[match.name] = last + 1
    place = {time: k for k, time in enumerate(sorted(set(times.values())))}
    columns = {name: place[time] for name, time in times.items()}
    if kind == "winners":
        losers = len({match.round for match in bracket.matches if match.side == "losers"})
        for match in matches:
            if match.side in _FINALS:
                columns[match.name] = max(columns[match.name], losers - 1)
    return columns


def _from_the_top(bracket: Bracket, boxes: list[Box]) -> list[str]:
    """Return matches ordered so that those whose winners meet are together, in slot order."""
    names = {box.match for box in boxes}
    order: list[str] = []

    def visit(name: str) -> None:
        for slot in bracket.by_name[name].slots:
            if isinstance(slot, Source) and slot.outcome == "winner" and slot.match in names:
                visit(slot.match)
        if name not in order:
            order.append(name)

    for box in boxes:
        if box.to not in names:
            visit(box.match)
    return order


def _titles(match: Match, kind: str, matches: list[Match], sides: set[str], column: int) -> Round:
    """Return a match's round name."""
    if match.side == "final":
        return Round(say("Final"), say("Final"))
    if match.side == "second final":
        return Round(say("If needed"), say("If needed"))
    if match.side == "third place":
        return Round(say("Third place"), say("Third place"))
    if match.side == "pod final":
        return Round(say("Pod finals"), say("Pods"))
    if kind == "losers":
        return Round(say("Losers {n}", n=column + 1), str(column + 1))
    rounds = max(one.round for one in matches if one.side not in _FINALS[1:])
    whole = kind == "knock-out" or (kind == "winners" and not sides & _THEN)
    left = rounds - match.round if whole else -1
    if left == 0 and kind == "winners":
        return Round(say("Winners’ final"), say("W-final"))
    if kind == "consolation" and match.round == rounds:
        return Round(say("Final"), say("Final"))
    if left == 1:
        return Round(say("Semifinals"), say("Semis"))
    if left == 2:
        return Round(say("Quarterfinals"), say("Quarters"))
    return Round(say("Round {n}", n=match.round), str(match.round))


def title_of(kind: str) -> str:
    """Return the name of a part of a bracket, such as 'Group A'."""
    name, _, letter = kind.partition(" ")
    if name == "group":
        return say("Group {name}", name=letter)
    titles = {
        "winners": say("Winners"),
        "losers": say("Losers"),
        "consolation": say("Consolation"),
        "knock-out": say("Knockout"),
        "round robin": say("Round robin"),
        "Chips": say("Racks"),
    }
    return titles.get(kind) or kind[:1].upper() + kind[1:]


def _empty(state: Evening, match: Match, column: int, to: str, title: str = "") -> Box:
    lines = Line("", known=False), Line("", known=False)
    number, then = state.number_of(match.name), state.number_of(to) if to else 0
    beside = {"second final": -1, "third place": 1}.get(match.side, 0)
    return Box(match.name, number, column, lines, to, then, "waits", title, beside)


def _filled(
    state: Evening, box: Box, chances: Mapping[str, float], states: Mapping[str, str]
) -> Box:
    """Return a match with its players, scores and state."""
    match, now = state.bracket.match(box.match), state.standing
    result, live = state.counted.get(match.name), state.live.get(match.name)
    pair = [None if seat is None else state.order[seat] for seat in now.seats[match.name]]
    needs: tuple[int | None, int | None] = None, None
    games: dict[str, int] = {}
    if result is None and None not in pair:
        needs = state.needed(match.name, (str(pair[0]), str(pair[1])))
        games = dict(zip(live.what.players, live.what.score, strict=True)) if live else {}
    elif result is not None and not result.forfeit:
        games = dict(result.games)
    table = state.on_tables.get(match.name)
    standing = "waits"
    if result is not None:
        standing = "forfeit" if result.forfeit else "done"
    elif table is not None:
        left = [
            need - games.get(str(name), 0) for need, name in zip(needs, pair, strict=True) if need
        ]
        standing = "called" if not live else "hill" if left == [1, 1] else "playing"
    elif match.name in now.to_play:
        standing = "ready"
    p = chances.get(match.name) if result is None else None
    lines = []
    for slot, name, need in zip(match.slots, pair, needs, strict=True):
        if name is None:
            text = source_words(slot, state.match_numbers) if isinstance(slot, Source) else ""
            lines.append(Line("" if match.side == "second final" else text, known=False))
            continue
        score = str(games[name]) if name in games else ""
        if result is not None and result.forfeit and name != result.winner:
            score = "forfeit"
        chance = p if p is None or name == pair[0] else 1.0 - p
        lines.append(Line(name, True, score, bool(result and result.winner == name), need, chance))
    label = "" if table is None else state.plan.table_name(table.call.table)
    standing = states.get(match.name, standing)
    return replace(box, lines=(lines[0], lines[1]), state=standing, table=label)


def group_words(name: str) -> Sentence | str:
    """Return the name of a group, or of the runners-up of whom the best advance.

    >>> group_words("A"), group_words("4")
    ('A', 'best 4th')
    """
    return say("best {rank}", rank=ordinal(int(name))) if name.isdigit() else name


def source_words(slot: Source, numbers: Mapping[str, int]) -> Sentence | str:
    """Return where a player comes from, such as 'winner of 12'."""
    if isinstance(slot.outcome, int) and slot.match.isdigit():  # a runner-up
        if slot.outcome == 1:
            return group_words(slot.match)
        rank = ordinal(int(slot.match))
        return say("{nth} best {rank}", nth=ordinal(slot.outcome), rank=rank)
    if isinstance(slot.outcome, int):
        return say("number {n} in {group}", n=slot.outcome, group=slot.match)
    if slot.match not in numbers:
        return say("to be drawn")
    if slot.outcome == "winner":
        return say("winner of {match}", match=numbers[slot.match])
    return say("loser of {match}", match=numbers[slot.match])
