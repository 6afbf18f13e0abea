"""A list as people paste it: one player per line, with numbers, signs and words around the name.

Each line is first read by itself, then compared with the others: numbers in front that count 1, 2,
3 ... are places, and "Player 2" is a name if there is a "Player 3". A line that can mean two things
is marked as doubtful, with its possible meanings, likeliest first. Nothing is guessed silently.
"""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from evenbreak.files.tables.names import clean_name, same_name
from evenbreak.files.tables.problems import quoted
from evenbreak.words import joined, say

_ONE = r"[0-9]+(?:[.,][0-9]{1,2})?"
_LABEL = (
    r"(?:(?:fargo(?:\s?rate)?|(?:skill\s?)?(?:level|lvl)|s/?l|rating|rated|rtg|elo|npl|apa|hcp|h/?c"
    r"|handicap|wertung|r)(?![^\W\d_])\s*[:=.]?\s*)"
)
_UNIT = r"(?:\s*(?:pts?|points?|punkte|fargo(?:rate)?)\.?)?"
_PICTURES = r"\u2600-\u27bf\U0001f000-\U0001faff\ufe0f\u200d"
_AROUND = re.compile(
    rf"^(?:[\s*+•·‣◦▪●○–—>{_PICTURES}-]+|\[[ xX]?\])+(?=\S)|[\s,;|{_PICTURES}]+$|(?<=\S)\s+[-–—]+$"
)
_MARKED = re.compile(
    r"(?:(?:no\.?|nr\.?|#|№)\s*(?P<no>[0-9]{1,3})\b\s*[.):\]]?"  # no. 3, #3
    r"|[(\[]\s*(?P<round>[0-9]{1,3})\s*[)\]]"  # (3)
    r"|(?P<dot>[0-9]{1,3})\s*[.)\]]"  # 3. 3)
    r"|(?P<sign>[0-9]{1,4}(?:[.,][0-9])?)\s*(?:[:;,|]|[-–—](?=\s))"  # 3: 3 - 612 -
    r"|(?P<tab>[0-9]{1,4}(?:[.,][0-9])?)\s*\t"
    r"|(?P<blank>[0-9]{1,4}(?:[.,][0-9])?)\s(?=\s*[^\s0-9]))"
    r"\s*(?=[^\s0-9])",
    re.IGNORECASE,
)
_PLACE_AND_RATING = re.compile(
    r"(?:#|no\.?)?\s*[(\[]?[0-9]{1,3}(?:[.):\]\t]|\s-|\s)\s*"
    r"(?=[0-9]{3,4}(?:[.,][0-9])?[\s,;:–—-]+[^\W\d_])",
    re.IGNORECASE,
)
_LETTER = re.compile(r"^[a-z]\)\s+", re.IGNORECASE)
_BRACKETED = re.compile(
    rf"(?P<name>.*[^\s,;:(\[–—-])(?P<sign>[\s,;:–—-]*[(\[{{])\s*{_LABEL}?(?P<cell>{_ONE}){_UNIT}"
    r"\s*[)\]}]",
    re.IGNORECASE,
)
_SIGNED = re.compile(
    rf"(?P<name>.*?(?:[^\s:=+/,;|–—._-]|\w\.))\s*(?P<sign>[:=,;|\t–—]|\s/\s|\s-+\s|-\s|\s?\.{{2,}}|\s?_{{2,}})"
    rf"\s*{_LABEL}?(?P<cell>(?:(?<=,)[-+]|(?<=\t)[-+])?{_ONE}){_UNIT}",
    re.IGNORECASE,
)
_SPACED = re.compile(
    rf"(?P<name>.*[^\s,:=])(?P<sign>[\s,]\s*{_LABEL}|\s+)(?P<cell>{_ONE}){_UNIT}", re.IGNORECASE
)
_NO_RATING = re.compile(
    r"(.*[^\s,;:(\[–—-])(?:[\s,;:–—-]*[(\[]\s*(?:un\s?rated|not rated|no rating|new(?: player)?"
    r"|n/?a|n/?r|none|tbd|\?+|-+|ohne(?: wertung)?|neu)\s*[)\]]"
    r"|[\s,;:–—-]+(?:un-?rated|not rated|no rating|n/a|\?{2,})"
    r"|\s*[,;:|\t]\s*(?:n/?r|none|tbd|\?|-+))",
    re.IGNORECASE,
)
_LABEL_BEHIND = re.compile(
    r"(.*[^\s,;:(\[–—-])[\s,;:(\[–—-]+(?:fargo(?:\s?rate)?|rating|rated|s/?l|skill(?: level)?|elo"
    r"|npl|apa|r(?=[:=]))[\s:=]*",
    re.IGNORECASE,
)
_HEADINGS = re.compile(
    r"(?:players?|entrants?|entries|names?|sign-?\s?ups?|player list|(?:tonight'?s )?(?:list|field)"
    r"|waiting list|spieler(?:innen)?|teilnehmer(?:innen)?|namen?|meldeliste|warteliste)"
    r"(?:\W+(?:and |und )?(?:ratings?|fargo(?:rate)?|wertung|elo))?\s*:?",
    re.IGNORECASE,
)
_LEFT_OVER = re.compile(
    r"[;|\t=±@<>$€£]|\+/-|[0-9]{3}|[0-9]-[0-9]|[0-9]\s*[,:]|[,:]\s*[0-9]|[(\[]\s*[0-9]|\s[-–—]+\s*[0-9]|,.*,"
    r"|[:/]$|[-–—]$"
)
_SIGNS = str.maketrans("（）［］：；，．｜＝＃", "()[]:;,.|=#")
_HUNDREDS = 100.0
"""A number this high is a rating rather than a place, a level or part of a name."""

