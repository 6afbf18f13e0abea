"""A small SVG shows what matplotlib drew."""

from __future__ import annotations

import io
import re
from xml.etree import ElementTree as ET

from evenbreak.games import OneBall
from evenbreak.plots import draw, image_bytes
from evenbreak.plots.picture import small_svg

PLACE = re.compile(r'translate\(([-\d.]+) ([-\d.]+)\)|[" ]x="([-\d.]+)"')


def places(svg: str) -> list[float]:
    return [float(number) for found in PLACE.findall(svg) for number in found if number]


def test_it_is_smaller_and_nothing_moves_by_more_than_a_twentieth_of_a_point() -> None:
    whole = io.StringIO()
    draw(OneBall(0.4, 0.8)).figure.savefig(whole, format="svg")
    small = small_svg(whole.getvalue())
    assert len(small) < 0.75 * len(whole.getvalue())
    before, after = places(whole.getvalue()), places(small)
    assert len(before) == len(after) > 10
    assert max(abs(x - y) for x, y in zip(before, after, strict=True)) < 0.051


def test_every_shape_that_is_used_is_there() -> None:
    svg = image_bytes(draw(OneBall(0.4, 0.8))).decode()
    ET.fromstring(svg)  # noqa: S314
    used = set(re.findall(r"[\"(]#([\w.-]+)", svg))
    assert used
    assert used == set(re.findall(r' id="([\w.-]+)"', svg))
