import math

import pytest

from evenbreak.answers.physics.shot import shot_heading, shot_words
from evenbreak.answers.physics.units import IMPERIAL
from evenbreak.physics import PoolTable, pocketed_shot, pockets, shot, strike_for_speed
from evenbreak.physics.units import INCH

POCKETS = {pocket.name: pocket for pocket in pockets(PoolTable())}
CORNER = ((25, 16), (50, 25), "foot-left")
FROZEN = ((20, 1.125), (50, 1.125), "foot-right")
FLAT = ((90, 40), (70, 44), "side-left")


def by_angle(cut=30, distance=24, speed=60, up=-0.3):
    found = shot(strike_for_speed(speed * INCH, up), math.radians(cut), distance * INCH)
    return " ".join(shot_words(found, None, IMPERIAL, None))


def at_pocket(cue, standing, name, speed=60, right=0.0, **kit):
    places = [[x * INCH, y * INCH] for x, y in (cue, standing)]
    struck = strike_for_speed(speed * INCH, 0.0, right)
    aimed = pocketed_shot(struck, *places, POCKETS[name], **kit)
    return " ".join(shot_words(aimed.shot, aimed, IMPERIAL, POCKETS[name]))


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ({}, "stops after"),
        ({"speed": 5}, "never reaches the object ball: it stops after 0.9 inches"),
        ({"speed": 80}, "still sliding"),
        ({"speed": 200}, "hits a rail"),
        ({"cut": 0, "distance": 2.25, "up": 0.0}, "arrives at once with stun"),
        ({"cut": 0, "distance": 2.25, "up": 0.0}, "The cue ball stops dead"),
        ({"cut": 0, "distance": 9, "up": 0.4}, "natural roll, rolling from the start"),
        ({"cut": 0, "distance": 9, "speed": 0}, "it stops after 0.0 inches"),
    ],
)
def test_where_the_balls_go(how, words):
    assert words in by_angle(**how)


@pytest.mark.slow_after(2)
@pytest.mark.parametrize(
    ("layout", "how", "words"),
    [
        (CORNER, {}, "Aim 0.36 inches to the left of the middle"),
        (CORNER, {}, "into the foot-left pocket at 20.2 inches per second"),
        (CORNER, {"mu": 0.0}, "hardly any throw"),
        (CORNER, {"speed": 30}, "does not drop: it stops 35.7 inches short"),
        (FROZEN, {}, "0.47 inches to the right of it"),
        (FROZEN, {}, "foot-right pocket"),
        (((20, 10), *FROZEN[1:]), {"right": 0.1}, "throw brings it back in line"),
        (FLAT, {}, "does not drop: from this angle the pocket is only 1.43 inches wide"),
    ],
)
def test_how_a_shot_is_aimed_and_why_it_misses(layout, how, words):
    assert words in at_pocket(*layout, **how)


def test_the_first_paragraph_says_where_both_balls_end():
    found = shot(strike_for_speed(60 * INCH), 0.5, 20 * INCH)
    first, second = shot_words(found, None, IMPERIAL, None)
    assert "object ball" in first
    assert "cue ball" in first
    assert "arrives" in second


def test_the_heading_has_the_numbers_that_were_typed():
    found = shot(strike_for_speed(60 * INCH, -0.3), math.radians(30), 24 * INCH)
    heading = shot_heading(found, IMPERIAL, None)
    for number in ("30 degrees", "24 inches", "0.3 radii", "60 inches per second"):
        assert number in heading
