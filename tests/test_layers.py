"""Imports go one way, files and the terminal are touched only at the end, modules stay short.

The rules are tested twice: on code that breaks them, and on the package, room by room. A failure
lists every place that breaks a rule, as file and line.
"""

import ast
import json
import subprocess
import sys
from collections.abc import Iterator, Sequence
from itertools import groupby
from pathlib import Path

import networkx as nx
import pytest

from places import ROOT, SRC, trees_of

# A layer may import from itself and from every layer before it; rooms in one row know nothing
# of each other.
LAYERS: tuple[tuple[str, ...], ...] = tuple(
    tuple(row.split())
    for row in (
        "words",
        "errors arrays",
        "checks plugins",
        "fields workers",
        "game",
        "games chains stats physics",
        "matches",
        "practice ratings",
        "handicaps.charts",
        "handicaps.systems",
        "handicaps.ladders",
        "handicaps",
        "league",
        "evenings",
        "teams tournaments",
        "files",
        "questions",
        "answers",
        "plots",
        "sheets",
        "site",
        "source_text",
        "cli web",
        "__main__",
    )
)
DEPTH = {room: depth for depth, row in enumerate(LAYERS) for room in row}
FACES_OUTWARD = {
    "files",
    "questions",
    "answers",
    "plots",
    "sheets",
    "site",
    "source_text",
    "cli",
    "web",
    "__main__",
}
OUTWARD_MODULES = {"click", "fileinput", "jinja2", "matplotlib", "pathlib", "rich", "tempfile"}
OUTWARD_CALLS = {"input", "open", "print"}
OUTWARD_STREAMS = {"stdin", "stdout", "stderr"}
LONGEST_MODULE = 500


def room_of(parts: Sequence[str]) -> str:
    """Return the room of a module that is named by its parts, 'evenbreak' left out."""
    inner = ".".join(parts[:2])
    return inner if inner in DEPTH else parts[0]


def module_of(path: Path) -> tuple[str, ...]:
    """Return the parts of a module's name, 'evenbreak' left out."""
    return path.relative_to(SRC).with_suffix("").parts


# The package's own __init__ names every layer, lazily.
MODULES = sorted(path for path in SRC.rglob("*.py") if path != SRC / "__init__.py")
ROOMS = {
    room: list(paths)
    for room, paths in groupby(
        sorted(MODULES, key=lambda path: room_of(module_of(path))),
        key=lambda path: room_of(module_of(path)),
    )
}


