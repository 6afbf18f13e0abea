"""What a night does to the ratings, by hand and by a season that was played."""

import importlib.util
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.files.results.results_file import read_results
from evenbreak.handicaps.charts.chart import chart
from evenbreak.handicaps.systems.catalog import system_of
from evenbreak.handicaps.systems.rating_changes import apply_results
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import NOT_STATED, Roster
from places import DATA

NPL = system_of("npl")
CLUB = Roster(["Cy", "Ann", "Bo"], [71, 92, 80], [9.0, 4.0, np.nan], [10, 200, NOT_STATED])


def night(*rows, **columns):
    a, b, score_a, score_b = zip(*rows, strict=True)
    return Results.from_names(a, b, score_a, score_b, **columns)


def test_the_player_who_reached_the_race_moves_up_whatever_the_score():
    changes = apply_results(NPL, CLUB, night(("Ann", "Bo", 4, 4), race_a=[5], race_b=[4]))
    assert list(changes.after.rating) == [71, 91, 81]
    (match,) = changes.matches
    assert (match.winner, match.loser, match.games, match.race) == (2, 1, (4, 4), (4, 5))
    assert (match.by_chart, match.points) == (None, (1, -1))


def test_the_changes_of_a_night_add_up_from_the_list_before_it():
    results = night(
        ("Ann", "Bo", 5, 3), ("Bo", "Ann", 4, 2), ("Bo", "Cy", 5, 1), ("Cy", "Bo", 3, 5)
    )
    changes = apply_results(NPL, CLUB, results, chart=chart("npl_10"))
    assert list(changes.after.rating) == [69, 92, 82]
    assert list(changes.won), list(changes.lost) == ([0, 1, 3], [2, 1, 1])
    assert list(changes.after.games) == [24, 214, NOT_STATED]
    assert changes.before is CLUB
    np.testing.assert_array_equal(changes.after.standard_error, CLUB.standard_error)


def test_the_chart_sets_the_race_where_none_is_stated():
    by_ten = chart("npl_10")
    changes = apply_results(NPL, CLUB, night(("Cy", "Ann", 4, 5)), chart=by_ten)
    assert changes.matches[0].race == changes.matches[0].by_chart == (4, 6)
    assert list(changes.after.rating) == [72, 91, 80]


def test_a_stated_race_goes_before_the_charts():
    results = night(("Ann", "Cy", 5, 4), race_a=[5], race_b=[5])
    (match,) = apply_results(NPL, CLUB, results, chart=chart("npl_10")).matches
    assert (match.race, match.by_chart) == ((5, 5), (6, 4))


def test_a_stated_winner_needs_no_race():
    changes = apply_results(NPL, CLUB, night(("Ann", "Bo", 3, 5), winner=[2]))
    assert list(changes.after.rating) == [71, 91, 81]


def test_a_match_known_by_its_winner_alone():
    results = night(("Ann", "Bo", 0, 0), race_a=[5], race_b=[4], winner=[1], unscored=[True])
    changes = apply_results(NPL, CLUB, results)
    assert (changes.matches[0].games, changes.matches[0].race, changes.empty) == (None, (5, 4), 0)
    assert list(changes.after.rating) == [71, 93, 79]
    assert list(changes.after.games) == list(CLUB.games)


def test_forfeits_and_matches_not_played_change_nothing():
    results = night(
        ("Ann", "Bo", 5, 0), ("Ann", "Zed", 0, 0), ("Cy", "Bo", 0, 0), forfeit=[True, True, False]
    )
    changes = apply_results(NPL, CLUB, results)
    assert (changes.matches, changes.forfeits, changes.empty) == ((), 2, 1)
    assert list(changes.after.rating) == list(CLUB.rating)


def test_no_results_leave_the_list_as_it_is():
    empty = Results.from_names([], [], [], [])
    assert list(apply_results(NPL, CLUB, empty, chart=chart("npl_8")).after.rating) == [71, 92, 80]


