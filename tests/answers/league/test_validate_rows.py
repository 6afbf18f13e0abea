"""A validated season as one table."""

import math

import pytest

from evenbreak.answers.league.validate_findings import COLUMNS, findings_table
from evenbreak.answers.league.validate_handicaps import scored_of


def rows_of(found):
    return [dict(zip(COLUMNS, row, strict=True)) for row in findings_table(found).rows]


def test_every_figure_has_its_row(demo):
    rows = rows_of(demo)
    assert {row["part"] for row in rows} == {
        *("half_life", "prior_sd", "log_loss", "brier", "slope", "gain", "experience"),
        *("first_column", "first_column_dates", "first_column_varies", "side", "first_break"),
        *("calibration", "calibration_plug_in", "no_favorite", "dispersion"),
        *("form", "score", "score_with_form", "spot", "start"),
    }
    (row,) = [r for r in rows if (r["part"], r["of"], r["item"]) == ("slope", "game", "integrated")]
    slope = scored_of(demo, "game").slope
    assert (row["value"], row["low"], row["high"], row["expected"]) == (*slope, 1.0)


def test_the_prior_that_was_chosen_has_its_loss_as_it_went(chosen):
    rows = rows_of(chosen)
    (went,) = [row["value"] for row in rows if row["part"] == "log_loss_as_it_went"]
    assert went == chosen.choice.as_it_went
    (ends,) = [(row["low"], row["high"]) for row in rows if row["part"] == "prior_range"]
    assert ends == (chosen.choice.low, chosen.choice.high)
    tried = [float(row["item"]) for row in rows if row["part"] == "prior"]
    assert tried == pytest.approx(list(chosen.choice.tried), abs=1e-6)


def test_a_coin_is_beside_each_loss(demo):
    losses = [row for row in rows_of(demo) if row["part"] == "log_loss"]
    assert {row["expected"] for row in losses} == {math.log(2)}


def test_bins_count_the_games_in_them(demo):
    rows = [r for r in rows_of(demo) if (r["part"], r["of"]) == ("calibration", "game")]
    assert [row["count"] for row in rows] == [one.games for one in demo.games]
