"""A page for text and lines, in inches from its top left corner; A4 landscape by default."""

import io
import locale
import os
import unicodedata
from bisect import bisect_right
from collections.abc import Sequence
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.ft2font import FT2Font
from matplotlib.patches import Rectangle
from matplotlib.textpath import text_to_path


class Size(NamedTuple):
    """A sheet of paper, landscape, in inches."""

    wide: float
    high: float

    @property
    def upright(self) -> "Size":
        """The same sheet in portrait."""
        return Size(self.high, self.wide)


PAPERS = {"a4": Size(11.69, 8.27), "letter": Size(11.0, 8.5)}
"""Paper sizes by name."""

_LETTER = frozenset(
    ["US", "CA", "MX", "PH", "CL", "CO", "VE", "CR", "GT", "NI", "PA", "SV", "DO", "PR", "BO"]
)
"""Countries that use letter paper (the Unicode CLDR has the list)."""

_LETTER_BY_NAME = ("United States", "Canada", "Mexico", "Philippines", "Chile", "Colombia")
"""The same countries as Windows names them."""


def usual_paper() -> str:
    """Return this computer's usual paper size, by its locale: 'letter' or 'a4'."""
    named = (os.environ.get(name) for name in ("LC_ALL", "LC_PAPER", "LANG"))
    place = next(filter(None, named), None) or locale.getlocale(locale.LC_CTYPE)[0] or ""
    territory = place.partition(".")[0].partition("@")[0].partition("_")[2]
    return "letter" if territory in _LETTER or territory.startswith(_LETTER_BY_NAME) else "a4"


MARGIN = 0.5
"""The margin that printers leave white, with room for a pin."""

POINTS = 72.0
"""How many points make an inch."""

SMALLEST = 8.0
"""The smallest font size on paper, in points: smaller text is hard to read on a wall."""

UNKNOWN = "\N{WHITE SQUARE}"
"""The replacement for a character that the font lacks."""


class Paper:
    """One page: text, lines and bands, all in inches to the right and down.

    Text is set literally: dollar signs and backslashes have no special meaning.

    >>> page = Paper()
    >>> page.text(0.5, 0.5, "Ann $ Bo", size=11)
    >>> page.figure.get_size_inches().tolist()
    [11.69, 8.27]
    """

    def __init__(self, size: tuple[float, float] = PAPERS["a4"]) -> None:
        width, height = size
        self.wide, self.high = size
        self.figure: Figure = Figure(figsize=(width, height), facecolor="white")
        self._axes = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self._axes.set(xlim=(0.0, width), ylim=(height, 0.0))
        self._axes.set_axis_off()

    def text(
        self, x: float, y: float, text: str, *, size: float, bold: bool = False, **style: Any
    ) -> None:
        """Write text on the line at y; `style` has matplotlib text properties."""
        style = {"va": "baseline", "ha": "left", "color": "black", **style}
        plain: Any = {"parse_math": False, "usetex": False}
        self._axes.text(
            x, y, drawable(text), fontproperties=_font(bold), size=size, **plain, **style
        )

    def centered(self, x: float, y: float, text: str, *, size: float, **style: Any) -> None:
        """Write text whose digits are vertically centered at (x, y)."""
        # Half the height of a digit: matplotlib's own centering moves with the letters.
        self.text(x, y + 0.365 * size / POINTS, text, size=size, **{"ha": "center", **style})

    def slanted(self, x: float, y: float, text: str, *, size: float, angle: float) -> None:
        """Write text that starts at (x, y) and rises at an angle in degrees."""
        self.text(x, y, text, size=size, rotation=angle, rotation_mode="anchor")

    def line(self, x: Sequence[float], y: Sequence[float], **style: Any) -> None:
        """Draw a line through points; `style` has matplotlib line properties."""
        self._axes.plot(x, y, **{"color": "black", "lw": 0.5, **style})

    def band(self, left: float, top: float, width: float, height: float, *, gray: str) -> None:
        """Fill a rectangle with a gray from 0 (black) to 1 (white)."""
        self._axes.add_patch(Rectangle((left, top), width, height, fc=gray, lw=0, zorder=0))

    def frame(
        self, left: float, top: float, width: float, height: float, *, thick: float = 0.5
    ) -> None:
        """Draw a rectangle's outline."""
        self._axes.add_patch(
            Rectangle((left, top), width, height, fill=False, ec="black", lw=thick)
        )

    def code(self, left: float, top: float, size: float, text: str) -> None:
        """Draw a QR code in a square."""
        import segno
        from matplotlib.collections import PolyCollection

        modules = [[bool(one) for one in row] for row in segno.make(text, error="m").matrix]
        step = size / len(modules)
        dots = [
            [
                (left + (k + dx) * step, top + (j + dy) * step)
                for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1))
            ]
            for j, row in enumerate(modules)
            for k, dark in enumerate(row)
            if dark
        ]
        self._axes.add_collection(PolyCollection(dots, facecolors="black", edgecolors="none"))