_HIGHEST_PLACE = 256


class Typed(NamedTuple):
    """A player on a list: the name, and the numbers after it as they were typed."""

    name: str
    cells: tuple[str, ...] = ()

    @property
    def words(self) -> str:
        """The player as an unambiguous line.

        >>> Typed("Ann Lee", ("612",)).words
        'Ann Lee, 612'
        """
        return ", ".join((self.name, *self.cells))


@dataclass(frozen=True)
class Reading:
    """One reading of a line, numbered from 1.

    `players` are the players in the likeliest reading; a heading has none. If the line is doubtful,
    `doubt` gives the reason and `choices` has all possible readings, likeliest first; () leaves the
    line out. `front` is a place in front of the name, which is left out.
    """

    number: int
    text: str
    players: tuple[Typed, ...]
    doubt: str = ""
    choices: tuple[tuple[Typed, ...], ...] = ()
    front: int | None = None


@dataclass(frozen=True)
class _Parts:
    """A line taken apart: the number in front, the name, the numbers after it."""

    number: int
    text: str
    name: str
    cells: tuple[str, ...] = ()
    sign: str = ""
    front: str = ""
    mark: str = ""
    columns: tuple[Typed, ...] = ()

    @property
    def blank(self) -> bool:
        """Whether only a space separates the number, so that it may be part of the name."""
        return bool(self.cells) and not self.sign.strip()

    @property
    def whole(self) -> str:
        """The name with the number after a space, if only a space separates it."""
        return f"{self.name} {self.cells[0]}" if self.blank else self.name

    @property
    def small(self) -> bool:
        """Whether the number after a space is too low to be a rating in points."""
        return self.blank and _value(self.cells[0]) < _HUNDREDS


def _value(cell: str) -> float:
    return float(cell.replace(",", ".") or 0.0)


def _stem(name: str) -> str:
    """Return a key shared by names that differ only in their numbers."""
    return same_name(re.sub(r"\s*[0-9]+$", "", name))


def readings(lines: Sequence[str], most: int = 1) -> list[Reading]:
    """Return readings for a list's lines, skipping lines without a letter or number.

    At most `most` numbers follow a name.
    """
    parts = [_parts(k, text, most) for k, text in enumerate(lines, 1)]
    rows = [one for one in parts if re.search(r"[^\W_]", one.name) or one.columns]
    titles = {one.number for one in rows if _is_heading(one)}
    judge = _Judge([one for one in rows if one.number not in titles], most)
    read = [
        Reading(one.number, one.text, ()) if one.number in titles else judge.reading(one)
        for one in rows
    ]
    return _without_doubles(read)


