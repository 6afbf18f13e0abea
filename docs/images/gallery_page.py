"""The gallery's page: a card for each picture, with what made it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import PurePath

from shown import SHOWN, Shown

WIDTH, WIDE = 42, 84
"""Characters of a line of code on a card, and on a wide one."""

HEAD = """\
# Gallery

Every chart evenbreak draws, and how to draw it; click one for its page. Commands write PNG or SVG;
in a notebook, charts display themselves. The sample data is in the folder `data/`.
"""

PAGE = (
    (
        "front_page",
        "On the wall and on every phone",
        "Scores, chances, finish time.",
    ),
    (
        "page/call",
        "Call the next matches",
        "The director's phone: which table is free, who goes there.",
    ),
    ("page/match", "Keep your own score", "A player's phone: tap for a game, see your chance."),
)
"""Pictures of the page, which `page_pictures.py` makes: file, title, words. The first is wide."""

PAPER = """\
## Pages and paper

| What | Command |
|---|---|
| the evening live, on phones and the wall | [`evenbreak serve`](how-to/a-page-for-phones-and-the-screen.md) |
| the bracket as a page, or on paper | `evenbreak tournament show --out bracket.html`, or `bracket.pdf` |
| score cards, the bracket, the draw | `evenbreak tournament print cards`, `bracket` or `draw` |
| the sheet for [phones and printers](how-to/publish-your-league.md) | `evenbreak report data/demo_league.csv --out sheet --page` |
| any answer as a web page | `evenbreak odds 612 521 --scale fargo --race 7:7 --html odds.html` |

PDFs are US Letter or A4, depending on your computer's region; to choose, add `--paper letter` or
`--paper a4`.

## The book's figures

`evenbreak reproduce` redraws every figure of Shepard's *Amateur Physics for the Amateur Pool
Player*, which this program grew out of: [see them all](../reports/index.md).
"""  # noqa: E501


def _command(text: str, width: int) -> str:
    """Return a command in lines that fit a card, broken before options."""
    lines = ["evenbreak"]
    for part in re.split(" (?=--)", text):
        if len(lines[-1]) + 1 + len(part) <= width or lines == ["evenbreak"]:
            lines[-1] += f" {part}"
        else:
            lines.append(f"  {part}")
    return " \\\n".join(lines)


def _made(one: Shown, made: set[str]) -> str:
    """Return what makes a picture; `made` are the commands that stand further up."""
    if one.python:
        # Not "python": make_images.py has run it, which takes longer than an example may.
        return _folded(f"```py\n{one.python}```\n")
    command = one.command.replace("FILE", PurePath(one.name).name)
    if command in made:
        return "The same command draws it.\n"
    made.add(command)
    return f"```sh\n{_command(command, WIDE if one.wide else WIDTH)}\n```\n"


def _folded(code: str) -> str:
    """Return long code behind a line to tap."""
    return f"<details><summary>How it is made</summary>\n\n{code}\n</details>\n"


def _boxed(kind: str, *parts: str) -> str:
    """Return parts in a box that `cards.css` lays out; elsewhere they stand one below the other."""
    return "\n".join((f'<div class="{kind}">\n', *parts, "</div>\n"))


def _card(one: Shown, made: set[str]) -> str:
    return _boxed(
        "picture wide" if one.wide else "picture",
        f"[![{one.title}](images/{PurePath(one.name).name})]({one.page})\n",
        f"[{one.title}]({one.page}). {one.says}\n",
        _made(one, made),
    )


def _live() -> Iterator[str]:
    """Yield the cards of the page's pictures."""
    page = "tutorial/evening-by-page.md"
    for name, title, says in PAGE:
        shown = f"[![{title}](images/{name}.png)]({page})\n\n[{title}]({page}). {says}\n"
        yield _boxed("picture phone" if "/" in name else "picture wide", shown)


def gallery_page() -> str:
    """Return the page as Markdown."""
    parts, made = [HEAD], set[str]()
    for k, (group, shown) in enumerate(SHOWN.items()):
        cards = (*(_live() if k == 0 else ()), *(_card(one, made) for one in shown))
        parts += [f"## {group}\n", _boxed("gallery", *cards)]
    return "\n".join([*parts, PAPER])
