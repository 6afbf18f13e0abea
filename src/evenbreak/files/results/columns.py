"""The columns of results files, and the English titles for each."""

from __future__ import annotations

import unicodedata
from functools import partial

from evenbreak.files.tables.dates import Day
from evenbreak.files.tables.names import Name
from evenbreak.files.tables.schema import Schema, Text, Whole, Word, YesNo
from evenbreak.ratings.results_frame import FORFEIT_WORDS, FORMAT_WORDS
from evenbreak.words import say

NAMES = ("player_a", "player_b")

_SCORE_WITHOUT = (
    "race_a race_b winner",
    "race winner",
    "racks",
    "score",
    "winner_score loser_score winner loser",
    "winner_race loser_race winner loser",
)
_WINNER_AND_LOSER = ("winner loser",)
_GAMES = Whole(needed=True, instead=_SCORE_WITHOUT, empty=None)
_RACE = Whole(least=1, empty=None, write=say("1, 2, 3, ..., or leave both races empty"))
_NFC = Text(form=partial(unicodedata.normalize, "NFC"))


def _without_blanks(text: str) -> str:
    return "".join(text.casefold().split())


RESULTS = Schema(
    "matches",
    player_a=Name(
        "player 1, player a name, home, home player, a",
        "one of the two players, not necessarily the one who broke",
        needed=True,
        instead=_WINNER_AND_LOSER,
    ),
    player_b=Name(
        "player 2, player b name, away, away player, b",
        "the other player",
        needed=True,
        instead=_WINNER_AND_LOSER,
    ),
    score_a=_GAMES.called(
        "score 1, games a, games 1, home score, frames a, racks won a",
        "how many games player a won",
    ),
    score_b=_GAMES.called(
        "score 2, games b, games 2, away score, frames b, racks won b",
        "how many games player b won",
    ),
    date=Day("day, match date, played, played on"),
    race_a=_RACE.called(
        "race 1, race to a, needs a, home race",
        "how many games player a needed. The winner is then the player who got to their number, "
        "even if the other player won more games",
    ),
    race_b=_RACE.called("race 2, race to b, needs b, away race", "how many games player b needed"),
    winner=Text(
        "won by, match winner, winning player, winner name",
        "the winner of the match: `a`, `b`, or a name; checked against scores and races",
    ),
    first_break=Text(
        "first breaker, breaks first, lag won by", "the player who broke first: `a`, `b`, or a name"
    ),
    break_format=Word(
        "who breaks, breaks next",
        "who breaks the next rack",
        values=FORMAT_WORDS,
        choices=say("winner, loser, alternate, a or b"),
    ),
    racks=Text(
        "rack winners, games in order",
        "the winner of each rack, in order: `abba`; checked against the scores",
        form=_without_blanks,
    ),
    event=_NFC.called("tournament, competition, league"),
    team_a=_NFC.called(
        "team 1, home team",
        "player a's team; ratings use it if it "
        "[clearly helps](../explanation/ratings.md#what-the-file-knows)",
    ),
    team_b=_NFC.called("team 2, away team", "player b's team"),
    division=_NFC.called("class, flight", "the division or class of the match; used like the team"),
    level_a=_NFC.called(
        "level 1, skill level a, skill level 1, class a, class 1, rating a",
        "the class, skill level or rating that the league used for player a that day: `B`, `5` "
        "or `87`; `validate` shows what a class is worth, and which "
        "[chart](../how-to/can-i-trust-the-ratings.md#handicaps) the races come from",
    ),
    level_b=_NFC.called(
        "level 2, skill level b, skill level 2, class b, class 2, rating b", "the same for player b"
    ),
    forfeit=YesNo(
        "walkover, forfeited, no show, w/o",
        "whether the match was a forfeit; forfeits are left out of the ratings, and the answer "
        "tells you how many there were",
        values=FORFEIT_WORDS,
    ),
)
"""The columns of a results file in the standard layout."""

LAYOUTS = Schema(
    loser=Name(
        "losing player, loser name, lost by",
        "used with `winner` instead of the two players; player a is then the winner",
    ),
    score=Text(
        "result, final score, match score", "both scores in one cell: `7-5`, `7:5` or `7/5`"
    ),
    status=Text(
        "", "whether the match was played: `played`, `forfeit`, `bye`, `postponed` and the like"
    ),
    remark=Text("", "used only if all it says is `forfeit`, `bye` or the like"),
    winner_score=Text(
        "winner games, winners score, games won by winner",
        "used with `winner` and `loser` instead of the two scores",
    ),
    loser_score=Text("loser games, losers score, games won by loser", "the same for the loser"),
    race=Text(
        "race to, match race",
        "used instead of `race_a` and `race_b`: `7`, `race to 7`, or `7-5` if the players need "
        "different numbers",
    ),
    winner_race=Text("winner needs, winners race", "how many games the winner needed"),
    loser_race=Text("loser needs, losers race", "how many games the loser needed"),
    winner_team=Text("winners team", "the winner's team"),
    loser_team=Text("losers team", "the loser's team"),
    winner_level=Text(
        "winners level, winner class, winner rating",
        "the winner's class, skill level or rating",
    ),
    loser_level=Text("losers level, loser class, loser rating", "the same for the loser"),
)
"""The columns that are converted to that layout."""

RESULTS_FILE = RESULTS | LAYOUTS
