"""The options that say how to rate, as people write them."""

import click
import pytest

from evenbreak.cli.league.rate_options import DAYS, NumberOr, prior_in_log_odds, read_day
from evenbreak.ratings import scale_of


def read(kind, text):
    return kind.convert(text, None, None)


def test_a_number_of_points_or_the_word_in_any_case():
    prior = NumberOr("best", 0.0)
    assert read(prior, "22.5") == 22.5
    assert read(prior, " Best ") == "best"
    assert read(NumberOr("fit", -1e6), "-3") == -3.0


@pytest.mark.parametrize("text", ["-1", "wide", "nan", "1e9", ""])
def test_other_words_are_refused_with_the_one_that_is_known(text):
    with pytest.raises(click.BadParameter, match="best"):
        read(NumberOr("best", 0.0), text)


@pytest.mark.parametrize("text", ["2026-01-31", "31.1.2026", "2026/1/31"])
def test_a_day_as_results_files_write_it(text):
    assert read_day(text) == "2026-01-31"


@pytest.mark.parametrize("text", ["1/31/2026", "31/1/2026"])
def test_a_day_above_12_settles_the_order(text):
    assert read_day(text) == "2026-01-31"


def test_the_option_settles_the_order():
    assert (read_day("1/2/2026", "mdy"), read_day("1/2/2026", "dmy")) == (
        "2026-01-02",
        "2026-02-01",
    )
    with pytest.raises(click.BadParameter, match="--dates"):
        read_day("1/2/2026")


@pytest.mark.parametrize("text", ["soon", "3/1/2026", "2026-02-30"])
def test_other_days_are_refused(text):
    with pytest.raises(click.BadParameter, match="2026-01-31"):
        read_day(text)


def test_days_of_a_half_life():
    assert read(DAYS, "180") == 180.0
    for text in ("0", "-1", "long"):
        with pytest.raises(click.BadParameter):
            read(DAYS, text)


def test_a_prior_that_a_scale_cannot_have_is_refused():
    fargo = scale_of("fargo")
    assert prior_in_log_odds(100.0, fargo) == pytest.approx(fargo.log_odds(100.0))
    with pytest.raises(click.UsageError, match="0 points"):
        prior_in_log_odds(0.0, fargo)
