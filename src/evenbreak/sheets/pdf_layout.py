"""How large everything on the paper sheet is, so that the table fills the page."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from evenbreak.answers.league.sheet import NO_RACE
from evenbreak.sheets.pdf_page import MARGIN, POINTS, WIDTH, shortened, width_of
from evenbreak.sheets.race_blocks import Races, parts_of
from evenbreak.sheets.rating_bars import PlayerLine

MOST_ON_A_PAGE = 24
LARGEST, SMALLEST = 11.0, 7.0
"""Sizes of letters, in points: more looks lost on the page, less cannot be read on a wall."""

LONGEST_NAME, LONGEST_RATING = 1.75, 1.5
WIDEST_CELL, HIGHEST_ROW = 0.6, 0.34
WIDEST_BARS, NARROWEST_BARS = 3.2, 1.6
GAP, CELL_EDGE = 0.12, 0.05
HEADING, TICKS = 1.08, 0.45
"""Heights of what is above the slanted names and below the table."""

SLANT = 45
GROUP, NOTE = "group", 8.0
"""What stands above the column of groups, and the size of notes, in points."""


@dataclass(frozen=True)
class PageSizes:
    """Sizes that all pages share: inches, and points for letters.

    `place`, `name`, `rating` and `group` are the widths of those columns, the last 0 if all
    players are of one group; `cell` and `row` are the size of a race's cell; `top` is where the
    table begins; `columns` is how many opponents a page has.
    """

    columns: int
    place: float
    name: float
    rating: float
    group: float
    cell: float
    row: float
    top: float
    text_size: float
    race_size: float
    slant_size: float

    @property
    def left(self) -> float:
        """Where the first race stands."""
        return MARGIN + self.place + self.name + 2 * GAP

    def right(self, across: int) -> float:
        """Where the last of so many races ends."""
        return self.left + self.cell * across

    def bars(self, across: int) -> tuple[float, float]:
        """Where the axis of the bars begins and ends."""
        start = self.right(across) + 3 * GAP + self.rating
        return start, min(start + WIDEST_BARS, WIDTH - MARGIN - self.group)


def page_sizes(lines: Sequence[PlayerLine], races: Races, room: float) -> PageSizes:
    """Return how large all can be, so that names, table and ticks have the height `room`."""
    rows = len(parts_of(lines, MOST_ON_A_PAGE)[0])
    size = min(LARGEST, 0.64 * POINTS * (room - 1.2) / rows)

    def widest(texts: Sequence[str], size: float) -> float:
        return max(width_of(text, size) for text in texts)

    place = widest([str(line.place) for line in lines], size)
    name = min(LONGEST_NAME, widest([line.name for line in lines], size))
    rating = min(LONGEST_RATING, widest([rating_text(line) for line in lines], size))
    grouped = any(line.group is not None for line in lines)
    group = GAP + max(width_of(GROUP, NOTE), widest(list(map(group_text, lines)), size))
    group = group if grouped else 0.0
    fixed = 2 * MARGIN + place + name + rating + group + NARROWEST_BARS + 5 * GAP
    letter = widest([NO_RACE, *set(races.values())], 1.0)
    fitting = int((WIDTH - fixed) / (letter * SMALLEST + CELL_EDGE))
    columns = len(parts_of(lines, min(MOST_ON_A_PAGE, fitting))[0])
    cell = min(WIDEST_CELL, (WIDTH - fixed) / columns)
    slant_size = min(size, 0.6 * cell * POINTS)
    slanted = widest([slanted_name(line, slant_size) for line in lines], slant_size) + 0.15
    height = slanted * math.sin(math.radians(SLANT))
    return PageSizes(
        columns=columns,
        place=place,
        name=name,
        rating=rating,
        group=group,
        cell=cell,
        row=min(HIGHEST_ROW, (room - height - TICKS) / rows),
        top=MARGIN + HEADING + height,
        text_size=size,
        race_size=min(size, (cell - CELL_EDGE) / letter),
        slant_size=slant_size,
    )


def rating_text(line: PlayerLine) -> str:
    """Return a rating with its standard error."""
    return f"{line.rating} ± {line.error}"


def group_text(line: PlayerLine) -> str:
    """Return the group that a player's rating compares in; empty if that is not to be said."""
    return str(line.group or "")


def slanted_name(line: PlayerLine, size: float) -> str:
    """Return what stands above a player's column."""
    return f"{line.place}  {shortened(line.name, size, LONGEST_NAME)}"
