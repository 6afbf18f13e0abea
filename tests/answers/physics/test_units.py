import pytest

from evenbreak.answers.physics.units import IMPERIAL, METRIC, unit_doubts


def test_a_quantity_is_named_by_its_unit():
    inches = IMPERIAL.length.quantity("slide", 0.0254)
    metric = METRIC.length.quantity("slide", 0.0254)
    assert (inches.name, inches.value) == ("slide_in", pytest.approx(1.0))
    assert (metric.name, metric.value) == ("slide_cm", pytest.approx(2.54))
    assert IMPERIAL.mass.quantity("optimal_cue", None).value is None


def test_a_number_reads_as_it_was_typed():
    assert IMPERIAL.length.typed(24.0 * IMPERIAL.length.size) == "24 inches"
    assert METRIC.speed.typed(1.5) == "1.5 meters per second"


@pytest.mark.parametrize(
    ("units", "typed", "option", "remedy"),
    [
        (METRIC, {"stick": 18.0}, "stick 18 grams", "For ounces, leave out metric"),
        (IMPERIAL, {"stick": 540.0}, "stick 540 ounces", "For grams, add metric"),
        (METRIC, {"forearm": 36.0}, "forearm 36", "For ounces, leave out"),
        (METRIC, {"speed": 60.0}, "60 meters per second", "For inches per second, leave"),
        (IMPERIAL, {"stick_speed": 6e3}, "stick_speed 6000", "For meters per second, add metric"),
    ],
)
def test_a_value_that_may_be_in_other_units_is_doubted(units, typed, option, remedy):
    (doubt,) = unit_doubts(units, **typed)
    assert option in doubt
    assert remedy in doubt


def test_typical_values_are_not_doubted():
    typical = {"stick": 19.0, "ball": 6.0, "forearm": 36.0, "speed": 80.0, "stick_speed": None}
    assert unit_doubts(IMPERIAL, **typical) == []
    assert unit_doubts(METRIC, stick=538.0, ball=170.0, forearm=1020.0, speed=2.0) == []
