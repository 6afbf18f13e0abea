import pytest

from evenbreak.cli.physics.hit_options import hit_of


def test_the_hit_is_as_typed():
    hit = hit_of(cut=-30.0, topspin=0.5, side=0.2, mu=0.06, friction="shepard")
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


@pytest.mark.parametrize("offset", ["--offset -0.3", "--offset 0.2 --side-offset -0.1"])
def test_strike_and_shot_are_hit_at_the_same_place(ask_physics, offset):
    struck = ask_physics("strike", offset)
    traced = ask_physics("shot", f"--cut 0 --distance 24 --speed 50 {offset}")
    for name in ("spin_speed_ratio", "side_spin_speed_ratio"):
        assert traced[name] == struck[name]
