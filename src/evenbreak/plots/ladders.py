"""Plots of a ladder: how far off ratings are, how fast they settle, what a step costs."""

import math
from collections.abc import Iterable, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.layout_engine import ConstrainedLayoutEngine

from evenbreak.handicaps.ladders.settling import Settling
from evenbreak.plots.picture import LINES, Picture, in_our_look, new_axes, unit_axis
from evenbreak.stats.summary import Distribution

_SHOWN = 1e-3
"""Errors rarer than this share of the most frequent one are beyond the edge of the plot."""

_LETTER = 8.5
"""Font size of a system's name."""

_PANEL = (400.0, 300.0)
"""The approximate width and height of the axes of the systems, in points."""

_Box = tuple[float, float, float, float]


class SystemPoint(NamedTuple):
    """A system as a point: the spread of rating errors, and how long newcomers take to settle.

    `sd` is the long-run spread in percent of a doubling of the odds; `matches` is the mean number
    of matches until a rating that is a doubling too low settles. `unbeaten` is whether no other
    step size is both more accurate and faster; None: not a step size, drawn for comparison.
    """

    name: str
    sd: float
    matches: float
    unbeaten: bool | None


@in_our_look
def ladder_figure(
    law: Distribution,
    *,
    natural: Distribution | None = None,
    within: int = 5,
    curve: Settling | None = None,
    title: str | None = None,
) -> Picture:
    """Draw the distribution of the rating error, and below it how fast newcomers settle.

    The normal distribution with the same mean and standard deviation is drawn for comparison, as is
    `natural`, the distribution against correctly rated opponents. Errors from -within to within
    points are shaded.
    """
    size, roomy = (5.4, 4.4 if curve is None else 7.8), ConstrainedLayoutEngine(h_pad=0.1)
    figure = Picture(figsize=size, layout=roomy)
    panels = figure.subplots(1 if curve is None else 2, 1, squeeze=False)[:, 0]
    _draw_law(panels[0], law, natural, within)
    if curve is not None:
        _draw_settling(panels[1], curve)
    if title:
        figure.suptitle(title, parse_math=False)
    return figure


def _draw_law(axes: Axes, law: Distribution, natural: Distribution | None, within: int) -> None:
    errors, chance = np.array(law.values, dtype=float), np.array(law.probability, dtype=float)
    possible = chance > 0.0
    errors, chance = errors[possible], chance[possible]
    # If ratings move by more than a point, some errors never occur.
    spacing = float(np.diff(errors).min()) if len(errors) > 1 else 1.0
    inside = law.between(-within, within)
    axes.axvspan(
        -within - 0.5,
        within + 0.5,
        facecolor="0.92",
        edgecolor="0.7",
        linewidth=0.5,
        zorder=0,
        label=f"within {within} point{'s' * (within != 1)}: {100 * inside:.0f}%",
    )
    style = LINES[0]
    axes.plot(
        errors, chance, "o", ms=3.5, color=style.color, label=f"this ladder (sd {law.sd:.2f})"
    )
    axes.vlines(errors, 0.0, chance, color=style.color, linewidth=0.8)
    if natural is not None:
        style = LINES[2]
        values = np.array(natural.values, dtype=float)
        p = np.array(natural.probability, dtype=float)
        axes.plot(
            values[p > 0.0],
            p[p > 0.0],
            **style._asdict(),
            label=f"against correctly rated opponents (sd {natural.sd:.2f})",
        )
    shown = errors[chance > _SHOWN * chance.max()]
    edge = max(abs(shown[0]), abs(shown[-1]), within) + 1.5
    if law.sd > 0.0:
        style = LINES[1]
        x = np.linspace(-edge, edge, 401)
        bell = np.exp(-0.5 * ((x - law.mean) / law.sd) ** 2) / (law.sd * math.sqrt(2.0 * math.pi))
        axes.plot(
            x,
            spacing * bell,
            **style._asdict(),
            linewidth=1.2,
            label="normal distribution with the same sd",
        )
    axes.set(xlabel="rating minus true skill (points)", ylabel="probability")
    axes.set_xlim(-edge, edge)
    axes.set_ylim(bottom=0.0)
    axes.tick_params(direction="in", top=True, right=True)
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.16), frameon=False, fontsize=9)


