"""One line of a typed list: a number in front or none, a name, and numbers after it.

A line is taken apart only where its signs leave no doubt. What is left over is the name, and where
that still has numbers or signs of a list in it, the line is doubted or refused, never guessed at.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

from evenbreak.files.player_names import clean_name

_ONE = r"[0-9]+(?:[.,][0-9]{1,2})?"
_NUMBER = rf"[-+]?{_ONE}"
_PICTURES = r"\u2600-\u27bf\U0001f000-\U0001faff\ufe0f"
_AROUND = re.compile(rf"^[\s*•·‣◦▪●○–—{_PICTURES}-]+(?=\S)|[\s{_PICTURES}]+$")
_MARKED = re.compile(
    r"(?:(?:no\.?|nr\.?|#|№)\s*([0-9]{1,3})\b\s*[.):\]]?"  # no. 3, #3
    r"|[(\[]\s*([0-9]{1,3})\s*[)\]]"  # (3)
    r"|([0-9]{1,3})\s*(?:[.):\]]|[-–—](?=\s)))"  # 3. 3) 3: 3 -
    r"\s*(?=[^\s0-9])",
    re.IGNORECASE,
)
_PLAIN = re.compile(r"([0-9]+)\s+(?=[^\s0-9])")
_COLUMN_IN_FRONT = re.compile(r"([0-9]+)\t(?=[^\t]*[^\s0-9][^\t]*(?:\t|$))")
_TRAILING = re.compile(r"[\s,;|]+$")
_APART = (
    re.compile(rf"(.*[^\s,;:(\[])[\s,;:]*[(\[]\s*({_ONE})\s*[)\]]"),  # Ann (560)
    re.compile(rf"(.*[^\s:=+/–—-])\s*(?:[:=–—]|\s-\s|-\s)\s*({_ONE})"),  # Ann: 560, Ann – 560
)
_AFTER_BLANKS = re.compile(r"(.*?[^\s0-9].*?)((?:\s+[0-9](?:[0-9.,]*[0-9])?)+)")
_LEFT_OVER = re.compile(
    r"[;|\t=±]|\+/-|[0-9]\s*[,:]|[,:]\s*[0-9]|[(\[]\s*[0-9]|\s[-–—]+\s*[0-9]|^[0-9]{3}"
)


@dataclass(frozen=True)
class TypedLine:
    """A line: where it is, the name, the numbers after it, and how they were set apart.

    Parameters
    ----------
    number
        of the line.
    name
        what is left without the numbers that are set apart by a sign.
    cells
        the numbers after the name.
    front
        the number in front of the name, None if there is none.
    after_blank
        whether a mere blank sets the numbers apart.
    joined
        whether only a comma stands between a number in the name and the next: 92,5 or 1,612.
    """

    number: int
    name: str
    cells: tuple[str, ...] = ()
    front: int | None = None
    after_blank: bool = False
    joined: bool = False

    @property
    def left_over(self) -> bool:
        """Whether there are signs of a list in the name, or a number could be two: 1,612."""
        several = self.joined and re.search(r"\s[0-9]+\s+[0-9]+$", self.name)
        grouped = self.after_blank and not all(re.fullmatch(_ONE, cell) for cell in self.cells)
        return bool(_LEFT_OVER.search(self.name) or several or grouped)

    def split_at_blanks(self, most: int) -> TypedLine:
        """Return the line with up to so many numbers after blanks set apart from its name.

        >>> TypedLine(1, "Ann Lee 612").split_at_blanks(1).cells
        ('612',)
        """
        text = f"{self.name},{self.cells[0]}" if self.joined else self.name
        found = None if self.cells and not self.joined else _AFTER_BLANKS.fullmatch(text)
        cells = tuple(found[2].split()) if found else ()
        if found is None or len(cells) > most:
            return self
        return replace(
            self, name=found[1].rstrip(" ,;:/"), cells=cells, after_blank=True, joined=False
        )


def typed_line(number: int, text: str, most: int, *, numbered: bool = False) -> TypedLine:
    """Return what a line says.

    Parameters
    ----------
    number
        of the line.
    text
        the line.
    most
        how many numbers may follow a name.
    numbered
        whether a number in front needs no sign after it, as all lines have one.

    >>> found = typed_line(1, "2) Łukasz Żak - 620", 1)
    >>> found.front, found.name, found.cells
    (2, 'Łukasz Żak', ('620',))
    >>> typed_line(1, "LEE, Ann (560)", 1).name
    'LEE, Ann'
    """
    rest = _AROUND.sub("", re.sub(r"[^\S\t]+", " ", text))
    front = None
    rest = _TRAILING.sub("", rest)  # an empty cell after the last that is filled
    found = (
        _MARKED.match(rest)
        or _COLUMN_IN_FRONT.match(rest)
        or (_PLAIN.match(rest) if numbered else None)
    )
    if found:
        front, rest = int(next(filter(None, found.groups()))), rest[found.end() :]
    name, cells, joined = _apart(rest.strip(), most)
    # A column in between is no part of the name, and clean_name would hide where it began.
    clean = "\t".join(map(clean_name, name.split("\t")))
    return TypedLine(number, clean, cells, front, joined=joined)


def _apart(text: str, most: int) -> tuple[str, tuple[str, ...], bool]:
    """Return the name, the numbers that a sign sets apart from it, and whether they may be one."""
    for separator in "\t;|,":
        name, *cells = (cell.strip() for cell in text.split(separator))
        if cells and len(cells) <= most and all(not c or re.fullmatch(_NUMBER, c) for c in cells):
            joined = separator == "," and bool(re.search(r"\s[0-9]+,[0-9.]+$", text))
            return name, tuple(cells), joined
    for pattern in _APART:
        if found := pattern.fullmatch(text):
            return found[1], (found[2],), False
    return text, (), False
