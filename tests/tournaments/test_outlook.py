"""What is to be expected of an evening: odds by the results and scores so far, the finish."""

import gc
import weakref

import numpy as np
import pytest

from evenbreak.answers.tournament.under_way import time_under_way
from evenbreak.ratings.scale import scale_of
from evenbreak.tournaments import chances_given, over_ratings, pair_odds, title_odds
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan, What
from evenbreak.tournaments.evening.fold import evening
from evenbreak.tournaments.evening.outlook import Outlook
from evenbreak.tournaments.evening.skills import Games, skills_tonight
from evenbreak.tournaments.odds.races import Races

FARGO = scale_of("fargo")


def begun(error: float = 0.0, players: int = 6, **plan: object) -> list[Event]:
    entrants = tuple(Entrant(f"P{k}", 600.0 - 30.0 * k, error) for k in range(1, players + 1))
    opened = Opened(Plan("double", 5, scale="fargo", tables=2, **plan), entrants)  # type: ignore[arg-type]
    events = [Event("2025-03-01T18:50:00", opened)]
    return after(events, "19:00", moves.draw(evening(events), np.random.default_rng(1)))


def after(events: list[Event], at: str, what: What) -> list[Event]:
    return [*events, Event(f"2025-03-01T{at}:00", what)]


def outlook(events: list[Event], at: str = "20:00") -> Outlook:
    return Outlook(evening(events), f"2025-03-01T{at}:00")


def one_played(events: list[Event]) -> list[Event]:
    return after(events, "19:40", moves.result(evening(events), "W1.4", (2, 5)))


def test_sure_odds_are_those_of_the_bracket_given_the_results() -> None:
    found = outlook(one_played(begun()))
    state = found.state
    laws = pair_odds(state.bracket, state.ratings, 5, scale="fargo")
    expected = title_odds(state.bracket, laws, results={"W1.4": state.winners["W1.4"]})
    assert found.odds is found.as_if_sure
    np.testing.assert_allclose(found.odds.p_place, expected.p_place, atol=1e-12)


def test_before_the_first_match_odds_are_averaged_over_the_ratings() -> None:
    found = outlook(begun(40.0))
    state = found.state
    win = chances_given(state.bracket, state.ratings, 5, scale="fargo")
    both = over_ratings(state.bracket, win, state.ratings, [40.0] * 6)
    np.testing.assert_allclose(found.odds.title, both.averaged.title, atol=1e-12)
    np.testing.assert_allclose(found.as_if_sure.title, both.as_if_sure.title, atol=1e-12)
    assert found.odds.title[0] < found.as_if_sure.title[0]


def test_an_outlook_gives_its_memory_back_without_being_collected() -> None:
    """A page works one out after every score; its arrays must not wait for the collector."""
    gc.disable()
    try:
        found = outlook(one_played(begun(40.0)))
        assert len(found.odds.title) == 6
        assert found.as_things_are is not None
        gone = weakref.ref(found)
        del found
        assert gone() is None
    finally:
        gc.enable()


def test_walkovers_happen_only_in_matches_that_have_not_begun() -> None:
    events = one_played(begun())
    events = after(events, "19:45", moves.call(evening(events), "W1.2", 1))
    events = after(events, "19:46", moves.drop(evening(events), "P1"))
    state = outlook(events).state
    laws = pair_odds(state.bracket, state.ratings, 5, scale="fargo")
    wins = {name: law.win.copy() for name, law in laws.items()}
    for name, win in wins.items():
        if name != "W1.2":
            win[:] = 0.1 + 0.8 * win
        gone = state.order.index("P1")
        win[gone], win[:, gone], win[gone, gone] = 0.0, 1.0, 0.5
    expected = title_odds(state.bracket, wins, results=state.results)
    found = Outlook(state, "2025-03-01T20:00:00", walkovers=0.2)
    np.testing.assert_allclose(found.odds.p_place, expected.p_place, atol=1e-12)


def test_a_live_score_is_worth_the_race_that_is_left() -> None:
    events = begun()
    one, other = evening(events).pair("W1.4")
    at_4_2 = after(events, "19:30", moves.score(evening(events), "W1.4", (4, 2)))
    now, mean = outlook(at_4_2), 0.0
    seats = [now.state.order.index(name) for name in (one, other)]
    rack = float(FARGO.win_probability(now.state.ratings[seats[0]] - now.state.ratings[seats[1]]))
    wins = 1.0 - (1.0 - rack) ** 3
    assert now.laws["W1.4"].win[seats[0], seats[1]] == pytest.approx(wins)
    for chance, score in ((wins, (5, 2)), (1.0 - wins, (4, 5))):
        ended = after(events, "19:40", moves.result(evening(events), "W1.4", score))
        mean += chance * outlook(ended).odds.title
    np.testing.assert_allclose(now.odds.title, mean, atol=1e-12)


