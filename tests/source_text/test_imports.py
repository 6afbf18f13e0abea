"""The source text stands on the public interface: what the rooms export, and a few open modules."""

import ast
import importlib
from pathlib import Path

import pytest

from places import SRC

ROOM = SRC / "source_text"
OPEN = {
    "answers.match.chain": "the road of a chain, as `evenbreak chain` shows it",
    "answers.match.graph": "how near to zero a rounding error is",
    "chains.ways": "the ways to a limit, by name",
    "files.csv_writer": "tables as files",
    "game": "what a game is",
    "handicaps.charts.off_rule": "the rule by which the charts of the text were made",
    "physics.units": "inches, ounces and degrees",
    "plots.contours": "axes of contours",
    "plots.picture": "lines, labels and axes in the look of all figures",
}
"""Modules whose public names may be imported beside those of the rooms, and why."""


@pytest.mark.parametrize("path", sorted(ROOM.rglob("*.py")), ids=lambda path: path.stem)
def test_only_public_names_are_imported(path: Path) -> None:
    private = []
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if not isinstance(node, ast.ImportFrom) or not (node.module or "").startswith("evenbreak"):
            continue
        module = (node.module or "").removeprefix("evenbreak").removeprefix(".")
        if module.startswith("source_text"):
            continue
        names = [alias.name for alias in node.names]
        if module not in OPEN:
            room = importlib.import_module(f"evenbreak.{module}".rstrip("."))
            exported = getattr(room, "__all__", ())
            private += [f"{node.lineno}: {module}.{name}" for name in names if name not in exported]
        private += [f"{node.lineno}: {module}.{name}" for name in names if name.startswith("_")]
    assert private == []
