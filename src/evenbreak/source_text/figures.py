"""The figures of the text, all drawn anew: plots, sketches and game diagrams."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING

from evenbreak.plots.picture import our_look
from evenbreak.source_text.physics import (
    collision_figures,
    deflection_figure,
    schematics,
    tip_figures,
)
from evenbreak.source_text.section5 import plots
from evenbreak.source_text.section5.diagrams import diagram_graphs, drawn

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def figures() -> Mapping[str, Callable[[], Figure]]:
    """Return every figure by name, each as a function that draws it.

    Notes
    -----
    Source: Figs. 1.1 to 5.11 and the diagrams of problem P5.24. In sections 1 to 4 only
    Figs. 3.1 to 3.4, 4.4, 4.5, 4.7 and 4.8 are plots, the others sketches;
    `evenbreak.source_text.physics.chosen` has the values chosen where those of the text are lost.

    >>> list(figures())[:3]
    ['figure_5_1', 'figure_5_3', 'figure_5_6']
    """
    drawings: dict[str, Callable[[], Figure]] = {
        "figure_5_1": plots.races,
        "figure_5_3": plots.one_ball,
        "figure_5_6": plots.break_formats,
        "figure_5_8": plots.progressive_drill,
        "figure_5_9": plots.rating_ladders,
        "figure_5_11": plots.ahead_matches,
        **{name: partial(drawn, graph) for name, graph in diagram_graphs().items()},
        "figure_1_1": schematics.friction_at_hit,
        "figure_1_2": schematics.tip_forces,
        "figure_2_1": schematics.sliding_draw,
        "figure_3_1": tip_figures.same_sidespin,
        "figure_3_2": tip_figures.small_circle,
        "figure_3_3": tip_figures.stick_speeds,
        "figure_3_4": tip_figures.lag_speeds,
        "figure_4_1": schematics.velocity_triangle,
        "figure_4_2": schematics.hit_from_above,
        "figure_4_3": schematics.slip_directions,
        "figure_4_4": collision_figures.throw_factors,
        "figure_4_5": collision_figures.sensitivity,
        "figure_4_6": schematics.tilted_axis,
        "figure_4_7": deflection_figure.deflections,
        "figure_4_8": collision_figures.gearing_tips,
    }
    return {name: our_look()(draw) for name, draw in drawings.items()}