def _is_heading(one: _Parts) -> bool:
    text = clean_name(one.text).strip("*#=- ")
    no_number = not re.search(r"[0-9]", text)
    return no_number and (text.endswith(":") or bool(_HEADINGS.fullmatch(text)))


def _parts(number: int, text: str, most: int) -> _Parts:
    """Take a line apart by its separators."""
    plain = "".join(
        str(unicodedata.decimal(c)) if not c.isascii() and c.isdecimal() else c for c in text
    ).translate(_SIGNS)
    # A blank of any kind is one; several, or a tab, may part columns.
    rest = re.sub(r"[^\S\t]", " ", plain)
    rest = _LETTER.sub("", _AROUND.sub("", _AROUND.sub("", rest)))
    if place := _PLACE_AND_RATING.match(rest):
        rest = rest[place.end() :]
    front, mark = "", ""
    if found := _MARKED.match(rest):
        mark = str(found.lastgroup)
        front, rest = found[mark], rest[found.end() :]
    columns = _columns(rest) if most == 1 else ()
    name, cells, sign = _apart(rest, most)
    clean = "\t".join(map(clean_name, name.split("\t")))
    return _Parts(number, " ".join(text.split()), clean, cells, sign, front, mark, columns)


def _apart(text: str, most: int) -> tuple[str, tuple[str, ...], str]:
    """Return the name, the numbers after it, and the separator in front of the first number."""
    text = _AROUND.sub("", text.strip())
    if none := _NO_RATING.fullmatch(text):
        return none[1], (), "none"
    for separator in "\t;|," if most > 1 else "":
        name, *columns = (cell.strip() for cell in text.split(separator))
        if 1 < len(columns) <= most and all(re.fullmatch(rf"(?:{_ONE})?", one) for one in columns):
            return name, tuple(columns), "|"
    cells: list[str] = []
    sign = ""
    for _ in range(most):
        found = (
            _BRACKETED.fullmatch(text)
            or (_SIGNED.fullmatch(text) if sign != " " else None)
            or (_SPACED.fullmatch(text) if sign in ("", " ") else None)
        )
        if found is None or not re.search(r"[^\W\d_]", found["name"]):
            break
        if not found["sign"].strip() and re.fullmatch(r"[0-9]{1,2}", found["cell"]) and cells:
            break  # the number of a name
        cells.insert(0, found["cell"])
        text, sign = found["name"], found["sign"] if found["sign"].strip() else " "
        if label := _LABEL_BEHIND.fullmatch(text + (sign if sign in ":=" else "")):
            text, sign = label[1], "label"
        text = text.rstrip(" ,;:/")
    return text, tuple(cells), sign


def _columns(text: str) -> tuple[Typed, ...]:
    """Return the players on a line with several, each with a rating; none if it has only one."""
    for parted in (r"\s{2,}|\t", r"\s*[|;]\s*", r"\s*,\s*"):
        cells = [one for one in re.split(parted, text.strip()) if one]
        pairs = [cells[k : k + 2] for k in range(0, len(cells), 2)]
        if len(cells) > 2 and all(
            len(pair) == 2 and not re.search("[0-9]", pair[0]) and re.fullmatch(_ONE, pair[1])
            for pair in pairs
        ):
            return tuple(Typed(clean_name(name), (cell,)) for name, cell in pairs)
        each = [_apart(one, 1) for one in cells]
        if len(each) > 1 and all(c and not re.search("[0-9]", name) for name, c, _ in each):
            return tuple(Typed(clean_name(name), c) for name, c, _ in each)
        if len(cells) > 2 and parted != r"\s{2,}|\t" and not re.search("[0-9]", text):
            return tuple(Typed(clean_name(one)) for one in cells)
    return ()


