import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.handicaps import Chart, ChartRow
from evenbreak.handicaps.charts.chart import catalog_rows, row_faults


def test_all_faults_are_told_with_the_place_of_their_row():
    rows = [
        ChartRow(1, 4, 5, 4),
        ChartRow(6, 3, 4, 5),
        ChartRow(4, None, 5, 4),
        ChartRow(9, 12, 5, 4),
    ]
    assert list(row_faults(rows)) == [
        (0, "row 1 must start at 0; it starts at 1"),
        (
            0,
            (
                "row 1 is a race 5:4. Give an even race, since at a difference of 0 neither "
                "player is stronger."
            ),
        ),
        (1, "difference_to in row 2 must be 6 or more; you gave 3"),
        (
            1,
            (
                "stronger_needs in row 2 must be 5 or more, since the stronger player never "
                "needs fewer games; you gave 4"
            ),
        ),
        (1, "row 2 starts at 6, but row 1 ends at 4. Start it at 5."),
        (2, "row 3 is open-ended, but only the last row can be. Give its end."),
        (
            3,
            (
                "the last row ends at 12, but a chart must cover all larger "
                "differences too. Leave out its end."
            ),
        ),
    ]


def test_the_rows_of_the_catalog_are_whole_numbers_with_open_ends():
    assert catalog_rows("npl_8")[-1] == (49, None, 6, 2)
    assert catalog_rows("apa_8ball")[0] == (2, 2, 2, 2)


ends = st.integers(0, 12)
rows = st.builds(ChartRow, ends, st.none() | ends, st.integers(1, 3), st.integers(1, 3))


@pytest.mark.slow
@given(st.lists(rows, min_size=1, max_size=4))
def test_rows_without_a_fault_are_a_chart_and_others_are_none(some):
    faults = list(row_faults(some))
    if faults:
        with pytest.raises(InputError) as refused:
            Chart("ours", some)
        assert str(refused.value) == faults[0][1]
    else:
        assert Chart("ours", some).rows == tuple(some)
