"""How to rate, as people write it."""

import pytest

from evenbreak.cli.league.ratings import prior_in_log_odds
from evenbreak.errors import InputError
from evenbreak.fields.question import AskedError, declaration
from evenbreak.questions.ratings import Rate, Validate
from evenbreak.ratings import scale_of


def read(name, text):
    return declaration(Rate, name).kind.read(text)


def day_of(text, dates=None):
    return Rate(results=("r.csv",), as_of=text, dates=dates).day("as_of")


def test_a_number_of_points_or_the_word_in_any_case():
    assert read("prior", "22.5") == 22.5
    assert read("prior", " Best ") == "best"
    assert read("break_advantage", "-3") == -3.0
    assert read("break_advantage", "FIT") == "fit"


@pytest.mark.parametrize("text", ["-1", "wide", "nan", "1e9", ""])
def test_other_words_are_refused_with_the_one_that_is_known(text):
    with pytest.raises(InputError, match="best"):
        read("prior", text)


@pytest.mark.parametrize("text", ["2026-01-31", "31.1.2026", "2026/1/31"])
def test_a_day_as_results_files_write_it(text):
    assert day_of(text) == "2026-01-31"


@pytest.mark.parametrize("text", ["1/31/2026", "31/1/2026"])
def test_a_day_above_12_settles_the_order(text):
    assert day_of(text) == "2026-01-31"


def test_the_option_settles_the_order():
    assert (day_of("1/2/2026", "mdy"), day_of("1/2/2026", "dmy")) == ("2026-01-02", "2026-02-01")
    with pytest.raises(AskedError, match="dates"):
        day_of("1/2/2026")


@pytest.mark.parametrize("text", ["soon", "3/1/2026", "2026-02-30"])
def test_other_days_are_refused(text):
    with pytest.raises(AskedError, match="2026-01-31"):
        day_of(text)


def test_days_of_a_half_life():
    assert read("half_life", "180") == 180.0
    for text in ("0", "-1", "long"):
        with pytest.raises(InputError):
            read("half_life", text)


def test_a_prior_that_a_scale_cannot_have_is_refused():
    fargo = scale_of("fargo")
    asked = Validate(results=("r.csv",), prior=100.0)
    assert prior_in_log_odds(asked, fargo) == pytest.approx(fargo.log_odds(100.0))
    with pytest.raises(AskedError, match="0 points"):
        prior_in_log_odds(Validate(results=("r.csv",), prior=0.0), fargo)
