import csv
import io
import json
from dataclasses import replace

import numpy as np
import pytest

from evenbreak.answers.kit.patience import told
from evenbreak.answers.ladder.asked import say_if_long
from evenbreak.handicaps import chart, system_of
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.ladders.opponents import EQUAL_SKILL
from evenbreak.handicaps.ladders.settling import settling
from evenbreak.handicaps.systems.catalog import FAMILIES
from evenbreak.ratings.scale import scale_of
from places import DATA
from rows import each_of

ROSTER = DATA / "demo_roster.csv"
COLUMNS = ("error", "probability", "cumulative", "p_win")
KEYS = {
    *("system", "scale", "points_per_doubling", "chart", "opponents", "day_sd"),
    *("matches_a_night", "match_sd", "drift", "sd", "mean", "distribution", "quantiles"),
    *("off_by_quantiles", "off_by_more", "natural_sd", "unfairness", "inflation"),
    *("newcomer_leaves", "gap", "mixing_matches", "settling", "schema_version"),
}
PRINTED = {  # the source's standard deviations: opponents rated rightly, and off as the player
    "npl_8": (4.963, 4.978),
    "npl_10": (4.634, 4.654),
    "npl_12": (4.269, 4.291),
    "npl_20": (3.668, 3.697),
}


@pytest.mark.parametrize("name", PRINTED)
def test_the_standard_deviations_of_the_source(ladder, name):
    natural, auto = ladder("--chart", name), ladder("--chart", name, "--autocorrelated")
    assert (round(natural["sd"], 3), round(auto["sd"], 3)) == PRINTED[name]
    assert natural["natural_sd"] == natural["sd"] == auto["natural_sd"]
    assert auto["opponents"] == "autocorrelated"


def test_all_keys_and_a_law_that_adds_up(ladder):
    answer = ladder("--chart", "npl_10", "--start-error", "-30", "--within", "5")
    assert set(answer) >= KEYS
    law = {row["error"]: row["probability"] for row in answer["distribution"]}
    assert sum(law.values()) == pytest.approx(1.0)
    assert answer["mean"] == pytest.approx(0.0, abs=1e-12)
    assert sum(error**2 * p for error, p in law.items()) == pytest.approx(answer["sd"] ** 2)
    assert round(answer["gap"], 4) == 0.0217
    off = sum(p for error, p in law.items() if abs(error) > 5)
    assert answer["off_by_more"]["5"] == pytest.approx(off)
    favorite = answer["unfairness"]
    assert favorite["favorite_mean"] == pytest.approx(0.5 + favorite["mean_off_even"])


def test_how_long_a_wrong_rating_takes(ladder):
    found = settling(Ladder("npl", chart("npl_10")), -20, 3, newcomer=True)
    told = ladder("--chart", "npl_10", "--start-error", "-20", "--within", "3", "--newcomer")[
        "settling"
    ]
    assert (told["start"], told["within"], told["newcomer"]) == (-20, 3, True)
    assert told["mean"] == found.mean
    assert told["quantiles"]["0.9"] == found.matches.quantile(0.9)
    assert told["after"] == {str(many): found.after(many) for many in (10, 20, 50, 100, 200)}


def test_who_is_favored_and_by_how_much(ladder):
    # Opponents are rated rightly: the player's own error says who is the favorite.
    told = ladder("--chart", "npl_10")["unfairness"]
    built = Ladder("npl", chart("npl_10"))
    law, win = np.array(built.law().probability), np.maximum(built.wins, 1.0 - built.wins)
    assert told["favorite_mean"] == pytest.approx(float(law @ win))
    assert told["favorite_over_60"] == pytest.approx(float(law[win >= 0.6].sum()))
    assert told["favorite_quantiles"]["0.5"] == 0.5


def test_newcomers_settle_sooner(ladder):
    slow = ladder("--chart", "npl_10")["settling"]
    fast = ladder("--chart", "npl_10", "--newcomer")["settling"]
    assert (slow["start"], slow["within"]) == (-30, 5)
    assert fast["mean"] < 0.5 * slow["mean"]


def test_the_csv_is_the_law_with_the_chance_to_win(run):
    result = run("ladder", "--chart", "npl_8")
    assert result.exit_code == 0, result.stderr
    rows = list(csv.DictReader(io.StringIO(result.stdout)))
    assert tuple(rows[0]) == COLUMNS
    built = Ladder("npl", chart("npl_8"))
    assert [int(row["error"]) for row in rows] == built.errors.tolist()
    wins = [float(row["p_win"]) for row in rows]
    assert wins == pytest.approx(built.wins.tolist(), abs=1e-6)
    assert float(rows[-1]["cumulative"]) == 1.0
    even = next(row for row in rows if row["error"] == "0")
    assert even["p_win"] == "0.500000"


def test_all_options_reach_the_ladder(ladder):
    answer = ladder(
        *("--system", "step 2", "--scale", "40", "--equal-skill", "--day-sd", "4"),
        *("--matches-a-night", "3", "--match-sd", "3", "--drift", "0.05"),
    )
    system = replace(system_of("step 2"), scale=scale_of(40))
    built = Ladder(
        system,
        opponents=EQUAL_SKILL,
        day_sd=4.0,
        matches_a_night=3,
        match_sd=3.0,
        drift=0.05,
    )
    assert answer["sd"] == built.law().sd
    assert answer["mean"] == built.law().mean < 0.0
    assert (answer["points_per_doubling"], answer["chart"]) == (40.0, "npl_10")
    assert answer["natural_sd"] == Ladder(system).law().sd


