"""The colors of all pages: readable by day and by night, and told apart by the color-blind."""

import itertools
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.site.look import (
    BEHIND,
    CONTRAST,
    MOST_LOGO_BYTES,
    accent,
    contrast,
    logo_name,
    tokens,
)

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "src" / "evenbreak"
WEB = SOURCES / "web" / "templates"
STYLE = (SOURCES / "site" / "templates" / "common.css").read_text("utf-8")

TEXT = ("ink", "ink-2", "ink-3", "live", "call", "stop", "accent")
"""What is written with; on every surface but the tint of another state, where only ink stands."""
SURFACES = ("paper", "card", "sunk")
TINTED = {"live-tint": "live", "call-tint": "call", "stop-tint": "stop", "accent-tint": "accent"}
ON = {"live-on": "live", "call-on": "call-surface", "stop-on": "stop", "accent-on": "accent"}


@pytest.mark.parametrize("dark", [False, True])
def test_every_text_can_be_read_and_every_edge_seen(*, dark: bool) -> None:
    of = tokens(dark=dark)
    pairs = [*itertools.product(TEXT, SURFACES), *ON.items()]
    for tint, own in TINTED.items():
        pairs += [(text, tint) for text in ("ink", "ink-2", "accent", own)]
    assert [pair for pair in pairs if contrast(*(of[one] for one in pair)) < CONTRAST] == []
    edges = [("edge", "card"), ("edge", "paper"), ("live", "card"), ("stop", "card")]
    assert [pair for pair in edges if contrast(*(of[one] for one in pair)) < 3.0] == []


def test_the_night_that_is_chosen_is_the_night_of_the_system() -> None:
    both = STYLE + (WEB / "css" / "parts.css").read_text("utf-8")
    system, chosen = re.findall(r"\{\s*(?:color-scheme: dark;\s*)?(--paper: #07.*?)\}", both, re.S)
    assert system.split() == chosen.split()


def test_the_page_about_the_look_says_the_contrasts_that_are_measured() -> None:
    said = (ROOT / "docs" / "explanation" / "design.md").read_text("utf-8")
    day, night = tokens(dark=False), tokens(dark=True)
    rows = re.findall(
        r"^\| `([\w-]+)` \| `(#\w+)` \| `(#\w+)` \| ([\d.]+) / ([\d.]+) \|", said, re.M
    )
    assert {name for name, *_ in rows} == {*TEXT, "edge"}
    for name, by_day, by_night, light, dark in rows:
        assert (by_day, by_night) == (day[name], night[name])
        worst = (min(contrast(of[name], of[one]) for one in SURFACES) for of in (day, night))
        assert [f"{one:.1f}" for one in worst] == [light, dark], name


# Viénot, Brettel & Mollon (1999), "Digital video colormaps for checking the legibility of
# displays by dichromats", Color Res. Appl. 24: linear RGB as protanopes and deuteranopes see it.
BLIND = {
    "protanopia": [[0.1124, 0.8876, 0.0], [0.1124, 0.8876, 0.0], [0.0040, -0.0040, 1.0]],
    "deuteranopia": [[0.2928, 0.7072, 0.0], [0.2928, 0.7072, 0.0], [-0.0223, 0.0223, 1.0]],
}


def _linear(color: str) -> np.ndarray:
    parts = np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0
    return np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)


