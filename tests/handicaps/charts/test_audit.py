from fractions import Fraction
from itertools import pairwise
from math import comb, log2

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.handicaps import (
    Chart,
    ChartDraft,
    ChartRow,
    RaceLimits,
    audit,
    chart,
    design,
    even_doublings,
)
from evenbreak.matches import race_win_probability
from evenbreak.ratings.scale import scale_of
from rows import each_of
from tiers import examples


def win(p, m, n):
    """Return W(p; m, n), summed over the games that player 2 wins."""
    return sum(comb(m - 1 + lost, lost) * p**m * (1 - p) ** lost for lost in range(n))


def made(races, points, tilt):
    """Return the chart of these races on a scale, cut where the tilt says, to whole points."""
    even = [points * float(even_doublings(m, n)) for m, n in races]
    cuts = [round((1 - tilt) * above + tilt * below + 0.5) for below, above in pairwise(even)]
    ends = [*(cut - 1 for cut in cuts), None]
    return Chart(
        "made", [(a, b, *race) for a, b, race in zip([0, *cuts], ends, races, strict=True)]
    )


NPL_LIKE = [(5, 5), (5, 4), (6, 4), (5, 3), (6, 3), (7, 3), (6, 2), (7, 2)]


@pytest.mark.parametrize("name", ["npl_8", "npl_10", "npl_12", "npl_20"])
def test_npl_charts_are_made_for_30_points_with_races_even_mid_band(name):
    report = audit(chart(name))
    assert report.best_fit.points_per_doubling == pytest.approx(30.0, abs=0.4)
    assert report.best_fit.tilt == pytest.approx(0.5, abs=0.03)
    assert report.best_fit.misfit < 0.35  # rounding to whole points makes 0.29
    assert report.scale.points_per_doubling == report.best_fit.points_per_doubling
    assert report.fit == report.best_fit


def test_r6_hot_is_made_for_100_points_with_races_even_where_the_band_begins():
    report = audit(chart("fargo_r6_hot"))
    assert report.best_fit.points_per_doubling == pytest.approx(100.0, abs=0.3)
    assert report.best_fit.tilt == pytest.approx(0.0, abs=0.02)


def test_five_edges_of_r6_hot_are_the_first_whole_point_where_the_stronger_reaches_a_half():
    report = audit(chart("fargo_r6_hot"), scale="fargo")
    edges = {row.difference_from: row for row in report.rows if row.difference_from}
    first = {edge for edge, row in edges.items() if edge - 1 < row.even_difference <= edge}
    assert set(edges) - first == {86}
    assert edges[86].even_difference == pytest.approx(86.09, abs=0.005)
    assert edges[86].p_win_low < 0.5 < audit(chart("fargo_r6_hot"), scale=99.0).rows[3].p_win_low


def test_even_gap_against_fractions():
    for m, n in [(5, 4), (7, 4), (18, 2), (2, 1)]:
        odds = Fraction(2 ** float(even_doublings(m, n)))
        p = odds / (1 + odds)
        assert float(win(p, m, n)) == pytest.approx(0.5, abs=1e-14)
    assert even_doublings(6, 6) == 0.0
    assert float(even_doublings(2, 1)) == pytest.approx(log2(1 + 2**0.5), rel=1e-14)
    assert even_doublings([3, 2], [2, 3]).tolist() == [
        even_doublings(3, 2),
        -even_doublings(3, 2),
    ]


def test_chances_of_each_row_against_a_sum():
    row = audit(chart("npl_10"), scale="npl").rows[1]
    assert (row.difference_from, row.difference_to) == (6, 14)
    assert (row.stronger_needs, row.weaker_needs) == (5, 4)
    for got, difference in [(row.p_win_low, 6), (row.p_win_middle, 10), (row.p_win_high, 14)]:
        assert got == pytest.approx(win(1 / (1 + 2 ** (-difference / 30)), 5, 4), rel=1e-13)
    assert row.unfairness == max(abs(row.p_win_low - 0.5), abs(row.p_win_high - 0.5))
    assert row.even_place == pytest.approx((row.even_difference - 5.5) / 9)


def test_the_worst_row_is_the_worst_of_all_whole_points():
    table, scale = chart("npl_12"), scale_of("npl")
    differences = np.arange(0, table.rows[-1].difference_from + 1)
    wins = race_win_probability(scale.win_probability(differences), *table.races(differences))
    report = audit(table, scale=scale)
    assert report.worst.unfairness == pytest.approx(np.abs(wins - 0.5).max())


@each_of("points", [30.0, 100.0, 120.41])
@each_of("tilt", [0.0, 0.25, 0.5, 0.9])
def test_the_audit_of_a_designed_chart_recovers_its_scale_and_tilt(points, tilt):
    fit = audit(made(NPL_LIKE, points, tilt)).best_fit
    assert fit.points_per_doubling == pytest.approx(points, rel=0.01)
    assert fit.tilt == pytest.approx(tilt, abs=1.5 / points)
    assert fit.misfit < 0.5


@each_of("scale", ["npl", "fargo", "elo", 45.0])
@each_of("tilt", [0.0, 0.25, 0.5, 0.75, 1.0])
@each_of("games", [(7, 9), (13, 15)])
def test_the_audit_of_the_fairest_chart_recovers_its_scale_and_tilt(scale, tilt, games):
    fit = audit(design(scale, RaceLimits(games, weaker_least=2), tilt=tilt)).best_fit
    assert fit.points_per_doubling == pytest.approx(scale_of(scale).points_per_doubling, rel=0.01)
    assert fit.tilt == pytest.approx(tilt, abs=0.06)
    assert fit.misfit < 1.0


