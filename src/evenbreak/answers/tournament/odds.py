"""Who wins tonight's tournament: each player's title odds, and chances of every other place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from evenbreak.answers.columns.shown import band
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.columns import column_of, quantities_of, table_by_column
from evenbreak.answers.kit.parts import Part, Quantities, Table
from evenbreak.answers.kit.scales import form_used_words
from evenbreak.answers.kit.wording import count_of, percent, share_at_a_glance
from evenbreak.answers.tournament.handicap import fairer_races, favors, favors_words
from evenbreak.answers.tournament.tournament import Tournament
from evenbreak.arrays import Floats
from evenbreak.tournaments.brackets.bracket import Place
from evenbreak.tournaments.brackets.double import losers_qualifiers, redrawn
from evenbreak.tournaments.brackets.standing import standing
from evenbreak.tournaments.brackets.swiss import swiss
from evenbreak.tournaments.odds.chances import Wins, chances_of
from evenbreak.tournaments.odds.draws import blind_draw_odds, redraw_odds, swiss_odds
from evenbreak.tournaments.odds.races import chances_given
from evenbreak.tournaments.odds.rematches import expected_rematches
from evenbreak.tournaments.odds.title import PlaceOdds, TitleOdds, title_odds
from evenbreak.tournaments.odds.uncertain import (
    drawn_chances,
    drawn_ratings,
    over_ratings,
    title_bands,
)
from evenbreak.words import Sentence, joined, say

Bands: TypeAlias = Mapping[str, tuple[float, float]]
"""Unrated players' title odds if they are weak, and if they are strong."""

NOTHING: Bands = MappingProxyType({})

_NAMED = {1: "title", 2: "second", 3: "third", 4: "fourth"}
_SHOWN = 3  # places that everybody sees; the others are details


def tournament_odds_answer(
    tournament: Tournament,
    *,
    sure: bool = False,
    walkovers: float = 0.0,
    prizes: Sequence[float] = (),
    fairest: bool = False,
    seed: int = 0,
    warnings: Sequence[str] = (),
) -> Answer:
    """Return each player's chances of each place, averaged over rating errors unless `sure`.

    `walkovers` is the chance that a match is a walkover; `fairest` looks for the races by side that
    make a handicapped tournament fairest.

    >>> from evenbreak.files.lists.roster import RosterFile
    >>> from evenbreak.ratings import SCALES, Roster
    >>> from evenbreak.tournaments import Races, double_elimination
    >>> club = Roster(["Ann", "Bo", "Cy", "Di"], [640, 600, 560, 520])
    >>> file = RosterFile(club, np.arange(2, 6), "club.csv", (), "")
    >>> asked = double_elimination(club.players), Races(5), SCALES["fargo"], "as listed"
    >>> print(tournament_odds_answer(Tournament(file, club, *asked)).sentences[0])
    The favorite is Ann, who wins the tournament 72% of the time; next are Bo (22%) and Cy (4.9%).
    An equal share would be 25%. On average, 6.4 matches are played, 1.3 of them between players
    who have met before; a second final is needed 41% of the time.
    """
    found = solved(tournament, sure=sure, walkovers=walkovers, seed=seed)
    plug_in, odds, bands = found
    quantities = quantities_of(
        {"exact": plug_in.exact and (not found.averaged), "ratings_averaged": found.averaged}
    )
    words = _in_words(odds, bands)
    if isinstance(odds, TitleOdds):
        rng = np.random.default_rng(seed)
        rematches = expected_rematches(tournament.bracket, tournament.laws, rng=rng).mean
        quantities = [
            *quantities_of(
                {
                    "p_second_final": odds.p_second_final,
                    "matches_mean": odds.matches_mean,
                    "rematches_mean": rematches,
                }
            ),
            *quantities,
        ]
        words += f" {_matches_words(odds, rematches)}"
    handicapped = not isinstance(tournament.races.race, int)
    if handicapped:
        words += f"\n{favors_words(tournament.ratings, odds)}"
        quantities += favors(tournament.ratings, odds)
    table = odds_table(tournament.ratings, plug_in, odds, prizes, bands, shares=handicapped)
    parts: list[Part] = [words, Quantities(quantities), table]
    if fairest:
        parts += fairer_races(tournament)
    unrated = tournament.unrated_words(spread=not sure)
    how = how_words(plug_in, odds, walkovers, tournament.to_draw)
    form = form_used_words(tournament.file.form, tournament.scale)
    parts += filter(None, [tournament.byes, unrated, bands_words(bands), form, how])
    return Answer(
        tournament.heading, parts, warnings=[*tournament.file.warnings, *warnings], csv=table
    )


