"""Every command that reads results takes them in any format, with the same options."""

import json

import pytest

TABLE = """Thursday league, autumn

Spieltag;Sieger;Verlierer;Stand
9/3/2026;Ann;Bo;7-5
9/10/2026;Bo;Cy;7-3
9/12/2026;Cy;Ann;7:6
10/1/2026;Ann;Cy;7/2
10/8/2026;Bo;Ann;W/O
"""
OPTIONS = ("--columns", "winner=Sieger,loser=Verlierer,score=Stand,date=Spieltag", "--dates", "mdy")
ROSTER = "player,rating\nAnn,90\nBo,80\nCy,70\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "season.csv").write_bytes(TABLE.encode("utf-16"))
    (tmp_path / "roster.csv").write_text(ROSTER)
    return tmp_path


@pytest.mark.slow_after(2)
@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    "words",
    [
        ("rate", "season.csv", "--json"),
        ("rate", "--system", "npl", "--roster", "roster.csv", "season.csv", "--json"),
        ("report", "season.csv", "--out", "sheet", "--json"),
        ("validate", "season.csv", "--json"),
        ("sandbag", "watch", "season.csv", "--roster", "roster.csv", "--json"),
    ],
)
def test_each_command_reads_it(run, words):
    result = run(*words, *OPTIONS)
    assert json.loads(result.stdout)
    assert "season.csv:3: the header is in this line" in result.stderr
    refused = run(*words, *OPTIONS[:2])
    assert (refused.exit_code, "--dates mdy" in refused.stderr) == (3, True)
    refused = run(*words)
    assert (refused.exit_code, '--columns "' in refused.stderr) == (3, True)


@pytest.mark.usefixtures("folder")
def test_as_of_goes_by_the_same_order(run):
    words = ("rate", "season.csv", "--json", *OPTIONS[:2])
    for as_of, day in (("9/12/2026", "2026-09-12"), ("2026-10-01", "2026-10-01")):
        found = json.loads(run(*words, "--as-of", as_of, "--dates", "mdy").stdout)
        assert found["as_of"] == day
    assert run(*words, "--as-of", "9/12/2026").exit_code == 2


def test_a_column_that_there_is_none_of_is_a_wrong_option(run, folder):
    refused = run("rate", str(folder / "season.csv"), "--columns", "place=X")
    assert (refused.exit_code, "'place'" in refused.stderr) == (2, True)