@settings(max_examples=examples(50))
@given(st.floats(2_000, 200_000), st.floats(0.0, 0.9), st.integers(3, 8))
def test_where_rounding_is_small_they_are_recovered_closely(points, tilt, races):
    fit = audit(made(NPL_LIKE[:races], points, tilt)).best_fit
    assert fit.points_per_doubling == pytest.approx(points, rel=2e-3)
    assert fit.tilt == pytest.approx(tilt, abs=5e-3)


def test_no_fit_near_the_best_is_better():
    report = audit(chart("npl_8"))
    even = even_doublings(*zip(*((row[2], row[3]) for row in chart("npl_8").rows), strict=True))
    cuts = np.array([row[0] - 0.5 for row in chart("npl_8").rows[1:]])

    def misfit(points, tilt):
        return np.sqrt(np.mean((points * (even[1:] - tilt * np.diff(even)) - cuts) ** 2))

    best = report.best_fit
    assert misfit(best.points_per_doubling, best.tilt) == pytest.approx(best.misfit)
    for points, tilt in [(0.01, 0), (-0.01, 0), (0, 0.001), (0, -0.001), (0.01, 0.001)]:
        assert misfit(best.points_per_doubling + points, best.tilt + tilt) > best.misfit


def test_the_tilt_on_a_given_scale():
    report = audit(chart("npl_10"), scale="npl")
    assert report.scale.name == "npl"
    assert report.fit.points_per_doubling == 30.0
    assert report.fit.misfit >= report.best_fit.misfit
    best = audit(chart("npl_10"))
    again = audit(chart("npl_10"), scale=best.best_fit.points_per_doubling).fit
    assert again.tilt == pytest.approx(best.best_fit.tilt)


def test_gaps_and_overlaps():
    draft = ChartDraft(
        "ours",
        (
            ChartRow(21, 30, 7, 4),
            ChartRow(2, 4, 5, 5),
            ChartRow(6, 14, 5, 4),
            ChartRow(12, 20, 6, 4),
        ),
    )
    report = audit(draft, scale="npl")
    assert [row.difference_from for row in report.rows] == [2, 6, 12, 21]
    assert report.gaps == ((0, 1), (5, 5), (31, None))
    assert report.overlaps == ((12, 14),)


def test_a_row_within_another_and_one_beyond_the_last():
    rows = (
        ChartRow(0, 20, 5, 5),
        ChartRow(5, 8, 5, 4),
        ChartRow(18, None, 6, 4),
        ChartRow(30, 40, 7, 4),
    )
    report = audit(ChartDraft("ours", rows), scale="npl")
    assert report.gaps == ()
    assert report.overlaps == ((5, 8), (18, 20), (30, 40))


spans = st.tuples(st.integers(0, 30), st.integers(0, 30)).map(sorted)


@given(st.lists(spans, min_size=1, max_size=6), st.booleans())
def test_gaps_and_overlaps_are_those_of_a_count(ends, open_end):
    rows = [ChartRow(first, last, 5, 4) for first, last in ends]
    if open_end:
        rows[-1] = rows[-1]._replace(difference_to=None)
    report = audit(ChartDraft("ours", tuple(rows)), scale="npl")
    for point in range(40):
        held = sum(row[0] <= point and (row[1] is None or point <= row[1]) for row in rows)
        in_gap = any(a <= point and (b is None or point <= b) for a, b in report.gaps)
        overlaps = any(a <= point and (b is None or point <= b) for a, b in report.overlaps)
        assert in_gap == (held == 0)
        assert overlaps == (held > 1)


def test_rows_that_get_no_harder_are_marked():
    rows = [(0, 4, 5, 5), (5, 9, 6, 4), (10, 14, 5, 4), (15, 19, 6, 4), (20, None, 7, 4)]
    assert [row.monotone for row in audit(Chart("ours", rows)).rows] == [
        True,
        True,
        False,
        False,
        True,
    ]


def test_a_chart_that_tells_no_scale_needs_one():
    short = Chart("short", [(0, 9, 3, 3), (10, None, 4, 3)])
    for table in (short, Chart("one", [(0, None, 5, 5)])):
        with pytest.raises(InputError, match="scale is missing"):
            audit(table)
    report = audit(short, scale="npl")
    assert report.best_fit is None
    assert report.fit.misfit == pytest.approx(0.0, abs=1e-12)
    assert audit(Chart("one", [(0, None, 5, 5)]), scale="npl").fit is None


@pytest.mark.parametrize(
    ("rows", "message"),
    [((), "has no rows"), ((ChartRow(5, 4, 5, 5),), "a row goes from 5 to 4")],
)
def test_drafts_that_cannot_be_audited(rows, message):
    with pytest.raises(InputError, match=message):
        audit(ChartDraft("ours", rows), scale="npl")


def test_odd_charts_are_audited_too():
    huge = [(0, 10**6, 5, 5), (10**6 + 1, 2 * 10**6, 10**6, 1), (2 * 10**6 + 1, None, 10**6, 1)]
    for report in (audit(Chart("huge", huge), scale=0.01), audit(Chart("huge", huge))):
        assert all(0.0 <= row.p_win_low <= 1.0 for row in report.rows)
        assert np.isfinite([row.even_difference for row in report.rows]).all()
    odd = ChartDraft("odd", (ChartRow(0, 0, 5, 5), ChartRow(1, 1, 900, 1), ChartRow(2, 2, 1, 900)))
    report = audit(odd, scale="npl")
    assert report.rows[2].even_difference == -report.rows[1].even_difference < 0.0
    assert not report.rows[2].monotone
