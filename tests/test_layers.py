"""Imports go one way only, files and the terminal are touched only at the end, modules stay short.

The rules are tested twice: on sentences that break them, and on the package.
"""

import ast
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from places import SRC

# A layer may import from itself and from every layer before it; rooms in one row know nothing
# of each other.
LAYERS: tuple[frozenset[str], ...] = tuple(
    frozenset(row.split())
    for row in (
        "errors",
        "checks",
        "game",
        "games chains stats physics",
        "matches",
        "practice ratings",
        "handicaps",
        "league",
        "files",
        "answers",
        "plots",
        "sheets",
        "source_text",
        "cli",
        "__main__",
    )
)
DEPTH = {room: depth for depth, row in enumerate(LAYERS) for room in row}
FACES_OUTWARD = {"files", "answers", "plots", "sheets", "source_text", "cli", "__main__"}
OUTWARD_MODULES = {"click", "fileinput", "jinja2", "matplotlib", "pathlib", "rich", "tempfile"}
OUTWARD_CALLS = {"input", "open", "print"}
OUTWARD_STREAMS = {"stdin", "stdout", "stderr"}
LONGEST_MODULE = 400

MODULES = sorted(SRC.rglob("*.py"))
LAYERED = [path for path in MODULES if path != SRC / "__init__.py"]


def room_of(path: Path) -> str:
    """Return the top-level name that a module belongs to."""
    return path.relative_to(SRC).parts[0].removesuffix(".py")


def own_imports(tree: ast.AST, package: tuple[str, ...]) -> Iterator[tuple[int, str]]:
    """Yield line and room for every import from the package itself; `package` resolves dots."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                parts = alias.name.split(".")
                if parts[0] == "evenbreak":
                    yield node.lineno, parts[1] if len(parts) > 1 else "evenbreak itself"
        elif isinstance(node, ast.ImportFrom):
            base = list(package[: len(package) + 1 - node.level]) if node.level else []
            base += node.module.split(".") if node.module else []
            if base[:1] != ["evenbreak"]:
                continue
            if len(base) > 1:
                yield node.lineno, base[1]
            else:
                names = (alias.name for alias in node.names if alias.name != "__version__")
                yield from ((node.lineno, name) for name in names)


def broken_directions(source: str, room: str, package: tuple[str, ...]) -> list[str]:
    """List the imports of a module in `room` that do not point to an earlier layer."""
    problems = []
    for line, target in own_imports(ast.parse(source), package):
        if target not in DEPTH:
            problems.append(f"line {line}: {target} is no layer; import from the module itself")
        elif target != room and DEPTH[target] >= DEPTH[room]:
            problems.append(f"line {line}: {room} must not import {target}")
    return problems


def outward_uses(source: str) -> list[str]:
    """List where a module uses files, plots or the terminal."""
    problems = []
    for node in ast.walk(ast.parse(source)):
        names: list[str] = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            names = [node.module or ""]
        problems += [
            f"line {node.lineno}: imports {name}"
            for name in names
            if name.split(".")[0] in OUTWARD_MODULES
        ]
        match node:
            case ast.Call(func=ast.Name(id=name)) if name in OUTWARD_CALLS:
                problems.append(f"line {node.lineno}: calls {name}")
            case ast.Attribute(value=ast.Name(id="sys"), attr=name) if name in OUTWARD_STREAMS:
                problems.append(f"line {node.lineno}: uses sys.{name}")
    return problems


# The package's own __init__ names every layer, lazily.
@pytest.mark.parametrize("path", LAYERED, ids=lambda path: str(path.relative_to(SRC)))
def test_imports_point_to_earlier_layers(path: Path) -> None:
    room = room_of(path)
    package = ("evenbreak", *path.relative_to(SRC).parts[:-1])
    assert broken_directions(path.read_text(encoding="utf-8"), room, package) == []


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(SRC)))
def test_only_reports_and_cli_touch_the_world(path: Path) -> None:
    if room_of(path) not in FACES_OUTWARD:
        assert outward_uses(path.read_text(encoding="utf-8")) == []


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(SRC)))
def test_modules_are_short(path: Path) -> None:
    assert len(path.read_text(encoding="utf-8").splitlines()) <= LONGEST_MODULE


@pytest.mark.parametrize(
    ("room", "source"),
    [
        ("games", "from evenbreak.chains import Chain"),
        ("chains", "import evenbreak.games.race"),
        ("stats", "from ..physics import units"),
        ("matches", "def f():\n    from evenbreak.ratings.scale import Scale"),
        ("ratings", "if TYPE_CHECKING:\n    from evenbreak.practice import drills"),
        ("handicaps", "from evenbreak import league"),
        ("game", "from evenbreak import Race"),
        ("game", "import evenbreak"),
        ("errors", "from evenbreak import checks"),
        ("sheets", "from evenbreak.cli import main"),
        ("matches", "from evenbreak.nowhere import thing"),
    ],
)
def test_checker_sees_a_wrong_direction(room: str, source: str) -> None:
    assert len(broken_directions(source, room, ("evenbreak", room))) == 1


@pytest.mark.parametrize(
    ("room", "source"),
    [
        ("games", "from evenbreak.games.race import Race\nfrom .race import Race"),
        ("cli", "from evenbreak.files import to_csv\nfrom evenbreak import errors, __version__"),
        ("matches", "from ..chains import Chain\nfrom evenbreak.games import Race\nimport numpy"),
        ("games", "import networkx.exception\nfrom games import evenbreak"),
    ],
)
def test_checker_lets_the_right_direction_pass(room: str, source: str) -> None:
    assert broken_directions(source, room, ("evenbreak", room)) == []


@pytest.mark.parametrize(
    "source",
    [
        "import pathlib",
        "from pathlib import Path",
        "def f():\n    from matplotlib.figure import Figure",
        "import rich.table",
        "print(1)",
        "with open('x') as file: pass",
        "sys.stderr.write('x')",
    ],
)
def test_checker_sees_the_world(source: str) -> None:
    assert len(outward_uses(source)) == 1


@pytest.mark.parametrize("source", ["import io", "table.print()", "sys.maxsize", "opening = 1"])
def test_checker_lets_the_rest_pass(source: str) -> None:
    assert outward_uses(source) == []


def modules_loaded_by(statement: str) -> set[str]:
    """Run a statement in a fresh interpreter and return the top-level names it loaded."""
    code = f"import json, sys\n{statement}\nprint(json.dumps(sorted(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    return {name.split(".")[0] for name in json.loads(done.stdout)}


@pytest.mark.parametrize(
    "statement",
    [
        "import evenbreak",
        "import evenbreak.errors, evenbreak.checks, evenbreak.game",
        "import evenbreak.games",
        "from evenbreak.games import Race",
        "import evenbreak.chains, evenbreak.matches, evenbreak.ratings, evenbreak.handicaps",
        "import evenbreak.files",
        "import evenbreak.cli",
        "import evenbreak.ratings.scale, evenbreak.handicaps.charts.fair",
    ],
)
def test_starting_up_loads_nothing_heavy(statement: str) -> None:
    heavy = {"numpy", "scipy", "pandas", "networkx", "matplotlib", "sympy"}
    assert modules_loaded_by(statement) & heavy == set()
