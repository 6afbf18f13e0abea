"""A tournament before its first match: the players, the bracket, the races, in words."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np

from evenbreak.answers.kit.remarks import file_name
from evenbreak.answers.kit.scales import scale_words
from evenbreak.answers.kit.wording import count_of, some_of
from evenbreak.answers.league.prior import games_words, unrated_words
from evenbreak.answers.tournament.bracket_view import source_words
from evenbreak.arrays import Floats
from evenbreak.files.lists.roster import RosterFile
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.tournaments.brackets.bracket import Bracket, Place, Slot
from evenbreak.tournaments.brackets.numbering import match_numbers
from evenbreak.tournaments.brackets.standing import Standing
from evenbreak.tournaments.evening.plan import TO_DRAW
from evenbreak.tournaments.evening.skills import skills_before
from evenbreak.tournaments.odds.races import Fairest, PairOdds, Race, Races, pair_odds
from evenbreak.words import Sentence, joined, ordinal, say


@dataclass(frozen=True, eq=False)
class Tournament:
    """A tournament before its first match; roster and bracket are in seed order.

    `seeding` says where that order comes from; `to_draw` is what is drawn later: '' (nothing),
    everyone's 'lines', the losers' side's 'qualifiers', or the 'rounds' of a Swiss.
    """

    file: RosterFile
    roster: Roster
    bracket: Bracket
    races: Races
    scale: Scale
    seeding: str
    to_draw: str = ""

    @cached_property
    def laws(self) -> dict[str, PairOdds]:
        """The odds of who wins each match and in how many games, with ratings treated as exact."""
        return self.laws_of(self.races)

    def laws_of(self, races: Races) -> dict[str, PairOdds]:
        """Return the same for different races."""
        form = self.file.form
        return pair_odds(self.bracket, self.ratings, races, scale=self.scale, form=form)

    @property
    def ratings(self) -> Floats:
        """The ratings, in seed order."""
        return self.roster.rating

    @cached_property
    def skills(self) -> tuple[Floats, Floats]:
        """The distribution of the players' skills: mean and covariance (see `skills_before`)."""
        errors = np.nan_to_num(self.roster.standard_error)
        unrated = np.array([name in self.unrated for name in self.roster.players])
        return skills_before(self.ratings, errors, unrated)

    @property
    def heading(self) -> str:
        """What is played, and by whom."""
        return say(
            "{format}: {players} in {file}, {seeding}\n{races}; ratings {scale}",
            format=self.bracket.format[0].upper() + self.bracket.format[1:],
            players=count_of(len(self.roster), "player"),
            file=file_name(self.file),
            seeding=self.seeding,
            races=races_words(self.races),
            scale=scale_words(self.scale),
        )

    @property
    def byes(self) -> str:
        """Who has a bye in the first round, in a sentence; '' if no one does."""
        names = [self.bracket.players[player] for _, player in self.bracket.byes]
        if not names:
            return ""
        return say("Byes in the first round: {players}.", players=some_of(names))

    @property
    def unrated(self) -> tuple[str, ...]:
        """The players who have no rating on the list."""
        read = self.file.roster
        names = (read.players[k] for k in np.flatnonzero(np.isnan(read.rating)).tolist())
        return tuple(name for name in names if name in self.roster.players)  # no bye rows

    def unrated_words(self, *, spread: bool = True) -> str:
        """Return what is assumed about players without a rating or an error; '' if none."""
        said = [games_words(self.file.roster, self.roster)] if spread else []
        if names := self.unrated:
            seat = self.roster.players.index(names[0])
            rating, error = float(self.ratings[seat]), 0.0
            if spread:
                mean, covariance = self.skills
                rating, error = round(mean[seat]), round(math.sqrt(covariance[seat, seat]))
            said.insert(0, unrated_words(names, rating, error))
        return joined(filter(None, said))


