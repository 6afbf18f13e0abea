"""A page as a Git host shows it: GitHub-flavored Markdown, and what a reader then meets."""

import re
from dataclasses import dataclass, field
from functools import cache
from html.parser import HTMLParser
from pathlib import Path

from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin

GFM = MarkdownIt("gfm-like", {"linkify": False}).use(dollarmath_plugin)
LEFT_OVER = re.compile(
    r":::"  # a container
    r"|\{[a-z:-]+\}(?=\0)"  # a role, before its code
    r"|^ *\([\w-]+\)= *$"  # a target
    r"|^: "  # a definition
    r"|\{#[\w-]+\}"  # attributes
    r"|^(?:orphan|file_format|kernelspec):",  # metadata
    re.MULTILINE,
)
"""What only Sphinx understands, where it stands in the text of a rendered page."""


@dataclass
class Seen(HTMLParser):
    """What is on a rendered page."""

    leads_to: list[str] = field(default_factory=list)
    anchors: set[str] = field(default_factory=set)
    text: str = ""
    """All that is read, each piece of code as one null."""

    fences: list[str] = field(default_factory=list)
    listed: dict[str, str] = field(default_factory=dict)
    """The links at the start of items of lists and of rows of tables, with what follows them."""

    def __post_init__(self) -> None:
        super().__init__()
        self._heading: str | None = None
        self._item: str | None = None
        self._code = False

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        has = {name: value or "" for name, value in attrs}
        self.leads_to += [has[name] for name in ("href", "src") if name in has]
        self.anchors |= {has[name] for name in ("id", "name") if name in has}
        if tag == "code":
            self._code = True
            if has.get("class", "").startswith("language-{"):
                self.fences.append(has["class"])
        elif re.fullmatch(r"h[1-6]", tag):
            self._heading = ""
        elif tag in {"li", "tr"}:
            self._item = ""
        elif tag == "a" and self._item == "":
            self._item = has.get("href", "")
            self.listed[self._item] = ""

    def handle_endtag(self, tag: str) -> None:
        if tag == "code":
            self._code = False
            self.text += "\0"
        elif tag in {"li", "tr"}:
            self._item = None
        elif self._heading is not None and re.fullmatch(r"h[1-6]", tag):
            slug = re.sub(r"[^\w\- ]", "", self._heading.lower()).replace(" ", "-")
            free = (name for k in range(99) if (name := f"{slug}-{k}" if k else slug))
            self.anchors.add(next(name for name in free if name not in self.anchors))
            self._heading = None

    def handle_data(self, data: str) -> None:
        if self._heading is not None:
            self._heading += data
        if self._item:
            self.listed[self._item] += data
        if not self._code:
            self.text += data

    @property
    def left_over(self) -> list[str]:
        """Return the marks that only Sphinx understands."""
        return self.fences + LEFT_OVER.findall(self.text)


def seen_in(text: str) -> Seen:
    """Return what a reader of a text meets."""
    seen = Seen()
    seen.feed(GFM.render(text))
    seen.close()
    return seen


@cache
def seen_on(page: Path) -> Seen:
    """Return what a reader of a page meets."""
    return seen_in(page.read_text("utf-8"))


def broken_links(page: Path, seen: Seen, root: Path) -> list[str]:
    """List the links and pictures that lead nowhere, read in the place of a page."""
    broken = []
    for target in seen.leads_to:
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        file = (page.parent / name).resolve() if name else page
        if not file.exists() or not file.is_relative_to(root):
            broken.append(target)
        elif anchor and file.suffix == ".md":
            there = seen_on(file) if name else seen
            broken += [target] if anchor not in there.anchors else []
    return broken
