"""The words in which results are written, in a file or in a DataFrame, and what they mean.

Words are compared by their letters and digits in one case: see `letters`.
"""

from __future__ import annotations

FORMATS = ("", "winner", "loser", "alternate", "a", "b")
"""Break formats in the order of their codes in `Results.break_format`; 0 is not stated."""

FORMAT_WORDS = {
    **{form + tail: code for code, form in enumerate(FORMATS) if form for tail in ("", "breaks")},
    **dict.fromkeys(("alternating", "alternatingbreaks"), FORMATS.index("alternate")),
}
"""The code of each word for a break format."""

FORFEIT_WORDS = {
    **dict.fromkeys(("yes", "y", "true", "t", "1", "x", "forfeit", "walkover", "wo"), True),
    **dict.fromkeys(("no", "n", "false", "f", "0"), False),
}
"""Whether each word says that a match was forfeited."""

LARGEST_WHOLE = 1_000_000
"""The largest whole number that is accepted, such as the games of a player in a match."""


def letters(text: str) -> str:
    """Return the letters and digits of a text, in one case.

    >>> letters("W/O"), letters("Player A")
    ('wo', 'playera')
    """
    return "".join(letter for letter in text.casefold() if letter.isalnum())
