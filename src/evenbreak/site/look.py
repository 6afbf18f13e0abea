"""The colors of pages, including a venue's own, and its logo: what is readable.

The colors are those of `common.css`, which all pages share. The contrast between two colors is
defined as in WCAG 2.2: (L1 + .05) / (L2 + .05), where L are the relative luminances and L1 is the
larger. Text needs 4.5.
"""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files
from typing import NamedTuple

from evenbreak.errors import InputError
from evenbreak.files.league.values import COLOR

CONTRAST = 4.5
"""The contrast that text needs."""

BEHIND = ("paper", "card", "sunk", "live-tint", "call-tint", "stop-tint")
"""The backgrounds behind text; the accent's own tint is made for it."""

MOST_LOGO_BYTES = 200_000
"""The largest logo, in bytes; a phone loads it with the first page."""

_LOGOS = {
    b"\x89PNG\r\n\x1a\n": "png",
    b"\xff\xd8\xff": "jpg",
    b"RIFF": "webp",
}


class Accent(NamedTuple):
    """A color for light and dark mode, its text color, and whether it had to be changed."""

    light: str
    dark: str
    on_light: str
    on_dark: str
    changed: bool

    def style(self) -> str:
        """Return the style that gives pages this color."""
        day, night = tokens(dark=False)["card"], tokens(dark=True)["card"]
        return (
            f":root {{ --accent: {self.light}; --accent-on: {self.on_light}; "
            f"--accent-tint: {_mixed(day, self.light, 12)}; }}\n@media screen {{\n"
            "@media (prefers-color-scheme: dark) { :root:not([data-theme=light]) "
            f"{(dark := self._dark(night))} }}\n[data-theme=dark] {dark}\n}}\n"
        )

    def _dark(self, card: str) -> str:
        tint = _mixed(card, self.dark, 18)
        return f"{{ --accent: {self.dark}; --accent-on: {self.on_dark}; --accent-tint: {tint}; }}"


@cache
def tokens(*, dark: bool) -> dict[str, str]:
    """Return the pages' base colors, for light or dark mode, as #rrggbb.

    >>> tokens(dark=False)["card"], tokens(dark=True)["card"]
    ('#ffffff', '#14181e')
    """
    style = files("evenbreak.site").joinpath("templates", "common.css").read_text("utf-8")
    blocks = style.split("}")[:2]  # the first rule is that of the day, the second of the night
    found = re.findall(r"--([\w-]+): #(\w{3}|\w{6});", blocks[dark])
    return {name: "#" + (code if len(code) == 6 else 2 * code) for name, code in found}


def accent(color: str) -> Accent:
    """Return a color that is readable on all pages: darker in light mode, lighter in dark mode.

    Raises InputError if it isn't a color like #1b6e53.

    >>> accent("#1b6e53").light, accent("#ffee00").light, accent("#ffee00").changed
    ('#1b6e53', '#736b00', True)
    """
    asked = COLOR.read(color)
    light, dark = (
        _toward(asked, end, tuple(tokens(dark=dark)[name] for name in BEHIND))
        for end, dark in (("#000000", False), ("#ffffff", True))
    )
    return Accent(light, dark, _on(light), _on(dark), light != asked)


def plate_style(*, accent: str = "", ink: str = "", back: str = "") -> str:
    """Return the style for plates over a picture, in a venue's colors; "" for the usual colors.

    Text on a custom background is white or black unless its color is given too.

    >>> plate_style(back="#ffffff")[:46]
    '[data-theme=dark] { --card: #ffffff; --sunk: #'
    """
    card = back or tokens(dark=True)["card"]
    ink = ink or (_on(back) if back else "")
    found = {"card": back, "sunk": back and _mixed(back, _on(back), 12), "ink": ink}
    found["ink-2"] = ink and _mixed(ink, card, 20)
    if accent:
        found |= {"accent": accent, "accent-on": _on(accent)}
    both = "; ".join(f"--{name}: {color}" for name, color in found.items() if color)
    return f"[data-theme=dark] {{ {both} }}\n"


def contrast(one: str, other: str) -> float:
    """Return the contrast between two colors, 1 to 21.

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
    """Return the color, mixed with just enough of another to be readable on these backgrounds."""
    for step in range(101):
        mixed = _mixed(color, end, step)
        if all(contrast(mixed, one) >= CONTRAST for one in behind):
            return mixed
    return end


def _mixed(color: str, other: str, percent: int) -> str:
    """Return a color mixed with a percentage of another."""
    parts = zip(_parts(color), _parts(other), strict=True)
    return "#" + "".join(f"{round(255 * (a + (b - a) * percent / 100)):02x}" for a, b in parts)


def _on(color: str) -> str:
    return max("#ffffff", "#10151b", key=lambda ink: contrast(ink, color))


def logo_name(content: bytes, source: str) -> str:
    r"""Return a logo's name on a site, judging by its content: logo.png, logo.jpg or logo.webp.

    Raises InputError, with the remedy, if it isn't such a picture, or is too large.

    >>> logo_name(b"\x89PNG\r\n\x1a\n...", "club.png")
    'logo.png'
    """
    if len(content) > MOST_LOGO_BYTES:
        raise InputError(
            "the logo {source} is {size:,} bytes; the limit is {most:,}. Save a smaller "
            "version, such as one 400 pixels wide.",
            source=source,
            size=len(content),
            most=MOST_LOGO_BYTES,
        )
    for start, ending in _LOGOS.items():
        if content.startswith(start) and (ending != "webp" or content[8:12] == b"WEBP"):
            return f"logo.{ending}"
    raise InputError(
        "the logo {source} isn't a PNG, JPEG or WebP image. Save it as one of these.", source=source
    )
