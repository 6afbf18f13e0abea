"""The fair-race sheet on paper: who gives whom what, and how sure that is, to pin up."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from evenbreak import __version__
from evenbreak.answers.fair_pairs import RaceLimits
from evenbreak.answers.sheet_words import (
    NO_RACE,
    decimals_of,
    how_rated,
    how_to_read,
    left_out,
    pairs_of,
    played,
    races_by_name,
    remarks,
    scale_sentences,
    source_and_dates,
    unlike_others,
    which_races,
)
from evenbreak.files.results import ResultsFile
from evenbreak.ratings.fitted import Ratings
from evenbreak.sheets.pdf_page import (
    HEIGHT,
    MARGIN,
    POINTS,
    UNKNOWN,
    WIDTH,
    Paper,
    drawable,
    shortened,
    width_of,
)

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

MOST_PAIRED = 48
"""Players that are put on paper; the files hold all."""

MOST_ON_A_PAGE = 24
LARGEST, SMALLEST = 11.0, 7.0
"""Sizes of letters, in points: more looks lost on the page, less cannot be read on a wall."""

LONGEST_NAME, LONGEST_RATING = 1.75, 1.5
WIDEST_CELL, HIGHEST_ROW = 0.6, 0.34
WIDEST_BARS, NARROWEST_BARS = 3.2, 1.6
GAP = 0.12
SLANT = 45
SMALL = 8.0
LEADING = 1.45
CELL_EDGE = 0.05
HEADING, TICKS, FOOTING = 1.08, 0.45, 0.35
"""Heights of what is above the names, below the table and at the foot."""


class Player(NamedTuple):
    """A line of the sheet."""

    place: str
    name: str
    rating: float
    error: float


def sheet_pages(
    file: ResultsFile,
    ratings: Ratings,
    limits: RaceLimits,
    rated: pd.DataFrame,
    paired: pd.DataFrame,
) -> list[Figure]:
    """Return the sheet as pages of A4, to be printed.

    Each line is a player: the fairest race against each opponent, the rating, and a bar of
    two standard errors of it either way. A league too large for a page is cut into blocks,
    each a page. White squares stand for letters that the font lacks.

    Parameters
    ----------
    file, ratings, limits
        what the sheet is made of.
    rated, paired
        as `ratings_frame` and `matchups_frame` make them. Of the players in `rated` those
        that `paired` pairs are shown, the 48 strongest at most.

    >>> from evenbreak.ratings import Results, fit
    >>> from evenbreak.files.results import ResultsFile
    >>> from evenbreak.answers.fair_pairs import matchups_frame
    >>> from evenbreak.answers.frames import ratings_frame
    >>> season = Results.from_names(["Ann", "Bo"], ["Bo", "Cy"], [7, 7], [5, 4])
    >>> ratings, limits = fit(season), RaceLimits(race_to=7)
    >>> paired = matchups_frame(ratings, [0, 1, 2], limits)
    >>> file = ResultsFile(season, "season.csv", (), (), "0123456789abcdef")
    >>> len(sheet_pages(file, ratings, limits, ratings_frame(ratings), paired))
    1
    """
    listed = rated[rated["player"].isin({*paired["player_a"], *paired["player_b"]})]
    shown = listed.head(MOST_PAIRED)
    pairs = pairs_of(paired, set(shown["player"]))
    decimals = decimals_of(ratings.scale)
    rows: Any = shown.itertuples(index=True)
    players = [
        # Rounded, so that the last bits of a sum cannot move a line.
        Player(
            str(row.Index + 1),
            row.player,
            round(row.rating, decimals + 4),
            round(row.standard_error, decimals + 4),
        )
        for row in rows
    ]
    head = [
        f"{source_and_dates(file, ratings)}. {played(ratings)}",
        " ".join(which_races(pairs, limits)),
    ]
    foot = [
        " ".join([scale_sentences(ratings), *left_out(ratings)]),
        f"{how_rated(ratings)} evenbreak {__version__}, from results with the SHA-256 "
        f"{file.sha256[:12]}…",
    ]
    told = [" ".join(remarks(pairs)), " ".join(unlike_others(ratings))]
    notes = _broken([*told, *_about_names(players, len(listed), len(rated))], SMALL)
    room = HEIGHT - 2 * MARGIN - HEADING - FOOTING - len(notes) * LEADING * SMALL / POINTS
    plan = _plan(players, races_by_name(pairs), decimals, room)
    pages = []
    blocks = [(down, across) for down in plan.down for across in plan.across]
    for number, (down, across) in enumerate(blocks, 1):
        page = Paper()
        _heading(page, head, how_to_read(pairs))
        _footing(page, foot, f"page {number} of {len(blocks)}" if len(blocks) > 1 else "")
        block = _Block(page, plan, down, across)
        block.draw()
        _lines(page, block.bottom + 0.42, notes, SMALL)
        pages.append(page.figure)
    return pages


def _about_names(players: list[Player], paired: int, rated: int) -> Iterator[str]:
    """Yield who is on paper of the players that are paired and rated, and by what name."""
    if rated > len(players):
        yield f"The number at a name is its place among all {rated:,} players."
    if paired > len(players):
        yield (
            f"Of {paired:,} paired players the {len(players)} strongest are on paper; "
            "matchups.csv has all."
        )
    if any(UNKNOWN in drawable(player.name) for player in players):
        yield (
            f"{UNKNOWN} is a letter that the font of this page lacks; the number at a name "
            "is its row in ratings.csv, which has it whole."
        )


@dataclass(frozen=True)
class _Plan:
    """How large everything is, the same on every page: inches, and points for letters."""

    races: dict[tuple[str, str], str]
    decimals: int
    down: list[list[Player]]
    across: list[list[Player]]
    column_names: dict[Player, str]
    reach: tuple[float, float]
    place: float
    name: float
    rating: float
    cell: float
    row: float
    top: float
    race_size: float
    name_size: float
    slant_size: float


def _plan(
    players: list[Player], races: dict[tuple[str, str], str], decimals: int, room: float
) -> _Plan:
    """Return how large all can be, so that names, table and ticks have the height `room`."""
    down = _blocks(players, MOST_ON_A_PAGE)
    name_size = min(LARGEST, 0.64 * POINTS * (room - 1.2) / len(down[0]))
    place = max(width_of(player.place, name_size) for player in players)
    name = min(LONGEST_NAME, max(width_of(player.name, name_size) for player in players))
    widest = max(width_of(_rating(player, decimals), name_size) for player in players)
    rating = min(LONGEST_RATING, widest)
    fixed = 2 * MARGIN + place + name + rating + NARROWEST_BARS + 5 * GAP
    letter = max(width_of(text, 1.0) for text in {NO_RACE, *races.values()})
    fitting = int((WIDTH - fixed) / (letter * SMALLEST + CELL_EDGE))
    across = _blocks(players, min(MOST_ON_A_PAGE, fitting))
    cell = min(WIDEST_CELL, (WIDTH - fixed) / len(across[0]))
    slant_size = min(name_size, 0.6 * cell * POINTS)
    names = [
        f"{player.place}  {shortened(player.name, slant_size, LONGEST_NAME)}" for player in players
    ]
    height = (max(width_of(text, slant_size) for text in names) + 0.15) * math.sin(
        math.radians(SLANT)
    )
    low = min(player.rating - 2 * player.error for player in players)
    high = max(player.rating + 2 * player.error for player in players)
    edge = 0.03 * (high - low)
    return _Plan(
        races=races,
        decimals=decimals,
        down=down,
        across=across,
        column_names=dict(zip(players, names, strict=True)),
        reach=(low - edge, high + edge),
        place=place,
        name=name,
        rating=rating,
        cell=cell,
        row=min(HIGHEST_ROW, (room - height - TICKS) / len(down[0])),
        top=MARGIN + HEADING + height,
        race_size=min(name_size, (cell - CELL_EDGE) / letter),
        name_size=name_size,
        slant_size=slant_size,
    )


def _blocks(players: list[Player], most: int) -> list[list[Player]]:
    """Cut a list into parts as equal as can be."""
    size = math.ceil(len(players) / math.ceil(len(players) / most))
    return [players[first : first + size] for first in range(0, len(players), size)]


def _rating(player: Player, decimals: int) -> str:
    return f"{player.rating:.{decimals}f} ± {player.error:.{decimals}f}"


def _heading(page: Paper, lines: Sequence[str], example: str) -> None:
    page.text(MARGIN, MARGIN + 0.22, "Fair races", size=22, bold=True)
    for k, line in enumerate(lines):
        told = shortened(line, 10.0, WIDTH - 2 * MARGIN)
        page.text(MARGIN, MARGIN + 0.5 + 0.2 * k, told, size=10.0)
    page.text(MARGIN, MARGIN + 0.93, example, size=LARGEST, bold=True)


def _footing(page: Paper, lines: Sequence[str], number: str) -> None:
    page.line([MARGIN, WIDTH - MARGIN], [HEIGHT - MARGIN - 0.32] * 2, color="0.6")
    _lines(page, HEIGHT - MARGIN - 0.16, lines, SMALL, color="0.25")
    page.text(WIDTH - MARGIN, HEIGHT - MARGIN, number, size=SMALL, ha="right", color="0.25")


def _broken(lines: Sequence[str], size: float) -> list[str]:
    """Return lines, those that are wider than the page broken."""
    letters = int((WIDTH - 2 * MARGIN) * POINTS / size / 0.58)
    return [part for line in lines for part in textwrap.wrap(line, letters)]


def _lines(page: Paper, y: float, lines: Sequence[str], size: float, **style: Any) -> None:
    for k, line in enumerate(lines):
        page.text(MARGIN, y + k * LEADING * size / POINTS, line, size=size, **style)


@dataclass(frozen=True)
class _Block:
    """The part of the sheet that is on one page: some players against some others."""

    page: Paper
    plan: _Plan
    down: list[Player]
    across: list[Player]

    @property
    def left(self) -> float:
        return MARGIN + self.plan.place + self.plan.name + 2 * GAP

    @property
    def right(self) -> float:
        return self.left + self.plan.cell * len(self.across)

    @property
    def bottom(self) -> float:
        return self.plan.top + self.plan.row * len(self.down)

    @property
    def bars(self) -> tuple[float, float]:
        start = self.right + 3 * GAP + self.plan.rating
        return start, min(start + WIDEST_BARS, WIDTH - MARGIN)

    def draw(self) -> None:
        for line in range(0, len(self.down), 2):
            top = self.plan.top + line * self.plan.row
            self.page.band(MARGIN, top, self.bars[1] - MARGIN, self.plan.row, grey="0.945")
        self._races()
        self._names()
        self._ratings()

    def _middles(self) -> Iterator[tuple[float, Player]]:
        for line, player in enumerate(self.down):
            yield self.plan.top + (line + 0.5) * self.plan.row, player

    def _names(self) -> None:
        size = self.plan.name_size
        for y, player in self._middles():
            x = MARGIN + self.plan.place
            self.page.centred(x, y, player.place, size=size, ha="right", color="0.35")
            name = shortened(player.name, size, self.plan.name)
            self.page.centred(x + GAP, y, name, size=size, ha="left")
        for column, player in enumerate(self.across):
            self.page.text(
                self.left + (column + 0.5) * self.plan.cell + 0.03,
                self.plan.top - 0.06,
                self.plan.column_names[player],
                size=self.plan.slant_size,
                rotation=SLANT,
                rotation_mode="anchor",
            )

    def _races(self) -> None:
        cell, row = self.plan.cell, self.plan.row
        for line, (y, player) in enumerate(self._middles()):
            for column, other in enumerate(self.across):
                x = self.left + column * cell
                if player == other:
                    self.page.band(x, self.plan.top + line * row, cell, row, grey="0.78")
                    continue
                text = self.plan.races.get((player.name, other.name), NO_RACE)
                self.page.centred(x + cell / 2, y, text, size=self.plan.race_size)
        for line in range(len(self.down) + 1):
            y = self.plan.top + line * row
            self.page.line([self.left, self.right], [y, y], color="0.55", lw=0.4)
        for column in range(len(self.across) + 1):
            x = self.left + column * cell
            self.page.line([x, x], [self.plan.top, self.bottom], color="0.55", lw=0.4)

    def _ratings(self) -> None:
        from matplotlib.ticker import MaxNLocator

        (low, high), (start, end) = self.plan.reach, self.bars

        def place(rating: float) -> float:
            return start + (end - start) * (rating - low) / (high - low)

        ticks = MaxNLocator(nbins=5, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
        for tick in (float(tick) for tick in ticks if low <= tick <= high):
            self.page.line([place(tick)] * 2, [self.plan.top, self.bottom], color="0.75", lw=0.5)
            self.page.centred(place(tick), self.bottom + 0.1, f"{tick:g}", size=SMALL)
        for y, player in self._middles():
            size = self.plan.name_size
            text = shortened(_rating(player, self.plan.decimals), size, self.plan.rating)
            self.page.centred(start - GAP, y, text, size=size, ha="right")
            ends = [
                place(player.rating - 2 * player.error),
                place(player.rating + 2 * player.error),
            ]
            self.page.line(ends, [y, y], color="0.45", lw=2.2, solid_capstyle="butt")
            self.page.line([place(player.rating)], [y], marker="o", ms=4.5)
        told = ("bar: two of them either way", "rating ± standard error")
        for k, line in enumerate(told):
            self.page.text(end, self.plan.top - 0.06 - 0.15 * k, line, size=SMALL, ha="right")
