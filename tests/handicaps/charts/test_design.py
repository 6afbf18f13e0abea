from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.handicaps import RaceLimits, audit, chart, design, measure_chart, nearest_chart
from evenbreak.handicaps.charts.race_grid import even_differences, win_grid
from evenbreak.ratings import SCALES, scale_of
from rows import each_of
from tiers import examples

NPL = {8: (5, 7), 10: (7, 9), 12: (9, 11), 20: (17, 19)}
"""The longest matches of the races that each printed chart draws on."""


def npl_limits(number):
    return RaceLimits(NPL[number], weaker_least=2)


def races_of(made, differences):
    m, n = made.races(differences)
    return list(zip(m.tolist(), n.tolist(), strict=True))


def all_charts(limits, scale, up_to):
    """Yield every way to give differences 0, 1, ... races that get harder and harder."""
    races = limits.races
    at = even_differences(scale, *np.array(races).T).round(9).tolist()
    even = dict(zip(races, at, strict=True))
    for path in product(races, repeat=up_to + 1):
        steps = pairwise(path)
        if path[0][0] == path[0][1] and all(a == b or even[a] < even[b] for a, b in steps):
            yield path


def losses(path, scale, target=0.5, tilt=0.5):
    """Return what each difference costs, by the definition."""
    cost = [0.0]
    for points, (m, n) in enumerate(path[1:], 1):
        above = win_grid(scale, [m], [n], [points])[0, 0] - target
        weight = 1.0 - tilt if above > 0 else tilt
        cost.append(0.5 * abs(above) / weight)
    return cost


SMALL = [
    (RaceLimits((3, 5), weaker_least=2), scale_of(2), 4),
    (RaceLimits((3, 4)), scale_of(1.5), 5),
]


@pytest.mark.slow_after(4)
@pytest.mark.parametrize(("limits", "scale", "up_to"), SMALL)
@pytest.mark.parametrize(("target", "tilt"), [(0.5, 0.5), (0.6, 0.5), (0.5, 0.2)])
def test_no_chart_of_all_is_fairer(limits, scale, up_to, target, tilt):
    every = [losses(path, scale, target, tilt) for path in all_charts(limits, scale, up_to)]
    assert len(every) > 10
    made = design(scale, limits, target=target, tilt=tilt, up_to=up_to)
    ours = losses(races_of(made, range(up_to + 1)), scale, target, tilt)
    assert sum(ours) == pytest.approx(min(map(sum, every)), abs=1e-9)


@pytest.mark.slow_after(7)
@pytest.mark.parametrize(("limits", "scale", "up_to"), SMALL)
@pytest.mark.parametrize("rows", [1, 2, 3, 9])
def test_no_chart_of_so_few_rows_is_fairer(limits, scale, up_to, rows):
    every = [
        losses(path, scale) for path in all_charts(limits, scale, up_to) if len(set(path)) <= rows
    ]
    made = design(scale, limits, up_to=up_to, rows=rows)
    assert len(made.rows) <= rows
    ours = losses(races_of(made, range(up_to + 1)), scale)
    assert sum(ours) == pytest.approx(min(map(sum, every)), abs=1e-9)


def test_more_rows_are_never_less_fair():
    limits, unfair = RaceLimits((7, 15), weaker_least=2), []
    for rows in range(1, 30):
        made = design("npl", limits, up_to=60, rows=rows)
        unfair.append(measure_chart(made, "npl", up_to=60).mean_unfairness)
    assert all(a >= b for a, b in pairwise(unfair))
    assert unfair[0] > 1.5 * unfair[4]
    free = design("npl", limits, up_to=60)
    assert len(design("npl", limits, up_to=60, rows=len(free.rows)).rows) <= len(free.rows)
    assert design("npl", limits, up_to=60, rows=10**9) == free


@pytest.mark.parametrize("number", NPL)
def test_designed_charts_are_fairer_than_the_printed_ones_of_the_same_races(number):
    printed = chart(f"npl_{number}")
    theirs = measure_chart(printed, "npl")
    ours = measure_chart(
        design("npl", npl_limits(number), up_to=theirs.up_to), "npl", up_to=theirs.up_to
    )
    assert ours.worst_unfairness <= theirs.worst_unfairness
    assert ours.mean_unfairness < theirs.mean_unfairness
    assert ours.games_p90 <= theirs.games_p90


@pytest.mark.parametrize(
    ("number", "where"),
    [
        (8, [19, 29]),
        (10, [46, 63, 64]),
        (12, [58, 74, 75, 76]),
        (20, [7, 8, 9, 17, 18, 19, 27, 28, 29, 45, 49, 50, 51, 52, 53, 59, 60, 61, 68, 98]),
    ],
)
def test_the_nearest_races_make_the_printed_charts_but_for_these_differences(number, where):
    printed = chart(f"npl_{number}")
    last = printed.rows[-1].difference_from + 7
    made = nearest_chart("npl", npl_limits(number), up_to=last)
    here = range(last + 1)
    differ = [
        d
        for d, one, other in zip(here, races_of(made, here), races_of(printed, here), strict=True)
        if one != other
    ]
    assert differ == where