def odds_table(
    ratings: Floats,
    plug_in: PlaceOdds,
    odds: PlaceOdds,
    prizes: Sequence[float] = (),
    bands: Bands = NOTHING,
    *,
    shares: bool = False,
) -> Table:
    """Return each player's chances of each place, next to those with ratings treated as exact.

    `bands` are unrated players' title odds if they are weak, and if they are strong; `shares` adds
    multiples of an equal share.
    """
    places = odds.bracket.places
    seats = range(len(odds.title))
    values: dict[Any, Any] = {
        "seed": range(1, len(seats) + 1),
        "name": odds.bracket.players,
        "-rating": ratings.astype(float),
    }
    for k, place in enumerate(places):
        column = column_of(
            "p_place", detail=k >= _SHOWN, name=place_key(place), place=place_words(place)
        )
        values[column] = odds.p_place[:, k]
        if k == 0 and bands:
            values["-p_title_band"] = [bands.get(name) for name in odds.bracket.players]
    if odds is not plug_in:
        values["p_title_if_sure"] = plug_in.title
        if not plug_in.exact:
            values["p_title_if_sure_error"] = plug_in.error[:, places.index(Place(1, 1))]
    if not odds.exact:
        values |= place_errors(
            {place_key(place): place_words(place) for place in places}, odds.error
        )
    if shares:
        column = column_of("times_equal_share", detail=odds is not plug_in)
        values[column] = len(seats) * odds.title
    if prizes:
        values["prize_mean"] = odds.expected_prize(prizes)
    return table_by_column("players", values, order=favorites(odds, bands))


def bands_words(bands: Bands) -> Sentence | str:
    """Return the range of unrated players' title odds; '' if there are none.

    >>> bands_words({"Di": (0.002, 0.57)})
    'Players without a rating have uncertain title odds: Di 0.2%-57%.'
    """
    each = [say("{name} {band}", name=name, band=band(ends)) for name, ends in bands.items()]
    if not each:
        return ""
    return say(
        "Players without a rating have uncertain title odds: {each}.", each=joined(each, ", ")
    )


def favorites(odds: PlaceOdds, bands: Bands = NOTHING) -> list[int]:
    """Return the players' seats, favorite first.

    An unrated player is placed by the low end of their band: a few games don't make an unknown
    player the favorite.
    """
    players, title = odds.bracket.players, odds.title.tolist()
    known = [bands[name][0] if name in bands else title[k] for k, name in enumerate(players)]
    return sorted(range(len(players)), key=lambda k: (-known[k], -title[k]))


def place_errors(places: Mapping[str, str], error: Floats) -> dict[Any, Any]:
    """Return the columns for the places' standard errors, given their keys and words."""
    columns = (
        "p_title_error" if key == "p_title" else column_of("p_place_error", name=key, place=words)
        for key, words in places.items()
    )
    return dict(zip(columns, error.T, strict=True))


def place_key(place: Place) -> str:
    """Return the key for P(place) in files.

    >>> [place_key(place) for place in (Place(1, 1), Place(5, 6), Place(1, 1, "consolation"))]
    ['p_title', 'p_5_6', 'p_consolation_1']
    """
    if place.first == place.last and not place.event:
        return f"p_{_NAMED.get(place.first, place.first)}"
    return f"p_{place}".replace("-", "_").replace(" ", "_")


def place_words(place: Place) -> str:
    """Return a place as a column heading.

    >>> place_words(Place(2, 2)), place_words(Place(5, 6))
    ('second', '5-6')
    """
    if place.first == place.last and not place.event:
        return _NAMED.get(place.first, str(place))
    return str(place)


