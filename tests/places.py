"""Where tests find the checkout's own files, and what may lie beside it."""

from pathlib import Path

ROOT = next(place for place in Path(__file__).parents if (place / "pyproject.toml").exists())
SRC = ROOT / "src" / "evenbreak"
DATA = ROOT / "data"
DOCS = ROOT / "docs"
SHARED = ROOT.parent / "shared"
"""The source text and a real season; tests that read it skip with a reason where it is absent."""
