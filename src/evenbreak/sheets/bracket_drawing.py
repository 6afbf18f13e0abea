"""A bracket as a drawing, in its own units: boxes, lines, headings; whole, or in parts.

One unit across is a round, one unit down a match. Pages, pictures and paper scale the same drawing.
A match is drawn between the matches whose winners go to it; the losers' side is below the winners',
round under round, and the line from its last match goes up to the final.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple, TypeAlias

from evenbreak.answers.tournament.bracket_view import Box, Panel

HEADING = 0.62
"""The headings' height."""

GAP = 0.25
"""The space below a part of the bracket."""

BOX_WIDE, BOX_HIGH = 0.85, 0.86
"""The share of a round's width and of a match's height that its box takes, at the right."""

_FINALS_APART = 1.62  # between a final and the one above or below it


Corners: TypeAlias = tuple[tuple[float, float], ...]
"""A line's corners."""


class Placed(NamedTuple):
    """A match, and the middle of its box's left side."""

    box: Box
    x: float
    y: float


class Heading(NamedTuple):
    """A heading, the left end of its line, and whether it is a part's heading."""

    text: str
    x: float
    y: float
    large: bool = False


@dataclass(frozen=True)
class Drawing:
    """A bracket, or a part of one, as a drawing; `wide` and `high` in rounds and matches.

    `lines` are given by corners; `onward` are the ends of lines that lead out of it, with the
    match's number.
    """

    wide: float
    high: float
    boxes: tuple[Placed, ...]
    lines: tuple[Corners, ...]
    headings: tuple[Heading, ...]
    onward: tuple[tuple[float, float, int], ...] = ()


def rows(panel: Panel) -> dict[str, float]:
    """Return the distance from the top of its part to each match's middle, in matches.

    >>> from evenbreak.answers.tournament.bracket_view import Line, Round
    >>> nobody = Line("", False), Line("", False)
    >>> one, other = (Box(f"W1.{k}", k, 0, nobody, "F", 3, "waits") for k in (1, 2))
    >>> both = Round("Semifinals", "Semis"), Round("Final", "Final")
    >>> rows(Panel("winners", "", both, (one, other, Box("F", 3, 1, nobody, "", 0, "waits"))))
    {'W1.1': 0.5, 'W1.2': 1.5, 'F': 1.0}
    """
    if not panel.linked:
        return {box.match: k + 0.5 for column in panel.columns for k, box in enumerate(column)}
    found: dict[str, float] = {}
    leaves = 0
    for box in panel.boxes:  # those that feed a match stand before it
        if box.beside:
            continue
        fed = [found[one.match] for one in panel.feeding(box)]
        leaves += not fed
        found[box.match] = sum(fed) / len(fed) if fed else leaves - 0.5
    for box in panel.boxes:
        if box.beside:
            final = [found[b.match] for b in panel.boxes if b.column == box.column and not b.beside]
            found[box.match] = max(final, default=0.5) + box.beside * _FINALS_APART
    top = min(found.values(), default=0.5)
    return {name: y + max(0.0, 0.5 - top) for name, y in found.items()}


def height(panel: Panel) -> float:
    """Return the height of a part of the bracket in matches, without its headings."""
    return max(rows(panel).values(), default=0.5) + 0.5


def drawing(panels: Sequence[Panel]) -> Drawing:
    """Return a drawing of a bracket's parts: sides below each other, small groups side by side."""
    across = max([len(panel.rounds) for panel in panels], default=1)
    parts: list[list[Placed]] = []
    headings: list[Heading] = []
    left, top, lowest = 0.0, 0.0, 0.0
    for panel in panels:
        if left and (panel.linked or left + len(panel.rounds) > across):
            left, top = 0.0, lowest + GAP
        titled = panel.title and panel.kind not in ("winners", "losers") and len(panels) > 1
        if titled:
            headings.append(Heading(panel.title, left + 1 - BOX_WIDE, top + 0.6 * HEADING, True))
        y = top + (HEADING if titled else 0.0)
        if any(one.title for one in panel.rounds):
            y += HEADING
        at = rows(panel)
        placed = [
            Placed(box, left + box.column + 1 - BOX_WIDE, y + at[box.match]) for box in panel.boxes
        ]
        headings += _headings(panel, placed, left)
        parts.append(placed)
        lowest = max(lowest, y + height(panel))
        left += len(panel.rounds)
        if panel.linked:
            left, top = 0.0, lowest + GAP
    boxes = [one for part in parts for one in part]
    wide = max((one.x for one in boxes), default=0.0) + BOX_WIDE
    lines, onward = _lines(parts)
    return Drawing(wide, lowest, tuple(boxes), tuple(lines), tuple(headings), tuple(onward))


