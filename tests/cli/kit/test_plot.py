"""The option --plot, which is checked before any work is done."""

import pytest


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("new/dir/x.png", "Create it or choose"),
        ("file/x.png", "is a file"),
        ("folder.png", "that's a folder"),
        ("x.pdf", "ends in .png or .svg"),
    ],
)
@pytest.mark.parametrize("words", ["ladder", "breaks --p1 0.9 --p2 0.5", "chart audit npl_10"])
def test_an_impossible_picture_is_refused_before_the_work(run, tmp_path, words, name, problem):
    (tmp_path / "file").write_text("1", encoding="utf-8")
    (tmp_path / "folder.png").mkdir()
    result = run(*words.split(), "--plot", str(tmp_path / name))
    assert (result.exit_code, result.stdout) == (2, "")
    assert problem in " ".join(result.stderr.split())
    assert not (tmp_path / "new").exists()