class _Judge:
    """What the other lines reveal about a line."""

    def __init__(self, rows: Sequence[_Parts], most: int) -> None:
        self.most = most
        fronts = [one.front for one in rows]
        self.counted = fronts == [str(k) for k in range(1, len(rows) + 1)]
        places = [int(one) for one in fronts if one.isdigit()]
        self.in_order = places == sorted(set(places)) and max(places, default=0) <= _HIGHEST_PLACE
        stems = Counter(_stem(name) for name in {same_name(one.whole) for one in rows})
        inner = Counter(_stem(name) for name in {same_name(one.name) for one in rows})
        self.numbered = {stem for stem, many in stems.items() if many > 1 and stem}
        self.numbered_inside = {stem for stem, many in inner.items() if many > 1}
        self.one_stem = len(stems) == 1
        self.all_small = len(rows) > 1 and all(one.small for one in rows)
        self.all_cells = bool(rows) and all(one.cells for one in rows)
        own = [one for one in rows if one.cells and not one.small]
        self.rated = bool(own) or self.all_small
        # A list of points in the hundreds has no ratings of 7 or 19, which are levels or names.
        low = [one for one in rows if one.small and _value(one.cells[0]) >= 20.0]
        points = [value for one in own if (value := _value(one.cells[0])) >= 20.0]
        self.hundreds = bool(points) and not low and min(points) >= _HUNDREDS
        twice = [one for one in own if re.search(r"\s[0-9]{1,2}$", one.name)]
        self.two_numbers = len(twice) == len(rows) > 1 and not self.numbered_inside

    def reading(self, one: _Parts) -> Reading:
        """Return the reading of a line."""
        players, doubt, choices = self._read(one)
        if doubt:
            kept = dict.fromkeys((players, *choices, ()))
            return Reading(one.number, one.text, players, doubt, tuple(kept))
        is_place = one.front.isdigit() and players and players[0].name == one.name
        front = int(one.front) if is_place and one.front not in players[0].cells else None
        return Reading(one.number, one.text, players, front=front)

    def _read(self, one: _Parts) -> tuple[tuple[Typed, ...], str, tuple[tuple[Typed, ...], ...]]:
        plain = (Typed(one.name.replace("\t", " "), one.cells),)
        if one.columns:
            many = say("this line has more than one player")
            return one.columns, many, (plain,)
        repeats = self._stem_repeats(one) and (one.small or self.one_stem)
        if one.blank and (repeats or (one.small and (self.hundreds or not self.all_cells))):
            plain = (Typed(one.whole),)
            if repeats and (self.counted or not one.front):
                return plain, "", ()
            if self.rated and not self.hundreds:
                other = (Typed(one.name, one.cells),)
                return plain, self._number(one.cells[0]), (other,)
            one = replace(one, name=one.whole, cells=(), sign="")
        if one.front and not self.counted:
            front = self._with_front(one)
            if front is not None:
                return front
        return self._named(one, plain)

    def _stem_repeats(self, one: _Parts) -> bool:
        return same_name(one.name) in self.numbered

    @staticmethod
    def _number(cell: str) -> str:
        return say("the number {n} may or may not be a rating", n=cell)

    def _with_front(
        self, one: _Parts
    ) -> tuple[tuple[Typed, ...], str, tuple[tuple[Typed, ...], ...]] | None:
        """Return the reading of a line whose first number may not be a place; None if it is one."""
        name = one.name.replace("\t", " ")
        rated, placed = Typed(name, (one.front,)), Typed(name, one.cells)
        whole = Typed(f"{one.front} {name}", one.cells)
        high = _value(one.front) >= _HUNDREDS
        if one.cells:
            if one.mark == "blank":
                return (whole,), self._number(one.front), ((placed,),)
            return None if not high else ((placed,), self._number(one.front), ((rated,),))
        if high and one.mark in ("sign", "tab", "blank"):
            if re.search(r"[0-9]", name):
                return (rated,), self._number(one.front), ((placed,), (whole,))
            return self._named(replace(one, cells=(one.front,)), (rated,))
        if high and one.mark != "no" and not self.in_order:
            return (rated,), self._number(one.front), ((placed,),)
        if one.mark == "blank":
            return (whole,), self._number(one.front), ((rated,), (placed,))
        if one.mark in ("sign", "tab") and (not self.in_order or "." in one.front):
            return (placed,), self._number(one.front), ((rated,), (whole,))
        return None

    def _named(
        self, one: _Parts, plain: tuple[Typed, ...]
    ) -> tuple[tuple[Typed, ...], str, tuple[tuple[Typed, ...], ...]]:
        """Return the reading of a line from what is left of it as a name."""
        name, cells = one.name, plain[0].cells
        if one.sign == "," and len(cells) == 1 and (last := re.search(r"\s([0-9]+)$", name)):
            stem, digits = name[: last.start()], re.sub("[^0-9].*", "", cells[0])
            decimal, grouped = f"{last[1]}.{cells[0]}", f"{last[1]}{cells[0]}"
            bare = re.search(r"[0-9],[0-9.,]+\W*$", one.text)
            if bare and len(digits) < 3 and "." not in cells[0]:
                return (Typed(stem, (decimal,)),), "", ()
            if bare and same_name(stem) not in self.numbered_inside:
                of_two = ((Typed(stem, (grouped,)),), (Typed(stem, (last[1],)),))
                return plain, self._number(cells[0]), of_two
        if one.sign == "," and len(cells) == 1 and "," in cells[0]:
            return plain, self._number(cells[0]), ((Typed(name, (cells[0].split(",")[0],)),),)
        number = re.search(rf"(?<![0-9])({_ONE})(?![0-9])", name)
        before = clean_name(re.split(r"[\t;|=±@<>$€£(\[0-9]|\s[-–—]|,", name)[0]).strip(" -–—:/,")
        shorter: list[tuple[Typed, ...]] = []
        if re.search(r"[^\W\d_]", before) and before != name:
            if not cells and number and _value(number[1]) >= 10:
                shorter.append((Typed(before, (number[1],)),))
            shorter.append((Typed(before, cells),))
        elif number and (behind := re.sub(r"^[\W\d_]+", "", name)):
            shorter += [(Typed(behind, (number[1],)),), (Typed(behind, cells),)]
        phone = len(re.sub("[^0-9]", "", name)) >= 7
        slip = self.rated and not cells
        comma = "," in name and (one.sign.strip() == "," or slip)
        double = cells and re.search(r"\s[0-9]+$", name) and self.two_numbers
        is_odd = not is_lettered(name)
        odd = is_odd or (slip and re.search("[0-9]{2}", name)) or _LEFT_OVER.search(name)
        if phone or comma or double or odd:
            best = shorter[-1] if phone and shorter else plain
            if not phone and shorter and not double and not (comma and not shorter[0][0].cells):
                best = shorter[0]
            doubt = say("this may be more than a name and a rating")
            return best, doubt, (*shorter, plain)
        if cells and self.hundreds and 0.0 < _value(cells[0]) < 10.0 and one.sign.strip():
            return (Typed(name),), self._number(cells[0]), (plain,)
        return plain, "", ()


