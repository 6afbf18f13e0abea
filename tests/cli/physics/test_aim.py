import pytest

from evenbreak.questions.english import english_in


def test_the_distance_is_in_the_units_of_the_command(ask_physics):
    inches = ask_physics("aim", "--cut 20 --distance 36")
    metric = ask_physics("aim", f"--cut 20 --distance {36 * 2.54!r} --metric")
    assert metric["offset_cm"] == pytest.approx(2.54 * inches["offset_in"])


@pytest.mark.parametrize(
    ("text", "way"),
    [
        ("outside", "1 tip outside"),
        ("left-hand english", "1 tip left"),
        ("2 tips of inside", "1.4 tips inside"),
        ("120% left", "1.4 tips left"),
    ],
)
def test_english_without_an_amount_or_with_too_much_is_shown_the_way(run, text, way):
    refused = run("physics", "aim", "--cut", "30", "--distance", "36", "--english", text)
    assert refused.exit_code == 2
    assert f'"{way}"' in " ".join(refused.stderr.split())
    english_in(way)
