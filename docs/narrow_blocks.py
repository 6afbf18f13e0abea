"""Blocks of code on a phone: sentences of an answer flow again, tables shrink until they fit.

An answer is printed in lines of 80 characters. Here its sentences and its tables are marked, so
that `cards.css` may break the ones elsewhere on a narrow screen and shrink the others; each table
has its width in `--columns`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import unescape
from itertools import groupby

WIDTH = 80
"""Characters of a line of an answer."""
BLOCK = re.compile(
    r'(<div class="highlight-(\w+) notranslate"><div class="highlight"><pre)>(.*?)</pre>', re.DOTALL
)
OUTPUT = re.compile(r'<span class="go">(.*)</span>')
OPTION = re.compile(r'<span class="pre">(?=--[a-z0-9-]{1,24}</span>)')
GIVEN = re.compile(r"(?<=>)--[a-z0-9-]+")
TAG = re.compile(r"<[^>]*>")


def _text(line: str) -> str:
    return unescape(TAG.sub("", line))


def _is_row(line: str) -> bool:
    """Return whether a line of output belongs to a table and not to a sentence."""
    text = _text(line)
    return bool(OUTPUT.fullmatch(line)) and ("  " in text or text[:1] == " ")


def _was_broken(line: str, after: str) -> bool:
    """Return whether a line ends where it does only because the next word had no room."""
    text, word = _text(line), _text(after).partition(" ")[0]
    csv = len(re.findall(r",\S", text)) > 1
    both = OUTPUT.fullmatch(line) and OUTPUT.fullmatch(after) and not _is_row(after)
    return bool(both) and not csv and len(text) <= WIDTH < len(text) + 1 + len(word)


def _console(lines: list[str]) -> Iterator[str]:
    """Yield the parts of a block of commands and answers."""
    pairs = zip(lines, [*lines[1:], ""], strict=True)
    for row, part in groupby(pairs, key=lambda pair: _is_row(pair[0])):
        if row:
            rows = [line for line, _ in part]
            columns = max(len(_text(line)) for line in rows)
            text = "\n".join(rows)
            yield f'<span class="rows" style="--columns: {columns}">{text}\n</span>'
        else:
            for line, after in part:
                given = not OUTPUT.fullmatch(line)
                yield GIVEN.sub(r'<span class="option">\g<0></span>', line) if given else line
                yield '<span class="joint">\n</span>' if _was_broken(line, after) else "\n"


def _marked(found: re.Match[str]) -> str:
    start, language, body = found.groups()
    lines = body.split("\n")
    if language == "console":
        body = "".join(_console(lines)).removesuffix("\n")
        return f"{start}>{body}</pre>"
    columns = max(len(_text(line)) for line in [*lines, "."])
    return f'{start} style="--columns: {columns}">{body}</pre>'


def narrow(app, pagename, templatename, context, doctree) -> None:  # noqa: ARG001
    """Mark the blocks of a page, and options in its sentences, which should not break."""
    if "body" in context:
        text = BLOCK.sub(_marked, context["body"])
        context["body"] = OPTION.sub('<span class="pre option">', text)
