"""The page of the tries says which classes there are, where, and how many tries each has."""

import re

from places import ROOT

TESTS = ROOT / "tests"
USED = re.compile(r'\btries\(\s*"([^"]+)",\s*(\d+)')
ROW = re.compile(r"^\| ([^|]+) \| [^|]+ \| `(.+?)` \| (\d+) \|", re.MULTILINE)


def test_each_class_is_on_the_page() -> None:
    used = {
        (name, str(path.relative_to(TESTS)), count)
        for path in TESTS.rglob("test_*.py")
        for name, count in USED.findall(path.read_text("utf-8"))
    }
    rows = ROW.findall((TESTS / "tries.md").read_text("utf-8"))
    assert sorted(rows) == sorted(used)
