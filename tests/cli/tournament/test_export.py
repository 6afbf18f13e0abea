"""The matches of a tournament, as they are exported for the ratings."""


def test_a_forfeit_is_no_match_that_was_played(run, tmp_path):
    entrants, path = tmp_path / "entrants.csv", str(tmp_path / "tonight.db")
    entrants.write_text("player,rating\nAnn,600\nBo,560\nCy,520\nDi,500\n")
    asked = ("--race", "3", "--tables", "2", "--format", "single", "--out", path)
    for words in (
        ("tournament", "new", str(entrants), *asked),
        ("tournament", "draw", "--file", path),
        ("tournament", "forfeit", "Di", "--file", path),
    ):
        assert run(*words).exit_code == 0
    said = run("tournament", "export", "--file", path, "--text").stdout
    assert "0 matches were played, 1 forfeited." in said