def test_the_nearest_race_is_nearest_at_each_difference():
    limits = npl_limits(12)
    made = nearest_chart("npl", limits, up_to=60)
    assert made.race(0) == made.race(1) == (6, 6)
    for points in range(1, 61):
        others = [race for race in limits.races if race[0] != race[1] or race == (6, 6)]
        missed = {
            race: abs(win_grid(SCALES["npl"], *zip(race), [points])[0, 0] - 0.5) for race in others
        }
        assert missed[made.race(points)] == pytest.approx(min(missed.values()), abs=1e-12)


@each_of("scale", ["npl", "fargo", 400.0])
@each_of("tilt", [0.0, 0.25, 0.5, 0.75, 1.0])
def test_the_audit_of_a_designed_chart_tells_its_scale_and_tilt(scale, tilt):
    made = design(scale, RaceLimits((9, 11), weaker_least=2), tilt=tilt)
    fit = audit(made).best_fit
    assert fit.points_per_doubling == pytest.approx(scale_of(scale).points_per_doubling, rel=0.02)
    assert fit.tilt == pytest.approx(tilt, abs=0.12)


def test_at_tilt_0_the_stronger_is_never_the_underdog_and_at_1_never_the_favorite():
    scale, points = SCALES["npl"], np.arange(1, 40)
    for tilt, sign in ((0.0, 1.0), (1.0, -1.0)):
        made = design(scale, RaceLimits((5, 9), weaker_least=2), tilt=tilt, up_to=40)
        races = races_of(made, points)
        for d, (m, n) in zip(points.tolist(), races, strict=True):
            others = (win_grid(scale, *zip(race), [d])[0, 0] for race in ((5, 4), (6, 2), (8, 2)))
            if any(sign * (other - 0.5) >= 0 for other in others):
                assert sign * (win_grid(scale, [m], [n], [d])[0, 0] - 0.5) >= -1e-9


def test_a_target_is_what_the_stronger_gets():
    made = design("fargo", RaceLimits((7, 15), weaker_least=2), target=0.6)
    m, n = made.races(np.arange(40, 200))
    wins = [
        win_grid(SCALES["fargo"], [a], [b], [d])[0, 0]
        for a, b, d in zip(m.tolist(), n.tolist(), range(40, 200), strict=True)
    ]
    assert np.mean(wins) == pytest.approx(0.6, abs=0.01)


@settings(max_examples=examples(40), deadline=None)
@given(
    st.integers(1, 9),
    st.integers(0, 6),
    st.integers(1, 3),
    st.floats(3, 120),
    st.floats(0.3, 0.8),
    st.floats(0, 1),
)
def test_every_design_is_a_chart_within_its_limits(low, more, least, scale, target, tilt):
    try:
        limits = RaceLimits((low, low + more), weaker_least=least)
    except InputError:
        return
    made = design(scale, limits, target=target, tilt=tilt)
    assert {row[2:] for row in made.rows} <= set(limits.races)
    even = [float(even_differences(scale_of(scale), row[2], row[3])) for row in made.rows]
    assert even == sorted(even)
    assert len(set(even)) == len(even)


def test_a_limit_on_the_90_per_cent_length_holds_at_every_difference():
    free, short = (
        design("npl", RaceLimits((5, 15), weaker_least=2, games_p90=most), up_to=60)
        for most in (None, 9)
    )
    assert measure_chart(free, "npl", up_to=60).games_p90 > 9
    assert measure_chart(short, "npl", up_to=60).games_p90 == 9


@pytest.mark.slow_after(6)
@pytest.mark.parametrize(
    ("wrong", "remedy"),
    [
        (
            {"scale": "nlp"},
            (
                r"scale must be npl, fargo, elo, or the points that double the odds, from "
                r"0\.01 to 1,000,000; you gave 'nlp'"
            ),
        ),
        ({"target": 2}, "target must"),
        ({"tilt": -1}, "tilt must be a number from 0 to 1; you gave -1"),
        ({"up_to": 0}, "up_to must"),
        ({"rows": 0}, "rows must"),
        (
            {"limits": RaceLimits((1, 99)), "rows": 60, "up_to": 400},
            "rows is 60",
        ),
        ({"limits": RaceLimits((5, 7), games_p90=3)}, "at a difference of 0 no allowed race"),
        ({"limits": RaceLimits((1, 999))}, "250000 races at 315 differences"),
    ],
)
def test_wrong_wishes_are_refused(wrong, remedy):
    with pytest.raises(InputError, match=remedy):
        design(**{"scale": "npl", "limits": RaceLimits((5, 7)), **wrong})


@pytest.mark.parametrize("spread", [-1, 2.5, "wide"])
def test_a_spread_that_is_no_count_is_refused(spread):
    with pytest.raises(InputError, match="spread"):
        design("npl", RaceLimits((5, 7)), spread=spread)
