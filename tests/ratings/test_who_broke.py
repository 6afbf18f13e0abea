import math
from collections import Counter
from itertools import product

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.ratings import Results
from evenbreak.ratings.results_frame import FORMATS
from evenbreak.ratings.who_broke import BreakWinsTerms, break_wins, breakers, count_broken
from rows import each_of


def counts(racks="", form="", first=0, score=None):
    won = (racks.count("a"), racks.count("b")) if score is None else score
    season = Results.from_names(
        ["Ann"],
        ["Bo"],
        [won[0]],
        [won[1]],
        racks=[racks],
        break_format=[FORMATS.index(form)],
        first_break=[first],
    )
    broken = count_broken(season)
    return tuple(broken.won[:, 0].tolist()), tuple(broken.lost[:, 0].tolist())


@each_of(
    "racks, form, first, won, lost",
    [
        # who broke:  a a b b a
        ("abbaa", "winner", 1, (0, 2, 1), (0, 1, 1)),
        # who broke:  ? a b b a
        ("abbaa", "winner", 0, (1, 1, 1), (0, 1, 1)),
        # who broke:  b b a a b
        ("abbaa", "loser", 2, (0, 1, 2), (0, 1, 1)),
        # who broke:  a b a b a
        ("abbaa", "alternate", 1, (0, 2, 1), (0, 1, 1)),
        ("abbaa", "alternate", 0, (3, 0, 0), (2, 0, 0)),
        ("abbaa", "a", 0, (0, 3, 0), (0, 2, 0)),
        ("abbaa", "b", 1, (0, 0, 3), (0, 0, 2)),
        ("abbaa", "", 0, (3, 0, 0), (2, 0, 0)),
        ("abbaa", "", 2, (2, 0, 1), (2, 0, 0)),
        ("", "winner", 1, (0, 0, 0), (0, 0, 0)),
    ],
)
def test_who_broke_follows_from_format_and_racks(racks, form, first, won, lost):
    assert counts(racks, form, first) == (won, lost)


def test_scores_tell_who_broke_only_where_one_player_did_throughout():
    assert counts(form="a", score=(7, 4)) == ((0, 7, 0), (0, 4, 0))
    assert counts(form="alternate", first=1, score=(7, 4)) == ((7, 0, 0), (4, 0, 0))


def test_no_columns_no_breakers():
    broken = count_broken(Results.from_names(["A"], ["B"], [7], [5]))
    assert (broken.won[:, 0].tolist(), broken.lost[:, 0].tolist()) == ([7, 0, 0], [5, 0, 0])


def test_racks_beyond_the_score_are_refused():
    with pytest.raises(InputError, match="find_problems"):
        counts("aab", "winner", 1, score=(1, 1))


@pytest.mark.parametrize(
    ("form", "first", "expected"),
    [
        ("winner", 2, [2, 1, 2, 2, 1]),
        ("loser", 2, [2, 2, 1, 1, 2]),
        ("alternate", 2, [2, 1, 2, 1, 2]),
        ("a", 1, [1, 1, 1, 1, 1]),
        ("b", 2, [2, 2, 2, 2, 2]),
        ("", 1, [1, 0, 0, 0, 0]),
        ("winner", 0, [0, 1, 2, 2, 1]),
        ("alternate", 0, [0, 0, 0, 0, 0]),
    ],
)
def test_breakers_rack_by_rack(form, first, expected):
    assert breakers("abbaa", form, first) == expected


# In how many ways a score can come about, against all sequences of racks written out.


def written_out(form, first, games, last):
    """Return how many sequences there are by (racks that a broke, of these won by a)."""
    counts = Counter()
    for racks in product((1, 2), repeat=sum(games)):
        if racks.count(1) != games[0] or racks[-1] != last:
            continue
        breaker, broke, won = first, 0, 0
        for winner in racks:
            broke += breaker == 1
            won += breaker == 1 and winner == 1
            breaker = {"winner": winner, "loser": 3 - winner, "alternate": 3 - breaker}[form]
        counts[broke, won] += 1
    return counts


@each_of("form", ["winner", "loser", "alternate"])
@each_of("first", [1, 2])
@each_of("last", [1, 2])
def test_against_all_sequences(form, first, last):
    for games in product(range(6), range(6)):
        if games[last - 1] == 0:
            continue
        wins = break_wins(form, first, games, last)
        got = {
            (wins.broke_a, int(k)): round(math.exp(count))
            for k, count in zip(wins.won, wins.log_count, strict=True)
        }
        assert got == dict(written_out(form, first, games, last)), games


def test_the_derivatives_are_those_of_the_sums():
    splits = BreakWinsTerms.of(
        [break_wins("winner", 1, (7, 5), 1), break_wins("alternate", 2, (3, 9), 2)]
    )
    low, at, high = (splits.log_sums(0.3 + step) for step in (-1e-5, 0.0, 1e-5))
    np.testing.assert_allclose((high[0] - low[0]) / 2e-5, at[1], rtol=1e-6)
    np.testing.assert_allclose((high[1] - low[1]) / 2e-5, at[2], rtol=1e-6)


def test_without_matches_there_are_no_sums():
    assert all(part.shape == (0,) for part in BreakWinsTerms.of([]).log_sums(0.1))
