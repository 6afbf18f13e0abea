"""The gallery's page: a card for each picture, with what made it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import PurePath

from shown import SHOWN, Shown

WIDTH = 42
"""Characters of a line of code on a card."""

HEAD = """\
# Gallery

Every chart evenbreak draws, with the command or the Python behind it. Each leads to its page.
Commands write to the file that you name, as PNG or SVG; in a notebook charts show themselves. The
sample data are in the folder `data/`.
"""

PAGES = """\
## Pages and paper

Not everything is a picture:

| what | command |
|---|---|
| any answer as a web page | `evenbreak odds 612 521 --scale fargo --race 7:7 --html odds.html`, and so with other commands |
| the sheet for [phones and printers](how-to/publish-your-league.md) | `evenbreak report data/demo_league.csv --out sheet --page` |
| the sheet as a workbook | `evenbreak report data/demo_league.csv --out sheet --excel` |
| the bracket as a page, or on paper | `evenbreak tournament show --out bracket.html`, or `bracket.pdf` |
| score cards, the bracket, the list of the draw | `evenbreak tournament print cards`, `bracket` or `draw` |
| the evening live, on phones and the screen | [`evenbreak serve`](how-to/a-page-for-phones-and-the-screen.md) |
"""  # noqa: E501

PHONE = (
    ("call", "Call the next matches", "The director's phone: which match goes to which table."),
    ("match", "Keep your own score", "A player's phone: the score, and the chances as it goes on."),
    ("tonight", "Tonight", "Everybody's phone: tables, the end of the evening, title odds."),
)
"""Pictures of the page, which `page_pictures.py` makes: name, title, words."""

TEXT = """\
## The figures of the text

Shepard's *Amateur Physics for the Amateur Pool Player*, the book this program grew out of, has 27
figures. One command draws them all again, next to tables of every number in it. The pages that it
writes are in the repository, `reports/index.md` and `reports/physics.md`:

```sh
evenbreak reproduce --out reports
```
"""


def _command(text: str) -> str:
    """Return a command in lines that fit a card, broken before options."""
    lines = ["evenbreak"]
    for part in re.split(" (?=--)", text):
        if len(lines[-1]) + 1 + len(part) <= WIDTH or lines == ["evenbreak"]:
            lines[-1] += f" {part}"
        else:
            lines.append(f"  {part}")
    return " \\\n".join(lines)


def _made(one: Shown) -> str:
    if one.python:
        # Not "python": make_images.py has run it, which takes longer than an example may.
        return f"```py\n{one.python}```\n"
    command = one.command.replace("FILE", PurePath(one.name).name)
    lines = "\n".join(map(_command, [*one.first.splitlines(), command]))
    return f"```sh\n{lines}\n```\n"


def _boxed(kind: str, *parts: str) -> str:
    """Return parts in a box that `cards.css` lays out; elsewhere they stand one below the other."""
    return "\n".join((f'<div class="{kind}">\n', *parts, "</div>\n"))


def _card(one: Shown) -> str:
    return _boxed(
        "picture",
        f"[![{one.title}](images/{PurePath(one.name).name})]({one.page})\n",
        f"[{one.title}]({one.page}). {one.says}\n",
        _made(one),
    )


def _on_a_phone() -> Iterator[str]:
    """Yield the cards of the page's pictures."""
    page = "tutorial/evening-by-page.md"
    for name, title, says in PHONE:
        shown = f"[![{title}](images/page/{name}.png)]({page})\n\n[{title}]({page}). {says}\n"
        yield _boxed("picture", shown)


def gallery_page() -> str:
    """Return the page as Markdown."""
    parts = [HEAD]
    for group, shown in SHOWN.items():
        parts += [f"## {group}\n", _boxed("gallery", *map(_card, shown))]
    parts += [PAGES, _boxed("gallery", *_on_a_phone())]
    return "\n".join([*parts, TEXT])
