"""English as players write it: how much, and to which side."""

from __future__ import annotations

import math
import re

from evenbreak.errors import InputError

_SIDES = ("right", "left", "inside", "outside")
_NEEDLESS = ("of", "to", "the", "on", "hand", "handed", "side", "english", "spin")
_HYPHEN = re.compile(r"(?<=\w)-(?=[a-z])")
_TOKEN = re.compile(r"\d+(?:[.,/]\d+)?|[a-z]+|[^\s,]", re.ASCII)
_PARTS = {"half": 0.5, "quarter": 0.25, "a": 1.0, "an": 1.0, "one": 1.0, "two": 2.0}
_AMOUNT = re.compile(
    r"(?P<many>\d+(?:[.,]\d+)?|\d+/\d+|(?:an? )?(?:half|quarter)(?: an?)?|"
    rf"{'|'.join(_PARTS)})"
    r"(?: (?P<unit>tips?|%|percent))?",
    re.ASCII,
)


def english_in(text: str) -> tuple[float, str]:
    """Return the sidespin J of some english, and the side: right, left, inside or outside.

    >>> english_in("1.4 tips outside"), english_in("50% right"), english_in("half a tip left")[1]
    ((1.25, 'outside'), (0.625, 'right'), 'left')
    """
    from evenbreak.physics import MOST_ENGLISH_OFFSET, TIPS_OF_MOST_ENGLISH, spin_of_offset

    tokens = _TOKEN.findall(
        _HYPHEN.sub(" ", text.lower().replace("\N{VULGAR FRACTION ONE HALF}", "1/2"))
    )
    sides = [token for token in tokens if token in _SIDES]
    amount = " ".join(token for token in tokens if token not in (*_SIDES, *_NEEDLESS))
    if len(sides) == 1 and not amount:
        raise InputError(
            '{value!r} gives the side but not how much. Write, for example, "1 tip {side}".',
            value=text,
            side=sides[0],
        )
    match = _AMOUNT.fullmatch(amount)
    words = (
        [] if match is None else [_PARTS[word] for word in match["many"].split() if word in _PARTS]
    )
    percent = match is not None and match["unit"] in ("%", "percent")
    if len(sides) != 1 or match is None or (percent and words):
        raise InputError(
            "{value!r} isn't english. Write how much and to which side, such as 1 tip "
            "outside, 1/2 tip left or 50% right.",
            value=text,
        )
    over, _, under = match["many"].replace(",", ".").partition("/")
    if under and not int(under):
        raise InputError("{value!r} isn't a fraction of a tip", value=text)
    many = math.prod(words) if words else float(over) / float(under or 1.0)
    share = many / (100.0 if percent else TIPS_OF_MOST_ENGLISH)
    if not 0.0 <= share <= 1.0:
        raise InputError(
            "{value!r} is more than the tip can give: beyond {tips:g} tips (100%) it "
            'slips. Write "{tips:g} tips {side}" or less.',
            value=text,
            tips=TIPS_OF_MOST_ENGLISH,
            side=sides[0],
        )
    return spin_of_offset(MOST_ENGLISH_OFFSET * share), sides[0]


def english_words(value: tuple[float, str]) -> str:
    """Return some english as it is typed."""
    return f"{80.0 * value[0]:.4g}% {value[1]}"