def _headings(panel: Panel, placed: list[Placed], left: float) -> Iterator[Heading]:
    """Return round headings, above the rounds, and headings for finals, right above their boxes."""
    top = min((p.y for p in placed if not p.box.title), default=0.5)
    for k, one in enumerate(panel.rounds):
        column = [p for p in placed if p.box.column == k and not p.box.title]
        if column and one.title:
            alone = panel.linked and len(column) == 1 and panel.kind != "losers"
            yield Heading(one.title, left + k + 1 - BOX_WIDE, (column[0].y if alone else top) - 0.6)
    for p in placed:
        if p.box.title:
            yield Heading(p.box.title, p.x, p.y - 0.6)


def _lines(parts: list[list[Placed]]) -> tuple[list[Corners], list[tuple[float, float, int]]]:
    """Return the lines to winners' next matches, and the lines that lead elsewhere."""
    everywhere = {one.box.match: one for part in parts for one in part}
    lines: list[Corners] = []
    onward = []
    for part in parts:
        here = {one.box.match for one in part}
        for box, x, y in part:
            to, right = everywhere.get(box.to), x + BOX_WIDE
            if to is not None and box.to in here and to.x > x:
                bend = to.x - 0.8 * (1.0 - BOX_WIDE)
                level = abs(to.y - y) < 1e-9
                middle = () if level else ((bend, y), (bend, to.y))
                lines.append(((right, y), *middle, (to.x, to.y)))
            elif to is not None and to.box.title and to.x >= x and to.y < y:  # up to the final
                across, bottom = to.x + 0.5 * BOX_WIDE, to.y + 0.5 * BOX_HIGH
                start = [(right, y), (across, y)] if to.x > x else [(across, y - 0.5 * BOX_HIGH)]
                lines.append((*start, (across, bottom)))
            elif box.to:
                onward.append((right, y, box.to_number))
    return lines, onward


# Parts of a bracket that is too large for one page.


def pages(panels: Sequence[Panel], high: float, wide: int) -> list[list[Panel]]:
    """Return the parts of a bracket for each page, given its size in matches and rounds.

    Headings count as matches.
    """
    whole = drawing(panels)
    if whole.high <= high and whole.wide <= wide:
        return [list(panels)]
    parts = [part for panel in panels for part in _split(panel, high - 2 * HEADING, wide)]
    found: list[list[Panel]] = []
    for part in parts:
        if found and drawing([*found[-1], part]).high <= high:
            found[-1].append(part)
        else:
            found.append([part])
    return found


def _split(panel: Panel, high: float, wide: int) -> list[Panel]:
    """Return a part of the bracket split into small enough parts, earlier rounds first."""
    panel = _without_empty(panel)
    if height(panel) <= high and len(panel.rounds) <= wide:
        return [panel]
    if not panel.linked:
        return _blocks(panel, high, wide)
    for cut in range(min(wide, len(panel.rounds)), 0, -1):
        trees = _trees(panel, cut)
        if cut > 1 and any(height(tree) > high for tree in trees):
            continue
        front: list[list[Box]] = []
        for tree in trees:
            if front and height(_some(panel, [*front[-1], *tree.boxes])) <= high:
                front[-1] += tree.boxes
            else:
                front.append(list(tree.boxes))
        rest = [box for box in panel.boxes if box.column >= cut]
        made = [_without_empty(_some(panel, part)) for part in front]
        return [*made, *(_split(_some(panel, rest), high, wide) if rest else [])]
    return [panel]


def _blocks(panel: Panel, high: float, wide: int) -> list[Panel]:
    """Return parts of rounds without lines."""
    found = []
    for first in range(0, len(panel.rounds), wide):
        columns = panel.columns[first : first + wide]
        most = max(map(len, columns))
        for k in range(0, most, max(1, int(high))):
            some = [box for column in columns for box in column[k : k + max(1, int(high))]]
            found.append(_without_empty(_some(panel, some)))
    return found


def _trees(panel: Panel, cut: int) -> list[Panel]:
    """Return the first rounds' matches, keeping together those that lead to the same match."""
    early = [box for box in panel.boxes if box.column < cut]
    names = {box.match: box for box in early}
    ends: dict[str, list[Box]] = {}
    for box in early:
        end = box
        while end.to in names:
            end = names[end.to]
        ends.setdefault(end.match, []).append(box)
    return [_some(panel, boxes) for boxes in ends.values()]


def _some(panel: Panel, boxes: Sequence[Box]) -> Panel:
    return replace(panel, boxes=tuple(boxes))


def _without_empty(panel: Panel) -> Panel:
    """Return a part of the bracket without empty rounds."""
    used = sorted({box.column for box in panel.boxes})
    place = {column: k for k, column in enumerate(used)}
    boxes = tuple(replace(box, column=place[box.column]) for box in panel.boxes)
    return replace(panel, rounds=tuple(panel.rounds[k] for k in used), boxes=boxes)
