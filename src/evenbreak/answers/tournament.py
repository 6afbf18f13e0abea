"""A tournament that is asked about: who is in, the bracket, what is raced to, in words."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from evenbreak.answers.report_frames import file_name
from evenbreak.answers.scale_words import scale_words
from evenbreak.answers.wording import count_of, some_of
from evenbreak.arrays import Floats
from evenbreak.files.roster import RosterFile
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.tournaments.brackets.bracket import Bracket, Slot
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
    """

    file: RosterFile
    roster: Roster
    bracket: Bracket
    races: Races
    scale: Scale
    seeding: str

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
    def shorter_races(self) -> Races | None:
        """All races one game shorter; None where they come from a chart, or one game is all."""
        races = self.races
        found = [_one_less(race) for race in (races.race, races.losers, races.final)]
        given = [race for race in (races.race, races.losers, races.final) if race is not None]
        if found.count(None) > 3 - len(given) or found[0] is None:
            return None
        return replace(races, race=found[0], losers=found[1], final=found[2])

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


def _one_less(race: Race | None) -> Race | None:
    match race:
        case Fairest(race_to=games) if games > 1:
            return Fairest(games - 1)
        case int() if race > 1:
            return race - 1
    return None


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
    if isinstance(slot.outcome, int):
        return f"number {slot.outcome} of {slot.match}"
    return f"{slot.outcome} of {slot.match}"