def favorite_words(odds: PlaceOdds, bands: Bands = NOTHING) -> str:
    """Return who is likely to win."""
    players, title = odds.bracket.players, odds.title
    alive = [k for k in favorites(odds, bands)[:3] if title[k] > 0.0]
    best, *others = alive
    if not others:
        return f"{players[best]} wins the tournament."
    given = {k: percent(title[k]) for k in alive}
    given |= {
        k: f"no rating: {share_at_a_glance(low)} to {share_at_a_glance(high)}"
        for k in alive
        for low, high in [bands.get(players[k], (0.0, 0.0))]
        if players[k] in bands
    }
    text = (
        f"The favorite is {players[best]}, who wins the tournament {percent(title[best])} of the "
        "time"
    )
    if others:
        following = " and ".join(f"{players[k]} ({given[k]})" for k in others)
        text += f"; next {'are' if len(others) > 1 else 'is'} {following}"
    return f"{text}."


def _in_words(odds: PlaceOdds, bands: Bands) -> str:
    equal = percent(1.0 / len(odds.bracket.players))
    return f"{favorite_words(odds, bands)}\nAn equal share would be {equal}."


def _matches_words(odds: TitleOdds, rematches: float) -> str:
    matches = odds.matches_mean
    if abs(matches - round(matches)) < 1e-9:
        text = f"{count_of(round(matches), 'match is', 'matches are')} played"
    else:
        text = f"On average, {matches:.1f} matches are played"
    if rematches > 0.0:
        text += f", {rematches:.1f} of them between players who have met before"
    if "F2" in odds.bracket.by_name:
        text += f"; a second final is needed {percent(odds.p_second_final)} of the time"
    return f"{text}."


def how_words(
    plug_in: PlaceOdds, odds: PlaceOdds, walkovers: float = 0.0, to_draw: str = ""
) -> str:
    """Return how exact the odds are, what they assume, and what is still to be drawn."""
    averaged = odds is not plug_in
    samples, off = f"{odds.samples:,}", points_off(odds)
    title = points_off(odds, title=True)
    lines = []
    if to_draw == "lines":
        lines.append("These are the odds before the draw; every draw is equally likely.")
    elif to_draw == "qualifiers":
        lines.append("The qualifiers from the losers' side are still to be drawn.")
    if to_draw == "racks" and not odds.exact:
        drawn = ", each time with different ratings" if averaged else ""
        lines.append(
            f"The rest of the evening was played out {samples} times{drawn}; with different "
            f"random numbers, no title odds would move by more than about {title}."
        )
    elif to_draw == "rounds":
        drawn = ", each time with different ratings" if averaged else ""
        lines.append(
            f"The remaining rounds were paired and played {samples} times{drawn}; with different "
            f"random numbers, no title odds would move by more than about {title}."
        )
    elif averaged:
        lines.append(
            f"The odds allow for rating uncertainty: they are averages over {samples} sets of "
            f"ratings, drawn using their standard errors. With different draws, no figure would "
            f"move by more than about {off}."
        )
    elif odds.exact:
        lines.append("The odds are exact, if the ratings are right.")
    elif to_draw == "lines":
        lines.append(
            f"The odds were calculated for {samples} random draws; with different "
            f"draws, no title odds would move by more than about {title}."
        )
    else:
        lines.append(
            f"The first rounds were sampled {samples} times, and the rest was calculated "
            f"exactly; with different samples, no figure would move by more than about {off}."
        )
    if walkovers:
        lines.append(
            f"{percent(walkovers)} of the matches are walkovers for one player or the other."
        )
    return " ".join(lines)


def points_off(odds: PlaceOdds, *, title: bool = False) -> str:
    """Return how much different luck would move sampled odds: for all places, or for the title."""
    points = 200.0 * float(odds.error[:, 0].max() if title else odds.error.max())
    if points < 0.05:
        return "0.1 percentage points"
    return f"{points:.1f} percentage {'point' if f'{points:.1f}' == '1.0' else 'points'}"


