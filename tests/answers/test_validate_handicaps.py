"""What is said of handicaps: what was planted, and nothing else."""

import re
import shlex

import pytest
from click.testing import CliRunner

from evenbreak.answers.validate_handicaps import handicap_remarks
from evenbreak.cli.program import program
from evenbreak.handicaps import league_chart
from evenbreak.ratings import scale_of, validate
from handicapped import by_chart, by_class

NPL = scale_of("npl")


def said(season):
    found = validate(season, prior_sd=0.5)
    return list(handicap_remarks(found, league_chart(season), NPL))


@pytest.fixture(scope="module")
def too_easy():
    """What is said of a league in which fewer points double the odds than the chart assumes."""
    return said(by_chart(1, doubling=24.0, instead={(6, 3): (7, 4)}))


def test_a_scale_that_is_off_comes_with_a_chart_that_fits(too_easy):
    (command,) = [text for text in too_easy if text.startswith("evenbreak")]
    points = re.search(r"^(\S+) points double", "\n".join(too_easy), re.MULTILINE).group(1)
    assert command.endswith(f"--scale {points}")
    assert abs(float(points) - 24.0) < 2.0
    made = CliRunner().invoke(program, [*shlex.split(command)[1:], "--text"])
    assert made.exit_code == 0, made.output


def test_the_chart_is_named_with_the_places_that_differ(too_easy):
    (text,) = [text for text in too_easy if "npl_10" in text]
    assert "7:4 instead of 6:3 at 29 to 36 points apart" in text


def test_a_class_has_its_worth_beside_what_a_start_takes_back():
    fair, worth = said(by_class(1, matches=800))
    assert "too little" in fair
    assert re.search(r"A class is worth 2[0-4] points", worth)
    assert "most often 7:6, take back 7 points" in worth
    assert re.search(r"7:[45] would", worth)


def test_nothing_is_found_in_a_league_that_plays_by_its_chart():
    fair, scale, chart = said(by_chart(3, matches=1500))
    assert fair.startswith("The handicaps look fair")
    assert "agree" in scale
    assert "but for" not in chart


def test_a_league_without_handicaps_hears_nothing(chosen):
    assert list(handicap_remarks(chosen, league_chart(chosen.forecasts.results), NPL)) == []