def pdf_bytes(pages: Sequence[Figure], title: str) -> bytes:
    """Return pages as one PDF document, with the same bytes every time.

    >>> pdf_bytes([Paper().figure], "Empty")[:5]
    b'%PDF-'
    """
    out = io.BytesIO()
    # No date, no version of matplotlib, and nothing from a matplotlibrc.
    metadata: Any = {"Title": title, "Creator": None, "Producer": None, "CreationDate": None}
    rules: Any = {"pdf.fonttype": 3, "pdf.compression": 6, "savefig.bbox": None}
    with mpl.rc_context(rules), PdfPages(out, metadata=metadata) as document:
        for page in pages:
            document.savefig(page)
    return out.getvalue()


def drawable(text: str) -> str:
    """Return text with a white square for every character that the page's font lacks.

    >>> drawable("Zoë 選手")
    'Zoë □□'
    """
    if text.isascii() and text.isprintable():
        return text
    letters = _letters()
    return "".join(
        letter if ord(letter) in letters else UNKNOWN
        for letter in text
        # What only joins or directs letters has no shape of its own.
        if unicodedata.category(letter) != "Cf"
    )


def width_of(text: str, size: float, *, bold: bool = False) -> float:
    """Return a string's width, in inches.

    >>> round(width_of("7:4", 72), 1)
    1.6
    """
    return _width(text, bold) * size


@lru_cache(maxsize=8192)
def _width(text: str, bold: bool) -> float:
    """Return a string's width at one point, in inches: widths are proportional to the size."""
    font = _font(bold).copy()
    font.set_size(POINTS)
    width, _, _ = text_to_path.get_text_width_height_descent(drawable(text), font, ismath=False)
    return float(width) / POINTS**2


def shortened(text: str, size: float, width: float) -> str:
    """Return text, or as much of its beginning as fits a width in inches, plus an ellipsis.

    >>> shortened("Ann Lee", 10, 2.0), shortened("A name without end", 10, 0.8)
    ('Ann Lee', 'A name…')
    """
    if width_of(text, size) <= width:
        return text
    fitting = bisect_right(
        range(len(text)), width, key=lambda length: width_of(f"{text[:length]}…", size)
    )
    return f"{text[: max(fitting - 1, 0)].rstrip()}…"


def fitted(text: str, size: float, width: float, *, bold: bool = False) -> tuple[str, float]:
    """Return a string, never cut, and the size in points at which it fits a width in inches.

    >>> fitted("Ann Lee", 10, 2.0), fitted("Maximiliane Lee", 10, 0.5)[1] < 6.0
    (('Ann Lee', 10.0), True)
    """
    room = 0.98 * width  # a screen rounds the widths of letters
    wide = width_of(text, size, bold=bold)
    return text, size * min(1.0, room / wide) if wide else size


def _file(bold: bool) -> Path:
    # The font that comes with matplotlib: another of the same name could look different.
    return Path(mpl.get_data_path(), "fonts", "ttf", f"DejaVuSans{'-Bold' if bold else ''}.ttf")


@cache
def _font(bold: bool) -> FontProperties:
    return FontProperties(fname=_file(bold))


@cache
def _letters() -> frozenset[int]:
    font = FT2Font(str(_file(bold=False)))
    return frozenset(code for code in font.get_charmap() if chr(code).isprintable())
