"""Who comes to the repository on a Git host finds the way: short, with links that work there."""

import re
from functools import cache
from pathlib import Path

import pytest

from places import ROOT
from rows import each_of
from test_docs import FENCE, PAGES

DOCS = ROOT / "docs"
INDEXES = [page for page in PAGES if page.name == "index.md" and page.parent.parent == DOCS]
FRONT = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md")),
    DOCS / "index.md",
    *(page for page in INDEXES if page.parent.name not in {"tutorial", "how-to"}),
    *(page for page in PAGES if page.parent.name in {"tutorial", "how-to"}),
    DOCS / "gallery.md",
    DOCS / "explanation" / "how-it-compares.md",
]
SPHINX_ONLY = re.compile(
    r"^ *:::|^ *```\{(?!(?:literal)?include\})|^\(.*\)=$|\{[a-z:]+\}`", re.MULTILINE
)
"""What only Sphinx understands: containers, directives, targets and roles.

A table may be included where the page names its file, and code where the page links to it.
"""

TARGET = re.compile(r"""(?:\]\(|(?:href|src)=")([^)"\s]+)[)"]""")
HEADING = re.compile(r"^#{1,6} +(.+?) *#*$", re.MULTILINE)
CODE = re.compile(r"`[^`]*`")


def name_of(page: Path) -> str:
    return str(page.relative_to(ROOT))


def without_blocks(text: str) -> str:
    return FENCE.sub("", text)


@cache
def anchors(page: Path) -> set[str]:
    """Return the anchors that a Git host gives a page: its headings, without marks, hyphenated."""
    found: dict[str, None] = {}
    for heading in HEADING.findall(without_blocks(page.read_text("utf-8"))):
        words = re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", heading)
        slug = re.sub(r"[^\w\- ]", "", re.sub(r"[*`]", "", words).lower()).replace(" ", "-")
        again = (name for k in range(99) if (name := f"{slug}-{k}" if k else slug) not in found)
        found[next(again)] = None
    return {*found}


def broken_links(page: Path, text: str) -> list[str]:
    """List the targets of a text that a Git host would not find, read in the place of a page."""
    broken = []
    for target in TARGET.findall(CODE.sub("`", without_blocks(text))):
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        file = (page.parent / name).resolve() if name else page
        lost = anchor and file.suffix == ".md" and file.exists() and anchor not in anchors(file)
        if not file.exists() or not file.is_relative_to(ROOT) or lost:
            broken.append(target)
    return broken


def test_the_readme_is_short() -> None:
    assert len((ROOT / "README.md").read_text("utf-8").split()) <= 900


@each_of("page", dict.fromkeys([*FRONT, *PAGES]))
def test_links_lead_somewhere_on_a_git_host(page: Path) -> None:
    assert broken_links(page, page.read_text("utf-8")) == []


@each_of("page", FRONT)
def test_the_front_pages_have_no_marks_that_a_git_host_prints(page: Path) -> None:
    text = page.read_text("utf-8")
    assert SPHINX_ONLY.findall(text) == []
    included = re.findall(r"^ *```\{literalinclude\} (\S+)$", text, re.MULTILINE)
    assert [name for name in included if f"]({name})" not in text] == []


@pytest.mark.parametrize("index", INDEXES, ids=name_of)
def test_every_page_of_a_room_has_a_link_and_a_line_in_its_index(index: Path) -> None:
    listed = dict(re.findall(r"^- \[[^]]+\]\(([^)#]+)\): (.+)", index.read_text("utf-8"), re.M))
    pages = {page.name for page in index.parent.glob("*.md")} - {"index.md"}
    pages |= {f"{inner.parent.name}/index.md" for inner in index.parent.glob("*/index.md")}
    assert set(listed) == pages


def test_what_a_git_host_would_not_find_is_seen() -> None:
    text = (
        "# One `x.csv`: it's\n[a](nowhere.md) [b](#one-xcsv-its) [c](#none) [d](README.md#set-up)"
        '\n<img src="gone.png">\n```\n[e](code.md)\n```\n`[f](code.md)` [g](https://example.org)'
    )
    page = ROOT / "README.md"
    assert broken_links(page, text) == ["nowhere.md", "#one-xcsv-its", "#none", "gone.png"]
    assert SPHINX_ONLY.search(":::{container} doors")
    assert SPHINX_ONLY.search("a {term}`bye`")
    assert not SPHINX_ONLY.search("a `bye` and ```console")
