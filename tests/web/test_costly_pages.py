"""Files that take long to make are made once of each state, however many ask for them."""

import asyncio
import threading
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

import pytest

from evenbreak.sheets import bracket_paper
from evenbreak.sheets import paper_pages as score_card_pages
from evenbreak.web.beside import Made
from web.conftest import Hall
from web.phones import Phone

PAPERS = ("/bracket.pdf", "/cards.pdf")


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often each paper was made."""
    count: Counter[str] = Counter()
    for module, name in ((bracket_paper, "bracket_pdf"), (score_card_pages, "score_cards_pdf")):
        own = getattr(module, name)

        def counting(*given: object, name: str = name, own: object = own, **more: object) -> bytes:
            count[name] += 1
            return own(*given, **more)

        monkeypatch.setattr(module, name, counting)
    return count


@pytest.mark.slow
def test_guests_who_ask_for_paper_cost_one_drawing_a_state(hall: Hall, made: Counter[str]) -> None:
    def ask(k: int) -> tuple[int, str]:
        shown = Phone(hall.site).open(PAPERS[k % 2])
        return shown.status, shown.text[:5]

    with ThreadPoolExecutor(8) as guests:
        assert set(guests.map(ask, range(24))) == {(200, "%PDF-")}
    assert dict(made) == {"bracket_pdf": 1, "score_cards_pdf": 1}
    before = hall.guest.open("/bracket.pdf").text
    hall.director.send("/desk/result", match="W1.1", a=3, b=1)
    assert hall.guest.open("/bracket.pdf").text != before
    assert made["bracket_pdf"] == 2


def test_one_is_made_at_a_time_and_a_failure_is_not_kept() -> None:
    running, most = [0], [0]
    lock = threading.Lock()

    def make() -> bytes:
        with lock:
            running[0] += 1
            most[0] = max(most[0], running[0])
        time.sleep(0.01)
        with lock:
            running[0] -= 1
        return b"x"

    def fail() -> bytes:
        raise ValueError("no room")

    async def all_at_once() -> None:
        made = Made()
        await asyncio.gather(*(made.file(f"{k}.pdf", made, make) for k in range(8)))
        with pytest.raises(ValueError, match="no room"):
            await made.file("a.pdf", made, fail)
        assert await made.file("a.pdf", made, make) == b"x"

    asyncio.run(all_at_once())
    assert most == [1]
