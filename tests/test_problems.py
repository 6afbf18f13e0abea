"""The page that leads from the source text's problems to functions says what docstrings say."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import evenbreak.physics
from places import ROOT

PAGE = ROOT / "docs" / "reference" / "problems.md"
PROBLEMS = [
    f"P{section}.{number}"
    for section, last in {1: 7, 2: 6, 3: 11, 4: 27}.items()
    for number in range(1, last + 1)
]
PUBLIC = set(evenbreak.physics.__all__)
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
            yield owner + ast.unparse(target), ast.literal_eval(after.value)


def named_in_docstrings() -> dict[str, list[str]]:
    """Return the public names whose docstrings name a problem, for each problem."""
    found: dict[str, list[str]] = {problem: [] for problem in PROBLEMS}
    for path in sorted(Path(evenbreak.physics.__file__).parent.glob("*.py")):
        for name, text in documented(ast.parse(path.read_text(encoding="utf-8")).body):
            if name.split(".")[0] in PUBLIC:
                for problem in set(re.findall(r"P\d\.\d+", RANGE.sub("", text))):
                    found[problem].append(name)
    return found


def rows() -> list[tuple[str, list[str]]]:
    cells = re.findall(
        r"^\| ([P\d.–]+) \| [^|]+ \| ([^|]*) \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE
    )
    return [(first, re.findall(r"`([^`]+)`", names)) for first, names in cells]


def test_each_problem_has_a_row_with_the_names_whose_docstrings_name_it() -> None:
    listed = [(first, names) for first, names in rows() if first.startswith("P")]
    assert [problem for problem, _ in listed] == PROBLEMS
    wanted = named_in_docstrings()
    assert {problem: sorted(names) for problem, names in listed} == {
        problem: sorted(names) for problem, names in wanted.items()
    }
    assert all(wanted.values())


def test_every_public_name_of_the_table_side_is_on_the_page() -> None:
    assert {name for _, names in rows() for name in names if "." not in name} == PUBLIC


def test_names_with_a_dot_are_members() -> None:
    for _, names in rows():
        for name in names:
            owner, *member = name.split(".")
            assert not member or hasattr(getattr(evenbreak.physics, owner), member[0]), name
