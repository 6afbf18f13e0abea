"""`evenbreak sandbag`: what it pays, who is flagged, how soon."""

import csv
import json
from pathlib import Path

import pytest

from places import DATA

SEASON = (str(DATA / "demo_sandbag.csv"), "--roster", str(DATA / "demo_sandbag_roster.csv"))


@pytest.fixture
def terminal(monkeypatch):
    for name in ("pay", "watch", "power"):
        monkeypatch.setattr(f"evenbreak.cli.sandbag_{name}.to_terminal", lambda: True)
    monkeypatch.setattr("evenbreak.cli.kit.output.to_terminal", lambda: True)


def table(text):
    return list(csv.DictReader(text.splitlines()))


def test_pay_into_a_pipe(run):
    result = run("sandbag", "pay", "--dumped", "6", "--earnest", "5")
    rows = table(result.stdout)
    assert result.exit_code == 0
    assert [row["dumped"] for row in rows] == [str(k) for k in range(7)]
    assert rows[6]["p_first"] == "0.636719"
    assert rows[0]["break_even"] == ""


@pytest.mark.usefixtures("terminal")
def test_pay_on_a_terminal(run):
    result = run("sandbag", "pay", "--dumped", "2", "--earnest", "4", "--chart", "npl_8")
    lines = result.stdout.splitlines()
    assert lines[0].startswith("npl_8, up 1 point")
    assert max(map(len, lines)) <= 80
    assert any(line.startswith("Most profit:") for line in lines)
    assert "newcomer steps" in " ".join(lines)


@pytest.mark.usefixtures("terminal")
def test_pay_where_nothing_pays(run):
    result = run("sandbag", "pay", "--stake", "0", "--dumped", "1", "--earnest", "2")
    assert "At these stakes none pays." in result.stdout
    assert "For ever" not in result.stdout


def test_pay_as_json(run):
    answer = json.loads(run("sandbag", "pay", "--dumped", "2", "--earnest", "3", "--json").stdout)
    assert answer["schema_version"] == 1
    assert len(answer["p_win"]) == len(answer["rows"]) == 3
    assert len(answer["p_honest"]) == 5
    assert answer["best"]["dumped"] >= 2
    assert set(answer["enters_low"]) == {"established", "newcomer"}


@pytest.mark.usefixtures("terminal")
def test_compare(run):
    result = run("sandbag", "pay", "--compare", "--dumped", "3")
    assert result.stdout.splitlines()[-1].startswith("Least worth gaming at these stakes: npl_")
    answer = json.loads(run("sandbag", "pay", "--compare", "--dumped", "3", "--json").stdout)
    charts = {row["chart"]: row for row in answer["charts"]}
    assert set(charts) == {"npl_8", "npl_10", "npl_12", "npl_20"}
    assert charts["npl_8"]["profit"] < charts["npl_20"]["profit"]


def test_pay_draws(run, tmp_path):
    path = tmp_path / "pay.svg"
    result = run("sandbag", "pay", "--dumped", "4", "--plot", str(path))
    assert result.exit_code == 0
    assert "<svg" in path.read_text()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("pay", "--stake", "much"), "give a number from 0"),
        (("pay", "--dumped", "0"), "give a whole number from 1 to 100"),
        (("pay", "--system", "foo"), "--system is 'foo'"),
        (("pay", "--chart", "apa_8ball"), "skill levels"),
        (("pay", "--compare", "--chart", "npl_8"), "leave --chart"),
        (("power", "--points", "30"), "--share"),
        (("power", "--share", "1.5"), "give a number from 0 to 1"),
        (("watch", "-", "--roster", "-"), "only one file"),
        (("watch", "x.csv"), "Missing option '--roster'"),
        ((*("watch", *SEASON), "--player", "Nobody"), "of whom there is no match"),
        ((*("watch", *SEASON), "--alpha", "1"), "give a number from 1e-09 to 0.5"),
    ],
)
def test_silly_words_are_refused(run, words, message):
    result = run("sandbag", *words)
    assert result.exit_code == 2
    assert message in result.stderr
    assert not result.stdout


def test_an_event_that_is_not_there(run):
    result = run("sandbag", "watch", *SEASON, "--dumps-in", "league")
    assert result.exit_code != 0
    assert "'league' is not in the results; give one of them (Cup, League night)" in result.stderr


