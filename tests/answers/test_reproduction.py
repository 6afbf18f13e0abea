from evenbreak.answers.written import MEANINGS, reproduction_answer


def test_numbers_are_counted_and_files_too():
    verdicts = {"agrees": 1000, "formula": 100, "erratum": 2, "derived": 3}
    files = ["index.md", "physics.md", "a.csv", "b.csv", "c.png", "c.svg"]
    answer = reproduction_answer("text", verdicts, files)
    found = answer.to_dict()
    assert {row["verdict"]: row["numbers"] for row in found["verdicts"]} == verdicts
    assert [row["verdict"] for row in found["verdicts"]] == [
        name for name in MEANINGS if name in verdicts
    ]
    assert (found["tables"], found["figures"]) == (2, 1)
    for words in ("1,105", "1,100", "2 are wrong", "text/index.md or text/physics.md"):
        assert words in answer.sentences[0]
