import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.systems.catalog import system_of
from evenbreak.handicaps.systems.step import step_system
from rows import each_of


@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("Step 3", "step 3"),
        ("step-3-1", "step 3 1"),
        ("step  3\t1", "step 3 1"),
        ("margin", "margin 2"),
        ("ELO", "elo 16"),
        ("elo-32", "elo 32"),
        ("fixed 13", "fixed 13"),
        ("level-steps 2", "level-steps 2"),
        ("level_steps-1", "level-steps 1"),
    ],
)
def test_a_name_is_a_word_and_numbers(written, name):
    assert system_of(written).name == name


def test_a_system_is_its_own_name():
    system = step_system(7)
    assert system_of(system) is system


@each_of(
    "written, message",
    [
        ("fide", "system must be npl, step UP .DOWN., .*fixed"),
        ("", "system must be npl"),
        (
            None,
            (
                r"system must be npl, step UP \[DOWN\], margin \[MOST\], elo \[K\], fixed "
                r"\[GAMES\], none \[GAMES\], fargo-like, level-review, apa-like, tap-like, "
                r"level-steps \[STEPS\], averages, win-percent or napa-like; you gave None"
            ),
        ),
        ("npl 3", "Write it as npl"),
        ("step", r"Write it as step UP \[DOWN\], in whole numbers"),
        ("step 1 2 3", "Write it as step"),
        ("step -2", "Write it as step"),
        ("step 1.5", "Write it as step"),
        ("step ²", "Write it as step"),
        ("elo 0", "system is 'elo 0': k must"),
        ("fixed 8", "system is 'fixed 8': games is 8"),
        ("level-review lowest=-3", "lowest must be a whole number, 0 or more; you gave -3"),
        ("fargo-like starter=nan", "starter must be a number from -10000 to 10000; you gave nan"),
        ("napa-like newcomer=inf", "newcomer must be a number from 0 to 10000; you gave inf"),
    ],
)
def test_what_names_no_system_is_told_with_what_does(written, message):
    with pytest.raises(InputError, match=message):
        system_of(written)


@each_of(
    "written, message",
    [
        ("level-review windw=3", "windw isn't one of its parameters: window, kept"),
        (
            "level-review window=many",
            "system is 'level-review window=many': window must be a number; you gave 'many'",
        ),
        ("level-review trim=10", "leaves none of the 20 scores"),
        ("npl k=3", "Leave out k="),
        ("fargo-like 3", "Write it as fargo-like"),
        (
            "averages games=8",
            "system is 'averages games=8': games must be an odd number; you gave 8",
        ),
    ],
)
def test_parameters_that_a_system_cannot_have_are_refused(written, message):
    with pytest.raises(InputError, match=message):
        system_of(written)


def test_parameters_are_set_by_name():
    system = system_of("Tap Like window=15 lowest=none hysteresis=.25")
    assert (system.window, system.lowest, system.hysteresis, system.trim) == (15, None, 0.25, 1)
    assert system_of(system.name) == system
    assert system_of("none 7").games == 7
