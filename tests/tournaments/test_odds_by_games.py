"""Title odds from a list with games hold where ratings are off by as much as their games say."""

from itertools import pairwise

import numpy as np
import pytest

from evenbreak.matches.win import race_win_probability
from evenbreak.ratings import SCALES
from evenbreak.ratings.roster import Roster
from evenbreak.tournaments import over_ratings, single_elimination, title_odds

FARGO, NEW, PLAYERS, EVENTS = SCALES["fargo"], 100.0, 16, 120
BINS = np.array([0.0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0])


def win(ratings):
    """Return P(the row's player wins a race to 5 against the column's)."""
    gap = np.asarray(ratings)[:, None] - np.asarray(ratings)
    return race_win_probability(FARGO.win_probability(gap), 5, 5)


@pytest.mark.slow
def test_stated_title_odds_are_how_often_players_win():
    rng, bracket = np.random.default_rng(11), single_elimination(PLAYERS)
    true, stated, sure = [], [], []
    for _ in range(EVENTS):
        games = np.maximum(1, rng.lognormal(3.6, 1.3, PLAYERS)).round().astype(int)
        rating = rng.normal(500.0, 100.0, PLAYERS)
        names = [f"p{k}" for k in range(PLAYERS)]
        club = Roster(names, rating, games=games).with_starters(500.0, NEW, FARGO)
        skill = rating + rng.standard_normal(PLAYERS) * club.standard_error
        found = over_ratings(bracket, win, rating, club.standard_error, samples=200, rng=rng)
        true.append(title_odds(bracket, win(skill)).title)
        stated.append(found.averaged.title)
        sure.append(found.as_if_sure.title)
    wins, odds = np.ravel(true), np.ravel(stated)
    for low, high in pairwise(BINS):
        inside = (odds >= low) & (odds < high)
        error = wins[inside].std() / np.sqrt(inside.sum())
        assert wins[inside].mean() == pytest.approx(odds[inside].mean(), abs=3.5 * error)
    # As if the ratings were sure, favorites are said to win far more often than they do.
    favorites = np.ravel(sure) > 0.5
    error = wins[favorites].std() / np.sqrt(favorites.sum())
    assert wins[favorites].mean() < np.ravel(sure)[favorites].mean() - 3.0 * error
