"""A league's color and logo: what is readable, and what may be handed out.

The contrast of two colors is that of WCAG 2.2: (L1 + .05) / (L2 + .05), with the relative
luminances L, the larger one above. Text needs 4.5.
"""

from __future__ import annotations

from typing import NamedTuple

from evenbreak.errors import InputError
from evenbreak.files.league.values import COLOR

CONTRAST = 4.5
"""The contrast that text needs."""

LIGHT, DARK = ("#ffffff", "#f1f3f5"), ("#12161b", "#090c10", "#1a2027")
"""What the color is read on: cards and pages, by day and by night."""

MOST_LOGO_BYTES = 200_000
"""The largest logo; a phone loads it with the first page."""

_LOGOS = {
    b"\x89PNG\r\n\x1a\n": "png",
    b"\xff\xd8\xff": "jpg",
    b"RIFF": "webp",
}


class Accent(NamedTuple):
    """A color by day and by night, what is written on it, and whether it had to be changed."""

    light: str
    dark: str
    on_light: str
    on_dark: str
    changed: bool


USUAL = "#00479e"


def accent(color: str) -> Accent:
    """Return a color that can be read on the site's pages: darker by day, lighter by night.

    Raises
    ------
    InputError
        if it is not a color like #1b6e53.

    >>> accent("#1b6e53").light, accent("#ffee00").light, accent("#ffee00").changed
    ('#1b6e53', '#787000', True)
    """
    asked = COLOR.read(color)
    light, dark = _toward(asked, "#000000", LIGHT), _toward(asked, "#ffffff", DARK)
    return Accent(light, dark, _on(light), _on(dark), light != asked)


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colors, 1 to 21.

    >>> round(contrast("#ffffff", "#000000"), 6), round(contrast("#777777", "#ffffff"), 2)
    (21.0, 4.48)
    """
    low, high = sorted((_luminance(one), _luminance(other)))
    return (high + 0.05) / (low + 0.05)


def _luminance(color: str) -> float:
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in _parts(color)]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def _parts(color: str) -> list[float]:
    return [int(color[k : k + 2], 16) / 255.0 for k in (1, 3, 5)]


def _toward(color: str, end: str, behind: tuple[str, ...]) -> str:
    """Return the color, mixed with as little of the end as makes it readable on these."""
    for step in range(101):
        mixed = "#" + "".join(
            f"{round(255 * (a + (b - a) * step / 100)):02x}"
            for a, b in zip(_parts(color), _parts(end), strict=True)
        )
        if all(contrast(mixed, one) >= CONTRAST for one in behind):
            return mixed
    return end


def _on(color: str) -> str:
    return max("#ffffff", "#10151b", key=lambda ink: contrast(ink, color))


def logo_name(content: bytes, source: str) -> str:
    r"""Return what a site calls a logo, by what is in it: logo.png, logo.jpg or logo.webp.

    Raises
    ------
    InputError
        if it is no such picture, or too large; the message says what to do.

    >>> logo_name(b"\x89PNG\r\n\x1a\n...", "club.png")
    'logo.png'
    """
    if len(content) > MOST_LOGO_BYTES:
        raise InputError(
            "logo {source} has {size:,} bytes, and {most:,} are the most; save it smaller, 400 "
            "pixels wide",
            source=source,
            size=len(content),
            most=MOST_LOGO_BYTES,
        )
    for start, ending in _LOGOS.items():
        if content.startswith(start) and (ending != "webp" or content[8:12] == b"WEBP"):
            return f"logo.{ending}"
    raise InputError(
        "logo {source} is not a PNG, JPEG or WebP picture; save it as one", source=source
    )
