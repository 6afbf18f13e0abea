"""Where tests find the checkout's own files, and what may lie beside it."""

import ast
import gc
from collections.abc import Iterable, Iterator
from pathlib import Path

ROOT = next(place for place in Path(__file__).parents if (place / "pyproject.toml").exists())
SRC = ROOT / "src" / "evenbreak"
DATA = ROOT / "data"
DOCS = ROOT / "docs"
SHARED = ROOT.parent / "shared"
"""The source text and a real season; tests that read it skip with a reason where it is absent."""


def trees_of(paths: Iterable[Path]) -> Iterator[ast.Module]:
    """Parse modules one by one; to look for garbage among the nodes would take far longer."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        for path in paths:
            yield ast.parse(path.read_text(encoding="utf-8"))
    finally:
        if was_on:
            gc.enable()