def statements(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield all statements, the inner ones too."""
    todo = [tree]
    while todo:
        node = todo.pop()
        yield node
        for name in ("body", "orelse", "handlers", "finalbody", "cases"):
            inner = getattr(node, name, None)
            todo += inner if isinstance(inner, list) else ()


def own_imports(tree: ast.AST, package: tuple[str, ...]) -> Iterator[tuple[int, str]]:
    """Yield line and room for every import from the package itself; `package` resolves dots."""
    for node in statements(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                parts = alias.name.split(".")
                if parts[0] == "evenbreak":
                    yield node.lineno, room_of(parts[1:] or ["evenbreak itself"])
        elif isinstance(node, ast.ImportFrom):
            base = list(package[: len(package) + 1 - node.level]) if node.level else []
            base += node.module.split(".") if node.module else []
            if base[:1] == ["evenbreak"]:
                for alias in node.names:
                    if alias.name != "__version__":
                        yield node.lineno, room_of([*base[1:], alias.name])


def broken_directions(tree: ast.Module, room: str, package: tuple[str, ...]) -> list[str]:
    """List the imports of a module in `room` that do not point to an earlier layer."""
    problems = {}
    for line, target in own_imports(tree, package):
        if target not in DEPTH:
            problems[f"{line}: {target} is not a layer; import from the module itself"] = None
        elif target != room and DEPTH[target] >= DEPTH[room]:
            problems[f"{line}: {room} must not import {target}"] = None
    return list(problems)


def outward_uses(tree: ast.Module) -> list[str]:
    """List where a module uses files, plots or the terminal."""
    problems = []
    for node in ast.walk(tree):
        names: list[str] = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            names = [node.module or ""]
        problems += [
            f"{node.lineno}: imports {name}"
            for name in names
            if name.split(".")[0] in OUTWARD_MODULES
        ]
        match node:
            case ast.Call(func=ast.Name(id=name)) if name in OUTWARD_CALLS:
                problems.append(f"{node.lineno}: calls {name}")
            case ast.Attribute(value=ast.Name(id="sys"), attr=name) if name in OUTWARD_STREAMS:
                problems.append(f"{node.lineno}: uses sys.{name}")
    return problems


def test_every_room_is_a_layer() -> None:
    assert set(ROOMS) == set(DEPTH)


@pytest.mark.parametrize("room", ROOMS)
def test_imports_point_to_earlier_layers(room: str) -> None:
    assert [
        f"{path.relative_to(ROOT)}:{problem}"
        for path, tree in zip(ROOMS[room], trees_of(ROOMS[room]), strict=True)
        for problem in broken_directions(tree, room, ("evenbreak", *module_of(path)[:-1]))
    ] == []


@pytest.mark.parametrize("room", sorted({*ROOMS} - FACES_OUTWARD))
def test_only_the_last_rooms_touch_files_and_the_terminal(room: str) -> None:
    assert [
        f"{path.relative_to(ROOT)}:{problem}"
        for path, tree in zip(ROOMS[room], trees_of(ROOMS[room]), strict=True)
        for problem in outward_uses(tree)
    ] == []


def imports_between(modules: dict[str, ast.Module]) -> nx.DiGraph:
    """Return who imports whom: within functions too, and for type checking alone."""
    arrows = nx.DiGraph()
    for name, tree in modules.items():
        for node in statements(tree):
            if isinstance(node, ast.Import):
                arrows.add_edges_from((name, alias.name) for alias in node.names)
            elif isinstance(node, ast.ImportFrom) and node.module:
                inner = (f"{node.module}.{alias.name}" for alias in node.names)
                arrows.add_edges_from(
                    (name, target if target in modules else node.module) for target in inner
                )
    return arrows


def circles(modules: dict[str, ast.Module]) -> list[list[str]]:
    """List the modules that import each other, those of a circle together."""
    components = nx.strongly_connected_components(imports_between(modules))
    return sorted(sorted(circle) for circle in components if len(circle) > 1)


def test_no_modules_import_each_other() -> None:
    names = [
        ".".join(("evenbreak", *module_of(path))).removesuffix(".__init__") for path in MODULES
    ]
    imports = [
        ast.Module(
            [one for one in statements(tree) if isinstance(one, ast.Import | ast.ImportFrom)], []
        )
        for tree in trees_of(MODULES)
    ]
    assert circles(dict(zip(names, imports, strict=True))) == []


def test_the_checker_sees_a_circle() -> None:
    modules = {"a": ast.parse("import b"), "b": ast.parse("def f():\n    from a import x")}
    assert circles(modules) == [["a", "b"]]
    modules["b"] = ast.parse("if TYPE_CHECKING:\n    from a import x")
    assert circles(modules) == [["a", "b"]]
    modules["b"] = ast.parse("import c")
    assert circles(modules) == []


@pytest.mark.parametrize("room", ROOMS)
def test_modules_are_short(room: str) -> None:
    lengths = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in ROOMS[room]}
    assert [
        f"{path.relative_to(ROOT)}: {length} lines, at most {LONGEST_MODULE} are allowed"
        for path, length in lengths.items()
        if length > LONGEST_MODULE
    ] == []


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
        ("handicaps.charts", "from evenbreak.handicaps.systems.elo import elo_system"),
        ("handicaps.systems", "from evenbreak.handicaps import Ladder"),
    ],
)
def test_the_checker_sees_a_wrong_direction(room: str, source: str) -> None:
    assert len(broken_directions(ast.parse(source), room, ("evenbreak", *room.split(".")))) == 1


@pytest.mark.parametrize(
    ("room", "source"),
    [
        ("games", "from evenbreak.games.race import Race\nfrom .race import Race"),
        ("cli", "from evenbreak.files import to_csv\nfrom evenbreak import errors, __version__"),
        ("matches", "from ..chains import Chain\nfrom evenbreak.games import Race\nimport numpy"),
        ("games", "import networkx.exception\nfrom games import evenbreak"),
        ("handicaps.systems", "from evenbreak.handicaps.charts.chart import Chart"),
        ("handicaps.ladders", "from evenbreak.handicaps import systems\nfrom .form import x"),
    ],
)
def test_the_checker_lets_the_right_direction_pass(room: str, source: str) -> None:
    assert broken_directions(ast.parse(source), room, ("evenbreak", *room.split("."))) == []


def test_a_wrong_import_is_named_by_its_line() -> None:
    source = "import numpy\n\nfrom evenbreak.cli import main, program\n"
    assert broken_directions(ast.parse(source), "files", ("evenbreak", "files")) == [
        "3: files must not import cli"
    ]


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
def test_the_checker_sees_files_and_the_terminal(source: str) -> None:
    assert len(outward_uses(ast.parse(source))) == 1


@pytest.mark.parametrize("source", ["import io", "table.print()", "sys.maxsize", "opening = 1"])
def test_the_checker_lets_the_rest_pass(source: str) -> None:
    assert outward_uses(ast.parse(source)) == []


def modules_loaded_by(statement: str) -> set[str]:
    """Run a statement in a fresh interpreter and return the modules it loaded."""
    code = f"import json, sys\n{statement}\nprint(json.dumps(sorted(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    return set(json.loads(done.stdout))


def test_the_terminal_needs_no_catalog() -> None:
    words = ["evenbreak", "odds", "612", "521", "--scale", "fargo", "--race", "x"]
    ask = f"import contextlib, sys; from evenbreak.cli import main; sys.argv = {words}"
    assert "babel" not in modules_loaded_by(f"{ask}\nwith contextlib.suppress(SystemExit): main()")


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
    heavy = {"numpy", "scipy", "pandas", "networkx", "matplotlib", "sympy", "babel"}
    assert modules_loaded_by(statement) & heavy == set()


@pytest.mark.slow
def test_the_page_starts_without_what_only_leagues_need() -> None:
    heavy = {"pandas", "networkx", "matplotlib", "scipy.optimize", "scipy.stats"}
    assert modules_loaded_by("import evenbreak.web.app") & heavy == set()
