import numpy as np
import pytest

from evenbreak.handicaps import ChartDraft, ChartRow, audit, chart
from evenbreak.plots.charts import draw_chart
from evenbreak.plots.picture import image_bytes


def curve(axes, name):
    (line,) = (line for line in axes.lines if line.get_label() == f"chart {name}")
    return line.get_xydata()


def texts(axes):
    return [text.get_text() for text in axes.texts]


def test_the_saw_tooth_passes_through_the_chances_of_the_audit():
    report = audit(chart("npl_10"), scale="npl")
    x, y = curve(draw_chart(report), "npl_10").T
    rows = report.rows
    assert x[0] == 0.0
    assert y[0] == 0.5
    assert x[-1] == 56.5 + 10  # the last race for as many points as the broadest band
    drops = np.flatnonzero(np.diff(y) < 0)
    assert x[drops].tolist() == [row.difference_from - 0.5 for row in rows[1:]]
    for row in rows[:-1]:
        middle = (row.difference_from + row.difference_to) / 2
        of_row = (x >= row.difference_from - 0.4) & (x <= row.difference_to + 0.4)
        assert np.interp(middle, x[of_row], y[of_row]) == pytest.approx(row.p_win_middle, abs=1e-4)


def test_races_are_named_and_upright_where_there_is_no_room():
    for name, rotation in (("npl_10", 0.0), ("npl_20", 90.0)):
        axes = draw_chart(audit(chart(name)))
        assert texts(axes) == [f"{row[2]}:{row[3]}" for row in chart(name).rows]
        assert {text.get_rotation() for text in axes.texts} == {rotation}


def test_another_chart_in_points_of_the_first():
    npl, fargo = audit(chart("npl_10"), scale="npl"), audit(chart("fargo_r6_hot"), scale="fargo")
    axes = draw_chart(npl, fargo)
    x, y = curve(axes, "fargo_r6_hot").T
    first_drop = x[np.flatnonzero(np.diff(y) < 0)[0]]
    assert first_drop == pytest.approx(27.5 * 30 / 100)
    assert "30 points" in axes.get_xlabel()
    assert "fargo_r6_hot" in axes.get_title()


def test_a_gap_breaks_the_curve():
    draft = ChartDraft("ours", (ChartRow(0, 4, 5, 5), ChartRow(7, 12, 5, 4)))
    x, _ = curve(draw_chart(audit(draft, scale="npl")), "ours").T
    (gap,) = np.flatnonzero(np.isnan(x))
    assert (x[gap - 1], x[gap + 1]) == (4.5, 6.5)


@pytest.mark.slow
def test_a_single_row_and_odd_names_draw():
    for name in ("_hidden", "$x", "two$of$them"):
        axes = draw_chart(audit(ChartDraft(name, (ChartRow(0, None, 5, 5),)), scale="npl"))
        assert image_bytes(axes, "png").startswith(b"\x89PNG")
        both = draw_chart(
            audit(chart("npl_8")), audit(ChartDraft(name, (ChartRow(0, None, 5, 5),)), scale="npl")
        )
        assert len(both.get_legend().texts) == 2
        assert image_bytes(both, "svg")
