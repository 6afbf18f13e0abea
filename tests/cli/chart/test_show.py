import json

import pytest


@pytest.mark.parametrize("name", ["npl_10", "fargo_r6_hot", "apa_8ball"])
def test_what_show_pipes_out_show_reads_in(run, tmp_path, name):
    shown = run("chart", "show", name).stdout
    path = tmp_path / "copy.csv"
    path.write_text(shown, encoding="utf-8")
    assert run("chart", "show", str(path)).stdout == shown
    assert run("chart", "show", "-", stdin=shown).stdout == shown


def test_json(run):
    answer = json.loads(run("chart", "show", "npl_8", "--json").stdout)
    assert answer["chart"] == "npl_8"
    assert answer["rows"][-1] == {
        "difference_from": 49,
        "difference_to": None,
        "stronger_needs": 6,
        "weaker_needs": 2,
    }


def test_a_file_that_is_not_a_chart_is_refused_with_all_its_problems(run, tmp_path):
    path = tmp_path / "ours.csv"
    path.write_text("from,to,stronger,weaker\n0,4,5,5\n6,14,5,4\n12,20,6,4\n21,,5,4\n")
    result = run("chart", "show", str(path))
    assert (result.exit_code, result.stdout) == (3, "")
    assert f"{path}:3: row 2 starts at 6" in result.stderr
    assert f"{path}:4: row 3 starts at 12" in result.stderr


def test_one_chart_at_a_time(run):
    assert run("chart", "show", "npl_8", "npl_10").exit_code == 2
