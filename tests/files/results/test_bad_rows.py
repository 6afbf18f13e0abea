import pytest

from evenbreak.errors import DataError
from evenbreak.files import read_results, read_seasons

HEAD = "date,player_a,player_b,score_a,score_b\n"
GOOD = "".join(f"2024-09-{day:02d},Ann,Bo,7,{day % 7}\n" for day in range(1, 31))


def season(tmp_path, rows):
    path = tmp_path / "season.csv"
    path.write_text(HEAD + GOOD + rows)
    return path


def test_rows_that_cannot_be_read_are_left_out_and_listed(tmp_path):
    path = season(tmp_path, "2024-10-01,Ann,Cy,seven,5\n2024-10-02,Ann,Ann,7,5\n2024-10-03,Ann\n")
    with pytest.raises(DataError) as refused:
        read_results(path)
    assert len(refused.value.problems) == 3
    found = read_results(path, skip_bad=True)
    assert len(found.results) == len(found.lines) == 30
    assert found.results.players == ("Ann", "Bo")  # nobody whose only match is left out
    texts = "\n".join(found.warnings)
    assert "3 rows were left out" in texts
    assert all(f"season.csv:{line}: " in texts for line in (32, 33, 34))
    assert "'seven'" in texts


def test_a_file_without_its_columns_is_refused_all_the_same(tmp_path):
    path = tmp_path / "season.csv"
    path.write_text("player_a,player_b\nAnn,Bo\n")
    with pytest.raises(DataError, match="score_a"):
        read_results(path, skip_bad=True)


def test_a_file_of_bad_rows_alone_is_refused(tmp_path):
    path = tmp_path / "season.csv"
    path.write_text(HEAD + "2024-10-01,Ann,Cy,seven,5\n")
    with pytest.raises(DataError, match="seven"):
        read_results(path, skip_bad=True)


def test_points_among_racks_are_named_and_left_out_on_request(tmp_path):
    path = season(tmp_path, "2024-10-01,Ann,Cy,67,45\n2024-10-02,Ann,Bo,13,2\n")
    found = read_results(path)
    assert len(found.results) == 32
    assert any("season.csv:32: 67-45" in text for text in found.warnings)
    assert not any(":33:" in text for text in found.warnings)
    kept = read_results(path, skip_bad=True)
    assert len(kept.results) == 31
    assert kept.results.score_a.max() == 13
    assert any("season.csv:32: 67-45" in text for text in kept.warnings)


def test_a_long_race_that_is_stated_is_no_mistake(tmp_path):
    path = tmp_path / "season.csv"
    rows = GOOD.replace("\n", ",,\n") + "2024-10-01,Ann,Bo,100,83,100,100\n"
    path.write_text(HEAD[:-1] + ",race_a,race_b\n" + rows)
    assert not read_results(path).warnings


def test_rows_left_out_are_counted(tmp_path):
    typed = tmp_path / "typed.csv"
    typed.write_text(f"{HEAD},Ann,Bo,7,4\n,Bo,Cy,x,7\n,Cy,Ann,3,7\n")
    later = tmp_path / "later.csv"
    later.write_text(f"{HEAD},Ann,Bo,,4\n,Bo,Cy,2,7\n")
    assert read_results(typed, skip_bad=True).skipped == 1
    assert read_seasons([typed, later], skip_bad=True).skipped == 2


def test_a_high_score_without_a_race_is_named_where_other_rows_have_races(tmp_path):
    path = tmp_path / "mixed.csv"
    rows = [*["Ann,Bo,7,5,7,7\n"] * 60, "Ann,Bo,67,45,,\n", "Ann,Bo,67,45,67,67\n"]
    path.write_text("player_a,player_b,score_a,score_b,race_a,race_b\n" + "".join(rows))
    doubts = [text for text in read_results(path).warnings if "67-45" in text]
    assert [text.split(": ")[0] for text in doubts] == [f"{path}:62"]
    assert read_results(path, skip_bad=True).skipped == 1


def test_rows_with_too_many_or_too_few_cells_count_as_left_out(tmp_path):
    path = tmp_path / "ragged.csv"
    path.write_text(
        "player_a,player_b,score_a,score_b\nAnn,Bo,7,5\nAnn,Bo,7\nAnn,Bo,x,5\nAnn,Bo,7,5,9\n"
    )
    found = read_results(path, skip_bad=True)
    assert (found.skipped, len(found.results)) == (3, 1)
    assert "3 rows were left out" in found.warnings[0]
