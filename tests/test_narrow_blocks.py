"""What a phone may break in a block of code, and what it may not."""

from __future__ import annotations

import re
import sys
from types import SimpleNamespace

from places import ROOT

sys.path.insert(0, str(ROOT / "docs"))


def narrowed(*lines: str) -> str:
    from narrow_blocks import narrow

    block = '<div class="highlight-console notranslate"><div class="highlight"><pre>'
    output = "\n".join(f'<span class="go">{line}</span>' if line else "" for line in lines)
    context = {"body": f"{block}{output}</pre></div></div>"}
    narrow(SimpleNamespace(), "index", "page.html", context, None)
    return context["body"]


def test_a_sentence_flows_only_where_the_next_word_had_no_room() -> None:
    long = "The fairest race is 7:4. A wins it 52% of the time, and it lasts 8.4 games on"
    body = narrowed(long, "average.", "It ends soon.")
    assert body.count('class="joint"') == 1
    assert '<span class="joint">\n</span><span class="go">average.' in body


def test_a_table_keeps_its_lines_and_knows_its_width() -> None:
    body = narrowed("Two players", "", "  player  title", "  Ann       0.4", "", "Both may win.")
    (rows,) = re.findall(r'<span class="rows" style="--columns: (\d+)">(.*?)\n</span>', body, re.S)
    assert rows[0] == "15"
    assert rows[1].count("\n") == 1


def test_lines_of_a_file_stay_apart() -> None:
    line = "2024-09-03,Autumn,Marguerite Oduya,Yuki Tamashiro-Lund,6,2,6,1,winner,a,"
    assert "joint" not in narrowed(line, line)
