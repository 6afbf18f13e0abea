import pytest

from evenbreak import InputError
from evenbreak.plots.contours import draw_shots
from evenbreak.plots.picture import image_bytes
from evenbreak.practice import ShotChoice

SHOTS = [ShotChoice("bank", 0.4, 0.8), ShotChoice("safety", 0.3, 0.3)]


@pytest.mark.parametrize("look_ahead", ["infinite", "two shots"])
def test_shots_stand_at_their_chances_by_name(look_ahead):
    axes = draw_shots(SHOTS, look_ahead=look_ahead)
    dots = [(line.get_xdata()[0], line.get_ydata()[0]) for line in axes.lines]
    assert dots == [(0.4, 0.8), (0.3, 0.3)]
    names = {note.get_text(): note.xy for note in axes.texts if hasattr(note, "xy")}
    assert names == {"bank": (0.4, 0.8), "safety": (0.3, 0.3)}


def test_the_look_aheads_look_different_and_each_the_same_every_time():
    pictures = [
        image_bytes(draw_shots(SHOTS, look_ahead=look_ahead), "svg")
        for look_ahead in ("infinite", "infinite", "two shots")
    ]
    assert pictures[0] == pictures[1] != pictures[2]


def test_an_unknown_look_ahead_is_refused():
    with pytest.raises(InputError, match="'infinite' or 'two shots'"):
        draw_shots(SHOTS, look_ahead="three shots")
