"""Workbooks made to exhaust the memory or the reader: each is one clear problem."""

import io
import random
import time
import zipfile
from collections.abc import Callable, Mapping

import pytest

from evenbreak.errors import DataError
from evenbreak.files.tables import rows as spreadsheet
from evenbreak.files.tables import workbook
from evenbreak.files.tables.rows import sheets_of
from tries import tries

MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
NAMES = "urn:oasis:names:tc:opendocument:xmlns:"
FILLED = '<c r="A1" t="inlineStr"><is><t>Name</t></is></c>'

Make = Callable[[random.Random], bytes]


def packed(parts: Mapping[str, str | bytes]) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return out.getvalue()


def xlsx(
    sheet: str, *, before: str = "", shared: str = "", path: str = "worksheets/s.xml"
) -> bytes:
    """Return a workbook with one sheet of this XML."""
    kinds = (
        f'<Types xmlns="{PACKAGE}/content-types"><Default Extension="xml" ContentType="x"/></Types>'
    )
    rel = '<Relationship Id="{0}" Type="{1}/{2}" Target="{3}"/>'
    book = (
        f'<workbook xmlns="{MAIN}" xmlns:r="{OFFICE}"><sheets>'
        '<sheet name="A" sheetId="1" r:id="a"/></sheets></workbook>'
    )
    inner = rel.format("a", OFFICE, "worksheet", path) + rel.format(
        "b", OFFICE, "sharedStrings", "sharedStrings.xml"
    )
    relations = f'<Relationships xmlns="{PACKAGE}/relationships">{{}}</Relationships>'
    return packed(
        {
            "[Content_Types].xml": kinds,
            "_rels/.rels": relations.format(
                rel.format("w", OFFICE, "officeDocument", "xl/workbook.xml")
            ),
            "xl/workbook.xml": book,
            "xl/_rels/workbook.xml.rels": relations.format(inner),
            "xl/sharedStrings.xml": f'<sst xmlns="{MAIN}">{shared}</sst>',
            f"xl/{path}": f'{before}<worksheet xmlns="{MAIN}">{sheet}</worksheet>',
        }
    )


def rows(inner: str) -> str:
    return f"<sheetData>{inner}</sheetData>"


def ods(inner: str, *, before: str = "") -> bytes:
    spaces = " ".join(f'xmlns:{name}="{NAMES}{name}:1.0"' for name in ("office", "table", "text"))
    return packed(
        {
            "mimetype": "application/vnd.oasis.opendocument.spreadsheet",
            "content.xml": f"{before}<office:document-content {spaces}><office:body>"
            f'<office:spreadsheet><table:table table:name="A">{inner}</table:table>'
            "</office:spreadsheet></office:body></office:document-content>",
            "META-INF/manifest.xml": f'<manifest:manifest xmlns:manifest="{NAMES}manifest:1.0"/>',
        }
    )


def cell_of_ods(repeated: int = 1, text: str = "x") -> str:
    return (
        f'<table:table-cell office:value-type="string" table:number-columns-repeated="{repeated}">'
        f"<text:p>{text}</text:p></table:table-cell>"
    )


def row_of_ods(inner: str, repeated: int = 1) -> str:
    return f'<table:table-row table:number-rows-repeated="{repeated}">{inner}</table:table-row>'


def large(luck: random.Random, digits: int = 8) -> int:
    return luck.randrange(10**digits, 10 ** (digits + luck.randrange(1, 6)))


def huge_row(luck: random.Random) -> bytes:
    quote = luck.choice("\"'")
    far = f"<row r={quote}{large(luck)}{quote}><c t='inlineStr'><is><t>x</t></is></c></row>"
    return xlsx(rows(f'<row r="1">{FILLED}</row>{far}'))


def huge_cell(luck: random.Random) -> bytes:
    far = f'<c r="{luck.choice("ABZ")}{large(luck, 7)}"><v>1</v></c>'
    return xlsx(rows(f'<row r="1">{FILLED}</row><row>{far}</row>'))


def wide_cell(luck: random.Random) -> bytes:
    far = "".join(luck.choices("XYZ", k=luck.randrange(3, 8)))
    return xlsx(rows(f'<row r="1">{FILLED}<c r="{far}1"><v>1</v></c></row>'))


def last_cell(luck: random.Random) -> bytes:
    path = luck.choice(["worksheets/s", "elsewhere/s.png", "worksheets/s.bin"])
    inner = f'<row r="1">{FILLED}</row><row r="1048576"><c r="XFD1048576"><v>1</v></c></row>'
    return xlsx(f'<dimension ref="A1"/>{rows(inner)}', path=path)


def after_a_far_row(luck: random.Random) -> bytes:
    inner = f'<row r="{luck.randrange(900_000, 1_048_000)}"><c><v>1</v></c></row><row>'
    inner += "<c><v>1</v></c>" * luck.randrange(200, 400)
    return xlsx(rows(f'<row r="1">{FILLED}</row>{inner}</row>'))


def repeated_rows(luck: random.Random) -> bytes:
    many = large(luck)
    return ods(row_of_ods(cell_of_ods(), many) + row_of_ods(cell_of_ods()))


