"""Who comes to the repository on a Git host finds the way: short, with links that work there."""

import re
import runpy
from pathlib import Path

import pytest

from git_host import GFM, broken_links, seen_in, seen_on
from places import ROOT
from rows import each_of
from test_docs import PAGES, name_of

DOCS = ROOT / "docs"
BUILD = runpy.run_path(str(ROOT / "hatch_build.py"))
SHOWN = [
    *PAGES,
    ROOT / "CHANGELOG.md",
    ROOT / "benchmarks" / "README.md",
    *sorted((ROOT / "reports").glob("*.md")),
]
INDEXES = [page for page in PAGES if page.name == "index.md" and page.parent != DOCS]


def test_the_readme_is_short() -> None:
    assert len((ROOT / "README.md").read_text("utf-8").split()) <= 900


@pytest.mark.slow
@each_of("page", SHOWN)
def test_links_and_pictures_lead_somewhere_on_a_git_host(page: Path) -> None:
    assert broken_links(page, seen_on(page), ROOT) == []


@each_of("page", SHOWN)
def test_pages_have_no_marks_that_a_git_host_prints(page: Path) -> None:
    assert seen_on(page).left_over == []


@pytest.mark.parametrize("index", INDEXES, ids=name_of)
def test_every_page_of_a_folder_has_a_link_and_a_line_in_its_index(index: Path) -> None:
    pages = {page.name for page in index.parent.glob("*.md")} - {"index.md"}
    pages |= {f"{inner.parent.name}/index.md" for inner in index.parent.glob("*/index.md")}
    listed = {link: line for link, line in seen_on(index).listed.items() if "://" not in link}
    # Contributors come to the decisions by CONTRIBUTING.md.
    assert set(listed) == pages - {"decisions/index.md"}
    assert [link for link, line in listed.items() if len(line.split()) < 3] == []


def test_what_a_git_host_would_not_find_is_seen() -> None:
    text = (
        "# One `x.csv`: it's\n[a](nowhere.md) [b](#one-xcsv-its) [c](#none) [d](README.md#set-up)"
        '\n<img src="gone.png">\n```\n[e](code.md)\n```\n`[f](code.md)` [g](https://example.org)'
    )
    broken = broken_links(ROOT / "README.md", seen_in(text), ROOT)
    assert broken == ["nowhere.md", "#none", "gone.png"]


@each_of(
    "mark",
    [
        ":::{container} doors\n:::",
        "a {term}`bye`",
        "```{toctree}\nx\n```",
        "    :::\n\n- a\n\n  ```{math}\n  x\n  ```",
        "(here)=\n\n# Here",
        "bye\n: an empty line",
        "---\nfile_format: mystnb\n---",
    ],
)
def test_marks_of_sphinx_are_seen(mark: str) -> None:
    assert seen_in(mark).left_over


def test_what_a_git_host_shows_as_it_should_is_not_taken_for_a_mark() -> None:
    text = (
        "a `bye`: {x}, `{term}`, $p_{1}$\n\n<!--\n```{toctree}\nx\n```\n-->\n\n```console\n:::\n```"
    )
    assert seen_in(text).left_over == []


def test_the_readme_of_the_package_leads_to_the_repository_or_nowhere() -> None:
    readme = (ROOT / "README.md").read_text("utf-8")
    where = BUILD["repository"]({"GITHUB_REPOSITORY": "pool/evenbreak"})
    abroad = seen_in(BUILD["for_an_index"](readme, where, "v1.0.0"))
    at_home = [link for link in seen_on(ROOT / "README.md").leads_to if not link.startswith("#")]
    there = [
        re.sub(r"^https://github.com/pool/evenbreak/(blob|raw)/v1.0.0/", "", link)
        for link in abroad.leads_to
        if not link.startswith("#")
    ]
    assert there == at_home
    assert all(link.startswith((where, "#")) for link in abroad.leads_to)
    assert f'src="{where}/raw/v1.0.0/docs/images/front_page.png"' in GFM.render(
        BUILD["for_an_index"](readme, where, "v1.0.0")
    )
    unknown = seen_in(BUILD["for_an_index"](readme, BUILD["repository"]({}), "v1.0.0"))
    assert [link for link in unknown.leads_to if not link.startswith("#")] == []
