import pytest

from evenbreak import InputError
from evenbreak.games import Rack
from evenbreak.plots.contours import breaks_figure


def titles(figure):
    return [axes.get_title() for axes in figure.axes]


def test_titles_have_the_shares_and_every_panel_the_dot():
    figure = breaks_figure(Rack(0.5, 0.1))
    assert titles(figure) == [
        "winner breaks: A wins 0.643",
        "loser breaks: A wins 0.833",
        "alternate breaks: A wins 0.700",
        "winner minus loser breaks: \N{MINUS SIGN}0.190",
    ]
    for axes in figure.axes:
        assert [(line.get_xdata()[0], line.get_ydata()[0]) for line in axes.lines] == [(0.5, 0.1)]


def test_the_first_breaker_counts_where_the_break_never_passes_on():
    assert titles(breaks_figure(Rack(1, 1)))[0] == "winner breaks: A wins 1.000"
    assert titles(breaks_figure(Rack(1, 1), first_breaker=2))[0] == "winner breaks: A wins 0.000"


def test_a_rack_whose_break_does_not_matter_is_on_the_diagonal():
    (dot,) = breaks_figure(Rack(0.6)).axes[0].lines
    assert (dot.get_xdata()[0], dot.get_ydata()[0]) == (0.6, 0.4)


def test_arrays_are_refused():
    with pytest.raises(InputError, match="one number"):
        breaks_figure(Rack([0.5, 0.6], 0.5))


def test_the_picture_says_what_it_shows():
    title, dot = breaks_figure(Rack(0.62, 0.55)).get_suptitle().splitlines()
    assert "long run" in title
    assert "0.62" in dot
    assert "0.55" in dot
