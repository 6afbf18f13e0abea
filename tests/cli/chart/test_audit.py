import csv
import io
import json

import pytest

from evenbreak.answers.chart.audit import other_chart
from evenbreak.ratings.scale import scale_of

ROWS = "difference_from,difference_to,stronger_needs,weaker_needs\n"


@pytest.fixture
def ask(run):
    def asked(*words, stdin=None):
        result = run("chart", "audit", "--json", *words, stdin=stdin)
        assert result.exit_code == 0, result.stderr
        return json.loads(result.stdout)

    return asked


@pytest.fixture
def ours(tmp_path):
    path = tmp_path / "ours.csv"
    path.write_text(ROWS + "0,4,5,5\n6,14,5,4\n12,20,6,4\n21,,5,4\n", encoding="utf-8")
    return str(path)


def test_the_scale_that_fits_best(ask):
    answer = ask("npl_10")
    assert answer["best_fit"]["points_per_doubling"] == pytest.approx(30.0, abs=0.4)
    assert answer["best_fit"]["tilt"] == pytest.approx(0.5, abs=0.03)
    assert answer["fit"] == answer["best_fit"]
    assert [row["stronger_needs"] for row in answer["rows"]] == [5, 5, 6, 5, 6, 7, 6, 7]
    assert (answer["gaps"], answer["overlaps"]) == ([], [])


def test_a_given_scale(ask):
    answer = ask("fargo_r6_hot", "--scale", "fargo")
    assert answer["points_per_doubling"] == 100.0
    assert answer["rows"][3]["even_difference"] == pytest.approx(86.09, abs=0.005)
    assert answer["fit"] != answer["best_fit"]


def test_csv_has_a_row_a_race_and_the_verdict_goes_beside_it(run):
    result = run("chart", "audit", "npl_8", "--scale", "npl")
    rows = list(csv.DictReader(io.StringIO(result.stdout)))
    assert list(rows[-1].values())[:4] == ["49", "", "6", "2"]
    assert {row["monotone"] for row in rows} == {"yes"}
    assert "npl_8" in result.stderr


def test_gaps_overlaps_and_easier_rows_of_a_file(run, ask, ours):
    answer = ask(ours, "--scale", "npl")
    assert (answer["gaps"], answer["overlaps"]) == ([[5, 5]], [[12, 14]])
    assert [row["monotone"] for row in answer["rows"]] == [True, True, True, False]
    assert len(answer["warnings"]) == 2
    assert f"Warning: {ours}:3: row 2 starts at 6" in run("chart", "audit", ours).stderr


def test_skill_levels(run, ask):
    answer = ask("apa_8ball", "--scale", "fargo")
    assert [round(one["rating"]) for one in answer["levels"]] == [0, 44, 101, 149, 184, 223]
    assert len(answer["cells"]) == 21
    assert len(run("chart", "audit", "apa_8ball").stdout.splitlines()) == 22


@pytest.mark.parametrize(("beside", "points"), [("npl_8", 30.0), ("fargo_r6_hot", 100.16)])
def test_the_chart_beside_is_on_the_same_scale_if_it_was_made_for_about_that(beside, points):
    other = other_chart(beside, scale_of("npl"))
    assert other.scale.points_per_doubling == pytest.approx(points, abs=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("ending", ["png", "svg"])
def test_plots(run, tmp_path, ending):
    path = tmp_path / f"audit.{ending}"
    for more in ([], ["--beside", "npl_12"], ["--beside", "fargo_r6_hot"]):
        result = run("chart", "audit", "npl_10", "--plot", str(path), *more)
        assert result.exit_code == 0
        assert f"Wrote {path}" in result.stderr
        assert path.stat().st_size > 1000
        path.unlink()


@pytest.mark.parametrize(
    ("line", "code", "wrong"),
    [
        ("", 2, "NAME_OR_FILE"),
        ("npl_9", 3, "npl_9"),
        ("npl_8 --scale 0", 2, "--scale"),
        ("npl_8 --beside npl_10", 2, "--plot FILE"),
        ("npl_8 --plot x.pdf", 2, "x.pdf"),
        ("npl_8 --plot x.png --beside apa_8ball", 2, "--beside"),
        ("apa_8ball --plot x.png", 2, "--plot"),
    ],
)
def test_wrong_use_is_named(run, line, code, wrong):
    result = run("chart", "audit", *line.split())
    assert (result.exit_code, result.stdout) == (code, "")
    assert wrong in result.stderr


def test_a_chart_that_determines_no_scale_needs_one(run):
    short = ROWS + "0,9,5,5\n10,,5,4\n"
    result = run("chart", "audit", "-", stdin=short)
    assert (result.exit_code, result.stdout) == (2, "")
    assert "scale is missing" in result.stderr
    assert run("chart", "audit", "-", "--scale", "npl", stdin=short).exit_code == 0


@pytest.mark.slow
def test_a_chart_of_points(run, ask, tmp_path):
    assert ask("apa_9ball")["levels"][4]["points"] == 38
    path = tmp_path / "nine.csv"
    path.write_text(run("chart", "show", "apa_9ball").stdout, encoding="utf-8")
    assert ask(str(path))["levels"] == ask("apa_9ball")["levels"]
    path.write_text("level,points\n1,14\n2,9\n", encoding="utf-8")
    assert (
        "points0/nine.csv: isn't a valid points chart: points must increase; 9 comes after 14"
        in run("chart", "audit", str(path)).stderr
    )
    for words in (["--scale", "npl"], ["--plot", "x.png"]):
        assert run("chart", "audit", "apa_9ball", *words).exit_code == 2
    beside = ["--plot", str(tmp_path / "x.png"), "--beside", "apa_9ball"]
    assert run("chart", "audit", "npl_8", *beside).exit_code == 2


def test_points_are_not_games(run):
    result = run("ladder", "--chart", "apa_9ball")
    assert (result.exit_code, result.stdout) == (2, "")
    assert "apa_9ball" in result.stderr
