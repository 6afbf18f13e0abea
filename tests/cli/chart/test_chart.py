import json

import click
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.cli.chart import COMMANDS as CHART_COMMANDS
from evenbreak.cli.chart import audit as chart_audit
from evenbreak.cli.chart import chart
from evenbreak.handicaps import CHARTS, LEVEL_CHARTS
from evenbreak.ratings.scale import scale_of

ROWS = "difference_from,difference_to,stronger_needs,weaker_needs\n"


@pytest.fixture
def ours(tmp_path):
    path = tmp_path / "ours.csv"
    path.write_text(ROWS + "0,4,5,5\n6,14,5,4\n12,20,6,4\n21,,5,4\n", encoding="utf-8")
    return path


def test_the_group_lists_its_commands_and_imports_none(run):
    output = run("chart", "--help").output
    for name, line in CHART_COMMANDS.items():
        assert f"{name} " in output
        assert line in output
    assert run("chart", "audiit").exit_code == 2


@pytest.mark.parametrize("name", CHART_COMMANDS)
def test_every_command_of_the_group_exists(name):
    command = chart.get_command(click.Context(chart), name)
    assert command.name == name
    for option in command.params:
        assert isinstance(option, click.Argument) or option.help


def test_list(run):
    charts = json.loads(run("chart", "list", "--json").stdout)["charts"]
    by_name = {one["chart"]: one for one in charts}
    assert by_name["npl_20"]["longest_games"] == 19
    assert by_name["fargo_r6_hot"]["races"] == 7
    assert by_name["apa_8ball"]["looked_up_by"] == "skill level"
    lines = run("chart", "list").stdout.splitlines()
    assert lines[0] == "chart,what,looked_up_by,races,longest_games"
    assert {line.count(",") for line in lines} == {4}


def test_list_has_every_chart(run):
    lines = run("chart", "list").stdout.splitlines()[1:]
    assert {line.partition(",")[0] for line in lines} == {*CHARTS, *LEVEL_CHARTS}


@pytest.mark.parametrize("name", ["npl_10", "fargo_r6_hot", "apa_8ball"])
def test_what_show_pipes_out_show_reads_in(run, tmp_path, name):
    shown = run("chart", "show", name).stdout
    path = tmp_path / "copy.csv"
    path.write_text(shown, encoding="utf-8")
    assert run("chart", "show", str(path)).stdout == shown
    assert run("chart", "show", "-", stdin=shown).stdout == shown


def test_show_as_json(run):
    told = json.loads(run("chart", "show", "npl_8", "--json").stdout)
    assert told["chart"] == "npl_8"
    assert told["rows"][-1] == {
        "difference_from": 49,
        "difference_to": None,
        "stronger_needs": 6,
        "weaker_needs": 2,
    }


def test_show_refuses_what_is_no_chart_with_all_that_is_wrong(run, ours):
    result = run("chart", "show", str(ours))
    assert (result.exit_code, result.stdout) == (3, "")
    assert f"{ours}:3: row 2 begins at 6 and row 1 ends at 4" in result.stderr
    assert f"{ours}:4: row 3 begins at 12 and row 2 ends at 14" in result.stderr


def test_audit_as_json(run):
    told = json.loads(run("chart", "audit", "npl_10", "--json").stdout)
    assert told["best_fit"]["points_per_doubling"] == pytest.approx(30.0, abs=0.4)
    assert told["best_fit"]["tilt"] == pytest.approx(0.5, abs=0.03)
    assert told["fit"] == told["best_fit"]
    assert [row["stronger_needs"] for row in told["rows"]] == [5, 5, 6, 5, 6, 7, 6, 7]
    assert (told["gaps"], told["overlaps"]) == ([], [])


def test_audit_on_a_scale(run):
    told = json.loads(run("chart", "audit", "fargo_r6_hot", "--scale", "fargo", "--json").stdout)
    assert told["points_per_doubling"] == 100.0
    assert told["rows"][3]["even_difference"] == pytest.approx(86.09, abs=0.005)


def test_audit_as_csv_with_the_verdict_beside_it(run):
    result = run("chart", "audit", "npl_8", "--scale", "npl")
    lines = result.stdout.splitlines()
    assert lines[0].startswith(
        "difference_from,difference_to,stronger_needs,weaker_needs,p_win_low"
    )
    assert lines[-1].startswith("49,,6,2,0.4")
    assert lines[-1].endswith(",yes")
    assert "On the scale given (30 points): tilt" in result.stderr
    assert "No gaps, no overlaps" in result.stderr


