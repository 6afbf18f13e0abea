"""A file read piece by piece: whatever the pieces are, it says what it says as a whole."""

import io
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from evenbreak.errors import DataError
from evenbreak.files import read_results
from evenbreak.files.tables import rows as module
from evenbreak.files.tables.rows import content_of, csv_rows, head_of, text_of

CELLS = st.sampled_from(
    ["Ann", "Zoë", "7", "", " ", "\u2028", "a,b", 'x"y', "two\nlines", "\u00ad"]
)
LOOSE = st.sampled_from(["Ann", "é", ",", ";", "\n", "\r\n", "\r", '"', "7", "\t", "sep=;", "\0"])
ENCODINGS = st.sampled_from(["utf-8", "utf-8-sig", "cp1252", "utf-16", "utf-16-be"])


class Trickle(io.RawIOBase):
    """A file of which no more than some bytes come at once."""

    def __init__(self, stream, most):
        self.stream, self.most = stream, most

    def readable(self):
        return True

    def close(self):
        self.stream.close()
        super().close()

    def readinto(self, place):
        piece = self.stream.read(min(self.most, len(place)))
        place[: len(piece)] = piece
        return len(piece)


def told(content):
    """Return all that is read of a file, or why it is refused."""
    try:
        text = text_of(content, "r.csv")
        unreadable = []
        parts = list(csv_rows(text.body, text.encoding, ",", unreadable))
    except DataError as error:
        return error.problems
    lines = [line for part, _ in parts for line in part]
    cells = [row for _, part in parts for row in part]
    return text.encoding, text.warnings, lines, cells, unreadable


def in_pieces(monkeypatch, most):
    """Let every file be read in pieces of so many bytes."""
    stream = module._stream
    monkeypatch.setattr(module, "MOST_BYTES", 0)
    monkeypatch.setattr(module, "PIECE", most)
    monkeypatch.setattr(module, "_stream", lambda content: Trickle(stream(content), most))


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(
    st.one_of(
        st.lists(st.lists(CELLS, min_size=1, max_size=3), max_size=6).map(
            lambda table: "\n".join(
                ",".join('"' + cell.replace('"', '""') + '"' for cell in row) for row in table
            )
        ),
        st.lists(LOOSE, max_size=20).map("".join),
    ),
    ENCODINGS,
    st.binary(max_size=2),
    st.integers(1, 9),
)
def test_any_piece_size_gives_what_the_whole_gives(tmp_path, text, encoding, damage, most):
    mark = "\ufeff" if encoding == "utf-16-be" else ""
    content = (mark + text).encode(encoding, "replace") + damage
    path = Path(tmp_path / "r.csv")
    path.write_bytes(content)
    whole = told(content)
    with pytest.MonkeyPatch.context() as patched:
        in_pieces(patched, most)
        assert told(path) == whole


SEASON = (
    "Date;Player A;Player B;Score A;Score B\r\n"
    '2024-09-03;"Zoë ""Z"" Lee";Bo;5;7\r\n\r\n'
    '2024-09-04;"Bo\r\n";Ann;7;2\r\n'
    "2024-09-04;Ann;Bo;7;5\r\n"
)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "utf-16"])
@pytest.mark.parametrize("more", ["", "2024-09-05;Ann;Bo;x;5\r\n", "2024-09-05;Ann;Bo;7\r\n"])
def test_results_and_their_refusals_are_the_same_at_every_border(
    monkeypatch, tmp_path, encoding, more
):
    path = tmp_path / "r.csv"
    path.write_bytes((SEASON + more).encode(encoding))

    def read():
        try:
            file = read_results(path)
        except DataError as error:
            return error.problems
        results = file.results
        columns = (results.player_a, results.score_b, results.date, file.lines)
        return results.players, [column.tolist() for column in columns], file.warnings, file.sha256

    whole = read()
    assert bool(more) == any("r.csv:7: " in text for text in whole)
    for most in (1, 2, 3, 7, 50):
        with monkeypatch.context() as patched:
            in_pieces(patched, most)
            assert read() == whole


def test_a_large_file_is_not_held_in_memory(monkeypatch, tmp_path):
    path = tmp_path / "r.csv"
    path.write_text(SEASON, encoding="utf-8")
    monkeypatch.setattr(module, "MOST_BYTES", 10)
    assert module.table_content(path) == (str(path), path)
    with pytest.raises(DataError, match="larger than"):
        content_of(path)
    assert head_of(path) == path.read_bytes()


@pytest.mark.parametrize("content", [b"PK\x03\x04rest", b'{"a": 1}', b"\xef\xbb\xbf [1]"])
def test_only_text_may_be_large(monkeypatch, tmp_path, content):
    path = tmp_path / "r.csv"
    path.write_bytes(content)
    monkeypatch.setattr(module, "MOST_BYTES", 2)
    with pytest.raises(DataError, match="larger than"):
        read_results(path)


def test_a_pipe_may_not_be_large(monkeypatch):
    monkeypatch.setattr(module, "MOST_BYTES", 10)
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(SEASON.encode())))
    with pytest.raises(DataError, match="stdin: is larger"):
        read_results("-")
