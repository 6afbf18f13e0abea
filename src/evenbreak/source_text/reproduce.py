"""The source text as files: tables, problems, printed numbers, figures and the page on top."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from evenbreak.files.csv_writer import to_csv
from evenbreak.plots.diagram import image_bytes
from evenbreak.source_text.physics.figure_frames import figure_frames as physics_figure_frames
from evenbreak.source_text.physics.figures import figures as physics_figures
from evenbreak.source_text.physics.frames import published_physics_frame
from evenbreak.source_text.physics.numbers import PhysicsFinding, physics_findings
from evenbreak.source_text.physics.page import physics_page
from evenbreak.source_text.published import errata, physics_errata
from evenbreak.source_text.section5.diagrams import diagrams
from evenbreak.source_text.section5.figures import figures
from evenbreak.source_text.section5.index import index_page
from evenbreak.source_text.section5.numbers import Finding, findings
from evenbreak.source_text.section5.problems import problem_frames, published_frame
from evenbreak.source_text.section5.tables import (
    charts_frame,
    figure_frames,
    ladder_frame,
    score_frames,
    table_frame,
)

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


def reproduction(say: Callable[[str], None] = lambda _: None) -> Mapping[str, bytes]:
    """Return every file by name: the same bytes each time.

    Parameters
    ----------
    say
        is told what is being done.
    """
    say("Computing the tables and problems")
    found = findings()
    frames = section_frames(found)
    table_side = physics_frames()
    files = {
        "index.md": index_page(found, frames).encode(),
        "physics.md": physics_page(physics_findings(), table_side).encode(),
    }
    files |= {f"{name}.csv": to_csv(frame) for name, frame in {**frames, **table_side}.items()}
    drawn = {**figures(), **diagrams(), **physics_figures()}
    say(f"Drawing {len(drawn)} figures")
    for name, figure in drawn.items():
        files |= _images(name, figure())
    return files


def section_frames(found: Iterable[Finding]) -> Mapping[str, pd.DataFrame]:
    """Return every table that is written, by the name of its file without `.csv`."""
    import pandas as pd

    found = list(found)
    return {
        **{f"table_5_{n}": table_frame(found, f"Table 5.{n}") for n in range(1, 6)},
        "table_5_6": charts_frame(),
        **problem_frames(found),
        **score_frames(),
        "npl_ladder": ladder_frame(found),
        **figure_frames(),
        "published": published_frame(found),
        "errata": pd.DataFrame(errata(), dtype=object).rename(columns={"class_": "class"}),
    }


def physics_frames() -> Mapping[str, pd.DataFrame]:
    """Return the tables of sections 1 to 4, by the name of their file without `.csv`."""
    import pandas as pd

    slips = pd.DataFrame(physics_errata(), dtype=object)
    return {
        "published_physics": published_physics_frame(physics_findings()),
        "errata_physics": slips.rename(columns={"class_": "class"}),
        **physics_figure_frames(),
    }


def differing(found: Iterable[Finding | PhysicsFinding]) -> Iterator[str]:
    """Yield a line for each number whose verdict is not the one that is expected.

    >>> list(differing([*physics_findings(), *findings()]))
    []
    """
    for row, computed, verdict in found:
        if verdict != row.verdict:
            number = "nothing" if computed is None else f"{computed:.10g}"
            yield (
                f"{row.problem}: {row.quantity} ({row.inputs}): printed {row.printed}, "
                f"computed {number}: {verdict}, not {row.verdict}"
            )


def _images(name: str, figure: Figure) -> Mapping[str, bytes]:
    return {f"{name}.{kind}": image_bytes(figure, kind) for kind in ("png", "svg")}
