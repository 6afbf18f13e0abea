from xml.etree import ElementTree as ET

from evenbreak.answers.faces.to_html import to_html
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.parts import Column, Quantities, Quantity, Table

NAMES = Table(
    "rows",
    [Column("player", "player", left=True), Column("p", "wins\na game", "{:.2f}".format)],
    [("<b>Ann</b>", 0.5251), ("Bo & Sons", None)],
    title="Tonight",
)


def page(*parts, heading="Heading", **more):
    """Return the section, which must be well-formed but for its line breaks."""
    text = to_html(Answer(heading, ["Words.", *parts], **more))
    return ET.fromstring(text.replace("<br>", "<br/>"))  # noqa: S314


def test_a_table_has_a_caption_heads_and_every_cell_escaped():
    (table,) = page(NAMES).iter("table")
    assert table.findtext("caption") == "Tonight"
    heads = list(table.iter("th"))
    assert ["".join(head.itertext()) for head in heads] == ["player", "winsa game"]
    assert {head.get("scope") for head in heads} == {"col"}
    rows = [[cell.text or "" for cell in row] for row in table.find("tbody")]
    assert rows == [["<b>Ann</b>", "0.53"], ["Bo & Sons", ""]]
    assert [cell.get("class") for cell in table.find("tbody")[0]] == [None, "number"]


def test_quantities_have_their_notes_and_a_screen_reader_their_names():
    win = Quantity(Column("p", "A wins"), 0.875, note="between 0.8 and 0.9")
    (row,) = page(
        Quantities([win, Quantity(Column("in_files"), 1), Quantity(Column("z", "z"), None)])
    ).iter("tr")
    assert [cell.text for cell in row] == ["A wins", "0.875", "between 0.8 and 0.9"]
    assert row.find("th").get("scope") == "row"


def test_the_first_line_of_a_heading_is_the_heading():
    section = page(heading="A < B\nRace 7:5")
    assert section.findtext("h2") == "A < B"
    assert [line.text for line in section.findall("p")] == ["Race 7:5", "Words."]


def test_details_are_folded_and_warnings_are_notes():
    section = page(details=["The model.", NAMES], warnings=["Too & few."])
    (details,) = section.iter("details")
    assert details.findtext("summary") == "Details"
    assert details.findtext("p") == "The model."
    assert details.find("table") is not None
    assert section.find("p[@role='note']").text == "Too & few."
    assert page().find("details") is None
