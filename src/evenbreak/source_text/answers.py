"""How each number of the text is computed, and how it compares with the printed one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import TYPE_CHECKING, Any

from evenbreak.plots.picture import our_look
from evenbreak.source_text.findings import Finding, find
from evenbreak.source_text.inputs import Answers, parse_inputs
from evenbreak.source_text.physics import (
    collision_figures,
    collisions,
    deflections,
    equipment,
    natural_roll,
    schematics,
    tip,
    tip_figures,
)
from evenbreak.source_text.physics import figure_tables as deflection_figure
from evenbreak.source_text.published import physics_numbers, published_numbers
from evenbreak.source_text.section5 import (
    break_formats,
    games_won,
    innings,
    long_run,
    one_ball,
    plots,
    samples,
)
from evenbreak.source_text.section5.plots import diagram_graphs, drawn

if TYPE_CHECKING:
    from matplotlib.figure import Figure


PHYSICS = (equipment, natural_roll, tip, collisions, deflections)
"""The modules that answer the problems of sections 1 to 4."""

SECTION_5 = (samples, games_won, innings, one_ball, break_formats, long_run)
"""The modules that answer the problems of section 5."""

ANSWERS: Answers = {
    key: answer for part in (*PHYSICS, *SECTION_5) for key, answer in part.ANSWERS.items()
}
"""How each quantity is computed from its inputs, by problem and quantity."""


def compute(problem: str, quantity: str, inputs: str) -> Any:
    """Return a quantity of the text, computed from the inputs as the text states them.

    Raises
    ------
    KeyError
        if the text has no such quantity.

    >>> compute("P5.5", "P(3:0)", "p=2/3"), round(compute("P4.17", "theta, deg", "alpha=30deg"), 2)
    (Fraction(8, 27), 33.67)
    """
    return ANSWERS[problem, quantity](parse_inputs(inputs))


@cache
def physics_findings() -> tuple[Finding, ...]:
    """Return every number of sections 1 to 4 with what is computed, in the order of the text.

    >>> finding = physics_findings()[0]
    >>> finding.published.quantity, finding.computed, finding.verdict
    ('diameter, in', 2.25, 'given')
    """
    return tuple(find(physics_numbers(), ANSWERS))


@cache
def section_5_findings() -> tuple[Finding, ...]:
    """Return every number of section 5 with what is computed, in the order of the text."""
    return tuple(find(published_numbers(), ANSWERS))


# The figures of the text, all drawn anew: plots, sketches and game diagrams.


def figures() -> Mapping[str, Callable[[], Figure]]:
    """Return every figure by name, each as a function that draws it.

    Notes
    -----
    Source: Figs. 1.1 to 5.11 and the diagrams of problem P5.24. In sections 1 to 4 only
    Figs. 3.1 to 3.4, 4.4, 4.5, 4.7 and 4.8 are plots, the others sketches;
    `evenbreak.source_text.physics.tip_figures` has the values chosen where the text lost its own.

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