def _lab(linear: np.ndarray) -> np.ndarray:
    """Return CIE L*a*b* under D65, where one color that is 2.3 from another is just noticed."""
    to_xyz = np.array(
        [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    )
    x, y, z = np.cbrt(np.clip(to_xyz @ linear, 1e-6, None) / (0.9505, 1.0, 1.089))
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


@pytest.mark.parametrize("blindness", BLIND)
@pytest.mark.parametrize("dark", [False, True])
def test_the_badges_of_tables_stay_apart_for_the_color_blind(blindness: str, *, dark: bool) -> None:
    seen = {
        name: _lab(np.array(BLIND[blindness]) @ _linear(tokens(dark=dark)[name]))
        for name in ("live", "call-surface", "stop", "accent", "card")
    }
    gaps = {
        pair: np.linalg.norm(seen[pair[0]] - seen[pair[1]])
        for pair in itertools.combinations(seen, 2)
    }
    assert min(gaps.values()) > 20.0, gaps


def test_each_state_of_a_match_has_a_shape_of_its_own() -> None:
    parts = (SOURCES / "web" / "templates" / "parts.html").read_text("utf-8")
    shapes = dict(re.findall(r'<symbol id="s-(\w+)"[^>]*>(.*?)</symbol>', parts))
    states = re.findall(r'"(\w+)": \("[\w-]*", say\(', parts)
    assert sorted(states) == sorted(shapes)
    assert len(set(shapes.values())) == len(shapes) == 9


@given(st.integers(0, 0xFFFFFF))
def test_any_color_is_readable_and_so_is_what_is_written_on_it(number: int) -> None:
    made = accent(f"#{number:06x}")
    tints = [
        line.split("--accent-tint: ")[1][:7] for line in made.style().splitlines() if "tint" in line
    ]
    for dark, own, on, tint in (
        (False, made.light, made.on_light, tints[0]),
        (True, made.dark, made.on_dark, tints[1]),
    ):
        of = tokens(dark=dark)
        assert min(contrast(own, of[one]) for one in BEHIND) >= CONTRAST
        assert contrast(on, own) >= CONTRAST
        assert min(contrast(of[ink], tint) for ink in ("ink", "ink-2")) >= CONTRAST


def test_the_contrast_is_that_of_the_standard() -> None:
    """The examples of WCAG's understanding document and of its well-known checker."""
    assert contrast("#767676", "#ffffff") == pytest.approx(4.54, abs=0.005)
    assert contrast("#0000ff", "#ffffff") == pytest.approx(8.59, abs=0.005)


def test_a_dark_enough_color_stays_as_it_is() -> None:
    assert accent("#1B6E53")[:1] == ("#1b6e53",)
    assert not accent("#1b6e53").changed
    assert accent("#FFEE00").changed


@pytest.mark.parametrize("color", ["red", "#12", "1b6e53", "#1b6e5g", "#1b6e53;}body{display:none"])
def test_what_is_no_color_is_refused_with_a_remedy(color: str) -> None:
    with pytest.raises(InputError, match="Write one such as"):
        accent(color)


def test_a_logo_is_known_by_its_content() -> None:
    assert logo_name(b"\xff\xd8\xff\xe0", "club.png") == "logo.jpg"
    assert logo_name(b"RIFF1234WEBPVP8 ", "club") == "logo.webp"
    for wrong in (b"<svg onload=alert(1)>", b"RIFF1234WAVE", b""):
        with pytest.raises(InputError, match="Save it as one"):
            logo_name(wrong, "club.png")
    with pytest.raises(InputError, match="Save a smaller version"):
        logo_name(b"\x89PNG\r\n\x1a\n" + bytes(MOST_LOGO_BYTES), "club.png")


def test_every_variable_of_a_style_is_declared() -> None:
    declared = {*tokens(dark=False), *re.findall(r"(--[\w-]+):", STYLE)}
    for sheet in [*(SOURCES / "site" / "templates").glob("*.css"), *(WEB / "css").glob("*.css")]:
        text = sheet.read_text("utf-8")
        own = declared | {*re.findall(r"(--[\w-]+):", text)}
        assert {*re.findall(r"var\((--[\w-]+)", text)} <= own, sheet.name


def test_a_style_has_no_class_that_no_page_has() -> None:
    """What a screen leaves behind when it is made anew weighs on every first visit."""
    pages = "".join(one.read_text("utf-8") for one in [*WEB.glob("*.html"), *WEB.glob("*.js")])
    pages += "".join(one.read_text("utf-8") for one in (SOURCES / "web").rglob("*.py"))
    pages += (SOURCES / "answers" / "faces" / "to_html.py").read_text("utf-8")
    words = set(re.findall(r"[\w-]+", pages))
    for sheet in (WEB / "css").glob("*.css"):
        selectors = re.sub(
            r"\{[^{}]*\}", " ", re.sub(r"/\*.*?\*/", "", sheet.read_text("utf-8"), flags=re.S)
        )
        classes = {*re.findall(r"\.([a-z][\w-]*)", selectors)}
        made = {one: {one, one.removeprefix("is-"), one.rstrip("0123456789")} for one in classes}
        left = {one for one, names in made.items() if not names & words}
        assert left == set(), sheet.name