def _draw_settling(axes: Axes, curve: Settling) -> None:
    settled = np.cumsum(curve.chances)
    # Nothing happens after nearly all have settled.
    last = min(int(np.searchsorted(settled, 0.995)) + 1, len(settled))
    matches = np.arange(last)
    style = LINES[0]
    axes.plot(matches, settled[:last], color=style.color, drawstyle="steps-post")
    for part, name in ((0.5, "half"), (0.9, "9 of 10")):
        place = int(np.searchsorted(settled, part))
        if place < last:
            axes.plot([0, place, place], [part, part, 0.0], color="0.6", linewidth=0.8, zorder=0)
            # Where the curve leaves room: below it, or above it on the left.
            early = place < last / 2
            axes.annotate(
                f"{name}: {place} matches",
                (place if early else 0, part),
                (6, -13 if early else 4),
                textcoords="offset points",
                fontsize=9,
            )
    unit_axis(axes, "y")
    axes.set_xlim(0, max(last - 1, 1))
    off = f"{abs(curve.start)} points too {'high' if curve.start > 0 else 'low'}"
    axes.set(
        xlabel=f"matches since the rating was {off}",
        ylabel=f"share of players within {curve.within} points",
    )


@in_our_look
def draw_systems(points: Iterable[SystemPoint], *, chart: str = "", ax: Axes | None = None) -> Axes:
    """Draw the spread of rating errors against the time newcomers take, for several systems.

    The step sizes that no other step beats in both are filled and joined.
    """
    on_chart = f" on {chart}" if chart else ""
    axes = new_axes(
        "matches until a newcomer's rating settles (mean)",
        "typical rating error (% of a doubling of the odds)",
        title=f"Systems and step sizes{on_chart}",
        size=(6.4, 5.0),
        ax=ax,
    )
    listed = sorted(points, key=lambda point: point.matches)
    black, orange = LINES[0].color, LINES[2].color
    front = [point for point in listed if point.unbeaten]
    axes.plot(*_places(front), color="0.6", linewidth=0.8, zorder=1)
    kinds = (
        (
            True,
            "o",
            black,
            black,
            f"best step sizes{on_chart}: none is both more accurate and faster",
        ),
        (False, "o", "white", black, "step sizes that another beats in both"),
        (None, "D", orange, orange, "other charts and systems"),
    )
    for unbeaten, mark, inside, edge, label in kinds:
        drawn = [point for point in listed if point.unbeaten is unbeaten]
        if not drawn:
            continue
        axes.plot(*_places(drawn), mark, mfc=inside, mec=edge, ms=5, zorder=3, label=label)
    right, top = 1.15 * listed[-1].matches, 1.1 * max(point.sd for point in listed)
    axes.set_xlim(0.0, right)
    axes.set_ylim(0.0, top)
    for point, offset in zip(listed, _free_offsets(listed, right, top), strict=True):
        axes.annotate(
            point.name,
            (point.matches, point.sd),
            offset,
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=_LETTER,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5},
            zorder=2,
            color=orange if point.unbeaten is None else black,
            parse_math=False,
        )
    axes.legend(frameon=False, fontsize=9, loc="upper right")
    return axes


def _free_offsets(
    listed: Sequence[SystemPoint], right: float, top: float
) -> list[tuple[float, float]]:
    """Return the offset of each name from its mark, in points, so that few overlap anything.

    Each name in turn takes the first free position, or the one with the least overlap.
    """
    wide, high = _PANEL
    marks = [(point.matches / right * wide, point.sd / top * high) for point in listed]
    taken = [(x, y, 6.0, 6.0) for x, y in marks]
    offsets = []
    for (x, y), point in zip(marks, listed, strict=True):
        width, height = 0.55 * _LETTER * len(point.name) + 4.0, _LETTER + 2.0
        side = width / 2.0 + 5.0
        places = [
            (dx, dy)
            for dy, dx in product((0.0, 9.0, -9.0, 18.0, -18.0, 27.0, -27.0), (0.0, side, -side))
            if dx or dy
        ]
        # Above and below come first, then beside, then further off.
        places.sort(key=lambda place: (abs(place[1]) + 0.6 * abs(place[0]), -place[1]))
        covered = [
            sum(_overlap((x + dx, y + dy, width, height), box) for box in taken)
            + 10.0 * max(0.0, width / 2.0 - x - dx, x + dx + width / 2.0 - wide)
            for dx, dy in places
        ]
        best = places[covered.index(min(covered))]
        taken.append((x + best[0], y + best[1], width, height))
        offsets.append(best)
    return offsets


def _overlap(box: _Box, placed: _Box) -> float:
    """Return the overlap area of two boxes, each given as center, width and height.

    >>> _overlap((0, 0, 4, 2), (3, 1, 4, 2))
    1.0
    """
    across = (box[2] + placed[2]) / 2.0 - abs(box[0] - placed[0])
    along = (box[3] + placed[3]) / 2.0 - abs(box[1] - placed[1])
    return max(0.0, across) * max(0.0, along)


def _places(points: Sequence[SystemPoint]) -> tuple[list[float], list[float]]:
    return [point.matches for point in points], [point.sd for point in points]
