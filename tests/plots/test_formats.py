import numpy as np
import pytest

from evenbreak.games import Rack, winner_breaks
from evenbreak.matches import crossings, match_format, win_probability
from evenbreak.plots.matches import draw_formats


def test_curves_and_crossings():
    formats = [match_format(text) for text in ("2:1", "4:2", "ahead 2:2")]
    found = crossings(*formats[:2])
    axes = draw_formats(formats, {}, [found], p1=0.6)
    curves = {line.get_label(): line for line in axes.lines}
    for played in formats:
        p, wins = curves[str(played)].get_xdata(), curves[str(played)].get_ydata()
        assert np.allclose(wins, win_probability(played.match(Rack(p))))
    assert list(curves["worth the same"].get_xdata()) == [found.points[0].p1]
    assert axes.get_xlabel() == "p = P(A wins a game)"


def test_along_p1_at_a_fixed_p2():
    line = {"p2": 0.7, "breaks": winner_breaks, "first_breaker": 2}
    played = match_format("3:2")
    axes = draw_formats([played], line, [], p1=0.6)
    (curve,) = (curve for curve in axes.lines if curve.get_label() == "3:2")
    at = len(curve.get_xdata()) // 2
    match = played.match(Rack(curve.get_xdata()[at], 0.7), breaks=winner_breaks, first_breaker=2)
    assert curve.get_ydata()[at] == pytest.approx(win_probability(match))
    assert "A breaks" in axes.get_xlabel()
    assert "worth the same" not in [text.get_text() for text in axes.get_legend().get_texts()]


def test_the_picture_names_the_players():
    two = [match_format("2:1"), match_format("4:2")]
    axes = draw_formats(two, {}, [], p1=0.6, title="Ann against Bo", names=("Ann", "Bo"))
    assert axes.figure.get_suptitle() == "Ann against Bo"
    assert (axes.get_xlabel(), axes.get_ylabel()) == (
        "p = P(Ann wins a game)",
        "P(Ann wins the match)",
    )
    (line,) = (line for line in axes.lines if line.get_label() == "Ann against Bo")
    assert list(line.get_xdata()) == [0.6, 0.6]
