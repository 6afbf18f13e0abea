"""A bracket as boxes on columns: what every picture of it shows, and where.

A panel is one side of the bracket. Its columns are rounds; heights count from 0 at the top to 1 at
the bottom, and the winner's line of a box leads to a box of the next column.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

from evenbreak.tournaments.brackets.bracket import Bracket, Match, Source
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.evening.events import race_words
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.words import Sentence, ordinal, say

_MAIN = ("winners", "knock-out")
"""The sides that a final belongs to."""

_NAME = re.compile(r"([A-Z]+)(\d+)\.(\d+)")
_TITLES = {
    "winners": say("Winners' side"),
    "losers": say("Losers' side"),
    "consolation": say("Consolation"),
    "third place": say("Third place"),
    "knock-out": say("Knock-out"),
    "round robin": say("Round robin"),
    "king of the hill": say("King of the hill"),
    "Swiss": say("Swiss"),
}


@dataclass(frozen=True)
class Line:
    """One player of a match.

    Parameters
    ----------
    text
        the name, or where the player comes from.
    known
        whether it is a player.
    seed
        the seed; None where not known.
    score
        games won, also of a match in play; 'forfeit' or ''.
    won
        whether this player won the match.
    """

    text: str
    known: bool
    seed: int | None = None
    score: str = ""
    won: bool = False


@dataclass(frozen=True)
class Box:
    """A match.

    Parameters
    ----------
    match
        its name.
    column
        the round, from 0.
    height
        where its middle is, from 0 (top) to 1.
    lines
        its two players.
    to
        the match that the winner goes to, in the same panel; '' if none.
    state
        'over', 'playing', 'ready' or 'waits'.
    table
        the table on which it is played; None unless it is.
    needs
        the games that each player needs; None where it is over, or the players are not known.
    """

    match: str
    column: int
    height: float
    lines: tuple[Line, Line]
    to: str
    state: str
    table: int | None = None
    needs: tuple[int, int] | None = None

    @property
    def race(self) -> str:
        """What is raced to, such as 'race to 5', unlike a score; '' where it is not known."""
        if self.needs is None:
            return ""
        return race_words(self.needs)


@dataclass(frozen=True)
class Panel:
    """A side of a bracket.

    Parameters
    ----------
    title
        what it is called.
    rounds
        the heading of each column.
    boxes
        its matches.
    """

    title: str
    rounds: tuple[str, ...]
    boxes: tuple[Box, ...]

    @property
    def most(self) -> int:
        """The most matches of a round, byes counted: how high the panel has to be."""
        closest = [
            min((b.height - a.height for a, b in pairwise(column)), default=1.0)
            for column in self.columns
        ]
        return max(1, round(1.0 / min(closest, default=1.0)))

    @property
    def rows(self) -> float:
        """How many matches high the panel is."""
        return self.row(max(self.boxes, key=lambda box: box.height)) + 0.5 if self.boxes else 1.0

    def row(self, box: Box) -> float:
        """Return how many matches below the top of the panel the middle of a match is."""
        return (box.height - min(one.height for one in self.boxes)) * self.most + 0.5

    @property
    def columns(self) -> list[list[Box]]:
        """The boxes of each round, from the top."""
        return [
            sorted((box for box in self.boxes if box.column == k), key=lambda box: box.height)
            for k in range(len(self.rounds))
        ]


def bracket_panels(state: Evening) -> tuple[Panel, ...]:
    """Return the sides of the bracket of a tournament, each with its matches.

    >>> from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan, Result
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> names = ("Ann", "Bo", "Cy", "Di")
    >>> begun = Opened(Plan("single", 5), tuple(Entrant(name, 80.0) for name in names))
    >>> happened = begun, Drawn(names, (0, 3, 1, 2)), Result("W1.1", ("Ann", "Di"), (5, 3), "Ann")
    >>> (panel,) = bracket_panels(evening([Event("2025-03-01T19:30:00", w) for w in happened]))
    >>> [(box.match, box.height, [line.text for line in box.lines]) for box in panel.boxes[1:]]
    [('W1.2', 0.75, ['Bo', 'Cy']), ('F', 0.5, ['Ann', 'winner of W1.2'])]
    """
    bracket = state.bracket
    sides: dict[str, list[Match]] = {}
    of_sides = {match.side for match in bracket.matches}
    for match in bracket.matches:
        if NOBODY in state.standing.seats[match.name]:
            continue
        side = match.side
        if side in ("final", "second final"):
            side = next((main for main in _MAIN if main in of_sides), side)
        sides.setdefault(side, []).append(match)
    return tuple(_panel(state, side, matches) for side, matches in sides.items())


def _panel(state: Evening, side: str, matches: list[Match]) -> Panel:
    columns = _columns(matches)
    heights = _heights(state.bracket, side, matches, columns)
    names = {match.name for match in matches}
    onward = {
        slot.match: match.name
        for match in matches
        for slot in match.slots
        if isinstance(slot, Source) and slot.outcome == "winner" and slot.match in names
    }
    boxes = tuple(
        _box(state, match, columns[match.name], heights[match.name], onward.get(match.name, ""))
        for match in matches
    )
    last = max(columns.values())
    headings = []
    for k in range(last + 1):
        here = [match for match in matches if columns[match.name] == k]
        headings.append(_heading(here[0]) if here else "")
    kind, _, letter = side.partition(" ")
    title: str = _TITLES.get(side) or side[:1].upper() + side[1:]
    if kind == "group":
        title = say("Group {name}", name=letter)
    if side == "winners" and not any(match.side == "losers" for match in state.bracket.matches):
        title = ""
    return Panel(title, tuple(headings), boxes)


_FINALS = {
    "final": say("Final"),
    "second final": say("Second final"),
    "third place": say("Third place"),
}


def _heading(match: Match) -> str:
    return _FINALS.get(match.side) or say("Round {n}", n=match.round)


def _columns(matches: list[Match]) -> dict[str, int]:
    """Return the column of each match: rounds of a side, then the finals."""
    rounds = max((m.round for m in matches if m.side not in ("final", "second final")), default=0)
    columns = {}
    for match in matches:
        shift = {"final": rounds, "second final": rounds + 1}.get(match.side, 0)
        columns[match.name] = shift + (match.round - 1 if shift == 0 else 0)
    return columns


def _heights(
    bracket: Bracket, side: str, matches: list[Match], columns: dict[str, int]
) -> dict[str, float]:
    """Return the height of each match: by its place in the full bracket, where it has one."""
    rounds = max((m.round for m in bracket.matches if m.side == "winners"), default=0)
    lines = 2 ** (rounds + ("F" in bracket.by_name and side == "winners" and not _double(bracket)))
    many = Counter(columns.values())
    seen: Counter[int] = Counter()
    found: dict[str, float] = {}
    for match in matches:
        column = columns[match.name]
        parsed = _NAME.fullmatch(match.name)
        count, place = many[column], seen[column]
        if parsed and side == "winners" and match.side == "winners":
            count, place = lines // 2**match.round, int(parsed[3]) - 1
        elif parsed and side == "losers":
            count = max(1, 2**rounds // 2 ** ((match.round + 1) // 2 + 1))
            place = int(parsed[3]) - 1
        seen[column] += 1
        if place >= count:
            count, place = many[column], seen[column] - 1
        found[match.name] = (place + 0.5) / count
    for column in set(columns.values()):
        here = [match.name for match in matches if columns[match.name] == column]
        if len({round(found[name], 6) for name in here}) < len(here):  # several brackets in one
            here.sort(key=_number)
            found |= {name: (k + 0.5) / len(here) for k, name in enumerate(here)}
    return found


def _number(match: str) -> int:
    parsed = _NAME.fullmatch(match)
    return int(parsed[3]) if parsed else 0


def _double(bracket: Bracket) -> bool:
    return any(match.side == "losers" for match in bracket.matches)


def _box(state: Evening, match: Match, column: int, height: float, to: str) -> Box:
    now, result = state.standing, state.counted.get(match.name)
    seats = now.seats[match.name]
    pair = [None if seat is None else state.order[seat] for seat in seats]
    needs = None
    if result is None and None not in pair:
        needs = state.needed(match.name, (str(pair[0]), str(pair[1])))
    live = state.live.get(match.name)
    games = dict(zip(live.what.players, live.what.score, strict=True)) if live else {}
    lines = []
    for k, (name, seat) in enumerate(zip(pair, seats, strict=True)):
        score = str(games[name]) if name in games else ""
        if result is not None and name is not None and not result.forfeit:
            score = str(result.games[name])
        elif result is not None and result.forfeit and name != result.winner:
            score = "forfeit"
        lines.append(
            Line(
                name or _from(match.slots[k]),
                name is not None,
                None if seat is None else seat + 1,
                score,
                result is not None and result.winner == name,
            )
        )
    table = state.on_tables.get(match.name)
    if result is not None:
        standing = "over"
    elif table is not None:
        standing = "playing"
    else:
        standing = "ready" if match.name in now.to_play else "waits"
    number = None if table is None else table.call.table
    return Box(match.name, column, height, (lines[0], lines[1]), to, standing, number, needs)


def _from(slot: int | Source) -> str:
    """Return where the player of an empty slot comes from."""
    return source_words(slot) if isinstance(slot, Source) else ""


def group_words(name: str) -> Sentence | str:
    """Return what a group is called, or the runners-up, of whom the best go on.

    >>> group_words("A"), group_words("4")
    ('A', 'best 4th')
    """
    return say("best {rank}", rank=ordinal(int(name))) if name.isdigit() else name


def source_words(slot: Source) -> Sentence | str:
    """Return where a player comes from, such as 'winner of W1.2'."""
    if isinstance(slot.outcome, int) and slot.match.isdigit():  # a runner-up
        if slot.outcome == 1:
            return group_words(slot.match)
        rank = ordinal(int(slot.match))
        return say("{nth} best {rank}", nth=ordinal(slot.outcome), rank=rank)
    if isinstance(slot.outcome, int):
        return say("number {n} of {group}", n=slot.outcome, group=slot.match)
    if slot.outcome == "winner":
        return say("winner of {match}", match=slot.match)
    return say("loser of {match}", match=slot.match)


def short_names(names: Iterable[str]) -> dict[str, str]:
    """Return the short form of each name that has one: first initial and last name.

    A form that two players would share is nobody's.

    >>> short_names(["Maximiliane Ndiaye-Roy", "Jean-Luc van Dam", "Ann Lee", "Al Lee", "Bo"])
    {'Jean-Luc van Dam': 'J.-L. van Dam', 'Maximiliane Ndiaye-Roy': 'M. Ndiaye-Roy'}
    """
    distinct = set(names)
    short = {name: _short(name) for name in sorted(distinct)}
    taken = Counter(short.values())
    return {
        name: form
        for name, form in short.items()
        if len(form) < len(name) and taken[form] == 1 and form not in distinct
    }


def _short(name: str) -> str:
    first, _, rest = name.partition(" ")
    parts = [part for part in first.split("-") if part]
    if not rest or not all(part[0].isalpha() for part in parts):
        return name
    return f"{'-'.join(f'{part[0]}.' for part in parts)} {rest}"
