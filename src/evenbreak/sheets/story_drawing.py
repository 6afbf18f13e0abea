"""A night's story as a picture: the title odds as steps, one line per player.

On a page, the drawing uses the page's colors; as a file, it is self-contained. Five lines are named
at their ends; the others are gray. Notes appear only where something happened.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from datetime import datetime, timedelta
from functools import cache
from importlib.resources import files
from itertools import pairwise, product
from typing import NamedTuple

from markupsafe import escape

from evenbreak.answers.kit.wording import share_at_a_glance
from evenbreak.answers.tournament.story import chance_words, clock_words, won_words
from evenbreak.tournaments.evening.story import Step, Story
from evenbreak.words import PYTHON, Face, in_face

LINES = 5
"""How many players' lines have their own color."""

_LETTER = 0.6  # the width of a letter at the most, on average, in sizes of type
_SHORTEST = timedelta(minutes=10)  # of a night that was not typed in afterward
_SHAPES = (
    '<circle r="{r}"/>',
    '<path d="M-{r}-{r}h{d}v{d}h-{d}z"/>',
    '<path d="M0-{r}l{r} {d}h-{d}z"/>',
    '<path d="M0-{d}l{d} {d}l-{d} {d}l-{d}-{d}z" transform="scale(.7)"/>',
    '<path class="cross" d="M-{r}-{r}l{d} {d}m0-{d}l-{d} {d}"/>',
)


class _Box(NamedTuple):
    left: float
    top: float
    right: float
    bottom: float

    def overlaps(self, other: _Box) -> bool:
        return (
            self.left < other.right
            and other.left < self.right
            and self.top < other.bottom
            and other.top < self.bottom
        )


def story_svg(
    story: Story,
    face: Face = PYTHON,
    *,
    size: tuple[int, int] = (1200, 460),
    letters: float = 17.0,
    alone: bool = True,
) -> str:
    """Return a night's title odds, after the draw, as an SVG that fills its box.

    Sizes are in the drawing's units; with `alone`, it includes its colors (`story_style`).
    """
    style = f"<style>{story_style()}</style>" if alone else ""
    return _Drawing(story, face, size, letters, style).svg() if story.steps else ""


@cache
def story_style() -> str:
    """Return the drawing's colors and lines, for a page's stylesheet."""
    sheet = files("evenbreak.sheets").joinpath("templates", "story.css")
    return sheet.read_text(encoding="utf-8")


