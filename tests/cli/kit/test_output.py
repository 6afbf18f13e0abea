from evenbreak.cli.kit.output import aligned, say


def test_wide_letters_take_their_columns():
    rows = [["Ann", "5"], ["🎱 Bo", "12"], ["李娜", "3"], ["Zoe\u0308", "4"]]
    assert aligned(rows).splitlines() == [
        "  Ann     5",
        "  🎱 Bo  12",
        "  李娜    3",
        "  Zoe\u0308     4",
    ]


def test_flush_right_too():
    assert aligned([["🎱", "1"], ["abc", "2"]], left=0) == "   🎱  1\n  abc  2\n"


def test_what_is_said_stays_on_its_line(capsys):
    say("No such file: a\nb\x1b.csv")
    assert capsys.readouterr() == ("", "No such file: a\\nb\\x1b.csv\n")


def test_what_is_said_is_broken_between_words_on_a_terminal(capsys, monkeypatch):
    said = "Wrote " + ", ".join(f"table_{k}.csv" for k in range(20)) + " to /" + "x" * 100
    say(said)
    assert capsys.readouterr().err == f"{said}\n"
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    say(said)
    told = capsys.readouterr().err
    assert told.split() == said.split()
    assert all(len(line) <= 80 for line in told.splitlines()[:-1])
    assert len(told.splitlines()) > 2
