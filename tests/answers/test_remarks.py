from evenbreak.answers.remarks import Remark, warnings_of
from evenbreak.files.results import ResultsFile
from leagues import league


def test_many_names_are_cut_and_counted():
    remark = Remark("8 players without a result", "rated at the mean", [f"P{k}" for k in range(8)])
    assert str(remark).endswith("(P0, P1, P2, P3, P4 and 3 more): rated at the mean.")
    assert (list(remark.shown_names), remark.more_names) == (["P0", "P1", "P2", "P3", "P4"], 3)


def test_warnings_do_not_name_the_folder_of_the_file():
    warnings = (
        "folder/season.csv: columns not used: 'x'",
        "folder/season.csv:7: 1 row is again",
        "aliases.csv: is not UTF-8",
    )
    file = ResultsFile(league(2), "folder/season.csv", warnings, (), "")
    said = [(one.what.partition("about ")[2], one.why) for one in warnings_of(file)]
    assert said == [
        ("season.csv", "columns not used: 'x'"),
        ("season.csv", "line 7: 1 row is again"),
        ("", "aliases.csv: is not UTF-8"),
    ]
