"""A tournament that is asked about: who is in, the bracket, what is raced to, in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from evenbreak.answers.kit.remarks import Remark, file_name
from evenbreak.answers.kit.scales import scale_words
from evenbreak.answers.kit.wording import count_of, some_of
from evenbreak.answers.league.prior import games_words
from evenbreak.arrays import Floats
from evenbreak.files.lists.roster import RosterFile
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.tournaments.brackets.bracket import Bracket, Slot
from evenbreak.tournaments.brackets.standing import Standing
from evenbreak.tournaments.evening.bracket_of_plan import TO_DRAW
from evenbreak.tournaments.odds.races import Fairest, PairOdds, Race, Races, pair_odds


@dataclass(frozen=True, eq=False)
class Tournament:
    """A tournament before its first match.

    Parameters
    ----------
    file
        the list of entrants, as it was read.
    roster
        the entrants in seed order, the new ones with a rating.
    bracket
        who meets whom; its players are those of the roster, in the same order.
    races
        what is played in each match.
    scale
        what the points mean.
    seeding
        where the order of the seeds comes from, in words.
    to_draw
        what is drawn later: '' (nothing), the 'lines' of everybody, the 'qualifiers' of the
        losers' side, or the 'rounds' of a Swiss.
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
        """Who wins each match in how many games, if the ratings are right."""
        return self.laws_of(self.races)

    def laws_of(self, races: Races, *, form: float = 0.0) -> dict[str, PairOdds]:
        """Return the same for other races, or with form of the day."""
        return pair_odds(self.bracket, self.ratings, races, scale=self.scale, form=form)

    @property
    def ratings(self) -> Floats:
        """The ratings, in seed order."""
        return self.roster.rating

    @property
    def heading(self) -> str:
        """What is played by whom."""
        players = count_of(len(self.roster), "player")
        return (
            f"{self.bracket.format[0].upper()}{self.bracket.format[1:]}: {players} in "
            f"{file_name(self.file)}, {self.seeding}\n"
            f"{races_words(self.races)}; ratings {scale_words(self.scale)}"
        )

    @property
    def byes(self) -> str:
        """Who has a bye in the first round, as a sentence; '' if nobody has."""
        names = [self.bracket.players[player] for _, player in self.bracket.byes]
        if not names:
            return ""
        return f"Byes in the first round: {some_of(names)}."

    @property
    def unrated(self) -> tuple[str, ...]:
        """The players who have no rating on the list."""
        read = self.file.roster
        names = (read.players[k] for k in np.flatnonzero(np.isnan(read.rating)).tolist())
        return tuple(name for name in names if name in self.roster.players)  # no bye rows

    def unrated_words(self, *, spread: bool = True) -> str:
        """Return what is assumed of players without a rating or an error; '' of nobody."""
        said = [games_words(self.file.roster, self.roster)] if spread else []
        if names := self.unrated:
            seat = self.roster.players.index(names[0])
            error = float(self.roster.standard_error[seat]) if spread else 0.0
            said.insert(0, unrated_words(names, float(self.roster.rating[seat]), error))
        return " ".join(filter(None, said))


def unrated_words(names: Sequence[str], rating: float, error: float) -> str:
    """Return what is assumed of players without a rating.

    >>> unrated_words(["Ann"], 80.0, 30.0)
    '1 player without a rating (Ann): taken as 80 ± 30.'
    """
    taken = f"taken as {rating:g} ± {error:g}" if error > 0.0 else f"taken as {rating:g}"
    return str(Remark(f"{count_of(len(names), 'player')} without a rating", taken, names))


def races_words(races: Races) -> str:
    """Return what is played.

    >>> races_words(Races(7, losers=5, final=9))
    "Races to 7, on the losers' side to 5, in the final to 9"
    >>> races_words(Races(Fairest(7)))
    'Races to 7 for the stronger player, and the fairest number of games for the weaker'
    """
    if isinstance(races.race, Chart):
        return f"Races by the chart {races.race.name}"
    text = f"Races to {_games(races.race)}"
    if races.losers is not None:
        text += f", on the losers' side to {_games(races.losers)}"
    if races.final is not None:
        text += f", in the final to {_games(races.final)}"
    if isinstance(races.race, Fairest):
        text += " for the stronger player, and the fairest number of games for the weaker"
    return text


def _games(race: Race) -> int | str:
    match race:
        case Fairest(race_to=games):
            return games
        case Chart(name=name):
            return name
    return race


def slot_words(bracket: Bracket, slot: Slot) -> str:
    """Return who is in a slot of a match: a name, or where the player comes from.

    >>> from evenbreak.tournaments import double_elimination
    >>> bracket = double_elimination(["Ann", "Bo", "Cy"])
    >>> [slot_words(bracket, slot) for slot in bracket.match("W2.1").slots]
    ['Ann', 'winner of W1.2']
    """
    if isinstance(slot, int):
        return bracket.players[slot]
    if slot.match == TO_DRAW:
        return "a qualifier to be drawn"
    if _of_swiss(bracket, slot):
        return "to be drawn"
    if isinstance(slot.outcome, int):
        return f"number {slot.outcome} of {slot.match}"
    return f"{slot.outcome} of {slot.match}"


def _of_swiss(bracket: Bracket, slot: Slot) -> bool:
    """Return whether a slot is one of a round that is paired when the round before is over."""
    if isinstance(slot, int) or slot.match not in bracket.by_name:
        return False
    return bracket.by_name[slot.match].side == "Swiss"


def pair_words(now: Standing, match: str) -> tuple[str, str]:
    """Return who plays a match, as `slot_words` does, with the players who are known by now."""
    one, other = (
        slot_words(now.bracket, slot)
        if seat is None or _of_swiss(now.bracket, slot)
        else now.bracket.players[seat]
        for slot, seat in zip(now.bracket.match(match).slots, now.seats[match], strict=True)
    )
    return one, other
