"""The figures of sections 1 to 4, all computed anew."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from evenbreak.plots.style import our_look
from evenbreak.source_text.physics.collision_figures import gearing_tips, sensitivity, throw_factors
from evenbreak.source_text.physics.deflection_figure import deflections
from evenbreak.source_text.physics.schematics import (
    friction_at_hit,
    hit_from_above,
    sliding_draw,
    slip_directions,
    tilted_axis,
    tip_forces,
    velocity_triangle,
)
from evenbreak.source_text.physics.tip_figures import (
    lag_speeds,
    same_sidespin,
    small_circle,
    stick_speeds,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def figures() -> Mapping[str, Callable[[], Figure]]:
    """Return the figures of sections 1 to 4 by name, each a function that draws it.

    Notes
    -----
    Source: Figs. 3.1 to 3.4, 4.4, 4.5, 4.7 and 4.8 are plots, the others sketches;
    `evenbreak.source_text.physics.chosen` says what is chosen where the text's values are lost.

    >>> list(figures())[:4]
    ['figure_1_1', 'figure_1_2', 'figure_2_1', 'figure_3_1']
    """
    plots = {
        "figure_1_1": friction_at_hit,
        "figure_1_2": tip_forces,
        "figure_2_1": sliding_draw,
        "figure_3_1": same_sidespin,
        "figure_3_2": small_circle,
        "figure_3_3": stick_speeds,
        "figure_3_4": lag_speeds,
        "figure_4_1": velocity_triangle,
        "figure_4_2": hit_from_above,
        "figure_4_3": slip_directions,
        "figure_4_4": throw_factors,
        "figure_4_5": sensitivity,
        "figure_4_6": tilted_axis,
        "figure_4_7": deflections,
        "figure_4_8": gearing_tips,
    }
    return {name: our_look()(plot) for name, plot in plots.items()}
