"""What is said of handicaps: what was planted, and nothing else."""

import re
import shlex
from dataclasses import replace

import pytest
from click.testing import CliRunner

from evenbreak.answers.league.validate_handicaps import handicap_remarks
from evenbreak.cli.program import program
from evenbreak.handicaps import league_chart
from evenbreak.ratings import scale_of, validate
from evenbreak.ratings.estimates import wilson
from evenbreak.ratings.validation.validate import HandicapFairness
from handicapped import by_chart, by_class

NPL = scale_of("npl")


def said(season):
    return remarks(validate(season, prior_sd=0.5), season)


def remarks(found, season):
    return list(handicap_remarks(found, league_chart(season), NPL))


@pytest.fixture(scope="module")
def too_easy():
    """What is said of a league in which fewer points double the odds than the chart assumes."""
    return said(by_chart(1, doubling=24.0, instead={(6, 3): (7, 4)}))


@pytest.mark.slow
def test_a_scale_that_is_off_comes_with_a_chart_that_fits(too_easy):
    (command,) = [text for text in too_easy if text.startswith("evenbreak")]
    points = re.search(r"^(\S+) ± \S+ points double", "\n".join(too_easy), re.MULTILINE).group(1)
    assert command.endswith(f"--scale {points}")
    assert abs(float(points) - 24.0) < 2.0
    made = CliRunner().invoke(program, [*shlex.split(command)[1:], "--text"])
    assert made.exit_code == 0, made.output


def test_a_class_has_its_worth_beside_what_a_start_takes_back():
    fair, worth = said(by_class(1, matches=800))
    assert "too little" in fair
    taken, should = map(
        int, re.search(r"make up for (\d+) points, but should .* (\d+) ±", fair).groups()
    )
    assert taken < 20 < 30 < should
    assert re.search(r"A class is worth 2[0-4] ± ", worth)
    assert "most often 7:6, make up for 7 points" in worth
    assert re.search(r"7:[45] would", worth)


@pytest.fixture(scope="module")
def by_the_book():
    season = by_chart(3, matches=1500)
    return validate(season, prior_sd=0.5), season


@pytest.mark.slow
def test_only_the_largest_start_is_unfair_in_a_league_that_plays_by_its_chart(by_the_book):
    fair, scale = remarks(*by_the_book)
    assert fair.startswith("A head start of 5 games gives too little")
    assert "No head start is larger" in fair
    assert "Taken together, the head starts are fair" in fair
    assert "agree" in scale


def test_a_league_without_handicaps_hears_nothing(chosen):
    assert list(handicap_remarks(chosen, league_chart(chosen.forecasts.results), NPL)) == []


def spots(*counts):
    """Return the starts of 1, 2, ... games with so many (won, matches), and all together."""
    every = [*enumerate(counts, 1), (None, tuple(map(sum, zip(*counts, strict=True))))]
    return [
        HandicapFairness(games, matches, won, won / matches, *wilson(won / matches, matches), 0.5)
        for games, (won, matches) in every
    ]


@pytest.mark.parametrize(
    ("counts", "parts"),
    [
        (((100, 200), (68, 100), (32, 100)), ["Taken together", "2 games gives too little", "68%"]),
        (((92, 200), (100, 200), (108, 200)), []),
        (
            ((180, 400), (200, 400), (228, 400)),
            ["The more games a player gives, the more often", "57%"],
        ),
    ],
)
def test_starts_that_are_fair_only_on_average_are_named(by_the_book, counts, parts):
    found, season = by_the_book
    fairness = remarks(replace(found, spots=spots(*counts)), season)[0]
    assert fairness.startswith("The handicaps look fair") == (not parts)
    for part in parts:
        assert part in fairness


def test_starts_that_are_clearly_unfair_are_named_among_few_matches(by_the_book):
    found, season = by_the_book
    fairness = remarks(replace(found, spots=spots((9, 9), (0, 9))), season)[0]
    assert "look fair" not in fairness
    assert "1 game gives too little" in fairness
    assert "2 games gives too much" in fairness
