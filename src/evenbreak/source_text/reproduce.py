"""The source text as files: tables, problems, printed numbers, figures and three pages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import TYPE_CHECKING

from matplotlib.axes import Axes

from evenbreak.plots import image_bytes
from evenbreak.plots.picture import figure_of, our_look
from evenbreak.source_text.answers import physics_findings, section_5_findings
from evenbreak.source_text.cells import Rows, Tables, csv_bytes
from evenbreak.source_text.graph_to_limit import game_tables, graph_to_limit_page
from evenbreak.source_text.pages import physics_page, section_5_page
from evenbreak.source_text.physics import schematics, section_3_plots, section_4_plots
from evenbreak.source_text.published import (
    Erratum,
    Finding,
    errata,
    physics_errata,
    physics_row_of,
    row_of,
)
from evenbreak.source_text.section5 import plots, tables

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def reproduction(say: Callable[[str], None] = lambda _: None) -> Mapping[str, bytes]:
    """Return every file by name, with the same bytes each time.

    Parameters
    ----------
    say
        a function that is called with a line about each step.
    """
    say("Computing the tables and problems")
    statistics, physics, games = section_5_tables(), physics_tables(), game_tables()
    files = {
        "index.md": section_5_page(section_5_findings(), statistics).encode(),
        "physics.md": physics_page(physics_findings(), physics).encode(),
        "graph_to_limit.md": graph_to_limit_page(games).encode(),
    }
    by_name = {**statistics, **physics, **games}
    files |= {f"{name}.csv": csv_bytes(rows) for name, rows in by_name.items()}
    drawings = figures()
    say(f"Drawing {len(drawings)} figures")
    for name, draw in drawings.items():
        figure = draw()
        files |= {f"{name}.{kind}": image_bytes(figure, kind) for kind in ("png", "svg")}
    return files


def section_5_tables() -> Tables:
    """Return the tables in section 5."""
    findings = section_5_findings()
    return {
        **{f"table_5_{n}": tables.table_rows(findings, f"Table 5.{n}") for n in range(1, 6)},
        "table_5_6": tables.chart_rows(),
        "table_5_6_off_rule": tables.off_rule_rows(),
        "drill_8_ball": tables.eight_ball_rows(),
        **tables.problem_tables(findings),
        **tables.score_tables(),
        "npl_ladder": tables.ladder_rows(findings),
        **plots.figure_tables(),
        "published": list(map(row_of, findings)),
        "errata": _errata_rows(errata()),
    }


def physics_tables() -> Tables:
    """Return the tables in sections 1 to 4."""
    return {
        "published_physics": list(map(physics_row_of, physics_findings())),
        "errata_physics": _errata_rows(physics_errata()),
        **section_3_plots.figure_tables(),
        **section_4_plots.figure_tables(),
    }


def figures() -> Mapping[str, Callable[[], Figure]]:
    """Return every figure by name, each as a function that draws it.

    Source: Figs. 1.1 to 5.11 and the diagrams in problem P5.24. In sections 1 to 4, only Figs. 3.1
    to 3.4, 4.4, 4.5, 4.7 and 4.8 are plots, and the others are sketches;
    `evenbreak.source_text.physics.section_3_plots` and `section_4_plots` have the values chosen
    where the text lost its own.

    >>> list(figures())[:3]
    ['figure_5_1', 'figure_5_3', 'figure_5_6']
    """
    diagrams = plots.diagram_graphs().items()
    drawings: dict[str, Callable[[], Axes | Figure]] = {
        "figure_5_1": plots.races,
        "figure_5_3": plots.one_ball,
        "figure_5_6": plots.break_formats,
        "figure_5_8": plots.progressive_drill,
        "figure_5_9": plots.rating_ladders,
        "figure_5_11": plots.ahead_matches,
        **{name: partial(plots.drawn, graph) for name, graph in diagrams},
        "figure_1_1": schematics.friction_at_hit,
        "figure_1_2": schematics.tip_forces,
        "figure_2_1": schematics.sliding_draw,
        "figure_3_1": section_3_plots.same_sidespin,
        "figure_3_2": section_3_plots.small_circle,
        "figure_3_3": section_3_plots.stick_speeds,
        "figure_3_4": section_3_plots.lag_speeds,
        "figure_4_1": schematics.velocity_triangle,
        "figure_4_2": schematics.hit_from_above,
        "figure_4_3": schematics.slip_directions,
        "figure_4_4": section_4_plots.throw_factors,
        "figure_4_5": section_4_plots.sensitivity,
        "figure_4_6": schematics.tilted_axis,
        "figure_4_7": section_4_plots.deflections,
        "figure_4_8": section_4_plots.gearing_tips,
    }
    return {name: partial(_figure, our_look()(draw)) for name, draw in drawings.items()}


def _figure(draw: Callable[[], Axes | Figure]) -> Figure:
    drawn = draw()
    return figure_of(drawn) if isinstance(drawn, Axes) else drawn


def all_findings() -> tuple[Finding, ...]:
    """Return every number in the text with the computed one."""
    return (*physics_findings(), *section_5_findings())


def _errata_rows(slips: Iterable[Erratum]) -> Rows:
    return [{name.rstrip("_"): value for name, value in slip._asdict().items()} for slip in slips]
