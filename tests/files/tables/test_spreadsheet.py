"""Workbooks as spreadsheets save them; .xlsx made by XlsxWriter, .ods by hand."""

import datetime as dt
import hashlib
import io
import random
import zipfile

import pytest
import xlsxwriter

from evenbreak.errors import DataError
from evenbreak.files.tables.rows import sheets_of
from evenbreak.files.tables.table import read_table
from evenbreak.files.tables.workbook import UNREADABLE, UnreadableError
from evenbreak.files.tables.workbook import read as read_workbook

REQUIRED = {"name": ["player"], "rating": ["points"]}
OPTIONAL = {"date": [], "score": []}


def xlsx(sheets, hidden=()):
    out = io.BytesIO()
    with xlsxwriter.Workbook(out, {"in_memory": True}) as book:
        day = book.add_format({"num_format": "yyyy-mm-dd"})
        clock = book.add_format({"num_format": "hh:mm"})
        for name, rows in sheets.items():
            sheet = book.add_worksheet(name)
            if name in hidden:
                sheet.hide()
            for i, row in enumerate(rows):
                for j, cell in enumerate(row):
                    if isinstance(cell, dt.time):
                        sheet.write_datetime(i, j, cell, clock)
                    elif isinstance(cell, dt.date):
                        sheet.write_datetime(i, j, cell, day)
                    elif cell is not None:
                        sheet.write(i, j, cell)
    return out.getvalue()


def ods(rows):
    def cell(value):
        if isinstance(value, dt.date):
            return (
                '<table:table-cell office:value-type="date" '
                f'office:date-value="{value}"><text:p>{value:%m/%d/%y}</text:p></table:table-cell>'
            )
        if isinstance(value, dt.time):
            return (
                '<table:table-cell office:value-type="time" office:time-value='
                f'"PT{value.hour:02}H{value.minute:02}M00S"><text:p>x</text:p></table:table-cell>'
            )
        if isinstance(value, int | float):
            return (
                f'<table:table-cell office:value-type="float" office:value="{value}">'
                f"<text:p>{value:,}</text:p></table:table-cell>"
            )
        if value is None:
            return "<table:table-cell/>"
        return (
            '<table:table-cell office:value-type="string">'
            f"<text:p>{value}</text:p></table:table-cell>"
        )

    body = "".join(f"<table:table-row>{''.join(map(cell, row))}</table:table-row>" for row in rows)
    names = "urn:oasis:names:tc:opendocument:xmlns:"
    content = (
        '<?xml version="1.0" encoding="UTF-8"?><office:document-content '
        f'xmlns:office="{names}office:1.0" xmlns:text="{names}text:1.0" '
        f'xmlns:table="{names}table:1.0" office:version="1.2"><office:body><office:spreadsheet>'
        f'<table:table table:name="Club">{body}</table:table>'
        "</office:spreadsheet></office:body></office:document-content>"
    )
    kind = "application/vnd.oasis.opendocument.spreadsheet"
    manifest = (
        '<?xml version="1.0" encoding="UTF-8"?><manifest:manifest '
        f'xmlns:manifest="{names}manifest:1.0"><manifest:file-entry manifest:full-path="/" '
        f'manifest:media-type="{kind}"/></manifest:manifest>'
    )
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        archive.writestr("mimetype", kind)
        archive.writestr("content.xml", content)
        archive.writestr("META-INF/manifest.xml", manifest)
    return out.getvalue()


ROWS = [
    ["Name", "Rating", "Date", "Score"],
    ["Zoë", 1500.0, dt.date(2024, 9, 3), "7-5"],
    [None, None, None, None],
    ["Bo", 92.5, dt.date(2024, 9, 13), dt.time(7, 5)],
]


@pytest.fixture
def read(tmp_path):
    def read_content(content):
        path = tmp_path / "t.dat"
        path.write_bytes(content)
        return read_table(path, REQUIRED, OPTIONAL, rows="players")

    return read_content


