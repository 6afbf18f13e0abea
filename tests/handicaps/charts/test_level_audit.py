import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import LevelChart, audit_levels, even_doublings, level_chart
from evenbreak.matches import race_win_probability
from evenbreak.ratings.scale import scale_of

APA = level_chart("apa_8ball")


def cells(report):
    return {(cell.level, cell.opponent_level): cell for cell in report.cells}


def test_the_ratings_are_the_least_squares_ones():
    report = audit_levels(APA, scale="fargo")
    ratings = np.array(report.ratings)
    needs = np.array(APA.needs)
    even = 100.0 * even_doublings(needs, needs.T)

    def misfit(ratings):
        gaps = ratings[:, None] - ratings[None, :]
        return np.sqrt(np.mean((gaps - even)[np.tril_indices(6, -1)] ** 2))

    assert report.misfit == pytest.approx(misfit(ratings))
    assert ratings[0] == 0.0
    for step in np.eye(6):
        assert misfit(ratings + 0.01 * step) > report.misfit
        assert misfit(ratings - 0.01 * step) > report.misfit


def test_chances_do_not_depend_on_the_scale():
    npl, fargo = audit_levels(APA), audit_levels(APA, scale="fargo")
    assert npl.scale.name == "npl"
    assert fargo.misfit == pytest.approx(npl.misfit * 100 / 30)
    for one, other in zip(npl.cells, fargo.cells, strict=True):
        assert one.p_win_low == pytest.approx(other.p_win_low)
        assert one.p_win_high == pytest.approx(other.p_win_high)


def test_chances_of_a_cell_from_the_ratings():
    report = audit_levels(APA, scale="fargo")
    _, _, r4, r5, r6, r7 = report.ratings
    cell = cells(report)[6, 4]
    assert (cell.needs, cell.opponent_needs) == (5, 3)
    assert cell.difference == pytest.approx(r6 - r4)
    low = (r5 + r6) / 2 - (r4 + r5) / 2
    p = scale_of("fargo").win_probability(np.array([low, r6 - r4]))
    assert [cell.p_win_low, cell.p_win_middle] == pytest.approx(
        race_win_probability(p, 5, 3).tolist()
    )
    assert cell.unfairness == pytest.approx(abs(cell.p_win_middle - 0.5))
    # Neighboring levels meet half-way, so that their nearest players are equal.
    assert cells(report)[7, 6].p_win_low == pytest.approx(race_win_probability(0.5, 5, 4))
    top = cells(report)[7, 7]
    widest = scale_of("fargo").win_probability(r7 - r6)
    assert (top.p_win_low, top.unfairness) == (0.5, 0.0)
    assert top.p_win_high == pytest.approx(race_win_probability(widest, 5, 5))


def test_a_consistent_chart_has_no_misfit():
    report = audit_levels(LevelChart("two", [3, 4], [[3, 3], [4, 4]]))
    assert report.misfit == pytest.approx(0.0, abs=1e-12)
    assert report.ratings[1] == pytest.approx(30.0 * float(even_doublings(4, 3)))
    assert cells(report)[4, 3].p_win_middle == pytest.approx(0.5)


@pytest.mark.parametrize(
    "needs",
    [
        pytest.param([[3, 2, 2], [5, 3, 3], [4, 4, 3]], id="easier than for the next lower level"),
        pytest.param([[3, 3, 2], [4, 3, 2], [4, 5, 3]], id="easier than against the next higher"),
    ],
)
def test_cells_that_get_no_harder_are_marked(needs):
    odd = cells(audit_levels(LevelChart("odd", [1, 2, 3], needs)))
    assert {pair for pair, cell in odd.items() if not cell.monotone} == {(3, 1)}
    assert all(cell.monotone for cell in audit_levels(APA).cells)


def test_one_level():
    report = audit_levels(LevelChart("one", [5], [[4]]))
    (cell,) = report.cells
    assert (report.ratings, report.misfit) == ((0.0,), 0.0)
    assert (cell.p_win_low, cell.p_win_middle, cell.p_win_high) == (0.5, 0.5, 0.5)


def test_the_worst_cell():
    worst = audit_levels(APA).worst
    assert (worst.level, worst.opponent_level) == (7, 4)


def test_an_unknown_scale():
    with pytest.raises(InputError, match="scale"):
        audit_levels(APA, scale="x")