def test_audit_tells_gaps_overlaps_and_easier_rows_of_a_file(run, ours):
    result = run("chart", "audit", str(ours), "--scale", "npl")
    assert result.exit_code == 0
    assert "Differences in no row: 5.\n" in result.stderr
    assert "Differences in more than one row: 12 to 14.\n" in result.stderr
    assert "Not harder than an earlier race: 5:4 (21 and more)." in result.stderr
    assert f"Warning: {ours}:3: row 2 begins at 6" in result.stderr
    told = json.loads(run("chart", "audit", str(ours), "--scale", "npl", "--json").stdout)
    assert (told["gaps"], told["overlaps"]) == ([[5, 5]], [[12, 14]])
    assert [row["monotone"] for row in told["rows"]] == [True, True, True, False]


def test_audit_of_skill_levels(run):
    told = json.loads(run("chart", "audit", "apa_8ball", "--scale", "fargo", "--json").stdout)
    assert [round(one["rating"]) for one in told["levels"]] == [0, 44, 101, 149, 184, 223]
    assert len(told["cells"]) == 21
    result = run("chart", "audit", "apa_8ball")
    assert len(result.stdout.splitlines()) == 22
    assert "Most unfair: level 7 v 4, 5:2" in result.stderr


def test_the_most_unfair_race_with_the_end_of_its_band_that_is_worse(run):
    early = ROWS + "0,2,5,5\n3,8,6,4\n9,25,6,4\n26,,7,4\n"
    told = run("chart", "audit", "-", "--scale", "npl", stdin=early).stderr
    assert "Most unfair: 6:4 at a difference of 3, where the stronger wins 0.289" in told
    told = run("chart", "audit", "npl_10").stderr
    assert "Most unfair: 7:3 at a difference of 46, where the stronger wins 0.57" in told


@pytest.mark.parametrize(("beside", "points"), [("npl_8", 30.0), ("fargo_r6_hot", 100.16)])
def test_the_chart_beside_is_on_the_same_scale_if_it_was_made_for_about_that(beside, points):
    other = chart_audit.other_chart(beside, scale_of("npl"))
    assert other.scale.points_per_doubling == pytest.approx(points, abs=0.01)


@pytest.mark.parametrize("ending", ["png", "svg"])
def test_pictures(run, tmp_path, ending):
    path = tmp_path / f"audit.{ending}"
    for more in ([], ["--beside", "npl_12"], ["--beside", "fargo_r6_hot"]):
        result = run("chart", "audit", "npl_10", "--plot", str(path), *more)
        assert result.exit_code == 0
        assert f"Wrote {path}" in result.stderr
        assert path.stat().st_size > 1000
        path.unlink()


@pytest.mark.parametrize(
    ("line", "code", "remedy"),
    [
        ("audit", 2, "Missing argument"),
        ("audit npl_9", 3, "name a file, or fargo_r6_hot, npl_8"),
        ("audit npl_8 --scale 0", 2, "give npl, fargo, elo"),
        ("audit npl_8 --beside npl_10", 2, "give --plot FILE"),
        ("audit npl_8 --plot x.pdf", 2, ".png or .svg"),
        ("audit npl_8 --plot x.png --beside apa_8ball", 2, "no rating differences"),
        ("audit apa_8ball --plot x.png", 2, "leave --plot out"),
        ("show npl_8 npl_10", 2, "unexpected extra argument"),
        ("list npl_8", 2, "unexpected extra argument"),
    ],
)
def test_wrong_use_says_how_to_mend_it(run, line, code, remedy):
    result = run("chart", *line.split())
    assert (result.exit_code, result.stdout) == (code, "")
    assert remedy in result.stderr


def test_a_chart_that_tells_no_scale(run):
    short = ROWS + "0,9,5,5\n10,,5,4\n"
    result = run("chart", "audit", "-", stdin=short)
    assert (result.exit_code, result.stdout) == (2, "")
    assert "scale is missing" in result.stderr
    assert run("chart", "audit", "-", "--scale", "npl", stdin=short).exit_code == 0


words = st.sampled_from(
    ["list", "show", "audit", "npl_8", "apa_8ball", "--scale", "fargo", "--json", "--beside", "-"]
) | st.text(max_size=3)


@given(st.lists(words, max_size=5))
def test_no_words_make_a_traceback(run, line):
    assert run("chart", *line).exit_code in (0, 2, 3)
