"""The numbers of sections 1 to 4 as a table: printed, computed and what is said of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from evenbreak.source_text.physics.numbers import PhysicsFinding
from evenbreak.source_text.section5.numbers import deciding_tolerance
from evenbreak.source_text.section5.problems import COLUMNS
from evenbreak.source_text.section5.rows import difference_cell, number_cell

if TYPE_CHECKING:
    import pandas as pd


def published_physics_frame(found: Iterable[PhysicsFinding]) -> pd.DataFrame:
    """Return every number of sections 1 to 4, with the one that is computed and the verdict."""
    import pandas as pd

    return pd.DataFrame(list(map(_row, found)), columns=list(COLUMNS), dtype=object)


def _row(finding: PhysicsFinding) -> tuple[Any, ...]:
    published, computed = finding.published, finding.computed
    printed = published.printed
    both = printed is not None and computed is not None
    return (
        published.problem,
        published.quantity,
        published.inputs,
        printed,
        None if computed is None else number_cell(computed),
        difference_cell(computed, printed) if both else None,  # type: ignore[arg-type]
        number_cell(deciding_tolerance(published)),
        finding.verdict,
        published.note,
    )
