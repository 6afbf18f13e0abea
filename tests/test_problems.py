"""The page that leads from the source text's problems to functions says what docstrings say."""

import ast
import importlib
import re
from collections.abc import Iterator
from pathlib import Path

import evenbreak.physics
from places import ROOT

PAGE = ROOT / "reports" / "problems.md"
LAST = {1: 7, 2: 6, 3: 11, 4: 27, 5: 27}
EXERCISES = ["1.1", "1.2", "1.3", "2.1", "2.2", "3.1", "4.1", "5.1"]
PROBLEMS = [f"P{section}.{n}" for section, last in LAST.items() for n in range(1, last + 1)]
PUBLIC = set(evenbreak.physics.__all__)
ROOMS = ("games", "chains", "stats", "matches", "practice", "ratings", "handicaps")
# 'P4.2 to P4.12' says what a whole is about, not where a problem is answered.
RANGE = re.compile(r"P\d\.\d+ to P\d\.\d+")


def documented(body: list[ast.stmt], owner: str = "") -> Iterator[tuple[str, str]]:
    """Yield each public name with its docstring, that of a constant too."""
    for statement, after in zip(body, [*body[1:], None], strict=True):
        if isinstance(statement, ast.FunctionDef | ast.ClassDef):
            if not statement.name.startswith("_"):
                yield owner + statement.name, ast.get_docstring(statement) or ""
            if isinstance(statement, ast.ClassDef):
                yield from documented(statement.body, f"{statement.name}.")
        elif isinstance(statement, ast.Assign | ast.AnnAssign) and isinstance(after, ast.Expr):
            target = statement.targets[0] if isinstance(statement, ast.Assign) else statement.target
            if isinstance(after.value, ast.Constant):
                yield owner + ast.unparse(target), ast.literal_eval(after.value)


def named_in_docstrings(room: str) -> Iterator[tuple[str, str]]:
    """Yield each problem and exercise with each public name whose docstring names it."""
    module = importlib.import_module(f"evenbreak.{room}")
    for path in sorted(Path(str(module.__file__)).parent.rglob("*.py")):
        for name, text in documented(ast.parse(path.read_text(encoding="utf-8")).body):
            if name.split(".")[0] in set(module.__all__):
                for problem in set(re.findall(r"P\d\.\d+", RANGE.sub("", text))):
                    yield problem, name
                for exercise in set(re.findall(r"[Ee]xercise (\d\.\d)", text)):
                    yield f"Exercise {exercise}", name


def rows(section: str = "") -> dict[str, set[str]]:
    """Return the names in each row of the page that begins with a problem or an exercise."""
    cells = re.findall(
        rf"^\| ((?:P|Exercise ){section}\S+) \| [^|]+ \| ([^|]*) \|$",
        PAGE.read_text(encoding="utf-8"),
        re.MULTILINE,
    )
    assert len(dict(cells)) == len(cells)
    return {first: set(re.findall(r"`([^`]+)`", names)) for first, names in cells}


def test_each_problem_and_exercise_has_a_row_in_the_order_of_the_text() -> None:
    listed = list(rows())
    assert [first for first in listed if first.startswith("P")] == PROBLEMS
    assert [first for first in listed if first.startswith("E")] == [
        f"Exercise {n}" for n in EXERCISES
    ]


def test_the_physics_has_the_names_whose_docstrings_name_the_problem() -> None:
    wanted: dict[str, set[str]] = {}
    for problem, name in named_in_docstrings("physics"):
        wanted.setdefault(problem, set()).add(name)
    assert rows("[1-4]") == wanted


def test_section_5_has_at_least_the_names_whose_docstrings_name_the_problem() -> None:
    listed = rows("5")
    for room in ROOMS:
        for problem, name in named_in_docstrings(room):
            if problem in listed:
                assert f"{room}.{name}" in listed[problem], f"add it to {problem} in {PAGE.name}"


def test_every_public_name_of_the_table_side_is_on_the_page() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert PUBLIC - set(re.findall(r"`(\w+)`", page)) == set()


def test_every_name_on_the_page_exists() -> None:
    for first, names in rows().items():
        for name in names:
            here = evenbreak if "5." in first else evenbreak.physics
            for part in name.split("."):
                here = getattr(here, part)
