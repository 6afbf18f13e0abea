import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import MatchRules, RaceLimits, chart, design, measure_chart, pareto

WIDE = RaceLimits((5, 19), weaker_least=2)
PRINTED = [chart(f"npl_{number}") for number in (8, 10, 12, 20)]


@pytest.fixture(scope="module", params=["mean", "worst"])
def front(request):
    return request.param, pareto("npl", WIDE, beside=PRINTED, criterion=request.param)


def bad(one, criterion):
    told = one.measure
    return getattr(told, f"{criterion}_unfairness"), told.mean_games, told.games_p90


def test_no_designed_chart_is_beaten_by_another(front):
    criterion, charts = front
    made = [one for one in charts if one.beaten_by is None]
    assert len(made) > 10
    for one in made:
        for other in charts:
            better = np.array(bad(one, criterion)) - bad(other, criterion)
            assert not ((better >= 0).all() and (better > 1e-6).any())


def test_all_printed_charts_are_there_and_those_of_the_npl_are_beaten(front):
    criterion, charts = front
    by_name = {one.chart.name: one for one in charts}
    assert {one.name for one in PRINTED} <= by_name.keys()
    for printed in PRINTED:
        one = by_name[printed.name]
        better = by_name[one.beaten_by]
        assert all(
            a <= b + 1e-9 for a, b in zip(bad(better, criterion), bad(one, criterion), strict=True)
        )


def test_the_npl_charts_over_their_own_races_are_within_a_few_per_cent_of_the_best():
    for number, games in ((8, (5, 7)), (10, (7, 9)), (12, (9, 11))):
        printed = chart(f"npl_{number}")
        charts = pareto("npl", RaceLimits(games, weaker_least=2), beside=[printed])
        unfair = {one.chart.name: one.measure.mean_unfairness for one in charts}
        assert unfair[printed.name] < 1.04 * unfair["fairest"]


def test_each_chart_is_the_design_of_its_limit_and_measured_as_it_is():
    charts = pareto("npl", WIDE, up_to=60)
    assert charts[0].chart.name == "fairest"
    for one in charts:
        name, _, most = one.chart.name.partition(" ")
        limits, budget = WIDE, None
        if name == "games_p90":
            limits = RaceLimits((5, 19), weaker_least=2, games_p90=int(most))
            assert one.measure.games_p90 <= int(most)
        elif name == "mean_games":
            budget = float(most)
            assert one.measure.mean_games <= budget
        again = design("npl", limits, mean_games=budget, up_to=60)
        assert again.rows == one.chart.rows
        assert measure_chart(again, "npl", up_to=60) == one.measure


def test_matches_won_by_two_have_a_front_too():
    charts = pareto(MatchRules("npl", win_by=2), RaceLimits((5, 6), weaker_least=2), up_to=20)
    lengths = [one.measure.games_p90 for one in charts]
    assert min(lengths) < max(lengths)


def test_a_limit_on_rows_holds_for_every_chart_and_each_is_told_of():
    told = []
    charts = pareto("npl", RaceLimits((5, 9)), up_to=40, rows=4, watch=told.append)
    assert max(len(one.chart.rows) for one in charts) == 4
    assert told == list(range(1, len(told) + 1))
    assert len(told) >= len(charts)


def test_wrong_wishes_are_refused():
    with pytest.raises(InputError, match="criterion"):
        pareto("npl", WIDE, criterion="best")
    with pytest.raises(InputError, match="up_to is 0"):
        pareto("npl", WIDE, up_to=0)
