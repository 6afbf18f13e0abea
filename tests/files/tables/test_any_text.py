"""Whatever bytes a file holds, it is read or refused with lines that a person can use."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import DataError
from evenbreak.files.arcs import read_arcs
from evenbreak.files.charts import read_chart, read_chart_file
from evenbreak.files.csv_writer import text_cell
from evenbreak.files.lists.roster import read_roster
from evenbreak.files.lists.season import read_pairs, read_schedule, read_season_players
from evenbreak.files.practice import read_drill_log, read_scores
from evenbreak.files.results.aliases import read_aliases
from evenbreak.files.results.results_file import read_results
from evenbreak.files.tables.names import clean_name
from evenbreak.files.tables.problems import printable
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster


def pairs(path):
    return read_pairs(path, Roster(["Ann", "Bo"], [90, 80]))


def schedule(path):
    return read_schedule(path, Roster(["Ann", "Bo"], [90, 80]))


RESULTS = (
    "date,player_a,player_b,score_a,score_b,race_a,race_b,winner,first_break,break_format,racks,"
    "event,forfeit\n2026-11-20,Ann,Bo,2,1,2,2,a,Bo,winner,aba,Cup,\n2026-11-20,Bo,Ann,,,,,,,,,,x\n"
)
READERS = {
    "results": (read_results, RESULTS),
    "racks": (read_results, "player_a,player_b,racks\nAnn,Bo,abba\n"),
    "races": (read_results, "player_a,player_b,race_a,race_b,winner\nAnn,Bo,5,4,b\n"),
    "roster": (
        read_roster,
        "player,rating,standard_error,games,component\nAnn,90.5,4,120,1\nBo,,,0,\n",
    ),
    "league": (
        read_season_players,
        "player,rating,standard_error,matches,skill,day_sd,drift,joins,leaves,absence\n"
        "Ann,90.5,4,12,92,5,0.1,1,20,0.2\nBo,80,,,,,,,,\n",
    ),
    "schedule": (schedule, "week,player_a,player_b\n1,Ann,Bo\n2,Bo,Ann\n"),
    "pairs": (pairs, "player_a,player_b\nAnn,Bo\nBo,Ann\n"),
    "aliases": (read_aliases, "name,means\nAnnie,Ann\nBobby,Bo\n"),
    "chart": (
        read_chart,
        "difference_from,difference_to,stronger_needs,weaker_needs\n0,9,5,5\n10,,5,4\n",
    ),
    "chart to audit": (
        read_chart_file,
        "difference_from,difference_to,stronger_needs,weaker_needs\n0,9,5,5\n12,,5,4\n",
    ),
    "levels": (
        read_chart,
        "level,opponent_level,needs,opponent_needs\n1,1,2,2\n1,2,2,3\n2,2,3,3\n",
    ),
    "arcs": (read_arcs, "source,target,probability\nS,W,0.5\nS,L,0.5\n"),
    "drill log": (read_drill_log, "level,success,session,date\n1,yes,1,2026-11-20\n2,no,,\n"),
    "scores": (read_scores, "score,date\n12.5,2026-11-20\n7,2026-11-21\n"),
}
readers = pytest.mark.parametrize(("reader", "good"), READERS.values(), ids=READERS)

CELLS = st.sampled_from(
    [
        *("", "Ann", "Bo", "ann", "a", "b", "0", "1", "2", "-1", "7.0", "0,5", "1e9", "1e999"),
        *("nan", "inf", "x", "yes", "no", "abba", "2026-11-20", "2026-13-40", "٣", "½", "9" * 30),
        *(
            "=cmd()",
            "'=1+1",
            "דנה",
            "\u202eAnn",
            "🎱",
            "Zoe\u0308",
            "a\u0000b",
            "\x1b[31m",
            "\ufeff",
        ),
        *('"Lee, ""Ann"""', '"two\nlines"', '"', ";", "\t", "\r", "\u2028", "  ", "sep=;"),
    ]
)


def refusal(reader, path):
    """Read a file; return the problems that its refusal tells, or None where it is read."""
    try:
        reader(path)
    except DataError as error:
        return error.problems
    return None


def is_of_use(told, path):
    """Whether a file was read, or refused with problems that name it, on lines that print."""
    source = printable(str(path))
    return told is None or (
        len(told) > 0 and all(line.startswith(source) and line == printable(line) for line in told)
    )


@readers
def test_a_good_file_is_read(tmp_path, reader, good):
    path = tmp_path / "good.csv"
    path.write_text(good, encoding="utf-8")
    assert refusal(reader, path) is None


@pytest.mark.slow_after(5)
@readers
@given(content=st.binary(max_size=200))
def test_any_bytes(tmp_path_factory, reader, good, content):
    path = tmp_path_factory.getbasetemp() / "bytes.csv"
    for whole in (content, good.encode() + content):
        path.write_bytes(whole)
        assert is_of_use(refusal(reader, path), path)


@pytest.mark.slow_after(7)
@readers
@given(text=st.text(max_size=100))
def test_any_text_below_the_header(tmp_path_factory, reader, good, text):
    path = tmp_path_factory.getbasetemp() / "text.csv"
    path.write_bytes(f"{good.partition(chr(10))[0]}\n{text}".encode("utf-8", "replace"))
    assert is_of_use(refusal(reader, path), path)


@readers
@given(data=st.data())
def test_any_cells(tmp_path_factory, reader, good, data):
    path = tmp_path_factory.getbasetemp() / "cells.csv"
    header = good.partition("\n")[0]
    width = header.count(",") + 1
    rows = data.draw(st.lists(st.lists(CELLS, min_size=width, max_size=width), max_size=5))
    path.write_text("\n".join([header, *map(",".join, rows)]), encoding="utf-8", newline="")
    assert is_of_use(refusal(reader, path), path)


@pytest.mark.slow_after(5)
@readers
@given(data=st.data())
def test_a_good_file_with_a_slip(tmp_path_factory, reader, good, data):
    path = tmp_path_factory.getbasetemp() / "slip.csv"
    content = good.encode()
    start = data.draw(st.integers(0, len(content)))
    end = min(len(content), start + data.draw(st.integers(0, 5)))
    slip = data.draw(st.sampled_from([b"", b",", b";", b'"', b"\n", b"\r", b"\xff", b"\0", b"9"]))
    path.write_bytes(content[:start] + slip + content[end:])
    assert is_of_use(refusal(reader, path), path)


# A name without what cleaning takes away, and without characters that no name may have.
NAMES = st.text(st.characters(exclude_categories=["Cc", "Cs"]), min_size=1, max_size=12).map(
    clean_name
)


@given(
    st.lists(
        NAMES | st.sampled_from(['Lee, "Ann"', "=cmd()", "+1", "@x", "דנה כהן", "🎱", "'t Hooft"]),
        min_size=2,
        max_size=5,
        unique=True,
    ).filter(lambda names: all(names) and all(name == clean_name(name) for name in names))
)
def test_names_come_back_as_they_were_written(tmp_path_factory, names):
    path = tmp_path_factory.getbasetemp() / "names.csv"
    cells = list(map(text_cell, names))
    path.write_bytes("\n".join(["player,rating", *(f"{cell},80" for cell in cells)]).encode())
    assert read_roster(path).roster.players == tuple(names)
    rows = [f"{cells[0]},{cell},5,3" for cell in cells[1:]]
    path.write_bytes("\n".join(["player_a,player_b,score_a,score_b", *rows]).encode())
    results: Results = read_results(path).results
    assert results.players == tuple(sorted(names))
