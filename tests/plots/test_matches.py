import numpy as np
import pytest

from evenbreak.games import Race, Rack, winner_breaks
from evenbreak.matches import crossings, live_odds, match_format, win_probability
from evenbreak.plots.matches import course_figure, draw_formats


def test_curves_and_crossings():
    formats = [match_format(text) for text in ("2:1", "4:2", "ahead 2:2")]
    found = crossings(*formats[:2])
    axes = draw_formats(formats, {}, [found], p1=0.6)
    curves = {line.get_label(): line for line in axes.lines}
    for played in formats:
        p, wins = curves[str(played)].get_xdata(), curves[str(played)].get_ydata()
        assert np.allclose(wins, win_probability(played.match(Rack(p))))
    assert list(curves["equal formats"].get_xdata()) == [found.points[0].p1]
    assert axes.get_xlabel() == "chance that A wins a game"


def test_along_p1_at_a_fixed_p2():
    line = {"p2": 0.7, "breaks": winner_breaks, "first_breaker": 2}
    played = match_format("3:2")
    axes = draw_formats([played], line, [], p1=0.6)
    (curve,) = (curve for curve in axes.lines if curve.get_label() == "3:2")
    at = len(curve.get_xdata()) // 2
    match = played.match(Rack(curve.get_xdata()[at], 0.7), breaks=winner_breaks, first_breaker=2)
    assert curve.get_ydata()[at] == pytest.approx(win_probability(match))
    assert "A breaks" in axes.get_xlabel()
    assert "equal formats" not in [text.get_text() for text in axes.get_legend().get_texts()]


def test_the_picture_names_the_players():
    two = [match_format("2:1"), match_format("4:2")]
    axes = draw_formats(two, {}, [], p1=0.6, title="Ann against Bo", names=("Ann", "Bo"))
    assert axes.figure.get_suptitle() == "Ann against Bo"
    assert (axes.get_xlabel(), axes.get_ylabel()) == (
        "chance that Ann wins a game",
        "chance that Ann wins the match",
    )
    (line,) = (line for line in axes.lines if line.get_label() == "Ann against Bo")
    assert list(line.get_xdata()) == [0.6, 0.6]


@pytest.fixture
def odds():
    return live_odds(Race(4, 3, Rack(0.6)), [1, 2, 2, 1, 1])


def test_the_line_is_the_course(odds):
    above, below = course_figure(odds).axes
    (line,) = (line for line in above.lines if len(line.get_xdata()) == 6)
    assert list(line.get_ydata()) == [moment.p_win_1 for moment in odds.course]
    assert [bar.get_height() for bar in below.patches] == [m.leverage for m in odds.course[:-1]]
    assert [label.get_text() for label in below.get_xticklabels()][-1] == "3-2"


def test_dots_show_who_won_a_rack(odds):
    above, _ = course_figure(odds).axes
    dots = {line.get_label(): list(line.get_xdata()) for line in above.lines}
    assert dots["A won the rack"] == [1, 4, 5]
    assert dots["B won the rack"] == [2, 3]


def test_the_largest_swing_is_labeled(odds):
    above, _ = course_figure(odds).axes
    (text,) = above.texts
    greatest = max(odds.swings, key=abs)
    assert text.get_text() == f"{greatest:+.2f}".replace("-", "\N{MINUS SIGN}")


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("p", [0.2, 0.6, 0.9])
@pytest.mark.parametrize("racks", ["a", "abb", "bbab", "ababbab", "abbabababab"])
def test_the_label_is_clear_of_the_line(p, racks):
    odds = live_odds(Race(7, 6, Rack(p)), ["ab".index(letter) + 1 for letter in racks])
    figure = course_figure(odds)
    figure.canvas.draw()
    above, _ = figure.axes
    box = above.texts[0].get_window_extent()
    x = np.linspace(0, len(racks), 2001)
    y = np.interp(x, range(len(racks) + 1), [moment.p_win_1 for moment in odds.course])
    assert not box.count_contains(above.transData.transform(np.column_stack([x, y])))
    frame = above.get_window_extent()
    assert frame.y0 < box.y0
    assert box.y1 < frame.y1


def test_sets_and_one_sided_matches():
    _, below = course_figure(live_odds(Race(2, 2, Race(2, 2, Rack(0.6))), [1, 1, 1])).axes
    labels = [label.get_text() for label in below.get_xticklabels()]
    assert labels == ["0-0\n0-0", "0-0\n1-0", "1-0\n0-0", "1-0\n1-0"]


def test_long_matches_name_some_scores_only():
    _, below = course_figure(live_odds(Race(60, 60, Rack(0.5)), [1, 2] * 40)).axes
    assert len(below.get_xticks()) <= 24


def test_the_picture_names_match_and_players(odds):
    figure = course_figure(odds, title="Ann against Bo\nRace 4:3", names=("Ann", "Bo"))
    assert figure.get_suptitle() == "Ann against Bo\nRace 4:3"
    above, _ = figure.axes
    assert above.get_ylabel() == "chance that Ann wins the match"
    assert [text.get_text().split()[0] for text in above.get_legend().get_texts()] == ["Ann", "Bo"]
    assert course_figure(odds).get_suptitle() == ""
