from decimal import Decimal
from fractions import Fraction

import pytest

from evenbreak.games import Ahead, Rack
from evenbreak.matches import race_win_probability, win_probability
from evenbreak.source_text.section5.numbers import findings
from evenbreak.source_text.section5.tables import (
    charts_frame,
    figure_frames,
    ladder_frame,
    score_frames,
    table_frame,
)


@pytest.fixture(scope="module")
def plots():
    return figure_frames()


@pytest.mark.parametrize(
    ("table", "rows", "quantities"),
    [("5.1", 10, 1), ("5.2", 14, 4), ("5.3", 25, 3), ("5.4", 10, 3), ("5.5", 7, 13)],
)
def test_tables_have_all_rows_and_nothing_is_missing(table, rows, quantities):
    frame = table_frame(findings(), f"Table {table}")
    assert len(frame) == rows
    printed = [name for name in frame.columns if name.endswith("_printed")]
    assert len(printed) == quantities
    assert not frame.isna().any(axis=None)
    for name in printed:
        off = (frame[name.removesuffix("_printed")] - frame[name]).abs().max()
        assert off <= Decimal("0.1"), name


def test_table_5_2_at_96_percent():
    frame = table_frame(findings(), "Table 5.2").set_index("p")
    row = frame.loc[Decimal("0.96")]
    assert (row.mean_run, row.median_run) == (24, 16)
    assert (str(row.median_bound), str(row.median_bound_printed)) == ("15.97974802", "15.9")


def test_unknown_table():
    with pytest.raises(KeyError, match=r"5\.7"):
        table_frame(findings(), "Table 5.7")


def test_score_frames_are_exact_and_follow_each_other():
    frames = score_frames()
    scores = frames["problem_5_06_scores_p_2_3"].set_index("m")
    matches = frames["problem_5_06_matches_p_2_3"].set_index("m")
    assert str(scores.loc[3, "n_1"]) == str(round(Decimal(32) / Decimal(81), 10))
    for m, n in ((1, 1), (3, 2), (9, 5), (10, 10)):
        assert float(matches.loc[m, f"n_{n}"]) == pytest.approx(
            race_win_probability(2 / 3, m, n), abs=1e-9
        )
    half = frames["problem_5_06_scores_p_1_2"].set_index("m")
    assert half.equals(half.set_axis(half.columns, axis=0).T.set_axis(half.index, axis=0))


def test_charts():
    frame = charts_frame()
    assert list(frame.groupby("chart").size()) == [6, 8, 11, 19]
    assert list(frame.iloc[1]) == [8, 7, 18, 4, 3]


def test_ladder():
    frame = ladder_frame(findings())
    assert list(frame.chart) == [8, 10, 12, 20]
    assert list(frame.even_up_to) == [6, 5, 4, 2]
    for kind in ("natural", "autocorrelated"):
        off = (frame[f"sd_{kind}"] - frame[f"sd_{kind}_printed"]).abs().max()
        assert off < Decimal("0.0005")


def test_curves_of_races(plots):
    frame = plots["figure_5_1"]
    assert frame.shape == (101, 21)
    even = frame[frame.p == Decimal("0.5")].iloc[0]
    assert {even[f"w_{n}_{n}"] for n in range(1, 11)} == {Decimal("0.500000")}
    assert even.w_2_1 == Decimal("0.250000")
    assert even.w_4_2 == Decimal("0.187500")


def test_surfaces(plots):
    shots = plots["figure_5_3"].set_index(["p1", "p2"])
    row = shots.loc[Decimal("0.4"), Decimal("0.8")]
    assert list(map(str, row)) == ["0.454545", "0.460000"]
    breaks = plots["figure_5_6"].set_index(["p1", "p2"])
    row = breaks.loc[Decimal("0.9"), Decimal("0.5")]
    assert list(map(str, row)) == ["0.833333", "0.642857", "0.700000", "0.190476"]
    assert len(shots) == len(breaks) == 19 * 19


def test_laws_sum_to_one(plots):
    levels = plots["figure_5_8"].drop(columns="p").astype(float)
    assert levels.sum(axis=1).to_list() == pytest.approx([1.0] * 101, abs=1e-5)
    errors = plots["figure_5_9"].drop(columns="rating_error").astype(float)
    assert errors.sum().to_list() == pytest.approx([1.0] * 8, abs=1e-4)
    assert (errors.to_numpy() == errors.to_numpy()[::-1]).all()


def test_leads(plots):
    row = plots["figure_5_11"].set_index("p").loc[Decimal("0.6")].astype(float)
    for m in range(1, 6):
        exact = win_probability(Ahead(m, 6 - m, Rack(0.6)))
        assert row[f"w_{m}_{6 - m}"] == pytest.approx(exact, abs=5e-7)


def test_fraction_of_the_text_in_the_tables():
    cell = score_frames()["problem_5_06_matches_p_2_3"].set_index("m").loc[3, "n_2"]
    assert float(cell) == pytest.approx(float(Fraction(16, 27)), abs=1e-10)