def is_lettered(name: str) -> bool:
    """Return whether a name contains a letter.

    >>> is_lettered("李"), is_lettered("555-1234")
    (True, False)
    """
    return bool(re.search(r"[^\W\d_]", name))


def _without_doubles(read: Sequence[Reading]) -> list[Reading]:
    """Mark a line as doubtful if its player is on an earlier line."""
    seen: dict[str, int] = {}
    found = []
    for one in read:
        names = [same_name(player.name) for player in one.players]
        first = next((seen[name] for name in names if name in seen), 0)
        if first and len(names) == 1:
            (player,) = one.players
            many = next(
                k for k in range(2, len(read) + 2) if same_name(f"{player.name} {k}") not in seen
            )
            other = (player._replace(name=f"{player.name} {many}"),)
            twice = say(
                "player {name} is already in line {line}. Delete one of the two, or give two "
                "players with the same name different names, such as {other}.",
                name=quoted(player.name),
                line=first,
                other=quoted(other[0].name),
            )
            others = [choice for choice in one.choices if choice and choice != one.players]
            one = replace(one, players=(), doubt=twice, choices=((), other, *others))
        seen |= {name: one.number for name in names if name not in seen and one.players}
        found.append(one)
    return found


def choice_words(choice: tuple[Typed, ...]) -> str:
    """Return a line's reading in words.

    >>> choice_words((Typed("Ann Lee", ("612",)), Typed("Bo"))), choice_words(())
    ('Ann Lee, 612; Bo', 'leave it out')
    """
    if not choice:
        return say("leave it out")
    return joined([one.words for one in choice], "; ")