def test_tonights_games_move_ratings_and_narrow_their_errors() -> None:
    ratings, errors = np.array([600.0, 500.0, 550.0]), np.array([30.0, 80.0, 50.0])
    before, wide = skills_tonight(ratings, errors, [], FARGO)
    np.testing.assert_allclose(before, ratings)
    np.testing.assert_allclose(wide, np.diag(errors**2))
    mean, spread = skills_tonight(ratings, errors, [Games(1, 0, 5, 1)], FARGO)
    assert mean[1] - ratings[1] > ratings[0] - mean[0] > 0.0 == mean[2] - ratings[2]
    assert spread[1, 1] < 80.0**2
    assert spread[0, 1] > 0.0 == spread[0, 2]


def test_the_posterior_is_that_of_a_grid() -> None:
    mean, spread = skills_tonight(
        np.array([500.0, 500.0]), np.array([60.0, 0.0]), [Games(0, 1, 7, 4)], FARGO
    )
    skill = np.linspace(200.0, 800.0, 2001)
    p = np.asarray(FARGO.win_probability(skill - 500.0))
    density = np.exp(-0.5 * ((skill - 500.0) / 60.0) ** 2) * p**7 * (1.0 - p) ** 4
    density /= density.sum()
    center = float(density @ skill)
    assert mean[0] == pytest.approx(center, abs=1.0)
    assert spread[0, 0] ** 0.5 == pytest.approx(
        float(density @ (skill - center) ** 2) ** 0.5, rel=0.02
    )


def test_a_surprise_counts_for_the_title_odds_of_an_uncertain_player() -> None:
    events = begun(80.0)
    weaker = evening(events).pair("W1.4")[1]
    now = outlook(one_played(events))
    seat = now.state.order.index(weaker)
    assert now.odds.title[seat] > 1.3 * now.as_if_sure.title[seat]


def test_a_score_says_how_much_of_a_match_is_left() -> None:
    events = begun()
    called = after(events, "19:05", moves.call(evening(events), "W1.4", 1))
    early, late = (
        after(called, "19:30", moves.score(evening(called), "W1.4", score))
        for score in ((1, 0), (4, 4))
    )
    ends = [outlook(one, "19:30").finish().finish(0.5) for one in (early, called, late)]
    assert ends[0] > ends[1] > ends[2]


def test_more_tables_and_shorter_races_from_here_on() -> None:
    now = outlook(one_played(begun()))
    usual = now.finish().finish(0.5)
    assert now.finish(tables=3).finish(0.5) < usual
    assert now.finish(laws=now.laws_of(Races(4))).finish(0.5) < usual


def test_pace_is_learned_from_matches_that_were_called() -> None:
    events = begun()
    called = after(events, "19:05", moves.call(evening(events), "W1.4", 1))
    result = moves.result(evening(called), "W1.4", (5, 2))
    quick, slow = (outlook(after(called, at, result), "20:30") for at in ("19:25", "20:25"))
    assert [match.minutes for match in slow.timed] == [80.0]
    assert quick.finish().pace.per_game < slow.finish().pace.per_game


def test_a_match_called_late_says_nothing_of_the_pace() -> None:
    events = begun()
    called = after(events, "19:05", moves.call(evening(events), "W1.4", 1))
    result = moves.result(evening(called), "W1.4", (5, 2))
    for at, is_timed in (("19:06", False), ("19:15", False), ("19:16", True)):  # 7 games
        assert bool(outlook(after(called, at, result), "20:30").timed) == is_timed


def test_nothing_is_said_of_a_pace_of_two_matches() -> None:
    events = begun()
    for k, name in enumerate(("W1.4", "W1.2", "W2.1"), start=1):
        events = after(events, "19:05", moves.call(evening(events), name, 1))
        events = after(events, f"19:{30 + k}", moves.result(evening(events), name, (5, 2)))
        now = outlook(events, "20:30")
        assert len(now.timed) == k
        said = "\n".join(str(part) for part in time_under_way(now).parts)
        assert ("tonight is" in said) == (k == 3)


def test_a_player_who_has_gone_home_loses_matches_to_come() -> None:
    events = begun()
    events = after(events, "19:30", moves.drop(evening(events), "P1"))  # has a bye
    now, mean = outlook(events), 0.0
    assert now.odds.title[0] == 0.0
    one, other = (now.state.order.index(name) for name in now.state.pair("W1.4"))
    p = now.laws["W1.4"].win[one, other]
    for chance, score in ((p, (5, 2)), (1.0 - p, (4, 5))):
        ended = after(events, "19:40", moves.result(evening(events), "W1.4", score))
        mean += chance * outlook(ended).odds.title
    np.testing.assert_allclose(now.odds.title, mean, atol=1e-12)
    assert now.laws["W2.1"].mean_games[0, 3] == 0.0


def test_a_match_whose_round_would_wait_can_be_called() -> None:
    events = begun(players=8)
    for name in ("W1.1", "W1.2"):
        events = after(events, "19:40", moves.result(evening(events), name, (5, 1)))
    calls = outlook(events).finish().calls()
    assert {call.match for call in calls} == {"W1.3", "W1.4", "W2.1", "L1.1"}
    assert all(np.isfinite([call.finish_mean, call.later, call.error]).all() for call in calls)
