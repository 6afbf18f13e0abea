from evenbreak.answers.kit.remarks import warnings_of
from evenbreak.files.results.results_file import ResultsFile
from leagues import league


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


def test_other_warnings_can_be_given():
    file = ResultsFile(league(2), "folder/season.csv", ("folder/season.csv: own",), (), "")
    (one,) = warnings_of(file, ["the ratings look like Fargo ratings"])
    assert str(one) == "Warning: the ratings look like Fargo ratings."
