import numpy as np
import pytest

from evenbreak.errors import DataError
from evenbreak.files.practice import read_scores


@pytest.fixture
def read(tmp_path):
    def read_text(text):
        path = tmp_path / "scores.csv"
        path.write_text(text, encoding="utf-8")
        return read_scores(path)

    return read_text


def problems(read, text):
    with pytest.raises(DataError) as caught:
        read(text)
    return [
        problem.partition("scores.csv")[2].partition(";")[0] for problem in caught.value.problems
    ]


def test_scores_with_dates_in_the_order_of_the_file(read):
    file = read("date,score\n2024-09-10,44\n2024-09-03 19:30,50.5\n")
    assert file.scores.tolist() == [44.0, 50.5]
    assert file.dates.tolist() == np.array(["2024-09-10", "2024-09-03"], "M8[D]").tolist()
    assert file.warnings == ()


def test_scores_alone(read):
    for text in ("score\n-3\n4\n", "Points\n-3\n4\n", "score,date\n-3,\n4,\n"):
        file = read(text)
        assert (file.scores.tolist(), file.dates, file.warnings) == ([-3.0, 4.0], None, ())


def test_some_dates_are_no_dates(read):
    file = read("date,score\n2024-09-10,44\n,45\n,46\n")
    assert file.dates is None
    assert "scores.csv:3: 2 dates" in file.warnings[0]
    one = read("date,score\n2024-09-10,44\n,45\n")
    assert "scores.csv:3: the date" in one.warnings[0]


def test_all_problems_at_once(read):
    text = "date,score\n2024-09-03,fifty\n3/9/2024,48\n2024-02-30,\n2024-09-24,1e12\n"
    assert problems(read, text) == [
        (
            ":2: score 'fifty' isn't a number from -1,000,000,000 to 1,000,000,000. "
            "Write a score such as 48."
        ),
        (
            ":3: date '3/9/2024' may have the month or the day first, and no date in the file "
            "shows which. Add dates mdy (month first) or dates dmy (day first)."
        ),
        ":4: score is empty. Write a score such as 48.",
        (
            ":4: date '2024-02-30' isn't a date. Write 2024-09-03, 3.9.2024 or 9/3/2024, "
            "or leave it empty."
        ),
        (
            ":5: score '1e12' isn't a number from -1,000,000,000 to 1,000,000,000. Write "
            "a score such as 48."
        ),
    ]


def test_no_scores(read):
    assert problems(read, "score\n") == [
        ": has no scores below its header. Write one line for each."
    ]
    (problem,) = problems(read, "date,mark\n2024-09-03,5\n")
    assert problem == (
        ":1: there's no column 'score' among 'date', 'mark'. Add it (it may also be "
        "called 'points', 'result' or 'total')."
    )