def test_watch_into_a_pipe(run):
    rows = table(run("sandbag", "watch", *SEASON, "--dumps-in", "League night").stdout)
    assert len(rows) == 10
    flagged = [row for row in rows if row["flagged"] == "yes"]
    assert [row["player"] for row in flagged] == ["Vito Drago"]
    assert flagged[0]["alarm_match"].isdigit()
    assert flagged[0]["alarm_date"].startswith("2025-")
    assert float(flagged[0]["p_value"]) == pytest.approx(
        1 / float(flagged[0]["largest_e"]), abs=1e-6
    )


@pytest.mark.usefixtures("terminal")
def test_watch_on_a_terminal(run):
    result = run("sandbag", "watch", *SEASON, "--dumps-in", "League night", "--dumps-in", "Cup")
    assert "Evidence is no verdict" in result.stdout
    assert max(map(len, result.stdout.splitlines()[1:])) <= 80
    one = run("sandbag", "watch", *SEASON, "--player", "Vito Drago").stdout.splitlines()
    assert one[0].startswith("Vito Drago: 52 matches")
    assert len(one) == 3 + 52


def test_watch_as_json_and_as_a_picture(run, tmp_path):
    path = tmp_path / "watch.png"
    result = run("sandbag", "watch", *SEASON, "--json", "--plot", str(path))
    answer = json.loads(result.stdout)
    assert (answer["alpha"], answer["honest"], len(answer["players"])) == (0.01, "any", 10)
    assert path.read_bytes().startswith(b"\x89PNG")
    one = json.loads(run("sandbag", "watch", *SEASON, "--json", "--player", "Gus Lindahl").stdout)
    assert len(one["matches"]) == 52


NONE_IN_EARNEST = ("sandbag", "power", "--share", "1", "--replicas", "20", "--matches", "8")


def test_who_plays_no_match_in_earnest_wins_no_part_of_them(run):
    kinds = json.loads(run(*NONE_IN_EARNEST, "--json").stdout)["kinds"]
    assert [kind["p_win"] is None for kind in kinds] == [False, True]
    assert table(run(*NONE_IN_EARNEST).stdout)[-1]["p_win"] == ""


@pytest.mark.usefixtures("terminal")
def test_a_part_that_is_not_known_is_left_empty(run):
    text = run(*NONE_IN_EARNEST).stdout
    assert "100%" in text
    assert "nan" not in text


@pytest.mark.usefixtures("terminal")
def test_power(run):
    words = ("sandbag", "power", "--share", "0.9", "--replicas", "20", "--matches", "8")
    shown = run(*words).stdout
    assert "honest" in shown
    assert "90%" in shown
    answer = json.loads(run(*words, "--json").stdout)
    assert [len(kind["flagged"]) for kind in answer["kinds"]] == [8, 8]


@pytest.mark.usefixtures("terminal")
def test_what_pays_at_least_is_said_of_all_that_can_be_dumped(run):
    shown = run("sandbag", "pay", "--system", "fixed", "--dumped", "2").stdout
    # The table ends long before: with 2 dumped it pays from 25.68.
    assert "2.15 times as much" in " ".join(shown.split())


def test_steps_that_leave_the_ladder(run):
    few = run("sandbag", "pay", "--system", "step 40", "--dumped", "5")
    assert len(table(few.stdout)) == 3
    assert "dumped is 2 at most" in few.stderr
    none = run("sandbag", "pay", "--system", "step 200")
    assert none.exit_code == 2
    assert "smaller steps" in none.stderr


def test_form_that_varies_is_weighed(run):
    words = ("sandbag", "watch", *SEASON, "--dumps-in", "League night", "--day-sd", "30")
    rows = {row["player"]: row for row in table(run(*words).stdout)}
    plain = {row["player"]: row for row in table(run(*words[:-2]).stdout)}
    assert float(rows["Vito Drago"]["e_any"]) < float(plain["Vito Drago"]["e_any"]) / 10.0
    refused = run(*words[:-1], "500")
    assert refused.exit_code == 2
    assert "--day-sd is 500.0; give a number from 0 to 120" in refused.stderr


def test_a_roster_of_mixed_scales_is_told(run, tmp_path):
    roster = tmp_path / "mixed.csv"
    header, *rows = Path(SEASON[2]).read_text(encoding="utf-8").splitlines()
    place = header.split(",").index("rating")
    for number, row in enumerate(rows[:3]):
        cells = row.split(",")
        cells[place] = "570"
        rows[number] = ",".join(cells)
    roster.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
    told = run("sandbag", "watch", SEASON[0], "--roster", str(roster), "--json").stderr
    assert f"3 of {len(rows)} ratings are more than 180 points" in " ".join(told.split())
