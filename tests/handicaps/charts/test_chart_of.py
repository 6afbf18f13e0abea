import numpy as np
import pytest

import evenbreak as eb
from evenbreak.errors import InputError
from evenbreak.handicaps import (
    Ladder,
    audit,
    audit_levels,
    chart,
    chart_of,
    last_difference,
    level_chart,
    level_chart_of,
    match_table,
    measure_chart,
    points_chart,
    system_of,
)
from evenbreak.handicaps.ladders.closed_league import ClosedPair
from evenbreak.league import LeaguePlayers, Season, reestimate
from rows import each_of


@pytest.mark.parametrize("name", ["npl_10", "NPL-10", " npl 10 ", chart("npl_10")])
def test_a_chart_by_name_or_as_it_is(name):
    assert chart_of(name) == chart("npl_10")


def test_a_chart_by_level_by_name_or_as_it_is():
    assert level_chart_of("apa-8ball") is level_chart_of(level_chart("apa_8ball"))


CALLS = {
    "audit": lambda given: audit(given),
    "eb.audit": lambda given: eb.audit(given),
    "measure_chart": lambda given: measure_chart(given, "npl"),
    "last_difference": lambda given: last_difference(given, "npl"),
    "Ladder": lambda given: Ladder("npl", given),
    "match_table": lambda given: match_table(system_of("npl"), given).chart,
    "ClosedPair": lambda given: ClosedPair("npl", given).table.chart,
    "Season": lambda given: Season(LeaguePlayers.of([80] * 4), "npl", given).chart,
    "reestimate": lambda given: (
        reestimate(
            np.linspace(70.0, 90.0, 6), given, scale="npl", weeks=2, newcomer_weeks=2, leagues=2
        ).row
    ),
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_every_function_that_takes_a_chart_takes_its_name(call):
    assert call("npl_8") == call(chart("npl_8"))


@each_of("call", CALLS.values())
@each_of("wrong", ["nobody", "apa_8ball", "apa_9ball", 12, level_chart("apa_8ball")])
def test_what_is_no_chart_by_difference_is_refused_with_those_that_are(call, wrong):
    with pytest.raises(InputError, match=r"chart must be .*npl_10"):
        call(wrong)


def test_levels_are_audited_by_name():
    assert audit_levels("apa_8ball") == audit_levels(level_chart("apa_8ball"))


@pytest.mark.parametrize(
    "wrong", ["nobody", "npl_8", None, chart("npl_8"), points_chart("apa_9ball")]
)
def test_what_is_no_chart_by_level_is_refused(wrong):
    with pytest.raises(InputError, match=r"chart must be .*apa_8ball"):
        audit_levels(wrong)
