"""The fair-race sheet on paper: the race against each opponent, and each rating, to pin up."""

import math
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.figure import Figure

from evenbreak.answers.kit.remarks import file_name
from evenbreak.answers.league.report import (
    about_ratings,
    heading,
    how_even,
    how_rated,
    how_to_read,
    left_out,
    played,
    source_and_dates,
    version_and_source,
)
from evenbreak.answers.league.sheet import MOST_ON_SHEET, NO_RACE, Sheet, count_groups
from evenbreak.plots.picture import our_look
from evenbreak.sheets.pdf_page import (
    MARGIN,
    PAPERS,
    POINTS,
    SMALLEST,
    UNKNOWN,
    Paper,
    drawable,
    fitted,
    pdf_bytes,
    shortened,
    width_of,
)
from evenbreak.sheets.race_blocks import (
    Bars,
    Block,
    PlayerLine,
    Races,
    Tick,
    parts_of,
    player_lines,
    race_blocks,
)

MOST_ON_A_PAGE = 28
LARGEST = 13.0
"""The table's largest font size, in points: larger letters look lost on the page."""

LONGEST_NAME, LONGEST_RATING = 1.75, 1.5
WIDEST_CELL, HIGHEST_ROW = 0.7, 0.5
WIDEST_BARS, NARROW_BARS, NARROWEST_BARS = 3.2, 1.6, 0.75
GAP, CELL_EDGE = 0.12, 0.035
HEADING, TICKS = 1.08, 0.45
"""Heights above the slanted names and below the table."""

SLANT = 45
GROUP, NOTE = "group", 8.0
"""The heading of the group column, and the font size of notes, in points."""


@dataclass(frozen=True)
class PageSizes:
    """Sizes shared by all pages: inches, and points for letters.

    `wide` is the page's width; `place`, `name`, `rating` and `group` are the widths of those
    columns, the last being 0 if all players are in one group; `cell` and `row` are the size of a
    race's cell; `top` is where the table starts; `columns` is how many opponents a page has.
    """

    wide: float
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
        """Where the first race is."""
        return MARGIN + self.place + self.name + 2 * GAP

    def right(self, across: int) -> float:
        """Where the last of this many races ends."""
        return self.left + self.cell * across

    def bars(self, across: int) -> tuple[float, float]:
        """Where the axis for the bars starts and ends."""
        start = self.right(across) + 3 * GAP + self.rating
        return start, min(start + WIDEST_BARS, self.wide - MARGIN - self.group)


