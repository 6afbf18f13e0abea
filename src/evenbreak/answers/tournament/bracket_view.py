"""A bracket as everyone sees it: its parts, rounds and matches, by number.

A panel is a part of the bracket. Its columns are rounds; who wins a match goes to a later column.
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
"""The parts in which lines lead from match to match; the others are lists of rounds."""

_THEN = {"knock-out", "pod final"}
"""What follows the sides of a double elimination that is not played to the end."""

_ACROSS = 6
"""How many matches stand in a row where rounds mean nothing."""


class Line(NamedTuple):
    """One player of a match: a name if `known`, else where the player comes from.

    `score` includes a match in play; `needs` is None once it is over or while a player is unknown.
    """

    text: str
    known: bool
    score: str = ""
    won: bool = False
    needs: int | None = None
    chance: float | None = None


@dataclass(frozen=True)
class Box:
    """A match, in the column of its round (from 0).

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
    """What a round is called, and in one word or number where there is no room."""

    title: str
    short: str


@dataclass(frozen=True)
class Panel:
    """A part of a bracket, its boxes from the top down.

    The kind is 'winners', 'losers', 'knock-out', 'consolation', or the name of another part.
    """

    kind: str
    title: str
    rounds: tuple[Round, ...]
    boxes: tuple[Box, ...]

    @property
    def linked(self) -> bool:
        """Whether lines lead from match to match."""
        return self.kind in _LINKED

    @property
    def columns(self) -> list[list[Box]]:
        """The matches of each round, from the top."""
        return [[box for box in self.boxes if box.column == k] for k in range(len(self.rounds))]

    def feeding(self, box: Box) -> list[Box]:
        """Return the matches of this part whose winners come to a match."""
        return [one for one in self.boxes if one.to == box.match and one.column < box.column]


def bracket_panels(
    state: Evening,
    chances: Mapping[str, float] | None = None,
    states: Mapping[str, str] | None = None,
) -> tuple[Panel, ...]:
    """Return the parts of the bracket of a tournament, each with its matches.

    `chances` are the first player's, `states` those that phones know better: 'sent', 'two'.
    """
    made = _panels(state)
    return tuple(
        replace(
            panel, boxes=tuple(_filled(state, b, chances or {}, states or {}) for b in panel.boxes)
        )
        for panel in made
    )


def _panels(state: Evening) -> list[Panel]:
    """Return the parts of the bracket, their matches still without players."""
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
    """Return what the round of each match is called away from the bracket, by the match's name."""
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
    """Return a part of the bracket, its matches still without players."""
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
    """Return the column of each match: rounds without a match have none.

    The final of two sides is above the last round of the losers, so that its line comes up.
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
    """Return matches so that those whose winners meet are together, as slots have them."""
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
    """Return what the round of a match is called."""
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
    """Return what a part of a bracket is called, such as 'Group A'."""
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
    """Return what a group is called, or the runners-up, of whom the best go on.

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
        return say("number {n} of {group}", n=slot.outcome, group=slot.match)
    if slot.match not in numbers:
        return say("to be drawn")
    if slot.outcome == "winner":
        return say("winner of {match}", match=numbers[slot.match])
    return say("loser of {match}", match=numbers[slot.match])