KINDS = pytest.mark.parametrize(
    "make", [lambda rows: xlsx({"Club": rows}), lambda rows: ods(rows)], ids=["xlsx", "ods"]
)


@KINDS
def test_a_workbook_is_read_whatever_its_name(read, make):
    content = make(ROWS)
    table = read(content)
    assert table.cells("name") == ["Zoë", "Bo"]
    assert table.cells("rating") == ["1500", "92.5"]
    assert table.cells("date") == ["2024-09-03", "2024-09-13"]
    assert table.cells("score") == ["7-5", "7:05"]
    assert table.lines.tolist() == [2, 4]
    assert table.warnings == ()
    assert table.sha256 == hashlib.sha256(content).hexdigest()
    table.problems.raise_any()


@KINDS
def test_a_title_above_the_header_is_skipped_and_lines_count_as_shown(read, make):
    table = read(make([["Autumn league"], [None], *ROWS]))
    assert table.lines.tolist() == [4, 6]
    (warning,) = table.warnings
    assert ":3:" in warning
    assert "'Autumn league'" in warning


def test_the_first_sheet_that_fits_is_read_and_others_are_named(read):
    other = [["Name", "Rating"], ["Cy", 1]]
    table = read(xlsx({"Notes": [["hello"]], "Club": ROWS, "Old": other}))
    assert table.cells("name") == ["Zoë", "Bo"]
    (warning,) = table.warnings
    assert "'Club'" in warning
    assert "'Old'" in warning
    assert read(xlsx({"Notes": [["hello"]], "Club": ROWS})).warnings == ()


def test_a_hidden_sheet_is_not_read(read):
    table = read(xlsx({"Shown": ROWS, "Old": [["Name", "Rating"], ["Cy", 1]]}, hidden=["Old"]))
    assert table.warnings == ()


def test_a_sheet_without_the_columns_is_refused_by_its_titles(read):
    table = read(xlsx({"A": [["x", "y"]], "B": [["Name", "Level"], ["Cy", 1]]}))
    with pytest.raises(DataError, match="'rating' among 'Name', 'Level'"):
        table.problems.raise_any()


def archive(**files):
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as made:
        for name, content in files.items():
            made.writestr(name.replace("_", "."), content)
    return out.getvalue()


def far_cells():
    out = io.BytesIO()
    with xlsxwriter.Workbook(out, {"in_memory": True}) as book:
        sheet = book.add_worksheet("A")
        sheet.write(0, 0, "Name")
        sheet.write(1_048_575, 16_383, "x")
    return out.getvalue()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("make", "told"),
    [
        (lambda: b"PK\x03\x04\x14\0", "can't be read as a workbook"),
        (lambda: archive(readme_txt="hello"), "not an .xlsx or .ods workbook"),
        (lambda: archive(content_xml="<a/>"), "can't be read as a workbook"),
        (lambda: xlsx({"A": []}), "no sheet with anything in it"),
        (far_cells, "far away"),
        (lambda: archive(content_xml=b"\0" * 500_000_000), "bytes once unpacked"),
    ],
    ids=["cut", "text", "page", "empty", "far", "large"],
)
def test_what_is_no_workbook_is_one_problem(make, told):
    content = make()
    with pytest.raises(DataError, match=told) as caught:
        sheets_of(content, "t.xlsx")
    assert len(caught.value.problems) == 1


@KINDS
def test_a_damaged_workbook_is_read_or_refused(make):
    content = make(ROWS)
    rng = random.Random(1)
    told = set()
    for _ in range(200):
        damaged = bytearray(content)
        for _ in range(rng.randrange(1, 30)):
            damaged[rng.randrange(4, len(damaged))] = rng.randrange(256)
        try:
            read_workbook(bytes(damaged[: rng.randrange(50, len(damaged) + 1)]))
        except UnreadableError as error:
            told.add(str(error))
    assert UNREADABLE in told
