import pytest

from evenbreak.answers.physics.asked import hit_of
from evenbreak.questions.physics import Throw


def test_the_hit_is_as_typed():
    hit = hit_of(Throw(cut=-30.0, topspin=0.5, side=0.2, friction="shepard", mu=0.06))
    assert (hit.cut, hit.topspin, hit.side, hit.mu, hit.friction) == (
        *(-30.0, 0.5, 0.2, 0.06),
        "shepard",
    )


@pytest.mark.parametrize("name", ["throw", "aim --distance 36", "deflect"])
def test_the_defaults_are_natural_roll_without_english(ask_physics, name):
    command, *rest = name.split()
    answer = ask_physics(command, f"--cut 30 {' '.join(rest)}")
    assert (answer["topspin"], answer["side"], answer["friction"]) == (1.0, 0.0, "limited")
    assert answer["mu"] == pytest.approx(4 / 72)
    line = "--cut 30 --topspin -1 --side 0.2 --mu 0.1 --friction shepard"
    asked = ask_physics(command, f"{line} {' '.join(rest)}")
    assert (asked["topspin"], asked["side"], asked["mu"]) == (-1.0, 0.2, 0.1)
    assert asked["friction"] == "shepard"


@pytest.mark.parametrize("name", ["throw", "aim --distance 36", "deflect"])
def test_a_speed_makes_the_friction_fall_with_it(ask_physics, name):
    command, *rest = name.split()
    line = f"--cut 30 --topspin 0 {' '.join(rest)}"
    soft, hard = (ask_physics(command, f"{line} --speed {speed}") for speed in (60, 150))
    assert soft["mu_by_speed"] is hard["mu_by_speed"] is True
    assert (soft["hit_speed_in_s"], hard["hit_speed_in_s"]) == (60.0, 150.0)
    assert soft["throw_deg"] > hard["throw_deg"]
    named = ask_physics(command, f"{line} --speed 60 --mu by-speed")
    assert named["throw_deg"] == soft["throw_deg"]
    metric = ask_physics(command, f"{line} --speed 1.524 --metric".replace("36", "91.44"))
    assert metric["throw_deg"] == pytest.approx(soft["throw_deg"])
    constant = ask_physics(command, line)
    assert (constant["mu_by_speed"], constant["hit_speed_in_s"]) == (False, None)


def test_a_traced_shot_takes_the_friction_of_its_hit(ask_physics):
    line = "--cut 30 --distance 24 --speed 150 --offset -0.3"
    by_speed = ask_physics("shot", f"{line} --mu by-speed")
    assert by_speed["mu_by_speed"] is True
    assert by_speed["mu"] < 4 / 72
    known = ask_physics("shot", f"{line} --mu {by_speed['mu']!r}")
    assert known["throw_deg"] == pytest.approx(by_speed["throw_deg"])
    missed = ask_physics("shot", "--cut 30 --distance 24 --speed 1 --mu by-speed")
    assert (missed["reached"], missed["mu"], missed["mu_by_speed"]) == (False, None, True)


@pytest.mark.parametrize("offset", ["--offset -0.3", "--offset 0.2 --side-offset -0.1"])
def test_strike_and_shot_are_hit_at_the_same_place(ask_physics, offset):
    struck = ask_physics("strike", offset)
    traced = ask_physics("shot", f"--cut 0 --distance 24 --speed 50 {offset}")
    for name in ("spin_speed_ratio", "side_spin_speed_ratio"):
        assert traced[name] == struck[name]
