"""The source text as files: tables, problems, printed numbers, figures and three pages."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from evenbreak.plots.picture import image_bytes
from evenbreak.source_text.answers import figures, physics_findings, section_5_findings
from evenbreak.source_text.cells import Rows, Tables, csv_bytes
from evenbreak.source_text.findings import Finding, physics_row_of, row_of
from evenbreak.source_text.graph_to_limit.page import graph_to_limit_page
from evenbreak.source_text.graph_to_limit.tables import game_tables
from evenbreak.source_text.physics.figure_tables import figure_tables as physics_figure_tables
from evenbreak.source_text.physics.page import physics_page
from evenbreak.source_text.published import Erratum, errata, physics_errata
from evenbreak.source_text.section5.page import section_5_page
from evenbreak.source_text.section5.problems import problem_tables
from evenbreak.source_text.section5.tables import (
    chart_rows,
    eight_ball_rows,
    figure_tables,
    ladder_rows,
    off_rule_rows,
    score_tables,
    table_rows,
)


def reproduction(say: Callable[[str], None] = lambda _: None) -> Mapping[str, bytes]:
    """Return every file by name: the same bytes each time.

    Parameters
    ----------
    say
        is called with a line about each step.
    """
    say("Computing the tables and problems")
    statistics, physics, games = section_5_tables(), physics_tables(), game_tables()
    files = {
        "index.md": section_5_page(section_5_findings(), statistics).encode(),
        "physics.md": physics_page(physics_findings(), physics).encode(),
        "graph_to_limit.md": graph_to_limit_page(games).encode(),
    }
    tables = {**statistics, **physics, **games}
    files |= {f"{name}.csv": csv_bytes(rows) for name, rows in tables.items()}
    drawn = figures()
    say(f"Drawing {len(drawn)} figures")
    for name, draw in drawn.items():
        figure = draw()
        files |= {f"{name}.{kind}": image_bytes(figure, kind) for kind in ("png", "svg")}
    return files


def section_5_tables() -> Tables:
    """Return the tables of section 5."""
    found = section_5_findings()
    return {
        **{f"table_5_{n}": table_rows(found, f"Table 5.{n}") for n in range(1, 6)},
        "table_5_6": chart_rows(),
        "table_5_6_off_rule": off_rule_rows(),
        "drill_8_ball": eight_ball_rows(),
        **problem_tables(found),
        **score_tables(),
        "npl_ladder": ladder_rows(found),
        **figure_tables(),
        "published": list(map(row_of, found)),
        "errata": _errata_rows(errata()),
    }


def physics_tables() -> Tables:
    """Return the tables of sections 1 to 4."""
    return {
        "published_physics": list(map(physics_row_of, physics_findings())),
        "errata_physics": _errata_rows(physics_errata()),
        **physics_figure_tables(),
    }


def all_findings() -> tuple[Finding, ...]:
    """Return every number of the text with the computed one."""
    return (*physics_findings(), *section_5_findings())


def _errata_rows(slips: Iterable[Erratum]) -> Rows:
    return [{name.rstrip("_"): value for name, value in slip._asdict().items()} for slip in slips]