def races_words(races: Races) -> Sentence:
    """Return what is played.

    >>> races_words(Races(7, losers=5, final=9))
    "Races to 7 (to 5 on the losers' side, to 9 in the final)"
    >>> races_words(Races(Fairest(7)))
    'Races to 7 for the stronger player; the weaker gets the fairest race'
    """
    if isinstance(races.race, Chart):
        return say("Races from the chart {chart}", chart=races.race.name)
    race, losers, final = (
        None if one is None else _games(one) for one in (races.race, races.losers, races.final)
    )
    if losers is not None and final is not None:
        text = say(
            "Races to {race} (to {losers} on the losers' side, to {final} in the final)",
            race=race,
            losers=losers,
            final=final,
        )
    elif losers is not None:
        text = say("Races to {race} (to {losers} on the losers' side)", race=race, losers=losers)
    elif final is not None:
        text = say("Races to {race} (to {final} in the final)", race=race, final=final)
    else:
        text = say("Races to {race}", race=race)
    if isinstance(races.race, Fairest):
        return say("{races} for the stronger player; the weaker gets the fairest race", races=text)
    return text


def _games(race: Race) -> int | str:
    match race:
        case Fairest(race_to=games):
            return games
        case Chart(name=name):
            return name
    return race


Numbers: TypeAlias = Mapping[str, int]
"""Each match's number, by name."""


def slot_words(bracket: Bracket, slot: Slot, numbers: Numbers | None = None) -> str:
    """Return who is in a match's slot: a name, or where the player comes from."""
    if isinstance(slot, int):
        return bracket.players[slot]
    if slot.match == TO_DRAW:
        return say("a qualifier to be drawn")
    if _of_swiss(bracket, slot):
        return say("to be drawn")
    return source_words(slot, match_numbers(bracket) if numbers is None else numbers)


def met_words(bracket: Bracket, slot: Slot, numbers: Numbers) -> str:
    """Return the opponent of whoever is in a match's slot."""
    if isinstance(slot, int) or slot.match == TO_DRAW or _of_swiss(bracket, slot):
        return slot_words(bracket, slot, numbers)
    if isinstance(slot.outcome, int) and slot.match.isdigit():
        return say("the {runner_up}", runner_up=source_words(slot, {}))
    if isinstance(slot.outcome, int):
        return say("the number {n} player in {group}", n=slot.outcome, group=slot.match)
    if slot.outcome == "winner":
        return say("the winner of match {n}", n=numbers[slot.match])
    return say("the loser of match {n}", n=numbers[slot.match])


def against(pair: Sequence[str]) -> Sentence:
    """Return who plays who.

    >>> against(["Ann", "Bo"])
    'Ann against Bo'
    """
    return say("{a} against {b}", a=pair[0], b=pair[1])


_EVENTS = {"consolation": say("consolation")}


def place_words(place: Place) -> Sentence:
    """Return a place, or the places that several players share.

    >>> place_words(Place(1, 1)), place_words(Place(5, 8))
    ('1st', '5th to 8th')
    """
    if place.first == place.last and not place.event:
        return ordinal(place.first)
    words = ordinal(place.first)
    if place.first != place.last:
        words = say("{first} to {last}", first=words, last=ordinal(place.last))
    if place.event:
        return say("{place} ({event})", place=words, event=_EVENTS[place.event])
    return words


def short_place(place: Place) -> str:
    """Return a place, or the places that several players share, in figures.

    >>> short_place(Place(5, 6)), short_place(Place(1, 1, "consolation"))
    ('5-6', 'consolation 1')
    """
    span = str(place._replace(event=""))
    return joined([_EVENTS[place.event], span]) if place.event else span


def _of_swiss(bracket: Bracket, slot: Slot) -> bool:
    """Return whether a slot belongs to a round that is paired when the round before is over."""
    if isinstance(slot, int) or slot.match not in bracket.by_name:
        return False
    return bracket.by_name[slot.match].side == "Swiss"


def pair_words(now: Standing, match: str, numbers: Numbers | None = None) -> tuple[str, str]:
    """Return who plays a match, as `slot_words` does, using players known by now."""
    one, other = (
        slot_words(now.bracket, slot, numbers)
        if seat is None or _of_swiss(now.bracket, slot)
        else now.bracket.players[seat]
        for slot, seat in zip(now.bracket.match(match).slots, now.seats[match], strict=True)
    )
    return one, other
