"""What is claimed of platforms and versions is what the workflow tries."""

import ast
import re
import tomllib
from typing import Any

import pytest

from places import ROOT

FOLDER = ROOT / ".github/workflows"
TESTS = (FOLDER / "tests.yml").read_text(encoding="utf-8")
SYSTEMS = {
    "macos-latest": "MacOS",
    "ubuntu-latest": "POSIX",
    "windows-latest": "Microsoft :: Windows",
}


def in_matrix(key: str) -> list[str]:
    return re.findall(r"[\w.-]+", re.findall(rf"^ +{key}: \[(.*)\]$", TESTS, re.MULTILINE)[0])


def test_every_version_and_platform_claimed_is_tried() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    claimed = project["classifiers"]
    versions = [one.rpartition(" ")[2] for one in claimed if re.search(r"Python :: 3\.\d+$", one)]
    assert in_matrix("python") == versions
    assert project["requires-python"] == f">={versions[0]}"
    systems = [one for one in claimed if one.startswith("Operating System")]
    assert systems == sorted(f"Operating System :: {SYSTEMS[one]}" for one in in_matrix("system"))


def test_steps_of_the_matrix_are_commands_of_any_shell() -> None:
    steps = re.findall(r"- run: (.*)", TESTS.partition("matrix:")[2].partition("\n\n")[0])
    assert len(steps) == 3
    assert all(re.fullmatch(r'python -m [\w.\- "\[\]]+', step) for step in steps)


def test_nothing_is_published_whose_tests_fail() -> None:
    publish = (FOLDER / "publish.yml").read_text(encoding="utf-8")
    needs = dict(
        re.findall(r"^  (\w+):[^\n]*\n(?:    .*\n)*?    needs: (\w+)$", publish, re.MULTILINE)
    )
    assert needs == {"dist": "tests", "publish": "dist"}
    assert "  tests:\n    uses: ./.github/workflows/tests.yml\n" in publish
    assert "  workflow_call:\n" in TESTS


def test_only_jobs_that_publish_may_ask_for_an_identity() -> None:
    """PyPI asks for one, and so does GitHub Pages."""
    asking = [
        (path.name, job.partition(":")[0].strip())
        for path in sorted(FOLDER.glob("*.yml"))
        for job in re.split(r"^(?=\S|  \w+:)", path.read_text("utf-8"), flags=re.MULTILINE)
        if "id-token" in job
    ]
    assert asking == [("docs.yml", "publish"), ("publish.yml", "publish")]


def test_what_publishes_is_one_version_of_each_action_and_never_a_branch() -> None:
    for path in FOLDER.glob("*.yml"):
        text = path.read_text(encoding="utf-8")
        for action, version in re.findall(r"uses: (\S+)@(\S+)", text):
            own = action.startswith("actions/")  # GitHub's, like the machine that runs them
            assert re.fullmatch(r"v\d+" if own else r"[0-9a-f]{40}", version), (path.name, action)


@pytest.mark.parametrize(
    ("version", "numbers"),
    [("0.2.0", (0, 2, 0, 0)), ("1.0rc1", (1, 0, 0, 0)), ("1.0.0.dev3+local.7", (1, 0, 0, 0)),
     ("2", (2, 0, 0, 0)), ("1.2.3.4.5", (1, 2, 3, 4))],
)  # fmt: skip
def test_the_bundle_takes_every_version(version: str, numbers: tuple[int, ...]) -> None:
    """The file of the bundle runs in PyInstaller alone; of it, what reads the version."""
    tree = ast.parse((ROOT / "packaging" / "evenbreak.spec").read_text(encoding="utf-8"))
    (read,) = (one for one in tree.body if getattr(one, "name", "") == "numbers_of")
    there: dict[str, Any] = {"re": re}
    exec(compile(ast.Module([read], []), "spec", "exec"), there)  # noqa: S102 - our own file
    assert there["numbers_of"](version) == numbers