_REDRAWS = 6
_RATINGS = 400  # draws of the ratings, each with a draw of the lines or a Swiss of its own


class Solved(NamedTuple):
    """The odds with ratings treated as exact, and averaged over their uncertainty."""

    plug_in: PlaceOdds
    odds: PlaceOdds
    bands: Bands = NOTHING

    @property
    def averaged(self) -> bool:
        """Whether there is anything to average over."""
        return self.odds is not self.plug_in


def solved(tournament: Tournament, *, sure: bool, walkovers: float, seed: int) -> Solved:
    """Return a tournament's odds before its first match."""
    bracket = tournament.bracket
    uncertain = bool(tournament.skills[1].any()) and not sure
    form = tournament.file.form
    win_of = chances_given(
        bracket, tournament.ratings, tournament.races, scale=tournament.scale, form=form
    )
    asked: Any = {"walkovers": walkovers, "rng": np.random.default_rng(seed)}
    if not tournament.to_draw:
        if not uncertain:
            odds = title_odds(bracket, tournament.laws, **asked)
            return Solved(odds, odds)
        both = over_ratings(bracket, win_of, *tournament.skills, **asked)
        if not tournament.unrated:
            return Solved(both.as_if_sure, both.averaged)
        sure_odds = title_odds(bracket, tournament.laws, **asked)
        return Solved(sure_odds, both.averaged, _of_unrated(tournament, both.bands))
    plug_in = _drawn_later(tournament, tournament.laws, asked)
    if not uncertain:
        return Solved(plug_in, plug_in)
    if tournament.to_draw == "qualifiers":
        return Solved(plug_in, *_redrawn(tournament, win_of, asked))
    drawn = drawn_ratings(*tournament.skills, _RATINGS // 2, asked["rng"])
    every = drawn_chances(bracket, win_of, drawn, walkovers=walkovers)
    averaged = _drawn_later(tournament, every, {**asked, "walkovers": 0.0})
    assert averaged.by_draw is not None  # noqa: S101  the ratings were drawn
    bands = title_bands(averaged.by_draw, drawn)
    return Solved(plug_in, averaged, _of_unrated(tournament, bands))


def _of_unrated(tournament: Tournament, bands: Floats) -> Bands:
    """Return the unrated players' bands."""
    seats = {name: tournament.bracket.players.index(name) for name in tournament.unrated}
    return {name: (bands[k, 0], bands[k, 1]) for name, k in seats.items()}


def _drawn_later(tournament: Tournament, win: Wins, asked: Any) -> PlaceOdds:
    bracket = tournament.bracket
    if tournament.to_draw == "lines":
        return blind_draw_odds(bracket, win, **asked)
    if tournament.to_draw == "qualifiers":
        return redraw_odds(bracket, win, **asked)
    chances = chances_of(standing(bracket), win, walkovers=asked["walkovers"])
    first = bracket.matches[0].name
    rounds = max(match.round for match in bracket.matches)
    table = chances.of(first)[:-1, :-1]
    return swiss_odds(swiss(bracket.players, rounds), table, rng=asked["rng"])


def _redrawn(tournament: Tournament, win_of: Any, asked: Any) -> tuple[PlaceOdds, Bands]:
    """Return the odds averaged over the ratings and over some redraws."""
    bracket = tournament.bracket
    qualifiers = losers_qualifiers(bracket)
    laws, bands = [], []
    for _ in range(_REDRAWS):
        order = [qualifiers[k] for k in asked["rng"].permutation(len(qualifiers)).tolist()]
        skills = tournament.skills
        both = over_ratings(redrawn(bracket, order), win_of, *skills, samples=100, **asked)
        laws.append(both.averaged.p_place)
        bands.append(both.bands)
    # How the redraws differ holds both kinds of luck: theirs, and that of the ratings within each.
    error = np.std(laws, axis=0, ddof=1) / np.sqrt(_REDRAWS)
    odds = PlaceOdds(bracket, np.mean(laws, axis=0), error, 100 * _REDRAWS)
    return odds, _of_unrated(tournament, np.mean(bands, axis=0))
