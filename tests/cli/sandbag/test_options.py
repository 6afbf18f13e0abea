"""What the commands of `sandbag` share."""

import click
import pytest

from evenbreak.cli.sandbag.options import between, watch_options, watched_ladder
from evenbreak.handicaps import chart
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.systems.catalogue import system_of


def test_a_number_within_bounds_and_what_to_give_instead():
    stake = between(0.5, 10_000.0)
    assert stake.convert("0.5", None, None) == 0.5
    for text in ("0.4", "10001", "nan", "much"):
        with pytest.raises(click.UsageError, match=r"0\.5 to 10,000"):
            stake.convert(text, None, None)


def test_without_options_honest_players_have_no_form_and_are_flagged_one_time_in_100():
    @click.command()
    @watch_options
    def command(**options):
        return options

    asked = command.main([], standalone_mode=False)
    assert asked == {"day_sd": 0.0, "honest": "any", "alpha": 0.01}
    with pytest.raises(click.UsageError, match=r"'0\.6'"):
        command.main(["--alpha", "0.6"], standalone_mode=False)


def test_the_ladder_that_is_watched():
    ladder, warnings = watched_ladder(system_of("npl"), "npl_8", 4.0)
    assert ladder.law().sd == Ladder("npl", chart("npl_8"), day_sd=4.0).law().sd
    assert warnings == []
    with pytest.raises(click.UsageError, match="--day-sd"):
        watched_ladder(system_of("npl"), None, 9000.0)
