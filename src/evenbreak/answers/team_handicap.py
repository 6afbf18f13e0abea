"""The points that the weaker of two teams gets in a round."""

from evenbreak.answers.answer import Answer
from evenbreak.answers.parts import Quantities, Quantity
from evenbreak.answers.scale_words import scale_words
from evenbreak.answers.wording import chance, count_of, decimals, percent
from evenbreak.handicaps.systems.team_handicap import TeamHandicap
from evenbreak.ratings.scale import Scale


def team_handicap_answer(
    averages: tuple[float, float], found: TeamHandicap, *, match_ups: int, scale: Scale
) -> Answer:
    """Return the handicap of a round between two teams of these average ratings.

    >>> from evenbreak.handicaps import team_handicap
    >>> from evenbreak.ratings import SCALES
    >>> fargo = SCALES["fargo"]
    >>> asked = {"match_ups": 3, "scale": fargo}
    >>> print(team_handicap_answer((417, 447), team_handicap(417, 447), **asked).sentences[0])
    Team 1 gets 4 points a round.
    """
    first, second = averages
    return Answer(
        f"Team 1 rated {first:g} on average, team 2 {second:g}, {scale_words(scale)}",
        [
            _in_words(found),
            _how(found, match_ups),
            Quantities(
                [
                    Quantity("average_1", first),
                    Quantity("average_2", second),
                    Quantity("p_game_1", found.p_game_1, "team 1 wins a game", chance),
                    Quantity("scored_1", found.scored_1, "team 1 scores", decimals(3)),
                    Quantity("scored_2", found.scored_2, "team 2 scores", decimals(3)),
                    Quantity("points", found.points, "points a round, rounded"),
                    Quantity("to_team", found.to_team),
                    Quantity(
                        "even_points", found.even_points, "points for an even round", decimals(2)
                    ),
                    Quantity("given_away", found.given_away),
                ]
            ),
        ],
        details=[
            "Every game is taken to be between two players of their teams' average ratings. The "
            "17-point scores of a game average 13.19 for the winner and 3.81 for the loser: CSI "
            "publishes an example, not these numbers, and they are the ones that reproduce it."
        ],
    )


def _in_words(found: TeamHandicap) -> str:
    if found.to_team is None:
        return "Neither team gets points."
    return f"Team {found.to_team} gets {count_of(found.points, 'point')} a round."


def _how(found: TeamHandicap, match_ups: int) -> str:
    gap = abs(found.scored_1 - found.scored_2)
    each = f"{found.scored_1:.2f} and {found.scored_2:.2f} points"
    pairs = count_of(match_ups, "match-up")
    text = f"Over one game in each of {pairs}, the teams should score {each}, {gap:.2f} apart."
    if not found.given_away:
        return text
    return (
        f"{text} That is rounded down and then multiplied by the games of a match-up, "
        f"{found.games}. {found.even_points:.2f} points would make the round even, so the rounding "
        f"keeps {percent(found.given_away)} of them from the weaker team."
    )