def test_step_k_is_the_system_of_that_step(ladder):
    by_step, by_name = ladder("--step", "3"), ladder("--system", "step 3")
    assert by_step == by_name
    assert by_step["sd"] > ladder("--step", "1")["sd"]


def test_a_step_of_one_is_the_rule_of_the_npl(ladder):
    assert ladder("--step", "1")["distribution"] == ladder()["distribution"]


def test_a_chart_of_ones_own(ladder, tmp_path):
    ours = tmp_path / "ours.csv"
    ours.write_text("difference_from,difference_to,stronger_needs,weaker_needs\n0,9,5,5\n10,,5,4\n")
    assert ladder("--chart", str(ours))["chart"] == "ours"


def test_a_chart_for_another_scale_is_a_warning(ladder):
    (warning,) = ladder("--chart", "fargo_r6_hot")["warnings"]
    assert "fargo_r6_hot" in warning
    right = ladder("--chart", "fargo_r6_hot", "--scale", "fargo")
    assert right["warnings"] == []
    assert right["settling"]["start"] == -100


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("words", [(), ("--autocorrelated", "--start-error", "-30")])
def test_the_picture(run, tmp_path, words):
    path = tmp_path / "ladder.png"
    result = run("ladder", "--chart", "npl_20", *words, "--plot", str(path))
    assert result.exit_code == 0, result.stderr
    assert path.read_bytes().startswith(b"\x89PNG")
    assert f"Wrote {path}" in result.stderr


def test_the_help_names_all_systems(run):
    text = " ".join(run("ladder", "--help").stdout.split()).replace("- ", "-")
    for family in FAMILIES.values():
        assert family.grammar in text


@each_of(
    "words, code, named",
    [
        (("--chart", "apa_8ball", "--system", "npl"), 2, "--system level-steps"),
        (("--chart", "apa_8ball", "--day-sd", "3"), 2, "Leave it out with skill levels"),
        (("--system", "tap-like"), 2, "evenbreak simulate --compare"),
        (("--chart", "npl_9"), 3, "npl_9"),
        (("--system", "chess"), 2, "'chess'"),
        (("--step", "0"), 2, "'0'"),
        (("--step", "2", "--system", "npl"), 2, "Leave out --system"),
        (("--start-error", "61"), 2, "from -60 to 60"),
        (("--start-error", "half"), 2, "'half'"),
        (("--day-sd", "-1"), 2, "'-1'"),
        (("--day-sd", "1e9"), 2, "0 to 120 points"),
        (("--scale", "0.01"), 2, "--scale 0.01"),
        (("--match-sd", "nan"), 2, "'nan'"),
        (("--drift", "2"), 2, "from -0.9 to 0.9"),
        (("--step", "100"), 1, "--step"),
        (("--matches-a-night", "3"), 2, "Give --day-sd"),
        (("--autocorrelated", "--equal-skill"), 2, "--autocorrelated and --equal-skill"),
        (("--equal-skill", "--league", "x.csv"), 2, "--equal-skill and --league"),
        (("--skill", "80"), 2, "Give --league"),
        (("--league", "no_such_file.csv"), 3, "no_such_file.csv"),
        (("--system", "elo 16", "--scale", "npl"), 2, "Leave --scale out"),
        (("--step", "2", "--newcomer"), 2, "--newcomer"),
        (("--scale", "-3"), 2, "'-3'"),
        (("--chart", "-", "--league", "-"), 2, "can stand for only one file"),
        (("--plot", "x.pdf"), 2, ".png or .svg"),
    ],
)
def test_what_is_wrong_is_named_with_a_remedy(run, words, code, named):
    result = run("ladder", *words)
    assert (result.exit_code, result.stdout) == (code, "")
    assert named in " ".join(result.stderr.split())


def test_uneven_steps_have_a_gap_and_mix(run):
    result = run("ladder", "--json", "--system", "step 2 1")
    told = json.loads(result.stdout)
    assert told["gap"] == pytest.approx(0.0362, abs=5e-5)
    assert told["mixing_matches"] == 65
    assert result.stderr == ""


@pytest.mark.parametrize(
    ("system", "matches", "said"), [("elo 16", 3, True), ("elo 16", 1, False), ("npl", 3, False)]
)
def test_what_takes_long_is_said_beforehand(system, matches, said):
    heard = []
    with told(heard.append):
        say_if_long(Ladder(system, day_sd=1.0, matches_a_night=matches))
    assert bool(heard) == said


def test_a_chart_that_is_even_everywhere_is_the_reason(run, tmp_path):
    path = tmp_path / "even.csv"
    path.write_text(
        "difference_from,difference_to,stronger_needs,weaker_needs\n0,,5,5\n", encoding="utf-8"
    )
    result = run("ladder", "--chart", str(path))
    assert result.exit_code == 1
    assert "same race at every difference" in " ".join(result.stderr.split())


@pytest.mark.slow
def test_a_part_that_takes_forever_is_left_out_with_a_warning(ladder):
    answer = ladder("--drift", "0.9")
    assert answer["settling"] is None
    (warning,) = answer["warnings"]
    assert "e+" not in warning


def test_a_chart_of_skill_levels_has_a_long_run_of_levels(run):
    answer = json.loads(run("ladder", "--chart", "apa_8ball", "--json").stdout)
    assert answer["system"] == "level-steps"
    for row in answer["levels"]:
        assert sum(row["shares"].values()) == pytest.approx(1.0)
        assert max(row["shares"], key=row["shares"].get) == str(row["level"])
    assert "level 3 needs on average" in " ".join(
        run("ladder", "--system", "level-steps").stderr.split()
    )
