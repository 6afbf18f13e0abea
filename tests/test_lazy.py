"""Public names load late, and mean the same whatever was imported before."""

import ast
import importlib
import subprocess
import sys
from types import ModuleType

import pytest

import evenbreak
from evenbreak import plots
from places import SRC

STUBS = sorted(SRC.rglob("__init__.pyi"))


@pytest.mark.slow
@pytest.mark.parametrize("first", ["evenbreak.ratings.fit", "evenbreak.ratings"])
def test_a_function_wins_over_the_module_of_its_name(first: str) -> None:
    code = f"import {first}\nfrom evenbreak.ratings import fit\nprint(callable(fit))"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout == "True\n"


def test_unknown_names_are_refused_by_name() -> None:
    with pytest.raises(AttributeError, match="nothing"):
        plots.nothing  # noqa: B018


def test_dir_lists_rooms_and_names() -> None:
    assert {"Race", "chains"} <= set(dir(evenbreak))
    assert evenbreak.chains is importlib.import_module("evenbreak.chains")


@pytest.mark.parametrize("stub", STUBS, ids=lambda stub: stub.parent.name)
def test_every_name_of_a_stub_is_there(stub) -> None:
    package = importlib.import_module(".".join(("evenbreak", *stub.parent.relative_to(SRC).parts)))
    for node in ast.parse(stub.read_text(encoding="utf-8")).body:
        names = node.names if isinstance(node, ast.ImportFrom) else []
        for alias in names:
            found = getattr(package, alias.name)
            assert isinstance(found, ModuleType) == (node.module is None)
            assert alias.asname == alias.name, "a type checker re-exports only `x as x`"
