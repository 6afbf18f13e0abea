"""The draw as a list: everybody once, by name, on as many pages as it takes."""

import re
import zlib

import pytest

from evenbreak.sheets.paper_pages import FirstMatch, draw_list_pdf


@pytest.mark.slow_after(1)
@pytest.mark.parametrize(("players", "pages"), [(1, 1), (16, 1), (36, 1), (37, 2), (64, 2)])
def test_everybody_has_a_line(players, pages):
    listed = [FirstMatch(f"Player {k}", k, f"W1.{k}", "Bo", None) for k in range(1, players + 1)]
    content = draw_list_pdf(listed, "Tuesday", "Single elimination")
    assert len(re.findall(rb"/Type /Page\b", content)) == pages
    streams = re.findall(rb"stream\r?\n(.*?)endstream", content, re.DOTALL)
    texts = b"".join(zlib.decompress(one) for one in streams if one[:1] == b"x")
    assert texts.count(b"Tf") >= players