def test_a_chart_is_looked_up_with_whole_points():
    club = Roster(["Ann", "Bo"], [92.5, 87.4])
    by_ten = chart("npl_10")
    (match,) = apply_results(NPL, club, night(("Ann", "Bo", 5, 3)), chart=by_ten).matches
    assert match.race == by_ten.race(93 - 87) == (5, 4)
    assert by_ten.race(5) == (5, 5)


def test_results_that_cannot_be_used_are_refused():
    with pytest.raises(InputError, match="row 0 of the results: 'Zed' isn't on the list"):
        apply_results(NPL, CLUB, night(("Ann", "Zed", 5, 3), race_a=[5], race_b=[5]))


def test_a_season_night_by_night_finds_the_races_that_were_played():
    # The script that made the season keeps ratings of its own, and they chose these races.
    spec = importlib.util.spec_from_file_location("make_league", DATA / "make_demo_league.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    names, skills, off = zip(*script.ROSTER, strict=True)
    roster = Roster(names, np.add(skills, off))
    season = read_results(DATA / "demo_league.csv").results
    bare = replace(season, race_a=None, race_b=None)
    played = 0
    for day in np.unique(season.date):
        of_day = season.date == day
        changes = apply_results(NPL, roster, bare.select(of_day), chart=chart("npl_10"))
        stated = season.select(of_day)
        for match in changes.matches:
            a_won = season.players[stated.player_a[match.row]] == names[match.winner]
            races = (stated.race_a, stated.race_b) if a_won else (stated.race_b, stated.race_a)
            assert match.by_chart == tuple(int(race[match.row]) for race in races)
        roster = changes.after
        played += len(changes.matches)
    assert played == 395
    assert roster.rating.sum() == sum(skills) + sum(off)
    assert np.abs(roster.rating - skills).mean() < np.abs(off).mean()


@st.composite
def nights(draw):
    ratings = draw(st.lists(st.integers(20, 130), min_size=2, max_size=6))
    roster = Roster([f"P{k}" for k in range(len(ratings))], ratings)
    by = chart(draw(st.sampled_from(NPL.charts)))
    rows = []
    for _ in range(draw(st.integers(1, 8))):
        a, b = draw(st.permutations(range(len(ratings))))[:2]
        m, n = by.race(ratings[a] - ratings[b])
        a_wins = draw(st.booleans())
        score = (m, draw(st.integers(0, n - 1))) if a_wins else (draw(st.integers(0, m - 1)), n)
        rows.append((a, b, *score, a_wins))
    return roster, by, rows


@given(nights())
def test_a_night_by_hand(drawn):
    roster, by, rows = drawn
    results = night(*((f"P{a}", f"P{b}", i, j) for a, b, i, j, _ in rows))
    changes = apply_results(NPL, roster, results, chart=by)
    rating = list(roster.rating)
    for a, b, _, _, a_wins in rows:
        rating[a] += 1 if a_wins else -1
        rating[b] -= 1 if a_wins else -1
    assert list(changes.after.rating) == rating
    assert changes.after.rating.sum() == roster.rating.sum()
    assert changes.won.sum() == changes.lost.sum() == len(rows) == len(changes.matches)
    for match, (_, _, i, j, _) in zip(changes.matches, rows, strict=True):
        assert sorted(match.games) == sorted((i, j))
        assert match.games[0] == match.race[0]
        assert match.games[1] < match.race[1]


def test_newcomers_steps_are_counted_match_by_match():
    club = Roster(["Ann", "New"], [92, 60], matches=[NOT_STATED, 9])
    results = night(
        ("Ann", "New", 5, 3), ("New", "Ann", 5, 3), ("Ann", "New", 5, 1), winner=[1, 1, 1]
    )
    changes = apply_results(NPL, club, results)
    assert [match.points for match in changes.matches] == [(1, -3), (2, -1), (1, -2)]
    assert list(changes.after.rating) == [93, 57]
    assert list(changes.after.matches) == [NOT_STATED, 12]


def test_forfeits_do_not_count_as_a_newcomers_matches():
    club = Roster(["Ann", "New"], [92, 60], matches=[40, 0])
    results = night(("Ann", "New", 5, 0), forfeit=[True])
    assert list(apply_results(NPL, club, results).after.matches) == [40, 0]
