"""A page in German shows nothing that it shows in English too, but for names."""

import re
from datetime import datetime
from html import unescape
from pathlib import Path

from evenbreak.files.demo import write_demo_evening
from evenbreak.files.store.tournament import read_tournament
from web.phones import Phone, running

PAGES = (  # without those that show addresses, and names of charts
    *("/", "/bracket", "/fair", "/players", "/prizes", "/screen", "/league", "/pin", "/desk"),
    *("/desk/time", "/desk/history", "/desk/check-in", "/play", "/share", "/team"),
)


def texts(page: str) -> set[str]:
    """Return what stands between the tags of a page."""
    inner = re.sub(r"<(script|style|textarea|svg).*?</\1>", " ", page, flags=re.DOTALL)
    return {" ".join(unescape(text).split()) for text in re.split(r"<[^>]*>", inner)}


def test_no_sentence_stays_english(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    write_demo_evening(path, datetime(2025, 3, 1, 20, 40))
    with running(path) as site:
        site.night.clock = site.clock = lambda: "2025-03-01T20:40:00"
        phones = [Phone(site, director=True, language=code) for code in ("en", "de")]
        codes = r"[2-9A-Z]{4,5}"
        names = "|".join([*map(re.escape, read_tournament(path).order), codes])
        left = {}
        for page in PAGES:
            english, german = (texts(phone.open(page).text) for phone in phones)
            both = {re.sub(rf"{names}|Code: \w+", "", text) for text in english & german}
            left[page] = {text for text in both if len(re.findall(r"[^\W\d]{2,}", text)) > 1}
        assert {page: same for page, same in left.items() if same} == {}
