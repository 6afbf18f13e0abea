"""The source text as files: tables, problems, printed numbers, figures, and two pages on top."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING

from evenbreak.files.csv_writer import to_csv
from evenbreak.plots.diagram import image_bytes
from evenbreak.source_text.answers import physics_findings, section_5_findings
from evenbreak.source_text.cells import frame
from evenbreak.source_text.figures import figures
from evenbreak.source_text.findings import Finding, findings_frame
from evenbreak.source_text.physics.figure_tables import figure_tables as physics_figure_tables
from evenbreak.source_text.physics.page import physics_page
from evenbreak.source_text.published import Erratum, errata, physics_errata
from evenbreak.source_text.section5.figure_tables import figure_tables
from evenbreak.source_text.section5.page import section_5_page
from evenbreak.source_text.section5.problems import problem_frames
from evenbreak.source_text.section5.tables import (
    charts_frame,
    ladder_frame,
    score_frames,
    table_frame,
)

if TYPE_CHECKING:
    import pandas as pd


def reproduction(say: Callable[[str], None] = lambda _: None) -> Mapping[str, bytes]:
    """Return every file by name: the same bytes each time.

    Parameters
    ----------
    say
        gets a line on each step of the work.
    """
    say("Computing the tables and problems")
    statistics, table_side = section_5_frames(), physics_frames()
    files = {
        "index.md": section_5_page(section_5_findings(), statistics).encode(),
        "physics.md": physics_page(physics_findings(), table_side).encode(),
    }
    files |= {f"{name}.csv": to_csv(table) for name, table in {**statistics, **table_side}.items()}
    drawn = figures()
    say(f"Drawing {len(drawn)} figures")
    for name, draw in drawn.items():
        figure = draw()
        files |= {f"{name}.{kind}": image_bytes(figure, kind) for kind in ("png", "svg")}
    return files


def section_5_frames() -> Mapping[str, pd.DataFrame]:
    """Return the tables of section 5, by the name of their file without `.csv`."""
    found = section_5_findings()
    return {
        **{f"table_5_{n}": table_frame(found, f"Table 5.{n}") for n in range(1, 6)},
        "table_5_6": charts_frame(),
        **problem_frames(found),
        **score_frames(),
        "npl_ladder": ladder_frame(found),
        **figure_tables(),
        "published": findings_frame(found),
        "errata": _errata_frame(errata()),
    }


def physics_frames() -> Mapping[str, pd.DataFrame]:
    """Return the tables of sections 1 to 4, by the name of their file without `.csv`."""
    return {
        "published_physics": findings_frame(physics_findings()),
        "errata_physics": _errata_frame(physics_errata()),
        **physics_figure_tables(),
    }


def all_findings() -> tuple[Finding, ...]:
    """Return every number of the text with what is computed in its place."""
    return (*physics_findings(), *section_5_findings())


def _errata_frame(slips: Iterable[Erratum]) -> pd.DataFrame:
    return frame(slip._asdict() for slip in slips).rename(columns={"class_": "class"})