def page_sizes(
    lines: Sequence[PlayerLine], races: Races, room: float, wide: float = PAPERS["a4"].wide
) -> PageSizes:
    """Return how large everything can be for names, table and ticks to have the height `room`."""
    rows = len(parts_of(lines, MOST_ON_A_PAGE)[0])
    size = min(LARGEST, max(SMALLEST, 0.64 * POINTS * (room - 1.2) / rows))

    def widest(texts: Sequence[str], size: float) -> float:
        return max(width_of(text, size) for text in texts)

    place = widest([line.place for line in lines], size)
    name = min(longest_name(size), widest([line.name for line in lines], size))
    rating = min(LONGEST_RATING, widest([rating_text(line) for line in lines], size))
    grouped = any(line.group is not None for line in lines)
    group = GAP + max(width_of(GROUP, NOTE), widest(list(map(group_text, lines)), size))
    group = group if grouped else 0.0
    fixed = 2 * MARGIN + place + name + rating + group
    letter = widest([NO_RACE, *set(races.values())], 1.0)
    least = letter * SMALLEST + CELL_EDGE
    # Bars are shortened only where that lets all races stand on one page.
    bars = NARROW_BARS
    if bars > wide - fixed - 5 * GAP - len(lines) * least >= NARROWEST_BARS:
        bars = NARROWEST_BARS
    across = wide - (fixed + bars + 5 * GAP)
    columns = len(parts_of(lines, min(MOST_ON_A_PAGE, int(across / least)))[0])
    cell = min(WIDEST_CELL, across / columns)
    slant_size = max(SMALLEST, min(size, 0.6 * cell * POINTS))
    slanted = widest([slanted_name(line, slant_size) for line in lines], slant_size) + 0.15
    height = slanted * math.sin(math.radians(SLANT))
    return PageSizes(
        wide=wide,
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


def longest_name(size: float) -> float:
    """Return the width available for a name, in inches: more if few players leave room."""
    return LONGEST_NAME if size < LARGEST else 2.6


def rating_text(line: PlayerLine) -> str:
    """Return a rating with its standard error."""
    return f"{line.rating} ± {line.error}"


def group_text(line: PlayerLine) -> str:
    """Return the group in which a player's rating is comparable; '' if that isn't shown."""
    return str(line.group or "")


def slanted_name(line: PlayerLine, size: float) -> str:
    """Return the heading of a player's column."""
    return f"{line.place}  {shortened(line.name, size, longest_name(size))}"


LEADING = 1.45
"""The line height, per point of font size."""


def sheet_pdf(sheet: Sheet, paper: str = "a4") -> bytes:
    """Return the sheet as a PDF document, with the same bytes every time."""
    title = sheet.title or f"Fair races from {file_name(sheet.file)}"
    with our_look():
        return pdf_bytes(sheet_pages(sheet, paper), title)


def sheet_pages(sheet: Sheet, paper: str = "a4") -> list[Figure]:
    """Return the sheet as pages to be printed, on 'a4' or 'letter'.

    Each line is a player: the fairest race against each opponent, the rating, and a bar of two
    standard errors either way. A league too large for one page is divided into blocks, one per
    page; if there are more than `MOST_ON_SHEET` paired players, only the first ones on the list are
    on paper. White squares replace characters that the font lacks.

    >>> from evenbreak.answers.league.roster_matchups import OfferedRaces
    >>> from evenbreak.files.results.results_file import ResultsFile
    >>> from evenbreak.ratings import Results, fit
    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> file = ResultsFile(season, "season.csv", (), (), "0123456789abcdef")
    >>> len(sheet_pages(Sheet.of(file, fit(season), OfferedRaces(race_to=7), [0, 1, 2])))
    1
    """
    shown = sheet.strongest(MOST_ON_SHEET)
    bars = Bars(shown.listed)
    grouped = count_groups(sheet.ratings) > 1
    lines = player_lines(
        shown.listed, sheet.ratings.scale, bars, grouped=grouped, places=sheet.places
    )
    size = PAPERS[paper]
    notes = _broken(
        size.wide,
        [*_notes(sheet, shown), *_about_names(lines, len(sheet.rated)), version_and_source(sheet)],
    )
    room = size.high - 2 * MARGIN - HEADING - len(notes) * LEADING * NOTE / POINTS
    sizes = page_sizes(lines, shown.races, room, size.wide)
    blocks = [
        (down, block)
        for down in parts_of(lines, MOST_ON_A_PAGE)
        for block in race_blocks(lines, shown.races, sizes.columns)
    ]
    pages = []
    for number, (down, block) in enumerate(blocks, 1):
        page = Paper(size)
        _heading(page, sheet, shown)
        bottom = _Table(page, sizes, down, block, bars.ticks()).draw()
        _lines(page, bottom + 0.42, notes)
        if len(blocks) > 1:
            text = f"page {number} of {len(blocks)}"
            page.text(size.wide - MARGIN, size.high - MARGIN, text, size=NOTE, ha="right")
        pages.append(page.figure)
    return pages


def _heading(page: Paper, sheet: Sheet, shown: Sheet) -> None:
    title, size = fitted(sheet.title or "Fair races", 22, page.wide - 2 * MARGIN, bold=True)
    page.text(MARGIN, MARGIN + 0.22, title, size=size, bold=True)
    source = heading(sheet)[-1] if sheet.title else source_and_dates(sheet)
    lines = [f"{source}. {played(sheet)}", sheet.offered.in_words]
    for k, line in enumerate(lines):
        text = shortened(line, 10.0, page.wide - 2 * MARGIN)
        page.text(MARGIN, MARGIN + 0.5 + 0.2 * k, text, size=10.0)
    text, size = fitted(how_to_read(shown.paired), 11.0, page.wide - 2 * MARGIN, bold=True)
    page.text(MARGIN, MARGIN + 0.93, text, size=size, bold=True)


def _notes(sheet: Sheet, shown: Sheet) -> Iterator[str]:
    yield " ".join(how_even(shown.paired))
    yield " ".join([*about_ratings(sheet), how_rated(sheet)])
    if items := list(left_out(sheet, in_table=len(shown.listed))):
        yield f"Left out: {'; '.join(item.heading for item in items)}."


def _about_names(lines: Sequence[PlayerLine], rated: int) -> Iterator[str]:
    if rated > len(lines):
        yield f"The number next to a name is that player's place among all {rated:,} players."
    if any(UNKNOWN in drawable(line.name) for line in lines):
        yield (
            f"{UNKNOWN} is a letter that this page's font lacks; ratings.csv has the full "
            "names, in the same order."
        )


def _broken(wide: float, notes: Sequence[str]) -> list[str]:
    """Return notes as lines, wrapping those wider than the page."""
    letters = int((wide - 2 * MARGIN) * POINTS / NOTE / 0.58)
    return [part for note in notes for part in textwrap.wrap(note, letters)]


def _lines(page: Paper, y: float, lines: Sequence[str]) -> None:
    for k, line in enumerate(lines):
        page.text(MARGIN, y + k * LEADING * NOTE / POINTS, line, size=NOTE)


@dataclass(frozen=True)
class _Table:
    """The part of the sheet on one page: some players against some others."""

    page: Paper
    sizes: PageSizes
    down: Sequence[PlayerLine]
    block: Block
    ticks: Sequence[Tick]

    def draw(self) -> float:
        """Draw it all, and return where the table ends."""
        sizes, end = self.sizes, self._bars[1]
        for k in range(0, len(self.down), 2):
            top = sizes.top + k * sizes.row
            self.page.band(MARGIN, top, end + sizes.group - MARGIN, sizes.row, gray="0.945")
        self._draw_names()
        self._draw_races()
        self._draw_ratings()
        return self._bottom

    @property
    def _bottom(self) -> float:
        return self.sizes.top + self.sizes.row * len(self.down)

    @property
    def _bars(self) -> tuple[float, float]:
        return self.sizes.bars(len(self.block.across))

    def _middles(self) -> Iterator[tuple[float, PlayerLine]]:
        for k, line in enumerate(self.down):
            yield self.sizes.top + (k + 0.5) * self.sizes.row, line

    def _draw_names(self) -> None:
        sizes, page = self.sizes, self.page
        look: dict[str, Any] = {"size": sizes.text_size}
        for y, line in self._middles():
            x = MARGIN + sizes.place
            page.centered(x, y, line.place, ha="right", color="0.35", **look)
            name = shortened(line.name, sizes.text_size, sizes.name)
            page.centered(x + GAP, y, name, ha="left", **look)
        for column, line in enumerate(self.block.across):
            x = sizes.left + (column + 0.5) * sizes.cell + 0.03
            size = sizes.slant_size
            page.slanted(x, sizes.top - 0.06, slanted_name(line, size), size=size, angle=SLANT)

    def _draw_races(self) -> None:
        sizes, page = self.sizes, self.page
        races = dict(self.block.rows)
        for y, line in self._middles():
            for column, race in enumerate(races[line]):
                x = sizes.left + column * sizes.cell
                if race is None:
                    page.band(x, y - sizes.row / 2, sizes.cell, sizes.row, gray="0.78")
                else:
                    page.centered(x + sizes.cell / 2, y, race, size=sizes.race_size)
        right = sizes.right(len(self.block.across))
        for k in range(len(self.down) + 1):
            y = sizes.top + k * sizes.row
            page.line([sizes.left, right], [y, y], color="0.55", lw=0.4)
        for column in range(len(self.block.across) + 1):
            x = sizes.left + column * sizes.cell
            page.line([x, x], [sizes.top, self._bottom], color="0.55", lw=0.4)

    def _draw_ratings(self) -> None:
        sizes, page = self.sizes, self.page
        start, end = self._bars

        def place(at: float) -> float:
            return start + (end - start) * at / 100

        for tick in self.ticks[:: 1 if end - start > NARROWEST_BARS else 2]:
            page.line([place(tick.at)] * 2, [sizes.top, self._bottom], color="0.75")
            page.centered(place(tick.at), self._bottom + 0.1, tick.label, size=NOTE)
        for y, line in self._middles():
            size = sizes.text_size
            text = shortened(rating_text(line), size, sizes.rating)
            page.centered(start - GAP, y, text, size=size, ha="right")
            ends = [place(line.low), place(line.high)]
            page.line(ends, [y, y], color="0.45", lw=2.2, solid_capstyle="butt")
            page.line([place(line.middle)], [y], marker="o", ms=4.5)
            page.centered(end + sizes.group, y, group_text(line), size=size, ha="right")
        if sizes.group:
            page.text(end + sizes.group, sizes.top - 0.06, GROUP, size=NOTE, ha="right")
        for k, text in enumerate(("bar: ±2 standard errors", "rating ± standard error")):
            page.text(end, sizes.top - 0.06 - 0.15 * k, text, size=NOTE, ha="right")
