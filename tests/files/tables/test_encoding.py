import io
import os
import sys

import pytest

from evenbreak.errors import DataError
from evenbreak.files.tables import rows as module
from evenbreak.files.tables.rows import content_of, text_of
from rows import each_of, posix


def test_a_file_is_called_as_the_person_called_it(tmp_path, monkeypatch):
    (tmp_path / "r.csv").write_bytes(b"abc")
    monkeypatch.chdir(tmp_path)
    assert content_of("./r.csv") == ("./r.csv", b"abc")


def test_a_dash_is_standard_input(monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"a\xffb")))
    assert content_of("-") == ("stdin", b"a\xffb")


def test_a_closed_standard_input_is_told(monkeypatch):
    monkeypatch.setattr(sys, "stdin", None)
    with pytest.raises(DataError, match="stdin: is closed"):
        content_of("-")


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("nowhere.csv", "there's no such file"),
        ("", "is a folder"),
        ("r.csv/more", "can't be read"),
        (os.fsdecode(b"\xff.csv"), "there's no such file"),
    ],
)
def test_a_file_that_cannot_be_read_is_one_problem(tmp_path, name, told):
    (tmp_path / "r.csv").write_bytes(b"")
    with pytest.raises(DataError, match=told) as caught:
        content_of(tmp_path / name)
    assert len(caught.value.problems) == 1
    assert caught.value.problems[0].encode()


@pytest.mark.parametrize(
    ("content", "encoding"),
    [
        (b"plain", "utf-8-sig"),
        ("Zoë".encode(), "utf-8-sig"),
        ("Zoë".encode("utf-8-sig"), "utf-8-sig"),
        ("Zoë".encode("cp1252"), "cp1252"),
        ("Zoë".encode("utf-16"), "utf-16"),
        ("\ufeffZoë".encode("utf-16-le"), "utf-16"),
        ("\ufeffZoë".encode("utf-16-be"), "utf-16"),
    ],
)
def test_encodings(content, encoding):
    text = text_of(content, "r.csv")
    assert text.encoding == encoding
    assert text.read() in ("plain", "Zoë")
    assert len(text.warnings) == (encoding == "cp1252")


def test_the_warning_says_where_the_file_stops_being_utf8():
    *_, warnings = text_of("Zoë\nBo\n".encode() + "Émile".encode("cp1252"), "r.csv")
    assert warnings[0].startswith("r.csv:3: isn't UTF-8. It was read as Windows-1252")


@each_of(
    "content, told",
    [
        (b"", "r.csv: is empty"),
        (b"\xef\xbb\xbf", "r.csv: is empty"),
        (b" \r\n\t\n", "r.csv: is empty"),
        (b"a,b\n1,\0\n", "r.csv:2: holds a NUL byte"),
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", "r.csv: is a picture. Save the table"),
        (b"a,b\n\x81\xff\n", "r.csv:2: is neither UTF-8 nor Windows-1252"),
        (b"\xef\xbb\xbfa,b\n\xe9,1\n", "r.csv:1: is neither UTF-8 nor Windows-1252"),
        ("a,b\n".encode("utf-16")[:-1], "r.csv: is damaged UTF-16 text"),
        (b"\xff\xfe\x00\xd8\x00\x00", "r.csv: is damaged UTF-16 text"),
        ("a,b\n1,\0\n".encode("utf-16"), "r.csv:2: holds a NUL byte"),
        ("a,b\n".encode("utf-32"), "r.csv:1: holds a NUL byte"),
        (b"\xff\xfe", "r.csv: is empty"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1", "r.csv: is an old or locked Excel workbook"),
        (b"%PDF-1.7", "r.csv: is a PDF document"),
    ],
)
def test_what_is_no_text_is_refused_with_a_remedy(content, told):
    with pytest.raises(DataError) as caught:
        text_of(content, "r.csv")
    (problem,) = caught.value.problems
    assert problem.startswith(told)
    assert "Save" in problem or "Write" in problem


def test_a_name_of_a_file_stays_on_one_line(tmp_path):
    with pytest.raises(DataError) as caught:
        content_of(tmp_path / "no\nsuch\x1b[31m\udcff.csv")
    (problem,) = caught.value.problems
    assert problem.endswith("no\\nsuch\\x1b[31m\\udcff.csv: there's no such file. Check its name.")


@posix
def test_a_file_without_end_is_refused(monkeypatch):
    monkeypatch.setattr(module, "MOST_BYTES", 1 << 20)
    with pytest.raises(DataError, match="larger than 1 MB"):
        content_of("/dev/zero")
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(bytes((1 << 20) + 1))))
    with pytest.raises(DataError, match="stdin: is larger"):
        content_of("-")
