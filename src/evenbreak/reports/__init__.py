"""From files to results and from results to files: tables in, frames, sheets and figures out.

Only this room and `evenbreak.cli` touch files, plots and the terminal.
"""

from evenbreak._lazy import attach

__getattr__, __dir__, __all__ = attach(
    __name__,
    {
        "draw": ["draw", "image_bytes"],
        "problems": ["Problems"],
        "read_table": ["Table", "read_table"],
    },
)