class _Drawing:
    def __init__(
        self, story: Story, face: Face, size: tuple[int, int], letters: float, style: str
    ) -> None:
        self.story, self.face, self.letters, self.style = story, face, letters, style
        self.width, self.height = size
        self.names = story.leaders
        last = story.steps[-1].title
        self.over = max(last.values()) > 1.0 - 1e-9
        longest = max(len(name) for name in self.names[:LINES])
        room = letters * _LETTER * (longest + 5) + 3.0 * letters
        self.left, self.right = 4.0 * letters, self.width - min(room, 0.45 * self.width)
        self.top, self.bottom = 1.0 * letters, self.height - 2.0 * letters
        highest = max(story.highest.values())
        self.step = 0.25 if highest > 0.5 else 0.1 if highest > 0.2 else 0.05
        self.most = min(1.0, self.step * math.ceil((highest + 0.01) / self.step))
        self.at = [datetime.fromisoformat(one.at) for one in story.steps]
        self.by_clock = self.at[-1] - self.at[0] >= _SHORTEST

    def x(self, step: int) -> float:
        """Return a step's position: by the clock, or by number if all was entered afterward."""
        if self.by_clock:
            share = (self.at[step] - self.at[0]) / (self.at[-1] - self.at[0])
        else:
            share = step / max(1, len(self.at) - 1)
        return self.left + share * (self.right - self.left)

    def y(self, p: float) -> float:
        return self.bottom - p / self.most * (self.bottom - self.top)

    def svg(self) -> str:
        shown = self.names[:LINES]
        gray = "".join(self._line(name) for name in self.names[LINES:])
        lines = "".join(
            f'<g class="s{k}">{self._line(name)}</g>' for k, name in reversed([*enumerate(shown)])
        )
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="story" role="img" '
            f'aria-label="{escape(self._label())}" font-size="{self.letters}" '
            f'viewBox="0 0 {self.width} {self.height}">'
            f'{self.style}{self._axes()}<g class="gray">{gray}</g>{lines}'
            f"{self._ends(shown)}{self._notes(shown)}</svg>"
        )

    def _label(self) -> str:
        last = self.story.steps[-1].title
        return ", ".join(f"{name} {self._percent(last[name])}" for name in self.names[:LINES])

    def _percent(self, p: float) -> str:
        return str(in_face(share_at_a_glance(p), self.face))

    def _points(self, name: str) -> list[tuple[float, float]]:
        points: list[tuple[float, float]] = []
        for k, step in enumerate(self.story.steps):
            if name not in step.title:
                continue
            if points:
                points.append((self.x(k), points[-1][1]))
            points.append((self.x(k), self.y(step.title[name])))
        return points

    def _line(self, name: str) -> str:
        kept: list[tuple[float, float]] = []
        for point in self._points(name):
            if len(kept) > 1 and abs(kept[-2][1] - point[1]) < 0.3 > abs(kept[-1][1] - point[1]):
                kept[-1] = point
            else:
                kept.append(point)
        return f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in kept)}"/>'

    def _axes(self) -> str:
        made = []
        for k in range(round(self.most / self.step) + 1):
            y, said = self.y(k * self.step), self._percent(k * self.step)
            made.append(
                f'<line class="grid" x1="{self.left:.0f}" x2="{self.right:.0f}" y1="{y:.1f}" '
                f'y2="{y:.1f}"/><text x="{self.left - 0.6 * self.letters:.1f}" '
                f'y="{y + 0.35 * self.letters:.1f}" text-anchor="end">{escape(said)}</text>'
            )
        made += [
            f'<text x="{x:.1f}" y="{self.height - 0.4 * self.letters:.1f}" '
            f'text-anchor="middle">{escape(said)}</text>'
            for x, said in self._ticks()
        ]
        return "".join(made)

    def _ticks(self) -> list[tuple[float, str]]:
        if not self.by_clock:
            return []
        begin, end = self.at[0], self.at[-1]
        whole = end - begin
        minutes = next((m for m in (15, 30, 60, 120) if whole <= timedelta(minutes=6 * m)), 240)
        tick = begin.replace(minute=0, second=0) - timedelta(hours=begin.hour % 4)
        found = []
        while tick <= end:
            if tick >= begin:
                x = self.left + (tick - begin) / whole * (self.right - self.left)
                found.append((x, str(in_face(clock_words(tick.isoformat()), self.face))))
            tick += timedelta(minutes=minutes)
        return found

    def _ends(self, shown: Sequence[str]) -> str:
        """Return the names at the ends of the lines, one below another."""
        last = self.story.steps[-1].title
        apart = 1.45 * self.letters
        places: list[float] = []
        for name in shown:  # the highest first
            y = self.y(last[name])
            places.append(max(y, places[-1] + apart) if places else y)
        if over := max(0.0, places[-1] - self.bottom):
            places[-1] -= over
            for k in range(len(places) - 2, -1, -1):
                places[k] = min(places[k], places[k + 1] - apart)
        made = []
        for k, (name, place) in enumerate(zip(shown, places, strict=True)):
            y, x = self.y(last[name]), self.right
            shape = _SHAPES[k].format(
                r=round(0.35 * self.letters), d=2 * round(0.35 * self.letters)
            )
            text = x + 2.4 * self.letters
            share = "" if self.over else self._percent(last[name])
            made.append(
                f'<g class="end s{k}"><g transform="translate({x:.1f} {y:.1f})">{shape}</g>'
                f'<path class="lead" d="M{x + 0.7 * self.letters:.1f} {y:.1f}L'
                f'{x + 2.0 * self.letters:.1f} {place:.1f}"/>'
                f'<text x="{text:.1f}" y="{place + 0.35 * self.letters:.1f}">{escape(name)}</text>'
                f'<text x="{self.width - 4:.0f}" y="{place + 0.35 * self.letters:.1f}" '
                f'text-anchor="end">{escape(share)}</text></g>'
            )
        return "".join(made)

    def _notes(self, shown: Sequence[str]) -> str:
        """Return what happened, placed close to where it did if there is room."""
        steps = self.story.steps
        told = [one for one in (self.story.turn, self.story.upset) if one and one.result]
        lines = [self._points(name) for name in shown]
        taken: list[_Box] = []
        told_at = dict.fromkeys(steps.index(one) for one in told)
        return "".join(self._note(k, steps[k], lines, taken) for k in told_at)

    def _note(
        self, k: int, step: Step, lines: list[list[tuple[float, float]]], taken: list[_Box]
    ) -> str:
        assert step.result is not None  # noqa: S101 - notes are of matches
        what = str(in_face(won_words(step.result), self.face))
        why = str(in_face(chance_words(step), self.face))
        x, y = self.x(k), self.y(step.title[step.result.winner])
        size = 0.9 * self.letters
        half = 0.5 * size * 0.56 * max(len(what), len(why))
        best: tuple[float, float, float] | None = None
        across = [x + d * self.letters for d in range(-16, 17, 2)]
        for middle, base in product(
            across, [self.top + d * self.letters for d in range(1, round(self.height / 10), 1)]
        ):
            box = _Box(middle - half, base - size, middle + half, base + 1.5 * size)
            inside = box.left > self.left + 4 and box.right < self.right - 4
            if not inside or box.bottom > self.bottom - 4 or box.top < 0:
                continue
            hit = sum(_crosses(box, line) for line in lines) + 3 * sum(map(box.overlaps, taken))
            near = abs(middle - x) + 1.3 * abs(y - base - 1.5 * size) + (300 if base > y else 0)
            near += 400.0 if box.left < x < box.right and box.top < y < box.bottom else 0.0
            score = near + 250.0 * hit
            if best is None or score < best[0]:
                best = score, middle, base
        if best is None or best[0] >= 250.0 * 1.8:
            return ""  # there is no room for it
        _, middle, base = best
        taken.append(_Box(middle - half, base - size, middle + half, base + 1.5 * size))
        from_y = base + 1.55 * size if base < y else base - 1.2 * size
        return (
            f'<g class="note"><line x1="{min(max(x, middle - half), middle + half):.1f}" '
            f'y1="{from_y:.1f}" x2="{x:.1f}" y2="{y:.1f}"/>'
            f'<circle class="dot" cx="{x:.1f}" cy="{y:.1f}" r="{0.3 * self.letters:.1f}"/>'
            f'<text class="what" font-size="{size:.1f}" text-anchor="middle" '
            f'x="{middle:.1f}" y="{base:.1f}">{escape(what)}</text>'
            f'<text font-size="{size:.1f}" text-anchor="middle" x="{middle:.1f}" '
            f'y="{base + 1.2 * size:.1f}">{escape(why)}</text></g>'
        )


def _crosses(box: _Box, line: Sequence[tuple[float, float]]) -> bool:
    """Return whether a line of steps passes through a box."""
    return any(
        min(x1, x2) < box.right
        and max(x1, x2) > box.left
        and min(y1, y2) < box.bottom
        and max(y1, y2) > box.top
        for (x1, y1), (x2, y2) in pairwise(line)
    )
