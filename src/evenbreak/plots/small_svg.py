"""An SVG in fewer bytes: what matplotlib writes beyond what can be seen, taken out."""

from __future__ import annotations

import re

_DECIMAL = re.compile(r"-?\d+\.\d+")
_PLACES = re.compile(r'( (?:d|x|y|points)="|translate\()([^")]*)')
_SHAPE = re.compile(r'<path id="([\w.-]+)" d="[^"]*" (style="[^"]*")')
_USE = re.compile(r'(<use href="#([\w.-]+)"[^>]*?) (style="[^"]*")')


def small_svg(svg: str) -> str:
    """Return a picture with coordinates to a twentieth of a point and without unused names.

    Parameters
    ----------
    svg
        a picture as matplotlib writes it.

    >>> small_svg('<path id="a" d="M 0.04 1.2345"/>  <!-- axis -->')
    '<path d="M 0 1.2"/>  '
    """
    svg = re.sub(r"<metadata>.*?</metadata>\n?|<!--.*?-->\n?", "", svg, flags=re.DOTALL)
    used = set(re.findall(r"#([\w.-]+)", svg))
    svg = re.sub(r' id="([\w.-]+)"', lambda name: name[0] if name[1] in used else "", svg)
    svg = _PLACES.sub(lambda place: place[1] + _DECIMAL.sub(_rounded, place[2]), svg)
    svg = svg.replace("DejaVuSans-", "f").replace("xlink:href", "href")
    # A tick looks like the shape that it uses; it need not say so again.
    style = dict(_SHAPE.findall(svg))
    svg = _USE.sub(lambda use: use[1] if style.get(use[2]) == use[3] else use[0], svg)
    return re.sub(r"\s*\n\s*", "\n", svg)


def _rounded(number: re.Match[str]) -> str:
    return f"{round(float(number[0]), 1) + 0.0:.1f}".removesuffix(".0")
