"""Systems side by side: what is advised, and what files hold."""

import numpy as np
import pytest

from evenbreak.answers.ladder.comparison import (
    NEWCOMERS,
    LadderComparison,
    ladder_comparison_answer,
)
from evenbreak.handicaps import chart
from evenbreak.handicaps.ladders.comparison import SystemRow
from evenbreak.league import Reestimated


def row(system, name, sd, settling):
    return SystemRow(system, name, sd, sd / 30, settling, int(1.4 * settling), 0.53, 0.25, 7.3, 0.0)


OWN = row("npl", "npl_10", 4.6, 60.0)
LONGER = row("npl", "npl_20", 3.7, 47.0)
NEW = row(NEWCOMERS, "npl_10", 4.6, 27.0)
STEP = row("step 10", "npl_10", 14.5, 5.8)


@pytest.fixture
def asked():
    def answer(*systems, steps=((STEP, True),)):
        found = LadderComparison(chart("npl_10"), "natural", [OWN, NEW, *systems], steps, None)
        return ladder_comparison_answer(found)

    return answer


def test_the_advice_comes_first(asked):
    text = asked(LONGER).sentences[0]
    assert text.startswith("Ratings are most accurate with npl on npl_20.")
    assert "step 10 on npl_10, in 5.8 matches" in text
    assert "npl on npl_20 is the most accurate of the systems that are no slower" in text
    assert "(npl new) take 27.0 matches" in text


def test_where_nothing_no_slower_is_better_that_is_said(asked):
    text = asked().sentences[0]
    assert text.startswith("Ratings are most accurate with npl on npl_10.")
    assert "no other system is both" in text


def test_steps_that_are_never_worth_it_are_named(asked):
    beaten = row("step 6", "npl_10", 15.0, 6.0)
    assert "Step 6 is never" in asked(steps=((STEP, True), (beaten, False))).sentences[-1]
    assert "never" not in asked().sentences[-1]


def test_files_say_which_steps_are_beaten(asked):
    frame = asked(LONGER).to_frame()
    assert frame["on_front"].tolist() == [None, None, None, True]
    assert asked(LONGER).to_dict()["systems"][-1]["on_front"] is True


def test_refitted_ratings_stand_below_the_systems_with_their_errors():
    refitted = Reestimated(row("refit", "npl_10", 5.5, 9.2), 0.21, 2.7, 0.0, np.zeros((8, 52)))
    found = LadderComparison(chart("npl_10"), "equal skill", [OWN, NEW], [(STEP, True)], refitted)
    answer = ladder_comparison_answer(found)
    assert any("0.21 points" in text and "2.7" in text for text in answer.sentences)
    frame = answer.to_frame()
    assert frame["system"].tolist() == ["npl", NEWCOMERS, "refit", "step 10"]
    assert frame["sd_se"].dropna().tolist() == [0.21]


def test_inflating_systems_are_named(asked):
    rising = LONGER._replace(system="step 2 1", inflation=1.0)
    assert any("step 2 1 by +1.00" in text for text in asked(rising).sentences)
