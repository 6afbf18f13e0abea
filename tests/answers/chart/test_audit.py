from dataclasses import asdict

import pytest

from evenbreak.answers.chart.audit import chart_audit_answer, level_audit_answer
from evenbreak.handicaps import (
    CHARTS,
    ChartDraft,
    ChartRow,
    LevelChart,
    RaceLimits,
    audit,
    audit_levels,
    chart,
    design,
    level_chart,
)
from evenbreak.matches import race_win_probability

ROUGH = [
    (0, 5, 5, 5),
    (6, 15, 5, 4),
    (16, 24, 6, 4),
    (25, 29, 5, 3),
    (30, 45, 7, 5),
    (46, None, 7, 3),
]


def words(answer):
    return " ".join(answer.sentences)


def test_json_has_what_the_audit_found():
    report = audit(chart("npl_10"), scale="npl")
    answer = chart_audit_answer(report).to_dict()
    assert answer["rows"] == [asdict(row) for row in report.rows]
    assert answer["fit"] == asdict(report.fit)
    assert answer["best_fit"] == asdict(report.best_fit)
    levels = audit_levels(level_chart("apa_8ball"))
    answer = level_audit_answer(levels).to_dict()
    assert answer["cells"] == [asdict(cell) for cell in levels.cells]
    assert answer["misfit"] == levels.misfit
    assert [one["rating"] for one in answer["levels"]] == list(levels.ratings)


def test_the_least_fair_race_with_the_end_of_its_band_that_is_worse():
    rows = [ChartRow(0, 2, 5, 5), ChartRow(3, 8, 6, 4), ChartRow(9, 25, 6, 4)]
    early = audit(ChartDraft("early", (*rows, ChartRow(26, None, 7, 4))), scale="npl")
    assert "6:4 at a difference of 3" in words(chart_audit_answer(early))
    assert "29%" in words(chart_audit_answer(early))
    assert "7:3 at a difference of 46" in words(chart_audit_answer(audit(chart("npl_10"))))


@pytest.mark.parametrize(("tilt", "who"), [(0.0, "stronger"), (0.5, "neither"), (1.0, "weaker")])
def test_whom_a_chart_favors(tilt, who):
    made = design("npl", RaceLimits((9, 11), weaker_least=2), tilt=tilt)
    assert f"favors {'the ' * (who != 'neither')}{who} player" in words(
        chart_audit_answer(audit(made))
    )


@pytest.mark.parametrize("name", CHARTS)
def test_whom_it_favors_is_counted_over_its_differences(name):
    report = audit(name)
    chances = [
        race_win_probability(report.scale.win_probability(d), *chart(name).race(d))
        for d in range(1, chart(name).rows[-1].difference_from)
    ]
    assert report.p_win.tolist() == pytest.approx(chances, rel=1e-12)
    mean = chart_audit_answer(report).to_dict()["mean_p_win"]
    assert mean == pytest.approx(sum(chances) / len(chances))


def test_beyond_the_chart_the_last_race_gets_easier():
    report = audit("npl_10", scale="npl")
    wins = race_win_probability(report.scale.win_probability(90), 7, 2)
    assert f"difference of 90 the stronger player wins {100 * wins:.0f}%" in words(
        chart_audit_answer(report)
    )


def test_a_scale_that_the_chart_was_not_made_for_is_named_with_the_one_it_fits():
    found = words(chart_audit_answer(audit(chart("fargo_r6_hot"), scale=150)))
    assert "100.2 points" in found
    assert "other ratings" in found
    assert "other ratings" not in words(chart_audit_answer(audit("fargo_r6_hot", scale="fargo")))


def test_a_chart_that_fits_no_ratings_is_not_said_to_fit_some():
    rough = ChartDraft("rough", tuple(ChartRow(*row) for row in ROUGH))
    assert "does not fit any" in words(chart_audit_answer(audit(rough, scale="npl")))


def test_gaps_overlaps_and_easier_races_are_said_once_each():
    rows = (ChartRow(0, 4, 5, 5), ChartRow(6, 14, 5, 4), ChartRow(12, 20, 6, 4))
    draft = ChartDraft("ours", (*rows, ChartRow(21, None, 5, 4)))
    found = words(chart_audit_answer(audit(draft, scale="npl")))
    assert "a difference of 5." in found
    assert "differences of 12 to 14." in found
    assert "21 and up" in found


def test_a_chart_that_determines_nothing_has_no_fit_and_no_details():
    short = ChartDraft("short", (ChartRow(0, None, 5, 5),))
    answer = chart_audit_answer(audit(short, scale="npl"))
    assert answer.details == []
    assert (answer.to_dict()["fit"], answer.to_dict()["best_fit"]) == (None, None)


def test_a_person_sees_only_pairs_of_different_levels():
    answer = level_audit_answer(audit_levels(level_chart("apa_8ball")))
    table = next(part for part in answer.parts if not isinstance(part, str))
    assert len(list(table.rows)) == 15
    assert len(list(answer.csv.rows)) == 21


def test_levels_out_of_order_are_named():
    needs = [[3, 3, 3], [5, 3, 3], [5, 5, 3]]
    found = words(level_audit_answer(audit_levels(LevelChart("odd", [1, 2, 3], needs))))
    assert "3 v 1" in found


def test_a_single_level_has_nothing_to_compare():
    answer = level_audit_answer(audit_levels(LevelChart("one", [5], [[4]])))
    assert "single level" in answer.sentences[0]
    assert len(answer.to_dict()["cells"]) == 1