def repeated_columns(luck: random.Random) -> bytes:
    empty = f'<table:table-cell table:number-columns-repeated="{large(luck)}"/>'
    return ods(row_of_ods(empty + cell_of_ods()))


def repeated_both(luck: random.Random) -> bytes:
    wide = cell_of_ods(luck.randrange(10_000, 16_384))
    return ods(row_of_ods(wide, luck.randrange(500_000, 1_048_576)))


def shared_text(luck: random.Random) -> bytes:
    text = "x" * luck.randrange(100_000, 200_000)
    cells = "".join(f'<row r="{k}"><c r="A{k}" t="s"><v>0</v></c></row>' for k in range(1, 30_000))
    return xlsx(rows(cells), shared=f"<si><t>{text}</t></si>")


def repeated_text(luck: random.Random) -> bytes:
    text = "x" * luck.randrange(100_000, 200_000)
    return ods(row_of_ods(cell_of_ods(16_000, text)) + row_of_ods(cell_of_ods()))


def entities(luck: random.Random) -> bytes:
    names = [f"e{k}" for k in range(luck.randrange(8, 12))]
    defined = f'<!ENTITY {names[0]} "xxxxxxxxxx">'
    for name, before in zip(names[1:], names, strict=False):
        defined += f'<!ENTITY {name} "{f"&{before};" * 10}">'
    kind = f"<!DOCTYPE a [{defined}]>"
    text = f"&{names[-1]};"
    if luck.random() < 0.5:
        return ods(row_of_ods(cell_of_ods(1, text)), before=kind)
    cell = FILLED.replace("Name", text)
    return xlsx(rows(f'<row r="1">{cell}</row>'), before=kind)


def lying_size(luck: random.Random) -> bytes:
    """Return a workbook that says of itself that it unpacks to less than it does."""
    content = bytearray(xlsx(rows(f'<row r="1">{FILLED}</row>{"<row/>" * 100_000}')))
    for mark, at in ((b"PK\x01\x02", 24), (b"PK\x03\x04", 22)):
        start = content.find(mark)
        while start >= 0:
            content[start + at : start + at + 4] = luck.randrange(10, 300).to_bytes(4, "little")
            start = content.find(mark, start + 4)
    return bytes(content)


def cut(luck: random.Random) -> bytes:
    content = xlsx(rows(f'<row r="1">{FILLED}</row>'))
    return content[: luck.randrange(4, len(content) - 1)]


def wrong_xml(luck: random.Random) -> bytes:
    inner = rows(f'<row r="1">{FILLED}</row>')
    at = luck.randrange(20, len(inner))
    return xlsx(inner[:at] + luck.choice(["<", "</row></x>", "&nothing;", "\0"]) + inner[at:])


def binary(luck: random.Random) -> bytes:
    return packed({"[Content_Types].xml": "<Types/>", "xl/workbook.bin": luck.randbytes(99)})


KINDS: list[Make] = [
    huge_row,
    huge_cell,
    wide_cell,
    last_cell,
    after_a_far_row,
    repeated_rows,
    repeated_columns,
    repeated_both,
    shared_text,
    repeated_text,
    entities,
    lying_size,
    cut,
    wrong_xml,
    binary,
]
TRIES = tries("hostile workbooks", 1, parts=len(KINDS))


@pytest.mark.slow_after(4)
@pytest.mark.parametrize("make", KINDS, ids=lambda make: make.__name__)
def test_a_hostile_workbook_is_one_problem(make: Make, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workbook, "MOST_MEMORY", 300_000_000)
    monkeypatch.setattr(spreadsheet, "PATIENCE", 20.0)
    for seed in range(TRIES):
        content = make(random.Random(seed))
        assert len(content) < 2_000_000
        began = time.monotonic()
        with pytest.raises(DataError) as caught:
            sheets_of(content, "t.xlsx")
        (problem,) = caught.value.problems
        assert problem.startswith("t.xlsx: ")
        assert "Save" in problem or "Delete" in problem
        assert time.monotonic() - began < 20.0


def test_these_workbooks_would_be_read_if_they_were_not_hostile() -> None:
    for content in (
        xlsx(rows(f'<row r="1">{FILLED}</row>')),
        xlsx(rows('<row r="3"><c r="B3" t="s"><v>0</v></c></row>'), shared="<si><t>Name</t></si>"),
        ods(row_of_ods(cell_of_ods(1, "Name"))),
    ):
        (sheet,) = sheets_of(content, "t.xlsx")
        assert sheet.rows == [["Name"]]


def test_an_empty_sheet_to_the_last_row_and_column_is_no_attack() -> None:
    """LibreOffice says of each sheet how many empty rows and columns follow."""
    rest = '<table:table-cell table:number-columns-repeated="16383"/>'
    empty = '<table:table-cell table:number-columns-repeated="16384"/>'
    content = ods(row_of_ods(cell_of_ods() + rest) + row_of_ods(empty, 1_048_575))
    (sheet,) = sheets_of(content, "t.ods")
    assert [row[0] for row in sheet.rows] == ["x"]


def test_where_no_process_can_be_started_that_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spreadsheet.sys, "executable", "/nowhere/python")
    with pytest.raises(DataError, match="can't be read now"):
        sheets_of(xlsx(rows(f'<row r="1">{FILLED}</row>')), "t.xlsx")
