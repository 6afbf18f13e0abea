import re
import zlib

import matplotlib as mpl
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.answers.tournament.printed import Card
from evenbreak.sheets.paper_pages import FirstMatch, draw_list_pdf, score_cards_pdf
from evenbreak.sheets.pdf_page import (
    PAPERS,
    SMALLEST,
    Paper,
    drawable,
    pdf_bytes,
    shortened,
    usual_paper,
    width_of,
)
from evenbreak.sheets.pdf_sheet import sheet_pdf
from leagues import league, sheet_of
from rows import each_of
from tiers import examples


def page_with(text):
    page = Paper()
    page.text(1.0, 1.0, text, size=12)
    page.line([1.0, 2.0], [1.0, 1.0])
    page.band(1.0, 1.0, 1.0, 1.0, gray="0.9")
    return page.figure


def test_a_document_has_its_pages_a_title_and_no_date():
    document = pdf_bytes([page_with("one"), page_with("two")], "Fair races from Zoë.csv")
    assert len(re.findall(rb"/Type /Page\b", document)) == 2
    assert "Fair races from Zoë.csv".encode("utf-16-be") in document
    assert re.search(rb"/MediaBox \[ 0 0 841\.\d+ 595\.\d+ \]", document)
    for word in (b"CreationDate", b"ModDate", b"Producer", b"Creator", mpl.__version__.encode()):
        assert word not in document


def test_the_same_page_gives_the_same_bytes_whatever_a_matplotlibrc_wishes():
    first = pdf_bytes([page_with("Zoë")], "a")
    wishes = {
        "font.family": "serif",
        "pdf.fonttype": 42,
        "pdf.compression": 0,
        "savefig.bbox": "tight",
        "text.color": "red",
        "text.parse_math": True,
    }
    with mpl.rc_context(wishes):
        assert pdf_bytes([page_with("Zoë")], "a") == first
    assert pdf_bytes([page_with("Zoe")], "a") != first


@given(st.text(max_size=20))
@settings(max_examples=examples(40))
def test_any_text_can_be_written_without_a_warning(text):
    written = drawable(text)
    assert written.isprintable()
    assert drawable(written) == written
    assert pdf_bytes([page_with(text)], "any").startswith(b"%PDF")


def test_dollars_and_backslashes_are_no_mathematics():
    page = page_with(r"$x$ \frac")
    page.set_dpi(300)
    (text,) = page.axes[0].texts
    drawn = text.get_window_extent().width / 300
    assert drawn == pytest.approx(width_of(r"$x$ \frac", 12), rel=0.05)


@pytest.mark.skipif(mpl.__version_info__ < (3, 11), reason="older ones do not join letters")
def test_arabic_letters_are_joined():
    name = "مريم"
    assert width_of(name, 72) < 0.9 * sum(width_of(letter, 72) for letter in name)


@each_of("width", [0.05, 0.3, 1.0, 2.0])
@each_of("name", ["iiiiiiiiiiiiiiiiii", "W" * 300, "選手" * 20, "Ann Lee"])
def test_a_name_is_shortened_just_as_much_as_it_must_be(name, width):
    short = shortened(name, 10, width)
    if short == name:
        assert width_of(name, 10) <= width
        return
    assert short.endswith("…")
    kept = short.removesuffix("…")
    assert name.startswith(kept)
    assert not kept or width_of(short, 10) <= width
    assert width_of(f"{name[: len(kept) + 1]}…", 10) > width


@each_of(
    "place, paper",
    [("en_US.UTF-8", "letter"), ("es_MX", "letter"), ("en_GB.UTF-8", "a4"), ("C", "a4"),
     ("de_DE@euro", "a4"), ("English_United States.1252", "letter")],
)  # fmt: skip
def test_paper_is_what_is_usual_at_the_place(place, paper):
    with pytest.MonkeyPatch.context() as patch:
        for name in ("LC_ALL", "LC_PAPER"):
            patch.delenv(name, raising=False)
        patch.setenv("LANG", place)
        assert usual_paper() == paper
        patch.setenv("LC_PAPER", "en_CA")
        assert usual_paper() == "letter"


@pytest.mark.parametrize("paper", PAPERS)
def test_cards_and_lists_are_on_the_paper_asked_for(paper):
    card = Card("W1.1", "winners' side", ("Ann", "Bo"), (7, 5), 3, ())
    first = FirstMatch("Ann", 1, "W1.1", "Bo", None)
    wide, high = (f"{72 * side:.2f}".rstrip("0").rstrip(".") for side in PAPERS[paper])
    cards = score_cards_pdf([card], "Tuesday", paper=paper)
    assert f"/MediaBox [ 0 0 {wide} {high} ]".encode() in cards
    listed = draw_list_pdf([first], "Tuesday", paper=paper)
    assert f"/MediaBox [ 0 0 {high} {wide} ]".encode() in listed


def sizes_in(pdf):
    """Return the sizes of the letters in a PDF."""
    streams = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", pdf, re.DOTALL)
    texts = [zlib.decompress(one) for one in streams if one[:1] == b"x"]
    return {float(size) for one in texts for size in re.findall(rb"/F\S+ (\S+) Tf", one)}


@pytest.mark.slow
@each_of("paper", PAPERS)
def test_no_letter_on_paper_is_too_small_to_read(paper):
    names = ("Maximiliane Vandersloot-Hale", "Renée Dubois-Lachapelle")
    card = Card(23, "losers’ side, round 12", names, (9, 7), "TV", "Winner to match 33")
    codes = dict.fromkeys(names, "K7QX")
    first = [FirstMatch(name, 1, 23, names[0], "TV") for name in names]
    sheets = [sheet_of(league(many, f"{names[0]} {{}}"), prior_sd=1.0) for many in (3, 28)]
    written = [
        *(
            score_cards_pdf([card], names[0], per_page=many, paper=paper, codes=codes, address="a")
            for many in (1, 4)
        ),
        draw_list_pdf(first, "Tuesday", "Races to 5", paper=paper),
        *(sheet_pdf(sheet, paper) for sheet in sheets),
    ]
    assert min(min(sizes_in(pdf)) for pdf in written) >= SMALLEST
