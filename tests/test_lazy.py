"""Public names load late, and mean the same whatever was imported before."""

import ast
import importlib
import subprocess
import sys
from pathlib import Path

import pytest

import evenbreak
from evenbreak import reports

PACKAGE = Path(evenbreak.__file__).parent


@pytest.mark.parametrize("first", ["evenbreak.reports.draw", "evenbreak.reports"])
def test_a_function_wins_over_the_module_of_its_name(first: str) -> None:
    code = f"import {first}\nfrom evenbreak.reports import draw\nprint(callable(draw))"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout == "True\n"


def test_unknown_names_are_refused_by_name() -> None:
    with pytest.raises(AttributeError, match=r"'evenbreak\.reports' has no attribute 'nothing'"):
        reports.nothing  # noqa: B018


def test_dir_lists_the_public_names() -> None:
    assert "Race" in dir(evenbreak)
    assert dir(evenbreak) == sorted(evenbreak.__all__)


@pytest.mark.parametrize("stub", sorted(PACKAGE.rglob("__init__.pyi")), ids=lambda s: s.parent.name)
def test_stub_and_package_export_the_same(stub: Path) -> None:
    name = ".".join(("evenbreak", *stub.parent.relative_to(PACKAGE).parts))
    package = importlib.import_module(name)
    homes = {}
    for node in ast.parse(stub.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ImportFrom):
            homes |= {alias.asname: node.module for alias in node.names}
    assert sorted(homes) == package.__all__
    for public, module in homes.items():
        assert getattr(package, public) is getattr(importlib.import_module(module), public)


def test_every_package_that_exports_has_a_stub() -> None:
    lazy = {p.parent for p in PACKAGE.rglob("__init__.py") if "attach(" in p.read_text("utf-8")}
    assert lazy == {stub.parent for stub in PACKAGE.rglob("__init__.pyi")}
