"""What is asked about sandbagging: limits, and the ladder that is watched."""

import pytest

from evenbreak.cli.sandbag import watched_ladder
from evenbreak.errors import InputError
from evenbreak.fields.question import AskedError, declaration
from evenbreak.handicaps import chart
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.systems.catalog import system_of
from evenbreak.questions.ladders import SandbagPay, SandbagWatch

NPL = system_of("npl")


def asked(**fields):
    return SandbagWatch(results="season.csv", roster="start.csv", **fields)


def test_a_number_within_bounds_and_what_to_give_instead():
    stake = declaration(SandbagPay, "stake").kind
    assert stake.read("0.5") == 0.5
    for text in ("-0.4", "1e10", "nan", "much"):
        with pytest.raises(InputError, match="0 to 1,000,000,000"):
            stake.read(text)


def test_without_options_honest_players_have_no_form_and_are_flagged_one_time_in_100(run):
    usual = asked()
    assert (usual.day_sd, usual.honest, usual.alpha) == (0.0, "any", 0.01)
    refused = run("sandbag", "watch", "season.csv", "--roster", "start.csv", "--alpha", "0.6")
    assert refused.exit_code == 2
    assert "'0.6'" in refused.stderr


def test_the_ladder_that_is_watched():
    ladder, warnings = watched_ladder(asked(chart="npl_8", day_sd=4.0), NPL)
    assert ladder.law().sd == Ladder("npl", chart("npl_8"), day_sd=4.0).law().sd
    assert warnings == []
    with pytest.raises(AskedError, match="day_sd"):
        watched_ladder(asked(day_sd=9000.0), NPL)
